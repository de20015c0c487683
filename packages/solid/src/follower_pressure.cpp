#include "host_view.hpp"
#include "load_support.hpp"

namespace mortise {
namespace {

/// On a side with current end positions x_1, x_2, t = x_2 - x_1 and n dgamma = (t_y, -t_x) w ds over s in [0, 1], w = thickness or 2 pi r:
///   r_a = integral of N_a p w(r) (t_y, -t_x) ds
///   d r_a / d x_b = integral of N_a p ( w  d(t_y, -t_x)/d x_b + 2 pi N_b (t_y, -t_x) x e_r ) ds, the second term if axisymmetric.
class FollowerPressure final : public Load {
 public:
  FollowerPressure(std::shared_ptr<const Bodies> bodies, const FollowerPressureOptions& options)
      : bodies_(std::move(bodies)), pressure_(options.pressure), lines_(sides_at_owned_nodes(*bodies_->mesh(), options.set)) {
    for (const LineNodes& line : lines_)
      for (int a = 0; a < 2; ++a)
        for (int b = 0; b < 2; ++b) positions_.push_back(bodies_->sparsity().position(line[a], line[b]));
  }

  bool follows() const override { return true; }

  void add_residual(double time, const Vector& local_displacement, Vector& residual, std::optional<StepFailure>& failure) const override {
    const HostReadView u(local_displacement);
    const HostWriteView r(residual);
    for (const LineNodes& line : lines_) {
      const Current current = at(line, u.data());
      for (const LineRulePoint& point : line_rule()) {
        const double force = point.weight * pressure(time, line, point, failure) * bodies_->depth(current.radius(point));
        for (int a = 0; a < 2; ++a)
          if (line[a] < bodies_->mesh()->owned_count())
            for (int i = 0; i < 2; ++i) r.data()[2 * line[a] + i] += force * point.N[a] * current.normal[i];
      }
    }
  }

  void add_jacobian(double time, const Vector& local_displacement, Matrix& matrix, std::optional<StepFailure>& failure) const override {
    // normal = (t_y, -t_x): d normal_i / d t_j.
    constexpr double turn[2][2] = {{0.0, 1.0}, {-1.0, 0.0}};
    const bool axisymmetric = bodies_->kinematics() == Kinematics::axisymmetric;
    const HostReadView u(local_displacement);
    const NodalSparsity::Values values = bodies_->sparsity().open(matrix);
    for (std::size_t n = 0; n < lines_.size(); ++n) {
      const LineNodes& line = lines_[n];
      const Current current = at(line, u.data());
      for (const LineRulePoint& point : line_rule()) {
        const double p = point.weight * pressure(time, line, point, failure);
        const double depth = bodies_->depth(current.radius(point));
        for (int a = 0; a < 2; ++a) {
          if (line[a] >= bodies_->mesh()->owned_count()) continue;
          for (int b = 0; b < 2; ++b) {
            const double sign = b == 0 ? -1.0 : 1.0;  // d t / d x_b
            for (int i = 0; i < 2; ++i) {
              double* entries = values.at(line[a], i, positions_[4 * n + 2 * a + b]);
              for (int j = 0; j < 2; ++j) entries[j] += p * point.N[a] * depth * sign * turn[i][j];
              if (axisymmetric) entries[0] += p * point.N[a] * 2.0 * EIGEN_PI * point.N[b] * current.normal[i];
            }
          }
        }
      }
    }
  }

 private:
  struct Current {
    std::array<double, 2> radii, normal;
    double radius(const LineRulePoint& point) const { return point.N[0] * radii[0] + point.N[1] * radii[1]; }
  };

  Current at(const LineNodes& line, const double* u) const {
    std::array<std::array<double, 2>, 2> x;
    for (int a = 0; a < 2; ++a)
      for (int i = 0; i < 2; ++i) x[a][i] = bodies_->mesh()->coordinates[line[a]][i] + u[2 * line[a] + i];
    return {{x[0][0], x[1][0]}, {x[1][1] - x[0][1], x[0][0] - x[1][0]}};
  }

  double pressure(double time, const LineNodes& line, const LineRulePoint& point, std::optional<StepFailure>& failure) const {
    std::array<double, 2> X{};
    for (int a = 0; a < 2; ++a)
      for (int i = 0; i < 2; ++i) X[i] += point.N[a] * bodies_->mesh()->coordinates[line[a]][i];
    return evaluate(pressure_, time, X, failure);
  }

  std::shared_ptr<const Bodies> bodies_;
  Expression pressure_;
  std::vector<LineNodes> lines_;
  std::vector<LocalOrdinal> positions_;  ///< [lines x 2 x 2] NodalSparsity::position
};

}  // namespace

void FollowerPressureOptions::describe(Parameters& parameters) {
  parameters.add("set", set, Says("side set under pressure").required());
  parameters.add("pressure", pressure, Says("force per current area against the outward normal, of t and the reference position").unit("stress"));
}

std::unique_ptr<Load> FollowerPressureOptions::make(const std::shared_ptr<const Bodies>& bodies) const {
  return std::make_unique<FollowerPressure>(bodies, *this);
}

}  // namespace mortise
