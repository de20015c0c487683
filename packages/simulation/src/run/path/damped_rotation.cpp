#include "run/path/damped_rotation.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <vector>

#include "mortise/core/over_ranks.hpp"

namespace mortise {
namespace {

using Vector3 = Eigen::Vector3d;

constexpr double noticeable_turn = 0.01;  ///< of the largest kinetic energy

/// The velocity v_c + w x (x - x_c) next to that of the nodes of each deformable body, in the mean over its nodes. Collective.
Vector rigid_part(const Model& model, const Vector& displacement, const Vector& velocity) {
  const Mesh& mesh = *model.mesh();
  const FieldSpace& space = model.space();
  const auto u = displacement.getLocalViewHost(Tpetra::Access::ReadOnly), v = velocity.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto bodies = mesh.bodies.size();
  const auto vector_of = [&](LocalOrdinal node, const auto& values) {
    Vector3 result = Vector3::Zero();
    for (int i = 0; i < mesh.dimension; ++i) result[i] = values(space.row(node, i), 0);
    return result;
  };
  const auto place = [&](LocalOrdinal node) -> Vector3 { return Eigen::Map<const Vector3>(mesh.coordinates[node].data()) + vector_of(node, u); };
  Eigen::MatrixXd mine = Eigen::MatrixXd::Zero(7, static_cast<Eigen::Index>(bodies));  // number of nodes, x, v
  for (LocalOrdinal node = 0; node < mesh.owned_body_count(); ++node)
    mine.col(mesh.body_of_node[node]) += (Eigen::Matrix<double, 7, 1>() << 1.0, place(node), vector_of(node, v)).finished();
  const Eigen::MatrixXd means = sum_over_ranks(*mesh.comm, mine);
  const auto centre = [&](std::size_t body) -> Vector3 { return means.col(static_cast<Eigen::Index>(body)).segment<3>(1) / means(0, body); };
  const auto mean_velocity = [&](std::size_t body) -> Vector3 { return means.col(static_cast<Eigen::Index>(body)).tail<3>() / means(0, body); };
  Eigen::MatrixXd mine_of_turns = Eigen::MatrixXd::Zero(12, static_cast<Eigen::Index>(bodies));  // sum of r x v, of |r|^2 I - r r^T
  for (LocalOrdinal node = 0; node < mesh.owned_body_count(); ++node) {
    const Vector3 r = place(node) - centre(mesh.body_of_node[node]);
    const Eigen::Matrix3d inertia = r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose();
    auto sums = mine_of_turns.col(mesh.body_of_node[node]);
    sums.head<3>() += r.cross(vector_of(node, v));
    sums.tail<9>() += Eigen::Map<const Eigen::Matrix<double, 9, 1>>(inertia.data());
  }
  const Eigen::MatrixXd turns = sum_over_ranks(*mesh.comm, mine_of_turns);
  std::vector<Vector3> spin(bodies);
  for (std::size_t body = 0; body < bodies; ++body) {
    const Eigen::Matrix3d inertia = Eigen::Map<const Eigen::Matrix3d>(turns.col(static_cast<Eigen::Index>(body)).data() + 3);
    spin[body] = inertia.completeOrthogonalDecomposition().solve(Vector3(turns.col(static_cast<Eigen::Index>(body)).head<3>()));
  }
  Vector result(velocity.getMap());
  const auto to = result.getLocalViewHost(Tpetra::Access::ReadWrite);
  for (LocalOrdinal node = 0; node < mesh.owned_body_count(); ++node) {
    const auto body = static_cast<std::size_t>(mesh.body_of_node[node]);
    if (mesh.bodies[body].is_surface) continue;
    const Vector3 of_node = mean_velocity(body) + spin[body].cross(place(node) - centre(body));
    for (int i = 0; i < mesh.dimension; ++i) to(space.row(node, i), 0) = of_node[i];
  }
  return result;
}

}  // namespace

void DampedRotationGuard::accept(const SemiSmoothSystem& system, const SystemEvaluation& at) {
  const TimeStep* step = at.context().step.get();
  if (is_said_ || step == nullptr) return;
  const RCP<const Vector> d = system.unknowns(at.x());
  const AcceptedRates rates = rates_at_end(*step, *d, at.external_forces());
  const Vector& v = *rates.velocity;
  largest_ = std::max(largest_, 0.5 * model_.inertia().mass->times(v)->dot(v));
  const Vector rigid = rigid_part(model_, *d, v);
  Vector force(rigid.getMap());
  model_.inertia().stiffness_damping->apply(rigid, force);
  taken_ += step->dt * force.dot(rigid);
  if (!(taken_ > noticeable_turn * largest_)) return;
  is_said_ = true;
  warn_(
      fmt::format("\"stiffness damping\" has taken {:.3g} from rigid-body motions, {:.2g} of the largest kinetic energy: it is that of the reference "
                  "orientation and "
                  "resists turns, so that moments and angular momenta are wrong. Please take \"mass damping\" or dashpots for bodies that turn, or a "
                  "smaller value",
                  taken_, taken_ / largest_));
}

void DampedRotationGuard::serialize(StateArchive& archive) {
  int is_said = is_said_ ? 1 : 0;
  mortise::serialize(archive, "damped_rotation.taken", taken_);
  mortise::serialize(archive, "damped_rotation.largest", largest_);
  mortise::serialize(archive, "damped_rotation.is_said", is_said);
  is_said_ = is_said != 0;
}

}  // namespace mortise
