#pragma once
// Every way to discretise and enforce contact that is not the default.

#include <memory>
#include <string>
#include <vector>

#include "mortise/contact/formulation/augmented_lagrange.hpp"
#include "mortise/contact/formulation/node_to_segment.hpp"
#include "mortise/contact/formulation/penalty.hpp"
#include "mortise/contact/formulation/standard_mortar.hpp"
#include "mortise/contact/formulation/variational_mortar.hpp"

namespace mortise::test {

struct NamedFormulation {
  std::string name;
  std::shared_ptr<Formulation> options;
};

inline std::vector<NamedFormulation> other_formulations() {
  const auto penalty = [](Coupling discretisation) {
    const auto result = std::make_shared<Penalty>();
    result->discretisation = discretisation;
    result->tangential = 30.0;
    return result;
  };
  const auto augmented = [](Coupling discretisation) {
    const auto result = std::make_shared<AugmentedLagrange>();
    result->discretisation = discretisation;
    result->normal = 3.0;
    return result;
  };
  return {{"standard mortar", std::make_shared<StandardMortar>()},
          {"variational mortar", std::make_shared<VariationalMortar>()},
          {"node to segment", std::make_shared<NodeToSegment>()},
          {"penalty", penalty(Coupling::dual_mortar)},
          {"penalty of standard mortar", penalty(Coupling::standard_mortar)},
          {"penalty of node to segment", penalty(Coupling::node_to_segment)},
          {"augmented lagrange", augmented(Coupling::dual_mortar)},
          {"augmented lagrange of standard mortar", augmented(Coupling::standard_mortar)}};
}

/// Whether a formulation exists for 3D surfaces.
inline bool in_space(const NamedFormulation& formulation) {
  const Coupling coupling = formulation.options->coupling();
  return coupling != Coupling::node_to_segment && coupling != Coupling::variational_mortar;
}

}  // namespace mortise::test
