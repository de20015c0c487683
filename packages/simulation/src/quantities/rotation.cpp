// The rotation of a reference point.

#include <Tpetra_Vector.hpp>
#include <boost/math/constants/constants.hpp>

#include "mortise/mesh/reference_point.hpp"
#include "mortise/simulation/quantities/quantity_support.hpp"

namespace mortise {
namespace {

/// Since the start, counterclockwise. [degrees]
struct Rotation : Quantity {
  Located<std::string> point;
  Component component = Component::z;

  void describe(Parameters& parameters) override {
    parameters.add("set", point, Says("a reference point that turns: the name of a tied set, or \"body/reference\" of a rigid body").required());
    parameters.add("component", component, component_names(), "of the rotation vector, in 3D scenes");
  }

  std::unique_ptr<QuantityEvaluator> make_evaluator(const QuantityContext& context) const override {
    const ReferencePoint& turning = require_rotating_point(context.mesh(), point);
    const LocalOrdinal dof = context.space().row(turning.rotation_node, context.mesh().dimension == 3 ? static_cast<int>(component) : 0);
    return evaluator_of([dof, arm = turning.arm](const QuantityContext& at) {
      const auto displacement = at.local_displacement->getLocalViewHost(Tpetra::Access::ReadOnly);
      return displacement(dof, 0) / arm * boost::math::constants::radian<double>();
    });
  }
};

}  // namespace

void add_rotation(Registry<Quantity>& kinds) { kinds.add<Rotation>("rotation", "rotation of a reference point"); }

}  // namespace mortise
