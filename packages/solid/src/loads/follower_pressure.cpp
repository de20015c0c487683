#include "bodies/host_view.hpp"
#include "loads/load_support.hpp"
#include "mortise/solid/loaded_side.hpp"

namespace mortise {
namespace {

/// Let t_1, t_2 be the current tangents of a side (in 2D t_2 = e_z) and n dgamma = t_1 x t_2 w dxi, w = 1, thickness or 2 pi r. Then
///   r_a = integral of N_a p w t_1 x t_2 dxi
///   d r_a / d x_b = integral of N_a p ( w (dN_b/dxi_1 e_j x t_2 + dN_b/dxi_2 t_1 x e_j) + 2 pi N_b (t_1 x t_2) x e_r ) dxi
/// The last term is there if axisymmetric.
class FollowerPressure final : public Load {
 public:
  FollowerPressure(std::shared_ptr<const Bodies> bodies, const FollowerPressureOptions& options)
      : bodies_(std::move(bodies)), pressure_(options.pressure), sides_(sides_at_owned_nodes(*bodies_->mesh(), options.set)) {
    for (const LoadedSide& side : sides_)
      for (const LocalOrdinal a : side.nodes)
        for (const LocalOrdinal b : side.nodes) positions_.push_back(bodies_->space().sparsity().position(a, b));
  }

  bool follows() const override { return true; }

  void add_residual(double time, const Vector& local_displacement, Vector& residual, std::optional<StepFailure>& failure) const override {
    const Mesh& mesh = *bodies_->mesh();
    const HostReadView u(local_displacement);
    const HostWriteView r(residual);
    for (const LoadedSide& side : sides_)
      for (const SidePoint& point : *side.rule) {
        const SidePosition current = side.at(point, mesh, {u.data(), bodies_->space().rows(0)});
        const double force = point.weight * pressure(time, side, point, failure) * bodies_->depth(current.position(0));
        for (std::size_t a = 0; a < side.nodes.size(); ++a)
          if (side.nodes[a] < mesh.owned_count())
            for (int i = 0; i < mesh.dimension; ++i) r.data()[bodies_->space().row(side.nodes[a], i)] += force * point.N[a] * current.area(i);
      }
  }

  void add_jacobian(double time, const Vector& local_displacement, Matrix& matrix, std::optional<StepFailure>& failure,
                    double factor) const override {
    const Mesh& mesh = *bodies_->mesh();
    const HostReadView u(local_displacement);
    const NodalSparsity::Values values = bodies_->space().sparsity().open(matrix);
    const LocalOrdinal* positions = positions_.data();
    for (const LoadedSide& side : sides_) {
      const std::size_t nodes = side.nodes.size();
      for (const SidePoint& point : *side.rule) {
        const SidePosition current = side.at(point, mesh, {u.data(), bodies_->space().rows(0)});
        const double p = factor * point.weight * pressure(time, side, point, failure);
        for (std::size_t b = 0; b < nodes; ++b) {
          const Eigen::Matrix3d change = change_of_area(point, current, b);
          for (std::size_t a = 0; a < nodes; ++a) {
            if (side.nodes[a] >= mesh.owned_count()) continue;
            for (int i = 0; i < mesh.dimension; ++i) {
              double* entries = values.row(bodies_->space().row(side.nodes[a], i)) + positions[nodes * a + b];
              for (int j = 0; j < mesh.dimension; ++j) entries[j] += p * point.N[a] * change(i, j);
            }
          }
        }
      }
      positions += nodes * nodes;
    }
    values.close();
  }

 private:
  /// d (w t_1 x t_2) / d x_b.
  Eigen::Matrix3d change_of_area(const SidePoint& point, const SidePosition& current, std::size_t b) const {
    Eigen::Matrix3d change;
    for (int j = 0; j < 3; ++j)
      change.col(j) = point.gradient[b][0] * Eigen::Vector3d::Unit(j).cross(current.tangents[1]) +
                      point.gradient[b][1] * current.tangents[0].cross(Eigen::Vector3d::Unit(j));
    change *= bodies_->depth(current.position(0));
    if (bodies_->kinematics() == Kinematics::axisymmetric) change.col(0) += 2.0 * EIGEN_PI * point.N[b] * current.area;
    return change;
  }

  double pressure(double time, const LoadedSide& side, const SidePoint& point, std::optional<StepFailure>& failure) const {
    const Eigen::Vector3d X = side.at(point, *bodies_->mesh(), {}).position;
    return evaluate(pressure_, time, {X(0), X(1), X(2)}, failure);
  }

  std::shared_ptr<const Bodies> bodies_;
  ScalarFunction pressure_;
  std::vector<LoadedSide> sides_;
  std::vector<LocalOrdinal> positions_;  ///< [sides x nodes x nodes] NodalSparsity::position
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
