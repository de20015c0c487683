#include "run/diagnosis/held_bodies.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>

#include "model/prescribed_rows.hpp"
#include "mortise/core/over_ranks.hpp"

namespace mortise {

std::vector<int> bodies_held_by_contact_only(const Model& model) {
  const Mesh& mesh = *model.mesh();
  std::vector<int> held(mesh.bodies.size(), 0), bodies;
  for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node)
    if (model.held_by_contact_only()[node]) held[mesh.body_of_node[node]] = 1;
  held = most_over_ranks(*mesh.comm, held);
  for (std::size_t body = 0; body < held.size(); ++body)
    if (held[body]) bodies.push_back(static_cast<int>(body));
  return bodies;
}

std::vector<int> without_turning_points(const Mesh& mesh, std::vector<int> bodies) {
  for (const ReferencePoint& point : mesh.reference_points)
    if (point.rotation_node >= 0) bodies.erase(std::remove(bodies.begin(), bodies.end(), mesh.body_of_node[point.node]), bodies.end());
  return bodies;
}

RCP<const Vector> displacement_of(const Model& model, const Vector& x) { return x.offsetView(model.parts().dofs, 0); }

NodePlaces places_at(const Model& model, const Vector& x) { return node_places(model.space(), *displacement_of(model, x)); }

RigidModes modes_at(const Model& model, std::vector<int> bodies, const NodePlaces& at) {
  return RigidModes(*model.mesh(), model.bodies()->kinematics() == Kinematics::axisymmetric, std::move(bodies), at.x);
}

Eigen::MatrixXd held_by_supports(const Model& model, const RigidModes& modes, const NodePlaces& at) {
  return sum_over_ranks(*model.mesh()->comm, prescribed_gram(model.space(), modes, at, model.supports()));
}

Vector outer_forces(const Model& model, const SystemEvaluation& at) {
  Vector contact(model.parts().dofs);
  at.contact_laws().add_force(contact);
  Vector outer(*displacement_of(model, at.residual()), Teuchos::Copy);
  outer.update(-1.0, contact, 1.0);
  return outer;
}

Eigen::RowVectorXd work_of_residual(const FieldSpace& space, const RigidModes& modes, const NodePlaces& at, const MultiVector& fixed,
                                    const Vector& F) {
  const Mesh& mesh = *space.mesh();
  const auto forces = F.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto prescribed = fixed.getLocalViewHost(Tpetra::Access::ReadOnly);
  Eigen::RowVectorXd work = Eigen::RowVectorXd::Zero(modes.count());
  for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node) {
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
    for (int i = 0; i < mesh.dimension; ++i)
      if (prescribed(node, i) == 0.0) force[i] = forces(space.row(node, i), 0);
    modes.add(mesh.body_of_node[node], at.x[node], force, work);
  }
  return work;
}

std::vector<MainMotions> main_motions(const RigidModes& modes, const Eigen::VectorXd& motion) {
  const double largest = motion.cwiseAbs().maxCoeff();
  std::vector<MainMotions> found;
  for (int b = 0; b < static_cast<int>(modes.bodies().size()); ++b) {
    MainMotions own{b, {}};
    for (int m = 0; m < modes.per_body(); ++m)
      if (std::abs(motion[modes.per_body() * b + m]) >= 0.5 * largest) own.names.emplace_back(modes.name(m));
    if (!own.names.empty()) found.push_back(std::move(own));
  }
  return found;
}

std::string to_string(const Mesh& mesh, const RigidModes& modes, const MainMotions& motions) {
  return fmt::format("'{}' ({})", mesh.bodies[modes.bodies()[motions.body]].name, fmt::join(motions.names, ", "));
}

std::string names_of_motion(const Mesh& mesh, const RigidModes& modes, const Eigen::VectorXd& motion) {
  std::vector<std::string> bodies;
  for (const MainMotions& motions : main_motions(modes, motion)) bodies.push_back(to_string(mesh, modes, motions));
  return fmt::format("{}", fmt::join(bodies, ", "));
}

std::string names_of_bodies(const Mesh& mesh, const std::vector<int>& bodies) {
  std::vector<std::string> names;
  for (const int body : bodies) names.push_back(fmt::format("'{}'", mesh.bodies[body].name));
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace mortise
