#pragma once
// Rigid motions that contact holds at one state, in all and pair by pair.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "mortise/contact/holding_nodes.hpp"
#include "mortise/simulation/model/model.hpp"
#include "mortise/simulation/model/rigid_modes.hpp"

namespace mortise {

/// Closed nodes of a pair, those of them that stick, over all ranks.
struct PairHold {
  int closed = 0, sticking = 0;
};

/// Of pairs that touch bodies of the modes.
struct ContactHold {
  Eigen::MatrixXd gram;         ///< [modes.count() squared] sum of the squared work of HoldingRow forces on the motions
  std::vector<PairHold> pairs;  ///< [contact pairs]
};

/// [owned nodes x 1 + dim] body and arm for holding_rows() and sliding_nodes(); arms over the sizes of the bodies.
RCP<MultiVector> contact_places(const Mesh& mesh, const RigidModes& modes, const std::vector<Eigen::Vector3d>& x);

/// [modes.count()] Work of forces of contact on the motions. Bodies of the wrenches are those of the modes.
Eigen::RowVectorXd work_of(const RigidModes& modes, const std::vector<HoldingRow::Wrench>& wrenches);
/// gram += squared work of such forces on the motions.
void add_squared_work(const RigidModes& modes, const std::vector<HoldingRow::Wrench>& wrenches, Eigen::Ref<Eigen::MatrixXd> gram);

/// At the laws of contact at a state with derivatives, where nodes are `at`. Collective.
ContactHold contact_hold(const Model& model, const RigidModes& modes, const NodePlaces& at, const ContactLaws& laws, Holds holds = Holds::by_forces);

/// [bodies] Bodies that a Gram matrix couples have the same number.
std::vector<int> coupled_bodies(const Eigen::MatrixXd& gram, int per_body);

/// Motions that a Gram matrix of what holds them leaves free: orthonormal columns [rows of gram x motions]. Bodies that hold one another are looked
/// at together, others by themselves. A motion is free where what it costs is below hardly_held^2 of the most that another one costs. The bound is
/// not 0 since contact normals turn with the loads, by as much as bodies are strained, and that holds nothing.
/// @param reference  Gram matrix of what else could hold the bodies: where a body has a single motion, no other one tells what counts as little
Eigen::MatrixXd free_motions(const Eigen::MatrixXd& gram, int per_body, double hardly_held = 1e-4, const Eigen::MatrixXd& reference = {});

/// States of pairs in accepted states.
class ContactRecord {
 public:
  void accept(const std::vector<PairHold>& pairs);
  /// Stores or restores it.
  void serialize(StateArchive& archive);
  /// Describes in words the present states of pairs that touch any of some bodies (mesh.bodies indices).
  std::string describe(const Model& model, const std::vector<int>& bodies, const std::vector<PairHold>& now) const;

 private:
  std::vector<PairHold> last_;
  std::vector<char> ever_closed_;
};

}  // namespace mortise
