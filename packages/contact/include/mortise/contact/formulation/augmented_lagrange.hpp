#pragma once

#include "mortise/contact/formulation/penalty.hpp"

namespace mortise {

/// Penalty whose multipliers are updated after each Newton solve until nothing penetrates (Uzawa; Simo, Laursen 1992; on mortar Puso, Laursen 2004).
struct AugmentedLagrange : Formulation {
  Coupling discretisation = Coupling::dual_mortar;
  double normal = 10.0;              ///< stiffness over E / h
  std::optional<double> tangential;  ///< the same along the surface; default: `normal`
  double tolerance = 1e-6;           ///< gap over h
  int augmentations = 50;
  void describe(Parameters& parameters) override;
  Coupling coupling() const override { return discretisation; }
  Elimination elimination() const override { return Elimination::law; }
  std::optional<Regularisation> regularisation() const override {
    return Regularisation{normal, tangential.value_or(normal), augmentations, tolerance};
  }
};

}  // namespace mortise
