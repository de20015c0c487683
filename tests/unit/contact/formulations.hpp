#pragma once
// Every way to discretise and enforce contact that is not the default.

#include <memory>
#include <string>
#include <vector>

#include "mortise/contact/formulation/augmented_lagrange.hpp"
#include "mortise/contact/formulation/node_to_segment.hpp"
#include "mortise/contact/formulation/penalty.hpp"
#include "mortise/contact/formulation/pressure_overclosure.hpp"
#include "mortise/contact/formulation/standard_mortar.hpp"
#include "mortise/contact/formulation/variational_mortar.hpp"
#include "mortise/mortar/coupling/node_to_segment.hpp"
#include "mortise/mortar/coupling/standard_mortar.hpp"
#include "mortise/mortar/coupling/variational_mortar.hpp"

namespace mortise::test {

struct NamedFormulation {
  std::string name;
  std::shared_ptr<Formulation> options;
};

inline std::vector<NamedFormulation> other_formulations() {
  const auto penalty = [](const SharedCoupling& discretisation) {
    const auto result = std::make_shared<Penalty>();
    result->discretisation = discretisation;
    result->tangential = 30.0;
    return result;
  };
  const auto augmented = [](const SharedCoupling& discretisation) {
    const auto result = std::make_shared<AugmentedLagrange>();
    result->discretisation = discretisation;
    result->normal = 3.0;
    return result;
  };
  const auto soft = [](const SharedCoupling& discretisation, const std::shared_ptr<PressureLaw>& law) {
    const auto result = std::make_shared<PressureOverclosure>();
    result->discretisation = discretisation;
    result->law.options = law;
    result->tangential = 40.0;
    return result;
  };
  const auto linear = std::make_shared<LinearPressure>();
  linear->stiffness = 25.0;
  const auto exponential = [](ExponentialPressure::Curve curve) {
    const auto law = std::make_shared<ExponentialPressure>();
    law->clearance = 0.04;
    law->pressure = 1.5;
    law->curve = curve;
    return law;
  };
  const auto table = std::make_shared<TabulatedPressure>();
  table->overclosures = {-0.04, 0.013, 0.047};
  table->pressures = {0.0, 0.7, 2.3};
  return {{"standard mortar", std::make_shared<StandardMortar>()},
          {"variational mortar", std::make_shared<VariationalMortar>()},
          {"node to segment", std::make_shared<NodeToSegment>()},
          {"penalty", penalty(coupling_of<DualMortarCoupling>())},
          {"penalty of standard mortar", penalty(coupling_of<StandardMortarCoupling>())},
          {"penalty of node to segment", penalty(coupling_of<NodeToSegmentCoupling>())},
          {"linear overclosure", soft(coupling_of<DualMortarCoupling>(), linear)},
          {"exponential overclosure", soft(coupling_of<DualMortarCoupling>(), exponential(ExponentialPressure::Curve::from_zero))},
          {"exponential overclosure of standard mortar",
           soft(coupling_of<StandardMortarCoupling>(), exponential(ExponentialPressure::Curve::from_hundredth))},
          {"tabulated overclosure of node to segment", soft(coupling_of<NodeToSegmentCoupling>(), table)},
          {"augmented lagrange", augmented(coupling_of<DualMortarCoupling>())},
          {"augmented lagrange of standard mortar", augmented(coupling_of<StandardMortarCoupling>())}};
}

/// True if a formulation exists for 3D surfaces.
inline bool in_space(const NamedFormulation& formulation) { return formulation.options->coupling()->exists_in(3); }

}  // namespace mortise::test
