// Momentum, angular momentum, and what contact forces change of them.

#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <array>
#include <limits>

#include "mortise/simulation/quantities/quantity_support.hpp"

namespace mortise {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// sum M v, a component. [mass length / time]
struct Momentum : Quantity {
  Component component = Component::x;
  Located<std::string> body;

  void describe(Parameters& parameters) override {
    parameters.add("component", component, component_names(), "direction");
    parameters.add("body", body, "body whose momentum is meant; empty: all");
  }

  std::unique_ptr<QuantityEvaluator> make_evaluator(const QuantityContext& context) const override {
    require_inertia(context);
    require_component(context, component);
    return evaluator_of([i = static_cast<int>(component), of_body = find_optional_body(context, body)](const QuantityContext& at) {
      if (at.motion == nullptr) return none;
      Vector direction(at.space().dofs());
      {
        const auto values = direction.getLocalViewHost(Tpetra::Access::ReadWrite);
        for (LocalOrdinal node = 0; node < at.mesh().owned_count(); ++node) values(at.space().row(node, i), 0) = 1.0;
        for (const ReferencePoint& point : at.mesh().reference_points)
          if (point.rotation_node >= 0 && point.rotation_node < at.mesh().owned_count()) values(at.space().row(point.rotation_node, i), 0) = 0.0;
      }
      return sum_over_body(at, of_body, *at.mass->times(at.motion->velocity), direction);
    });
  }
};

/// sum (x - c) x M v about a fixed point c, in 2D about z. [mass length^2 / time]
struct AngularMomentum : Quantity {
  Component component = Component::z;
  Located<std::string> body;
  std::vector<double> centre;

  void describe(Parameters& parameters) override {
    parameters.add("component", component, component_names(), "axis; in 2D z");
    parameters.add("body", body, "body whose angular momentum is meant; empty: all");
    parameters.add("about", centre, Says("fixed point, \"x, y\" or \"x, y, z\"; left out: the origin").unit("length"));
  }

  std::unique_ptr<QuantityEvaluator> make_evaluator(const QuantityContext& context) const override {
    require_inertia(context);
    const int dimension = context.mesh().dimension;
    if (context.bodies.kinematics() == Kinematics::axisymmetric) throw InputError(Place{}, "an axisymmetric scene has no angular momentum");
    if (dimension == 2 && component != Component::z) throw InputError(Place{}, "in 2D angular momentum has the component z alone");
    if (!centre.empty() && static_cast<int>(centre.size()) != dimension)
      throw InputError(Place{}, "\"about\" needs as many numbers as the scene has dimensions");
    std::array<double, 3> about{};
    std::copy(centre.begin(), centre.end(), about.begin());
    return evaluator_of([axis = static_cast<int>(component), of_body = find_optional_body(context, body), about](const QuantityContext& at) {
      if (at.motion == nullptr) return none;
      const Mesh& mesh = at.mesh();
      Vector arm(at.space().dofs());  // e x (x - c)
      {
        const auto values = arm.getLocalViewHost(Tpetra::Access::ReadWrite);
        const auto u = at.displacement->getLocalViewHost(Tpetra::Access::ReadOnly);
        const int j = (axis + 1) % 3, k = (axis + 2) % 3;
        const auto add = [&](LocalOrdinal node) {
          const auto from_centre = [&](int i) { return mesh.coordinates[node][i] + u(at.space().row(node, i), 0) - about[i]; };
          values(at.space().row(node, j), 0) = -from_centre(k);
          values(at.space().row(node, k), 0) = from_centre(j);
        };
        for (LocalOrdinal node = 0; node < mesh.owned_body_count(); ++node) add(node);
        for (const ReferencePoint& point : mesh.reference_points) {  // point masses
          if (point.node < mesh.owned_count()) add(point.node);
          if (mesh.dimension == 2 && point.rotation_node >= 0 && point.rotation_node < mesh.owned_count())
            values(at.space().row(point.rotation_node, 0), 0) = point.arm;
        }
      }
      return sum_over_body(at, of_body, *at.mass->times(at.motion->velocity), arm);
    });
  }
};

/// The integral of a pair's contact force over time, on the slave side. [force time]
struct Impulse : PairQuantity {
  Component component = Component::x;

  void describe(Parameters& parameters) override {
    PairQuantity::describe(parameters);
    parameters.add("component", component, component_names(), "direction of the force on the slave side");
  }

  std::unique_ptr<QuantityEvaluator> make_evaluator(const QuantityContext& context) const override;
};

class ImpulseEvaluator final : public QuantityEvaluator {
 public:
  explicit ImpulseEvaluator(std::unique_ptr<QuantityEvaluator> force) : force_(std::move(force)) {}

  double evaluate(const QuantityContext& context) override {
    const double now = force_->evaluate(context);
    if (context.motion != nullptr) impulse_ += context.motion->dt * (context.motion->is_over_step ? now : 0.5 * (before_ + now));
    before_ = now;
    return impulse_;
  }

  void serialize(StateArchive& archive, const std::string& name) override {
    mortise::serialize(archive, name + ".impulse", impulse_);
    mortise::serialize(archive, name + ".before", before_);
  }

 private:
  std::unique_ptr<QuantityEvaluator> force_;
  double impulse_ = 0.0, before_ = 0.0;
};

std::unique_ptr<QuantityEvaluator> Impulse::make_evaluator(const QuantityContext& context) const {
  require_inertia(context);
  ContactForce force;
  force.pair = pair;
  force.component = component;
  return std::make_unique<ImpulseEvaluator>(force.make_evaluator(context));
}

}  // namespace

void add_momentum(Registry<Quantity>& kinds) { kinds.add<Momentum>("momentum", "mass times velocity, with inertia"); }
void add_angular_momentum(Registry<Quantity>& kinds) {
  kinds.add<AngularMomentum>("angular momentum", "moment of momentum about a fixed point, with inertia");
}
void add_impulse(Registry<Quantity>& kinds) { kinds.add<Impulse>("impulse", "a contact pair's force, integrated over time, with inertia"); }

}  // namespace mortise
