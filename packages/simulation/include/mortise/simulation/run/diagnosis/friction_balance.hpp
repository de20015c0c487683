#pragma once
// Where bodies that slip come to rest against friction: a convex problem in their rigid motions alone.

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "mortise/contact/frame.hpp"

namespace mortise {

/// A node that slips by v = slip + work q when bodies move by q.
struct SlidingRow {
  double bound = 0.0;    ///< largest |t|
  double weight = 1.0;   ///< v / weight is a length
  TangentVector slip;    ///< of the step so far
  Eigen::MatrixXd work;  ///< [tangents x motions]
};

/// Adds up over ranks, in place. Collective.
using Sum = std::function<void(std::vector<double>&)>;

struct FrictionBalance {
  bool borne = false;                   ///< false: no tractions within the bounds bear the load
  Eigen::VectorXd motion;               ///< q
  std::vector<TangentVector> traction;  ///< [rows] t of each row
};

/// The minimum over q of
///   W(q) = sum_i bound_i |slip_i + work_i q| - load . q.
/// There sum_i work_i^T t_i = load, with t_i = bound_i v_i / |v_i|, and any |t_i| <= bound_i where v_i = 0. In 2D such a point is a corner of W.
/// Newton's method for the rows' own laws cannot find it: on either side W has a slope and no curvature. So |v| is rounded off over a length that
/// falls to 1e-10 of `longest`, or to 1e-6 of the mean slip if that is less.
/// @param load     [motions]
/// @param longest  motions beyond it mean that the load is not borne [length]
FrictionBalance balance_friction(const std::vector<SlidingRow>& rows, const Eigen::VectorXd& load, double longest, const Sum& sum);

}  // namespace mortise
