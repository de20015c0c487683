#include "model/motion/initial_state.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>

#include "model/heat/booked_heat.hpp"
#include "model/heat/heat_of_scene.hpp"
#include "mortise/core/names.hpp"
#include "mortise/core/over_ranks.hpp"
#include "surfaces/body_surfaces.hpp"

namespace mortise {
namespace {

using Vector3 = Eigen::Vector3d;

constexpr double short_time = 1e-3;  ///< over the first step: differences of prescribed functions
constexpr double rigid_round_off = 1e-9;
constexpr double same_place = 1e-9;  ///< over the size of the model
constexpr double same_speed = 1e-3;  ///< over the largest speed at the start: smooth functions are known to differences

Vector3 place(const Mesh& mesh, LocalOrdinal node) { return Eigen::Map<const Vector3>(mesh.coordinates[node].data()); }

/// A function of the reference position. Throws InputError if it is not finite.
double value_at(const ScalarFunction& function, const Vector3& X) {
  const double value = function.at({X[0], X[1], X[2]});
  if (!std::isfinite(value))
    throw InputError(function.place(), fmt::format("\"{}\" is {} at x = {:g}, y = {:g}, z = {:g}", function.source(),
                                                   std::isnan(value) ? std::abs(value) : value, X[0], X[1], X[2]));
  return value;
}

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
      const Vector3 X = place(mesh_, node), spin = omega.cross(X - centre(condition, body));
      for (int i = 0; i < dimension; ++i) {
        if (condition.displacement[i]) u(space_.row(node, i), 0) += value_at(*condition.displacement[i], X);
        if (condition.velocity[i]) v(space_.row(node, i), 0) += value_at(*condition.velocity[i], X);
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
        if (condition.velocity[i]) v(space_.row(point.node, i), 0) += value_at(*condition.velocity[i], X);
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

/// What is prescribed at the start, [prescribed dofs].
struct PrescribedStart {
  std::vector<double> values, velocities;
};

/// Velocities are one-sided differences over a time that is short beside the first step. Collective.
PrescribedStart prescribed_start(const Scene& scene, const Model& model) {
  const AffineConstraints& constraints = *model.parts().constraints;
  const double h = short_time * scene.stepping.step;
  std::optional<StepFailure> failure;
  PrescribedStart start{constraints.prescribed_values(0.0, failure), {}};
  const std::vector<double> next = constraints.prescribed_values(h, failure), after = constraints.prescribed_values(2.0 * h, failure);
  throw_if_any(*model.mesh()->comm, failure);
  for (std::size_t i = 0; i < next.size(); ++i) start.velocities.push_back((4.0 * next[i] - 3.0 * start.values[i] - after[i]) / (2.0 * h));
  return start;
}

void put_prescribed(const Scene& scene, const Model& model, Vector& velocity) {
  const std::vector<double> prescribed = prescribed_start(scene, model).velocities;
  const auto v = velocity.getLocalViewHost(Tpetra::Access::ReadWrite);
  for (std::size_t i = 0; i < prescribed.size(); ++i) v(model.parts().constraints->prescribed()[i], 0) = prescribed[i];
}

/// The largest difference of a prescribed value and that of the body, at nodes of deformable bodies.
struct StartJump {
  double size = 0.0, prescribed = 0.0, of_body = 0.0;
  LocalOrdinal dof = -1;  ///< -1: on another rank
};
StartJump largest_jump(const Model& model, const std::vector<double>& prescribed, const Vector& of_bodies) {
  const Mesh& mesh = *model.mesh();
  const auto values = of_bodies.getLocalViewHost(Tpetra::Access::ReadOnly);
  StartJump mine;
  for (std::size_t i = 0; i < prescribed.size(); ++i) {
    const LocalOrdinal dof = model.parts().constraints->prescribed()[i], node = model.space().place(dof).node;
    if (model.space().place(dof).field != 0) continue;  // a temperature may jump
    if (node >= mesh.owned_body_count() || mesh.bodies[mesh.body_of_node[node]].is_surface) continue;
    const double size = std::abs(prescribed[i] - values(dof, 0));
    if (size > mine.size) mine = {size, prescribed[i], values(dof, 0), dof};
  }
  const double largest = most_over_ranks(*mesh.comm, mine.size);
  if (mine.size < largest) mine = {largest, 0.0, 0.0, -1};
  return mine;
}

/// A text of the rank that has a jump, on all ranks: the first by rank.
std::string of_first_rank(const Communicator& comm, const std::string& text) {
  const int mine = text.empty() ? comm.getSize() : comm.getRank(), root = least_over_ranks(comm, mine);
  if (root == comm.getSize()) return "";
  std::string all = text;
  auto length = static_cast<int>(all.size());
  Teuchos::broadcast(comm, root, 1, &length);
  all.resize(static_cast<std::size_t>(length));
  Teuchos::broadcast(comm, root, length, all.data());
  return all;
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

namespace {

/// Heat that is stored and flows at the start.
void begin_heat(const Model& model, const Vector& unknowns) {
  const HeatOfModel& heat = model.heat();
  if (!heat.bodies) return;
  Vector local(model.space().local_dofs());
  local.doImport(unknowns, *model.space().ghost_import(), Tpetra::INSERT);
  const Configuration start{0.0, unknowns, local};
  if (heat.bulk) heat.bulk->begin(start);
  if (heat.stored) heat.stored->begin(start);
  heat.conduction->begin(start);
  for (const auto& source : heat.sources) source->begin(start);
}

}  // namespace

AcceptedState initial_state(const Scene& scene, const Model& model, const SemiSmoothSystem& system) {
  Vector x(system.map());
  put_initial_temperatures(scene, model.space(), *system.unknowns(x));
  begin_heat(model, *system.unknowns(std::as_const(x)));
  if (!scene.inertia.acts()) return system.initial_state(x);
  Vector velocity(model.parts().dofs);
  Start(scene, model).put(*system.unknowns(x), velocity);
  put_prescribed(scene, model, velocity);
  const AcceptedState state = system.initial_state(x, velocity, scene.inertia.start == InertiaOptions::Start::at_rest);
  refuse_other_motion(scene, model, velocity, *state.rates->velocity);
  return state;
}

std::vector<std::string> jumps_at_start(const Scene& scene, const Model& model) {
  std::vector<std::string> warnings;
  if (!scene.inertia.acts()) return warnings;
  const Mesh& mesh = *model.mesh();
  Vector displacement(model.parts().dofs), velocity(model.parts().dofs);
  Start(scene, model).put(displacement, velocity);
  const PrescribedStart start = prescribed_start(scene, model);
  double fastest = velocity.normInf();
  double mine = 0.0;
  for (const double one : start.velocities) mine = std::max(mine, std::abs(one));
  fastest = std::max(fastest, most_over_ranks(*mesh.comm, mine));
  const auto say = [&](const StartJump& jump, double noticeable, const auto& words) {
    if (!(jump.size > noticeable)) return;
    std::string text;
    if (jump.dof >= 0) {
      const auto [node, component] = std::pair(model.space().place(jump.dof).node, model.space().place(jump.dof).component);
      const std::array<double, 3>& X = mesh.coordinates[node];
      text = words(jump, fmt::format("body \"{}\" at ({:.6g}, {:.6g}, {:.6g}) in {}", mesh.bodies[mesh.body_of_node[node]].name, X[0], X[1], X[2],
                                     "xyz"[component]));
    }
    warnings.push_back(of_first_rank(*mesh.comm, text));
  };
  say(largest_jump(model, start.values, displacement), same_place * model.size().length, [](const StartJump& jump, const std::string& where) {
    return fmt::format(
        "at t = 0 a support prescribes the displacement {:.6g} of {}, which starts with {:.6g}: it is moved there within the first step, with the "
        "work of that. Please give \"initial conditions\" with this displacement, or a function that begins with it",
        jump.prescribed, where, jump.of_body);
  });
  say(largest_jump(model, start.velocities, velocity), same_speed * fastest, [](const StartJump& jump, const std::string& where) {
    return fmt::format(
        "at t = 0 a support gives {} the velocity {:.6g} at once, where it has {:.6g}: a shock wave begins there. Where that is not meant, please "
        "round the function at its beginning, or give \"initial conditions\" with this velocity",
        where, jump.prescribed, jump.of_body);
  });
  return warnings;
}

}  // namespace mortise
