#include "mortise/material/point_driver.hpp"

#include <fmt/format.h>

#include <Eigen/LU>

#include "mortise/material/plane_stress.hpp"

namespace mortise {
namespace {

[[noreturn]] void fail(int step, double time, const std::string& why) {
  throw StepFailure(FailureKind::material, fmt::format("step {} (t = {:g}): {}", step, time, why));
}

/// One law with its history.
template <class Kind>
class Point {
 public:
  explicit Point(const Kind& law) : law_{law} {}

  PointRecord step(int number, const PathPoint& target) {
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        if (a != b || std::find(target.free.begin(), target.free.end(), a) == target.free.end()) F_(a, b) = target.F(a, b);
    if (!target.free.empty()) find_free_stretches(number, target);

    PointRecord record;
    record.step = number;
    record.time = target.time;
    record.F = F_;
    record.kirchhoff = law_.stress(F_, state_);
    if (!record.kirchhoff.allFinite()) fail(number, target.time, "the law finds no stress");
    if constexpr (Kind::small_strain) {
      record.cauchy = record.kirchhoff;
      record.strain = 0.5 * (F_ + F_.transpose()) - Matrix3::Identity();
    } else {
      record.cauchy = record.kirchhoff / F_.determinant();
      const Spectrum b = spectral_decomposition(F_ * F_.transpose());
      record.strain = in_axes_of(b, logarithmic_strain(b));
    }
    if constexpr (has_history<Kind>) {
      record.equivalent_plastic_strain = law_.law.equivalent_plastic_strain(F_, state_);
      state_ = law_.law.updated(F_, state_);
    }
    return record;
  }

 private:
  /// Newton's method for tau_aa = 0 in y_a = ln F_aa, dF = L F with L_aa = d y_a: d tau_aa = sum_b A_aabb d y_b + tau_aa d y_a (no sum over a). Small
  /// strain: in y_a = F_aa with d sigma_aa = sum_b A_aabb d y_b.
  void find_free_stretches(int number, const PathPoint& target) {
    constexpr int most_iterations = 60;
    constexpr double longest = 0.5, shortest = 1e-13;  // of a change of y; below the latter there is but round-off
    const int size = static_cast<int>(target.free.size());
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      const auto [stress, tangent] = law_.template stress_and_tangent<SolidComponents>(F_, state_);
      Eigen::VectorXd residual(size);
      Eigen::MatrixXd slope(size, size);
      for (int p = 0; p < size; ++p) {
        const int a = target.free[p];
        residual(p) = stress(a, a);
        for (int q = 0; q < size; ++q) slope(p, q) = tangent(4 * a, 4 * target.free[q]);
        if (!Kind::small_strain) slope(p, p) += stress(a, a);
      }
      Eigen::VectorXd change = slope.fullPivLu().solve(-residual);
      if (!change.allFinite()) break;
      const double length = change.cwiseAbs().maxCoeff();
      if (length > longest) change *= longest / length;
      for (int p = 0; p < size; ++p) {
        double& stretch = F_(target.free[p], target.free[p]);
        stretch = Kind::small_strain ? stretch + change(p) : stretch * std::exp(change(p));
      }
      if (length <= shortest) return;
    }
    fail(number, target.time,
         fmt::format("no lateral stretch is found that leaves no lateral stress, at F11 = {:g}; smaller steps may help", F_(0, 0)));
  }

  Unconstrained<Kind> law_;
  typename Unconstrained<Kind>::State state_;
  Matrix3 F_ = Matrix3::Identity();  ///< of the last step
};

}  // namespace

double PointRecord::von_mises() const { return std::sqrt(1.5) * (cauchy - cauchy.trace() / 3.0 * Matrix3::Identity()).norm(); }

void drive_point(const Law& law, const std::vector<PathPoint>& path, const std::function<void(const PointRecord&)>& accepted) {
  std::visit(
      [&](const auto& kind) {
        Point point(kind);
        for (std::size_t n = 0; n < path.size(); ++n) accepted(point.step(static_cast<int>(n), path[n]));
      },
      law);
}

}  // namespace mortise
