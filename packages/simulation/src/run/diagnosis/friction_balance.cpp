#include "mortise/simulation/run/diagnosis/friction_balance.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace mortise {
namespace {

constexpr double first_rounding = 1e-2, last_rounding = 1e-10;  // over `longest`
constexpr double of_slips = 1e-6;                               // the last rounding over the mean slip, if that is less
constexpr int rounding_iterations = 60;                         // of each rounding
constexpr double flat = 1e-12;                                  // of the load that friction could bear: what is left of the gradient

/// W at q, rounded off: |v|_e = (|v|^2 + (e w)^2)^1/2. Its derivatives, and sum bound |work| as a measure of forces.
struct Work {
  double value = 0.0, forces = 0.0;
  Eigen::VectorXd slope;
  Eigen::MatrixXd curvature;
};

/// A rounding that is not small next to the slips leaves all nodes below their bounds, as if all rested. Below round-off of positions slips are
/// nothing.
double last_rounding_of(const std::vector<SlidingRow>& rows, double longest, const Sum& sum) {
  std::vector<double> sums(2, 0.0);
  for (const SlidingRow& row : rows) {
    sums[0] += row.bound * row.slip.norm();
    sums[1] += row.bound * row.weight;
  }
  sum(sums);
  const double mean = sums[1] > 0.0 ? sums[0] / sums[1] : 0.0;
  return std::clamp(of_slips * mean, std::numeric_limits<double>::epsilon() * longest, last_rounding * longest);
}

double rounded(const TangentVector& v, double e) { return std::hypot(v.norm(), e); }

Work work_at(const std::vector<SlidingRow>& rows, const Eigen::VectorXd& load, const Eigen::VectorXd& q, double rounding, const Sum& sum) {
  const Eigen::Index n = q.size();
  std::vector<double> all(static_cast<std::size_t>(2 + n + n * n), 0.0);
  Eigen::Map<Eigen::VectorXd> slope(all.data() + 2, n);
  Eigen::Map<Eigen::MatrixXd> curvature(all.data() + 2 + n, n, n);
  for (const SlidingRow& row : rows) {
    const TangentVector v = row.slip + row.work * q;
    const double length = rounded(v, rounding * row.weight);
    const TangentVector e = v / length;
    all[0] += row.bound * length;
    all[1] += row.bound * row.work.norm();
    slope += row.bound * row.work.transpose() * e;
    // A little of what all directions cost keeps it definite.
    const TangentMatrix turning = (1.0 + 1e-9) * TangentMatrix::Identity(v.size(), v.size()) - e * e.transpose();
    curvature += row.bound / length * row.work.transpose() * turning * row.work;
  }
  sum(all);
  return {all[0] - load.dot(q), all[1], slope - load, curvature};
}

}  // namespace

FrictionBalance balance_friction(const std::vector<SlidingRow>& rows, const Eigen::VectorXd& load, double longest, const Sum& sum) {
  FrictionBalance balance;
  balance.motion = Eigen::VectorXd::Zero(load.size());
  const double last = last_rounding_of(rows, longest, sum);
  double rounding = first_rounding * longest;
  for (bool is_last = false; !is_last;) {
    is_last = rounding <= last;
    Work at = work_at(rows, load, balance.motion, rounding, sum);
    for (int iteration = 0; iteration < rounding_iterations && at.slope.norm() > flat * at.forces; ++iteration) {
      const Eigen::VectorXd step = -at.curvature.ldlt().solve(at.slope);
      const double fall = at.slope.dot(step);
      double share = 1.0;
      Work next = work_at(rows, load, balance.motion + step, rounding, sum);
      // Close to the minimum W does not show what its slope does.
      const auto is_better = [&] { return next.value <= at.value + 1e-4 * share * fall || next.slope.norm() <= 0.5 * at.slope.norm(); };
      for (; !is_better() && share > 1e-6; share *= 0.5) next = work_at(rows, load, balance.motion + 0.5 * share * step, rounding, sum);
      if (!is_better()) break;  // round-off
      balance.motion += share * step;
      at = next;
      if (!(balance.motion.norm() <= longest)) return balance;
    }
    if (!is_last) rounding = std::max(0.1 * rounding, last);
  }
  balance.borne = true;
  for (const SlidingRow& row : rows) {
    const TangentVector v = row.slip + row.work * balance.motion;
    balance.traction.push_back(row.bound / rounded(v, rounding * row.weight) * v);
  }
  return balance;
}

}  // namespace mortise
