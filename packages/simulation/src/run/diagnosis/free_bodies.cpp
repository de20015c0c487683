#include "run/diagnosis/free_bodies.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>

#include "mortise/core/over_ranks.hpp"
#include "mortise/core/trilinos_versions.hpp"
#include "mortise/simulation/run/diagnosis/contact_hold.hpp"
#include "mortise/solid/rotation_vector.hpp"
#include "run/diagnosis/held_bodies.hpp"

namespace mortise {
FreeBodies::FreeBodies(const Model& model, const SystemEvaluation& evaluation, const std::vector<int>& bodies, double momentum_tolerance)
    : model_(model),
      evaluation_(evaluation),
      tolerance_(momentum_tolerance),
      at_(places_at(model, evaluation.x())),
      modes_(modes_at(model, bodies, at_)),
      held_(held_by_supports(model, modes_, at_)) {
  const Mesh& mesh = *model.mesh();
  prescribed_.assign(local_id_count(*model.space().dofs()), 0);
  for (const LocalOrdinal dof : model.parts().constraints->prescribed()) prescribed_[static_cast<std::size_t>(dof)] = 1;
  turning_.assign(static_cast<std::size_t>(mesh.owned_count()), -1);
  for (std::size_t p = 0; p < mesh.reference_points.size(); ++p)
    if (const LocalOrdinal node = mesh.reference_points[p].rotation_node; node >= 0 && node < mesh.owned_count())
      turning_[node] = static_cast<int>(p);
  held_ += contact_hold(model, modes_, at_, evaluation.contact_laws(), Holds::by_conditions).gram;
}

// See move_bodies(): of a point that rotates the second node carries arm theta, whose rates in 3D are T^-1 times the spin.
DofMotion FreeBodies::motion_of(LocalOrdinal node, int component) const {
  const Mesh& mesh = *model_.mesh();
  DofMotion row = DofMotion::Zero(modes_.per_body());
  const int b = modes_.number(mesh.body_of_node[node]);
  if (turning_[node] >= 0) {
    const ReferencePoint& point = mesh.reference_points[turning_[node]];
    const double factor = point.arm / modes_.size(b);
    if (modes_.rotations() == 1 && component == 0) row(modes_.dimension()) = factor;
    if (modes_.rotations() == 3) row.tail<3>() = factor * spin(at_.turned[turning_[node]]).fullPivLu().inverse().row(component);
    return row;
  }
  if (modes_.axisymmetric()) {
    if (component == 1) row(0) = 1.0;
    return row;
  }
  row(component) = 1.0;
  const Eigen::Vector3d moment = ((at_.x[node] - modes_.centre(b)) / modes_.size(b)).cross(Eigen::Vector3d::Unit(component));
  if (modes_.rotations() == 1) row(2) = moment.z();
  if (modes_.rotations() == 3) row.tail<3>() = moment.transpose();
  return row;
}

std::vector<Eigen::MatrixXd> FreeBodies::masses() const {
  const int n = modes_.per_body();
  std::vector<double> mine(static_cast<std::size_t>(n * modes_.count()), 0.0);
  each_dof([&](int b, LocalOrdinal, int, const DofMotion& motion) {
    Eigen::Map<Eigen::MatrixXd>(&mine[static_cast<std::size_t>(n * n * b)], n, n) += motion.transpose() * motion;
  });
  mine = sum_over_ranks(*model_.mesh()->comm, mine);
  std::vector<Eigen::MatrixXd> result;
  for (std::size_t b = 0; b < modes_.bodies().size(); ++b)
    result.emplace_back(Eigen::Map<const Eigen::MatrixXd>(&mine[static_cast<std::size_t>(n * n) * b], n, n));
  return result;
}

Eigen::MatrixXd FreeBodies::works(const Vector& v) const {
  const int n = modes_.per_body();
  std::vector<double> mine(static_cast<std::size_t>(modes_.count()), 0.0);
  {
    const auto values = v.getLocalViewHost(Tpetra::Access::ReadOnly);
    each_dof([&](int b, LocalOrdinal node, int i, const DofMotion& motion) {
      Eigen::Map<Eigen::VectorXd>(&mine[static_cast<std::size_t>(n * b)], n) += values(model_.space().row(node, i), 0) * motion.transpose();
    });
  }
  mine = sum_over_ranks(*model_.mesh()->comm, mine);
  return Eigen::Map<const Eigen::MatrixXd>(mine.data(), n, static_cast<Eigen::Index>(modes_.bodies().size()));
}

// Forces of contact do no work on motions that are free. Those of nodes that have just opened, and still have a multiplier, do not count.
void FreeBodies::find_loads() {
  if (has_loads_) return;
  has_loads_ = true;
  Vector outer(evaluation_.nodal_forces(), Teuchos::Copy), contact(outer.getMap());  // f_int - f_ext
  evaluation_.contact_laws().add_force(contact);
  outer.update(-1.0, contact, 1.0);
  loads_ = -works(outer);
  const auto out = outer.getLocalViewHost(Tpetra::Access::ReadOnly), in = evaluation_.internal_forces().getLocalViewHost(Tpetra::Access::ReadOnly);
  std::vector<double> sums(2 * modes_.bodies().size(), 0.0);
  each_dof([&](int b, LocalOrdinal node, int i, const DofMotion& motion) {
    const auto dof = static_cast<std::size_t>(model_.space().row(node, i));
    sums[2 * static_cast<std::size_t>(b)] += out(dof, 0) * out(dof, 0) + in(dof, 0) * in(dof, 0);
    sums[2 * static_cast<std::size_t>(b) + 1] += motion.squaredNorm();
  });
  sums = sum_over_ranks(*model_.mesh()->comm, sums);
  for (std::size_t b = 0; b < modes_.bodies().size(); ++b) {
    forces_.push_back(sums[2 * b]);
    masses_.push_back(sums[2 * b + 1]);
  }
}

// A load along a motion v of dofs is F . v <= |F| |v|. So one below |v| times what Newton's method accepts as |F| is none.
std::vector<FreeGroup> FreeBodies::groups(const Eigen::MatrixXd& held, double hardly_held) {
  const int n = modes_.per_body();
  const Eigen::MatrixXd free = free_motions(held, n, hardly_held);
  std::vector<FreeGroup> groups;
  if (free.cols() == 0) return groups;
  find_loads();
  const std::vector<int> group_of = coupled_bodies(held, n);
  for (int g = 0; g < static_cast<int>(group_of.size()); ++g) {
    FreeGroup group;
    std::vector<Eigen::Index> rows, columns;
    for (std::size_t b = 0; b < group_of.size(); ++b) {
      if (group_of[b] != g) continue;
      group.bodies.push_back(static_cast<int>(b));
      for (int m = 0; m < n; ++m) rows.push_back(n * static_cast<Eigen::Index>(b) + m);
    }
    if (rows.empty()) continue;
    for (Eigen::Index column = 0; column < free.cols(); ++column)
      if (!free(rows, column).isZero(0.0)) columns.push_back(column);
    if (columns.empty()) continue;
    group.motions = free(rows, columns);
    Eigen::VectorXd load(rows.size());
    double forces = 0.0, mass = 0.0;
    for (std::size_t i = 0; i < group.bodies.size(); ++i) {
      load.segment(n * static_cast<Eigen::Index>(i), n) = loads_.col(group.bodies[i]);
      forces += forces_[static_cast<std::size_t>(group.bodies[i])];
      mass += masses_[static_cast<std::size_t>(group.bodies[i])];
    }
    group.load = group.motions.transpose() * load;
    group.no_load = std::sqrt(mass) * std::max(tolerance_ * std::sqrt(forces), evaluation_.norms().round_off);
    groups.push_back(std::move(group));
  }
  return groups;
}

std::string names_of(const Model& model, const RigidModes& modes, const FreeGroup& group, const Eigen::VectorXd& motion) {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(modes.count());
  const int n = modes.per_body();
  for (std::size_t b = 0; b < group.bodies.size(); ++b) all.segment(n * group.bodies[b], n) = motion.segment(n * static_cast<Eigen::Index>(b), n);
  return names_of_motion(*model.mesh(), modes, all);
}

}  // namespace mortise
