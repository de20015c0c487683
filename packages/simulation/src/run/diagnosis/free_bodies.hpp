#pragma once
// Bodies that contact alone holds, at one iterate: which of their motions nothing holds, and what load acts along them.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "mortise/nonlinear/semi_smooth_system.hpp"
#include "mortise/simulation/model/model.hpp"
#include "mortise/simulation/model/rigid_modes.hpp"

namespace mortise {

/// Bodies that hold one another, and their common motions that nothing holds.
struct FreeGroup {
  std::vector<int> bodies;  ///< numbers in the modes, ascending
  Eigen::MatrixXd motions;  ///< [per_body() x bodies, motions] orthonormal columns
  Eigen::VectorXd load;     ///< [motions] work of f_ext - f_int on them
  double no_load = 0.0;     ///< a load that is no larger is none
  bool is_loaded() const { return load.norm() > no_load; }
};

/// Motion of a dof in each motion of its body.
using DofMotion = Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, 6>;

/// A motion is held where a boundary condition forbids it, where it changes the gap of a closed node, or goes along its tangents if that has
/// friction. A node that slips holds as well: how much it bears is for its law to say.
class FreeBodies {
 public:
  /// Collective.
  /// @param bodies              mesh.bodies indices
  /// @param momentum_tolerance  over the forces on the bodies: of a load below it Newton's method sees nothing
  FreeBodies(const Model& model, const SystemEvaluation& evaluation, const std::vector<int>& bodies, double momentum_tolerance);

  const RigidModes& modes() const { return modes_; }
  /// Positions of the owned nodes.
  const std::vector<Eigen::Vector3d>& places() const { return at_.x; }
  /// [modes().count() squared] What is held: the sum of squared works on the motions.
  const Eigen::MatrixXd& held() const { return held_; }
  /// The groups that are free in some motion where a Gram matrix says what holds; see free_motions(). Collective.
  std::vector<FreeGroup> groups(const Eigen::MatrixXd& held, double hardly_held);

  /// Of a component of an owned node of one of the bodies. [modes().per_body()]
  DofMotion motion_of(LocalOrdinal node, int component) const;
  /// True if a dof is prescribed.
  bool is_prescribed(LocalOrdinal dof) const { return prescribed_[static_cast<std::size_t>(dof)] != 0; }
  /// Of all dofs of the bodies that are not prescribed: visit(number of the body, node, component, motion_of()).
  template <class Visit>
  void each_dof(const Visit& visit) const {
    const Mesh& mesh = *model_.mesh();
    for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node) {
      const int b = modes_.number(mesh.body_of_node[node]);
      for (int i = 0; b >= 0 && i < mesh.dimension; ++i)
        if (!is_prescribed(model_.space().row(node, i))) visit(b, node, i, motion_of(node, i));
    }
  }
  /// [bodies of the modes] Sums over these dofs of m^T m, [per_body() squared] each, with m = motion_of(). Collective.
  std::vector<Eigen::MatrixXd> masses() const;
  /// [per_body() x bodies of the modes] Sums over these dofs of m^T v. Collective.
  Eigen::MatrixXd works(const Vector& v) const;

 private:
  void find_loads();

  const Model& model_;
  const SystemEvaluation evaluation_;
  double tolerance_;
  NodePlaces at_;
  RigidModes modes_;
  Eigen::MatrixXd held_;
  std::vector<char> prescribed_;         ///< [owned dofs]
  std::vector<int> turning_;             ///< [owned nodes] reference point whose rotation the node is, -1: none
  bool has_loads_ = false;               ///< true if the rest has been found
  Eigen::MatrixXd loads_;                ///< [per_body() x bodies] work of f_ext - f_int on each motion
  std::vector<double> forces_, masses_;  ///< [bodies] |f_int|^2 + |f_ext - f_int|^2; the largest sum of squared motions of the dofs
};

/// "'a' (translation in y), 'b' (rotation)": what of a motion of a group is at least half as large as the largest of it.
std::string names_of(const Model& model, const RigidModes& modes, const FreeGroup& group, const Eigen::VectorXd& motion);

}  // namespace mortise
