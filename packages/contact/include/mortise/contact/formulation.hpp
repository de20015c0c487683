#pragma once
// Formulations: how a pair's contact conditions are discretised and enforced. A new one: a struct in formulation/, and its line in
// formulation_registry().

#include <optional>

#include "mortise/core/parameters.hpp"
#include "mortise/mortar/mortar_interface.hpp"

namespace mortise {

/// How the multipliers of a pair leave the linear system.
enum class Elimination {
  momentum,  ///< by the momentum rows of its slave nodes: needs a diagonal D
  law,       ///< by the pair's own conditions, which give z as a function of the displacements
  none       ///< they stay unknowns: a saddle point system
};

/// Conditions with a stiffness instead of exact ones.
struct Regularisation {
  double normal = 0.0;      ///< stiffness over E / h: traction per length is that times E / h
  double tangential = 0.0;  ///< the same along the surface
  int augmentations = 0;    ///< most times that the multipliers are updated within a step; 0: penalty
  double tolerance = 0.0;   ///< error of the multipliers over the largest of the pair that is let be
};

/// The formulation of a contact pair.
struct Formulation : Described {
  virtual Coupling coupling() const = 0;        ///< functions of the multipliers, and where they act
  virtual Elimination elimination() const = 0;  ///< how they leave the linear system
  /// Whether both sides are slaves, one after the other: then the host gives a second ContactPair with the sides exchanged.
  virtual bool two_pass() const { return false; }
  /// No value: the conditions hold exactly.
  virtual std::optional<Regularisation> regularisation() const { return std::nullopt; }
};

/// All formulations by name.
const Registry<Formulation>& formulation_registry();

}  // namespace mortise
