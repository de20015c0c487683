#include "mortise/simulation/run/diagnosis/contact_statics.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "mortise/core/over_ranks.hpp"

namespace mortise {
namespace {

constexpr double no_resistance = 1e-9;  ///< work against a motion over force and motion: forces that bore what is missing would be 1e9 times as large
constexpr int most_rays = 2000;         ///< that are tried: a corner of the cones is met after a few, a round cone after some tens

/// The force of a cone that works most against a motion, of size 1; of no entries: no force works on it.
Eigen::VectorXd most_against(const BearingCone& cone, const Eigen::VectorXd& motion) {
  std::vector<Eigen::VectorXd> forces;
  const Eigen::VectorXd slip = cone.along.transpose() * motion;
  const double speed = slip.norm();
  if (!std::isfinite(cone.friction)) {
    forces.push_back(cone.push);
    if (speed > 0.0) forces.emplace_back(-cone.along * slip / speed);
  } else {
    forces.emplace_back(speed > 0.0 ? Eigen::VectorXd(cone.push - cone.friction / speed * cone.along * slip) : cone.push);
  }
  Eigen::VectorXd best;
  for (const Eigen::VectorXd& force : forces) {
    const double size = force.norm();
    if (size > 0.0 && (best.size() == 0 || motion.dot(force) / size < motion.dot(best))) best = force / size;
  }
  return best;
}

/// Least squares with coefficients >= 0 of some of the rays: those of the others are 0 (Lawson, Hanson 1974, algorithm NNLS).
class Rays {
 public:
  explicit Rays(Eigen::VectorXd load) : load_(std::move(load)), missing_(load_) {}

  const Eigen::VectorXd& missing() const { return missing_; }

  /// False: round-off lets the ray add nothing.
  bool add(const Eigen::VectorXd& ray) {
    const double before = missing_.norm();
    rays_.push_back(ray);
    shares_.push_back(0.0);
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> columns;
    while (!rays_.empty()) {
      columns.compute(matrix());
      const Eigen::VectorXd wanted = columns.solve(-load_);
      double way = 1.0;
      for (std::size_t i = 0; i < rays_.size(); ++i) {
        const double to = wanted[static_cast<Eigen::Index>(i)];
        if (to <= 0.0) way = std::min(way, shares_[i] / (shares_[i] - to + std::numeric_limits<double>::min()));
      }
      for (std::size_t i = 0; i < rays_.size(); ++i) shares_[i] += way * (wanted[static_cast<Eigen::Index>(i)] - shares_[i]);
      if (way >= 1.0) break;
      drop_unused();
    }
    missing_ = load_;
    if (rays_.empty()) return false;
    for (std::size_t i = 0; i < rays_.size(); ++i) missing_ += shares_[i] * rays_[i];
    // Of a difference of large forces the direction is known to their round-off: across the rays it is to its own.
    missing_ += matrix() * columns.solve(-missing_);
    return missing_.norm() < before;
  }

 private:
  Eigen::MatrixXd matrix() const {
    Eigen::MatrixXd columns(load_.size(), static_cast<Eigen::Index>(rays_.size()));
    for (std::size_t i = 0; i < rays_.size(); ++i) columns.col(static_cast<Eigen::Index>(i)) = rays_[i];
    return columns;
  }

  void drop_unused() {
    const double largest = *std::max_element(shares_.begin(), shares_.end());
    for (std::size_t i = rays_.size(); i-- > 0;) {
      if (shares_[i] > std::numeric_limits<double>::epsilon() * largest) continue;
      rays_.erase(rays_.begin() + static_cast<std::ptrdiff_t>(i));
      shares_.erase(shares_.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }

  Eigen::VectorXd load_, missing_;
  std::vector<Eigen::VectorXd> rays_;
  std::vector<double> shares_;
};

}  // namespace

double resistance(const BearingCone& cone, const Eigen::VectorXd& motion) {
  const Eigen::VectorXd force = most_against(cone, motion);
  return force.size() == 0 ? -std::numeric_limits<double>::infinity() : -motion.dot(force) / motion.norm();
}

std::vector<double> best_offer(const Communicator& comm, double score, const std::vector<double>& values, std::size_t size) {
  constexpr double none = std::numeric_limits<double>::lowest();
  const double mine = std::isfinite(score) ? score : none;
  const double best = most_over_ranks(comm, mine);
  if (best == none) return {};
  const int first = least_over_ranks(comm, mine == best ? comm.getRank() : comm.getSize());
  std::vector<double> offer = first == comm.getRank() ? values : std::vector<double>(size);
  Teuchos::broadcast(comm, first, static_cast<int>(size), offer.data());
  return offer;
}

// The ray that works most against what is missing is added to those that have a share, until none works against it. Of all cones only these rays are
// known to every rank, at most as many as there are motions.
BorneLoad bear(const Communicator& comm, const std::vector<BearingCone>& cones, const Eigen::VectorXd& load, double round_off) {
  Rays rays(load);
  double most = 0.0;
  for (int ray = 0; ray < most_rays; ++ray) {
    const Eigen::VectorXd& missing = rays.missing();
    if (missing.norm() <= round_off) return {Bearing::borne, missing};
    most = -std::numeric_limits<double>::infinity();
    const BearingCone* chosen = nullptr;
    for (const BearingCone& cone : cones)
      if (const double against = resistance(cone, missing); against > most) most = against, chosen = &cone;
    std::vector<double> values(1 + static_cast<std::size_t>(load.size()));
    if (chosen != nullptr) {
      values[0] = most;
      const Eigen::VectorXd force = most_against(*chosen, missing);
      std::copy(force.begin(), force.end(), values.begin() + 1);
    }
    values = best_offer(comm, most, values, values.size());
    most = values.empty() ? -std::numeric_limits<double>::infinity() : values[0];
    if (most <= no_resistance) return {Bearing::not_borne, missing};
    if (!rays.add(Eigen::Map<const Eigen::VectorXd>(values.data() + 1, load.size()))) break;
  }
  return {rays.missing().norm() <= round_off ? Bearing::borne : Bearing::undecided, rays.missing()};
}

}  // namespace mortise
