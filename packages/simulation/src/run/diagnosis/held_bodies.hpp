#pragma once
// Pieces that diagnoses of bodies held by contact alone share: their motions, what holds these, forces on them, and names.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "mortise/simulation/model/model.hpp"
#include "mortise/simulation/model/rigid_modes.hpp"

namespace mortise {

/// mesh.bodies indices of the bodies that only contact holds. Collective.
std::vector<int> bodies_held_by_contact_only(const Model& model);
/// Of some bodies, those without a reference point that turns: its rotation is a degree of freedom of its own.
std::vector<int> without_turning_points(const Mesh& mesh, std::vector<int> bodies);

/// A view into the displacements of x, unknowns of the model's system.
RCP<const Vector> displacement_of(const Model& model, const Vector& x);
/// Where the model is at x.
NodePlaces places_at(const Model& model, const Vector& x);
/// Rigid motions of bodies of the model. Collective.
RigidModes modes_at(const Model& model, std::vector<int> bodies, const NodePlaces& at);

/// What supports hold of rigid motions: prescribed_gram() of all ranks. Collective.
Eigen::MatrixXd held_by_supports(const Model& model, const RigidModes& modes, const NodePlaces& at);
/// The residual without the forces of contact, on the owned dofs.
Vector outer_forces(const Model& model, const SystemEvaluation& at);
/// [modes.count()] Work of the residual F, whose displacements come first, on the motions, without that on prescribed components; this rank's part.
/// @param fixed  Supports::fixed
Eigen::RowVectorXd work_of_residual(const FieldSpace& space, const RigidModes& modes, const NodePlaces& at, const MultiVector& fixed,
                                    const Vector& F);

/// Names of what of a motion of a body is at least half as large as the largest of all bodies.
struct MainMotions {
  int body = 0;  ///< its number in the modes
  std::vector<std::string> names;
};
/// Of the bodies that have any.
/// @param motion  [modes.count()]
std::vector<MainMotions> main_motions(const RigidModes& modes, const Eigen::VectorXd& motion);
/// "'a' (translation in y)".
std::string to_string(const Mesh& mesh, const RigidModes& modes, const MainMotions& motions);
/// Those of all bodies, "'a' (translation in y), 'b' (rotation)".
std::string names_of_motion(const Mesh& mesh, const RigidModes& modes, const Eigen::VectorXd& motion);
/// "'a', 'b'".
std::string names_of_bodies(const Mesh& mesh, const std::vector<int>& bodies);

}  // namespace mortise
