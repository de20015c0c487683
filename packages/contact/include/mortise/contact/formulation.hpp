#pragma once
// Formulations: a coupling and an enforcement, with their options. A new one: a struct in formulation/, and its line in formulation_registry().

#include <memory>

#include "mortise/core/parameters.hpp"
#include "mortise/mortar/coupling.hpp"

namespace mortise {

class Enforcement;

/// An enforcement as a pair holds it.
using SharedEnforcement = std::shared_ptr<const Enforcement>;
/// Conditions that hold exactly, with multipliers that leave the system by the momentum rows of their slave nodes.
SharedEnforcement condensed_multipliers();
/// Conditions that hold exactly, with multipliers that stay unknowns.
SharedEnforcement kept_multipliers();

/// The formulation of a contact pair.
struct Formulation : Described {
  virtual SharedCoupling coupling() const = 0;        ///< functions of the multipliers, and where they act
  virtual SharedEnforcement enforcement() const = 0;  ///< enforcement of the conditions, with these options
  /// True if both sides are slaves, one after the other: then the host gives a second ContactPair with the sides exchanged.
  virtual bool two_pass() const { return false; }
};

/// All formulations by name.
const Registry<Formulation>& formulation_registry();

}  // namespace mortise
