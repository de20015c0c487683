// Loads that do not follow the deformation: nodal force, dead traction, gravity.

#include <fmt/format.h>

#include "bodies/host_view.hpp"
#include "loads/load_support.hpp"
#include "mortise/solid/loaded_side.hpp"

namespace mortise {
namespace {

class NodalForce final : public Load {
 public:
  NodalForce(std::shared_ptr<const Bodies> bodies, const NodalForceOptions& options)
      : bodies_(std::move(bodies)), components_(components(*bodies_, options.x, options.y, options.z)) {
    const Mesh& mesh = *bodies_->mesh();
    look_up(mesh, [&] {
      for (LocalOrdinal node : require_node_set(mesh, options.set))
        if (node < mesh.owned_count()) nodes_.push_back(node);
    });
  }

  void add_residual(double time, const Vector&, Vector& residual, std::optional<StepFailure>& failure) const override {
    const HostWriteView r(residual);
    const int dimension = bodies_->dimension();
    for (LocalOrdinal node : nodes_)
      for (int i = 0; i < dimension; ++i)
        r.data()[bodies_->space().row(node, i)] -= evaluate(components_[i], time, bodies_->mesh()->coordinates[node], failure);
  }

 private:
  std::shared_ptr<const Bodies> bodies_;
  std::vector<ScalarFunction> components_;
  std::vector<LocalOrdinal> nodes_;
};

/// f_a = integral of N_a T dGamma0, in 2D dGamma0 = reference length x thickness or 2 pi R.
class DeadTraction final : public Load {
 public:
  DeadTraction(std::shared_ptr<const Bodies> bodies, const DeadTractionOptions& options)
      : bodies_(std::move(bodies)),
        components_(components(*bodies_, options.x, options.y, options.z)),
        sides_(sides_at_owned_nodes(*bodies_->mesh(), options.set)) {}

  void add_residual(double time, const Vector&, Vector& residual, std::optional<StepFailure>& failure) const override {
    const Mesh& mesh = *bodies_->mesh();
    const HostWriteView r(residual);
    for (const LoadedSide& side : sides_)
      for (const SidePoint& point : *side.rule) {
        const SidePosition reference = side.at(point, mesh, {});
        const auto& X = reference.position;
        const double area = point.weight * reference.area.norm() * bodies_->depth(X(0));
        for (int i = 0; i < mesh.dimension; ++i) {
          const double traction = evaluate(components_[i], time, {X(0), X(1), X(2)}, failure);
          for (std::size_t a = 0; a < side.nodes.size(); ++a)
            if (side.nodes[a] < mesh.owned_count()) r.data()[bodies_->space().row(side.nodes[a], i)] -= area * point.N[a] * traction;
        }
      }
  }

 private:
  std::shared_ptr<const Bodies> bodies_;
  std::vector<ScalarFunction> components_;
  std::vector<LoadedSide> sides_;
};

/// f_a = integral of rho g N_a dV0, and m_a g of point masses.
class Gravity final : public Load {
 public:
  Gravity(const std::shared_ptr<const Bodies>& bodies, const GravityOptions& options)
      : bodies_(bodies),
        body_(options.body.value),
        components_(components(*bodies, options.x, options.y, options.z)),
        masses_(bodies->mesh()->owned_count(), 0.0),
        weighs_(masses_.size(), 0.0) {
    const Mesh& mesh = *bodies->mesh();
    for (LocalOrdinal node = 0; node < mesh.owned_body_count(); ++node)
      if (options.body.value.empty() || mesh.bodies[mesh.body_of_node[node]].name == options.body.value) weighs_[node] = 1.0;
    for (const ReferencePoint& point : mesh.reference_points)  // point masses
      if (point.node < mesh.owned_count() && (body_.empty() || mesh.bodies[mesh.body_of_node[point.node]].name == body_)) weighs_[point.node] = 1.0;
    bool found = false;
    for (std::size_t n = 0; n < bodies->properties().size(); ++n) {
      const BodyProperties& body = bodies->properties()[n];
      if (!options.body.value.empty() && options.body.value != body.name) continue;
      found = true;
      if (body.is_rigid()) continue;  // it has no elements
      const std::vector<double> volumes = bodies->nodal_volumes(static_cast<LocalOrdinal>(n));
      for (std::size_t node = 0; node < masses_.size(); ++node) masses_[node] += body.material->density * volumes[node];
    }
    if (found) return;
    std::string names;
    for (const MeshBody& body : bodies->mesh()->bodies) names += (names.empty() ? "" : ", ") + body.name;
    throw InputError(options.body.place, fmt::format("there is no body \"{}\"; the bodies are: {}", options.body.value, names));
  }

  void add_residual(double time, const Vector&, Vector& residual, std::optional<StepFailure>& failure) const override {
    add(time, -1.0, masses_, residual, failure);
    add_weight_of_points(time, residual, failure);
  }
  bool is_weight() const override { return true; }
  void add_acceleration(double time, Vector& acceleration, std::optional<StepFailure>& failure) const override {
    add(time, 1.0, weighs_, acceleration, failure);
  }

 private:
  /// to += sign factors[node] g
  void add(double time, double sign, const std::vector<double>& factors, Vector& to, std::optional<StepFailure>& failure) const {
    const HostWriteView r(to);
    const std::size_t dimension = components_.size();
    for (std::size_t i = 0; i < dimension; ++i) {
      const double acceleration = sign * evaluate(components_[i], time, {}, failure);
      for (std::size_t node = 0; node < factors.size(); ++node)
        r.data()[bodies_->space().row(static_cast<LocalOrdinal>(node), static_cast<int>(i))] += factors[node] * acceleration;
    }
  }

  void add_weight_of_points(double time, Vector& residual, std::optional<StepFailure>& failure) const {
    const Mesh& mesh = *bodies_->mesh();
    const std::vector<double>& masses = bodies_->point_masses();
    if (masses.empty()) return;
    const HostWriteView r(residual);
    for (std::size_t i = 0; i < components_.size(); ++i) {
      const double acceleration = evaluate(components_[i], time, {}, failure);
      for (LocalOrdinal node = 0; node < static_cast<LocalOrdinal>(masses.size()); ++node)
        if (masses[node] != 0.0 && (body_.empty() || mesh.bodies[mesh.body_of_node[node]].name == body_))
          r.data()[bodies_->space().row(node, static_cast<int>(i))] -= masses[node] * acceleration;
    }
  }

  std::shared_ptr<const Bodies> bodies_;
  std::string body_;  ///< empty: all
  std::vector<ScalarFunction> components_;
  std::vector<double> masses_;  ///< of the owned nodes
  std::vector<double> weighs_;  ///< likewise, 1 on bodies that have weight, else 0
};

}  // namespace

void NodalForceOptions::describe(Parameters& parameters) {
  parameters.add("set", set, Says("node or side set; each of its nodes gets the whole force").required());
  parameters.add("x", x, Says("force on each node in x (axisymmetric: r, on the whole circle), of t and the reference position").unit("force"));
  parameters.add("y", y, Says("force on each node in y (axisymmetric: z, on the whole circle), of t and the reference position").unit("force"));
  parameters.add("z", z, Says("force on each node in z, in three dimensions, of t and the reference position; left out: none").unit("force"));
}

void DeadTractionOptions::describe(Parameters& parameters) {
  parameters.add("set", set, Says("side set that carries the traction").required());
  parameters.add("x", x, Says("force per reference area in x (axisymmetric: r), of t and the reference position").unit("stress"));
  parameters.add("y", y, Says("force per reference area in y (axisymmetric: z), of t and the reference position").unit("stress"));
  parameters.add("z", z, Says("force per reference area in z, in three dimensions, of t and the reference position; left out: none").unit("stress"));
}

void GravityOptions::describe(Parameters& parameters) {
  parameters.add("body", body, Says("the body that has weight; left out: every body"));
  parameters.add("x", x, Says("acceleration in x (axisymmetric: r), of t").unit("length / time^2").arguments({"t"}));
  parameters.add("y", y, Says("acceleration in y (axisymmetric: z), of t").unit("length / time^2").arguments({"t"}));
  parameters.add("z", z, Says("acceleration in z, in three dimensions, of t; left out: none").unit("length / time^2").arguments({"t"}));
}

std::unique_ptr<Load> NodalForceOptions::make(const std::shared_ptr<const Bodies>& bodies) const {
  return std::make_unique<NodalForce>(bodies, *this);
}
std::unique_ptr<Load> DeadTractionOptions::make(const std::shared_ptr<const Bodies>& bodies) const {
  return std::make_unique<DeadTraction>(bodies, *this);
}
std::unique_ptr<Load> GravityOptions::make(const std::shared_ptr<const Bodies>& bodies) const { return std::make_unique<Gravity>(bodies, *this); }

const Registry<LoadOptions>& load_registry() {
  static const Registry<LoadOptions> registry =
      Registry<LoadOptions>()
          .add<NodalForceOptions>("nodal force", "one force on each node of a set")
          .add<SurfaceForceOptions>("surface force", "one force on a whole surface, spread evenly over its reference area")
          .add<MomentOptions>("moment", "a moment on a reference point that rotates")
          .add<DeadTractionOptions>("dead traction", "force per reference area, of fixed direction")
          .add<FollowerPressureOptions>("follower pressure", "pressure on the current surface, against its outward normal")
          .add<GravityOptions>("gravity", "density times acceleration")
          .add<CentrifugalOptions>("centrifugal", "density times speed of rotation squared times distance from the axis");
  return registry;
}

}  // namespace mortise
