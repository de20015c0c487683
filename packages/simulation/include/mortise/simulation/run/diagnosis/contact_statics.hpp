#pragma once
// Statics of rigid bodies: which loads can be borne by pressures and friction at given places.

#include <Eigen/Core>
#include <vector>

#include "mortise/core/types.hpp"

namespace mortise {

/// The forces that one place can bear, as their works on some motions:  p push + along t  with p >= 0, |t| <= friction p; with infinite friction any
/// t.
struct BearingCone {
  Eigen::VectorXd push;   ///< [motions]
  Eigen::MatrixXd along;  ///< [motions x tangents]
  double friction = 0.0;  ///< not below 0
};

enum class Bearing { borne, not_borne, undecided };

struct BorneLoad {
  Bearing bearing = Bearing::undecided;
  /// load + forces of least size. Not borne: this is the motion v along which the load does work, load . v = |v|^2, while no force within its bounds
  /// works against it, f . v >= 0. By Farkas' lemma there is such a motion if and only if the load is not borne.
  Eigen::VectorXd missing;
};

/// The largest work of forces of a cone against a motion, over their size and that of the motion. It is 0 where the place bears the load and the
/// motion neither opens it nor slips more than friction pays for. It is below 0 where the motion opens the place.
double resistance(const BearingCone& cone, const Eigen::VectorXd& motion);

/// Least |load + f| over the sum of all cones. Collective; cones are those of this rank.
/// @param round_off  of the load's works: what is missing up to that is nothing
BorneLoad bear(const Communicator& comm, const std::vector<BearingCone>& cones, const Eigen::VectorXd& load, double round_off);

/// Of the ranks that offer values with a finite score, those of the largest score; of several the first. Empty where none offers any. Collective.
/// @param size  of the values, the same on every rank
std::vector<double> best_offer(const Communicator& comm, double score, const std::vector<double>& values, std::size_t size);

}  // namespace mortise
