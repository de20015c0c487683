#pragma once

#include "mortise/contact/formulation/penalty.hpp"

namespace mortise {

/// Penalty whose multipliers are updated after each Newton solve until nothing penetrates (Uzawa; Simo, Laursen 1992; on mortar Puso, Laursen 2004).
struct AugmentedLagrange : Penalty {
  double tolerance = 1e-6;  ///< error of the multipliers over the largest one
  int augmentations = 50;   ///< most times that the multipliers are updated within a step
  void describe(Parameters& parameters) override;
  SharedEnforcement enforcement() const override;
};

}  // namespace mortise
