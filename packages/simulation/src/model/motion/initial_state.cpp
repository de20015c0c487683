#include "model/motion/initial_state.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>

#include "mortise/core/names.hpp"
#include "surfaces/body_surfaces.hpp"

namespace mortise {
namespace {

using Vector3 = Eigen::Vector3d;

constexpr double short_time = 1e-3;  ///< over the first step: differences of prescribed functions
constexpr double rigid_round_off = 1e-9;

Vector3 place(const Mesh& mesh, LocalOrdinal node) { return Eigen::Map<const Vector3>(mesh.coordinates[node].data()); }

/// Initial conditions, put on the dofs of a model.
class Start {
 public:
  Start(const Scene& scene, const Model& model)
      : scene_(scene), space_(model.space()), mesh_(*space_.mesh()), boxes_(body_boxes(mesh_, reference_places(mesh_))) {}

  void put(Vector& displacement, Vector& velocity) const {
    const auto u = displacement.getLocalViewHost(Tpetra::Access::ReadWrite), v = velocity.getLocalViewHost(Tpetra::Access::ReadWrite);
    std::vector<Diagnostic> diagnostics;
    for (const auto& condition : scene_.initial_conditions) {
      try {
        put(condition.value, u, v);
      } catch (const InputError& error) {
        for (Diagnostic one : error.diagnostics()) {
          if (one.place.path.empty()) one.place = condition.place;
          diagnostics.push_back(std::move(one));
        }
      }
    }
    throw_if_any(*mesh_.comm, diagnostics);
  }

 private:
  template <class View>
  void put(const InitialConditionOptions& condition, const View& u, const View& v) const {
    const int dimension = mesh_.dimension;
    if (dimension == 2 && (condition.displacement[2] || condition.velocity[2] || !condition.axis.empty()))
      throw InputError(Place{}, "z and axes have a meaning in three dimensions only");
    if (!condition.centre.empty() && static_cast<int>(condition.centre.size()) != dimension)
      throw InputError(Place{}, fmt::format("\"centre\" has {} numbers; {} are needed", condition.centre.size(), dimension));
    if (scene_.kinematics == Kinematics::axisymmetric && condition.spin != 0.0) throw InputError(Place{}, "an axisymmetric scene has no spin");
    std::optional<int> of_body;
    std::vector<std::string> names;
    for (const MeshBody& body : mesh_.bodies) {
      if (body.name == condition.body.value) of_body = static_cast<int>(names.size());
      names.push_back(body.name);
    }
    if (!condition.body.value.empty() && !of_body) throw InputError(condition.body.place, unknown_name("body", condition.body.value, names));
    Vector3 axis = Vector3::UnitZ();
    if (!condition.axis.empty()) axis = Eigen::Map<const Vector3>(condition.axis.data()).normalized();
    const Vector3 omega = condition.spin * axis;
    const bool deforms = std::any_of(condition.displacement.begin(), condition.displacement.end(), [](const auto& one) { return one.has_value(); });
    for (LocalOrdinal node = 0; node < mesh_.owned_body_count(); ++node) {
      const int body = mesh_.body_of_node[node];
      if (of_body && body != *of_body) continue;
      const std::array<double, 3>& X = mesh_.coordinates[node];
      const Vector3 spin = omega.cross(place(mesh_, node) - centre(condition, body));
      for (int i = 0; i < dimension; ++i) {
        if (condition.displacement[i]) u(space_.row(node, i), 0) += condition.displacement[i]->at({X[0], X[1], X[2]});
        if (condition.velocity[i]) v(space_.row(node, i), 0) += condition.velocity[i]->at({X[0], X[1], X[2]});
        v(space_.row(node, i), 0) += spin[i];
      }
    }
    for (const ReferencePoint& point : mesh_.reference_points) {
      const int body = mesh_.body_of_node[point.node];
      if (of_body && body != *of_body) continue;
      if (deforms && mesh_.bodies[body].is_surface)
        throw InputError(Place{},
                         fmt::format("body \"{}\" is rigid and starts without displacement; please place its mesh there", mesh_.bodies[body].name));
      const Vector3 X = place(mesh_, point.node), spin = omega.cross(X - centre(condition, body));
      for (int i = 0; i < dimension && point.node < mesh_.owned_count(); ++i) {
        if (condition.velocity[i]) v(space_.row(point.node, i), 0) += condition.velocity[i]->at({X[0], X[1], X[2]});
        v(space_.row(point.node, i), 0) += spin[i];
      }
      if (point.rotation_node < 0 || point.rotation_node >= mesh_.owned_count()) continue;
      if (dimension == 2)
        v(space_.row(point.rotation_node, 0), 0) += point.arm * omega[2];
      else
        for (int i = 0; i < 3; ++i) v(space_.row(point.rotation_node, i), 0) += point.arm * omega[i];
    }
  }

  Vector3 centre(const InitialConditionOptions& condition, int body) const {
    const Box3& box = boxes_[static_cast<std::size_t>(body)];
    Vector3 result = 0.5 * (box.low + box.high);
    if (mesh_.bodies[body].is_surface)
      for (const ReferencePoint& point : mesh_.reference_points)
        if (mesh_.body_of_node[point.node] == body) result = place(mesh_, point.node);
    for (std::size_t i = 0; i < condition.centre.size(); ++i) result[static_cast<Eigen::Index>(i)] = condition.centre[i];
    return result;
  }

  const Scene& scene_;
  const FieldSpace& space_;
  const Mesh& mesh_;
  std::vector<Box3> boxes_;
};

/// One-sided differences of what is prescribed, over a time that is short beside the first step.
void put_prescribed(const Scene& scene, const Model& model, Vector& velocity) {
  const AffineConstraints& constraints = *model.parts().constraints;
  const double h = short_time * scene.stepping.step;
  std::optional<StepFailure> failure;
  const std::vector<double> now = constraints.prescribed_values(0.0, failure), next = constraints.prescribed_values(h, failure),
                            after = constraints.prescribed_values(2.0 * h, failure);
  throw_if_any(*model.mesh()->comm, failure);
  const auto v = velocity.getLocalViewHost(Tpetra::Access::ReadWrite);
  for (std::size_t i = 0; i < now.size(); ++i) v(constraints.prescribed()[i], 0) = (4.0 * next[i] - 3.0 * now[i] - after[i]) / (2.0 * h);
}

/// Velocities of what follows have to be those that were asked for.
void refuse_other_motion(const Scene& scene, const Model& model, const Vector& wanted, const Vector& found) {
  if (!model.parts().rigid) return;
  const Mesh& mesh = *model.mesh();
  const double size = wanted.normInf();
  const auto of_wanted = wanted.getLocalViewHost(Tpetra::Access::ReadOnly), of_found = found.getLocalViewHost(Tpetra::Access::ReadOnly);
  std::vector<Diagnostic> diagnostics;
  for (const LocalOrdinal dof : model.parts().rigid->dofs()) {
    if (std::abs(of_wanted(dof, 0) - of_found(dof, 0)) <= rigid_round_off * size) continue;
    const auto node = static_cast<std::size_t>(model.space().place(dof).node);
    diagnostics.push_back(
        {scene.initial_conditions.empty() ? scene.inertia.place : scene.initial_conditions.front().place,
         fmt::format("the velocity {:.6g} of body \"{}\" at ({:.6g}, {:.6g}, {:.6g}) is none of a rigid-body motion, which would be "
                     "{:.6g} there; please give velocities that do not depend on the position, and \"spin\"",
                     of_wanted(dof, 0), mesh.bodies[mesh.body_of_node[node]].name, mesh.coordinates[node][0], mesh.coordinates[node][1],
                     mesh.coordinates[node][2], of_found(dof, 0))});
    break;
  }
  throw_if_any(*mesh.comm, diagnostics);
}

}  // namespace

AcceptedState initial_state(const Scene& scene, const Model& model, const SemiSmoothSystem& system) {
  Vector x(system.map());
  if (!scene.inertia.acts()) return system.initial_state(x);
  Vector velocity(model.parts().dofs);
  Start(scene, model).put(*system.unknowns(x), velocity);
  put_prescribed(scene, model, velocity);
  const AcceptedState state = system.initial_state(x, velocity, scene.inertia.start == InertiaOptions::Start::at_rest);
  refuse_other_motion(scene, model, velocity, *state.rates->velocity);
  return state;
}

}  // namespace mortise
