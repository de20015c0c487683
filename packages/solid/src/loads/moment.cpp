#include <fmt/format.h>

#include <algorithm>

#include "bodies/host_view.hpp"
#include "loads/load_support.hpp"
#include "mortise/mesh/reference_point.hpp"
#include "mortise/solid/rotation_vector.hpp"

namespace mortise {
namespace {

/// In 2D a moment works on the angle; the unknown is arm * theta.
class PlaneMoment final : public Load {
 public:
  PlaneMoment(std::shared_ptr<const Bodies> bodies, const ReferencePoint& point, ScalarFunction moment)
      : bodies_(std::move(bodies)), point_(point), moment_(std::move(moment)) {}

  void add_residual(double time, const Vector&, Vector& residual, std::optional<StepFailure>& failure) const override {
    const Mesh& mesh = *bodies_->mesh();
    if (point_.rotation_node >= mesh.owned_count()) return;
    HostWriteView(residual).data()[bodies_->space().row(point_.rotation_node, 0)] -=
        evaluate(moment_, time, mesh.coordinates[point_.node], failure) / point_.arm;
  }

 private:
  std::shared_ptr<const Bodies> bodies_;
  const ReferencePoint& point_;
  ScalarFunction moment_;
};

/// In 3D a moment m works on the spin, m . d omega = T(theta)^T m . d theta. The unknown is q = arm * theta:
///   r = -T^T m / arm,    dr/dq = -d(T^T m)/dtheta / arm^2.
/// The work of a moment of fixed direction depends on the path, so that dr/dq is not symmetric.
class SpaceMoment final : public Load {
 public:
  SpaceMoment(std::shared_ptr<const Bodies> bodies, const ReferencePoint& point, std::array<ScalarFunction, 3> moment)
      : bodies_(std::move(bodies)),
        point_(point),
        moment_(std::move(moment)),
        position_(bodies_->space().sparsity().position(point.rotation_node, point.rotation_node)) {}

  bool follows() const override { return true; }

  void add_residual(double time, const Vector& local_displacement, Vector& residual, std::optional<StepFailure>& failure) const override {
    if (!is_owned()) return;
    const OfRotation force = generalised(time, local_displacement, failure);
    const HostWriteView r(residual);
    for (int i = 0; i < 3; ++i) r.data()[first_dof() + i] -= force.value[i] / point_.arm;
  }

  void add_jacobian(double time, const Vector& local_displacement, Matrix& matrix, std::optional<StepFailure>& failure,
                    double factor) const override {
    if (!is_owned()) return;
    const OfRotation force = generalised(time, local_displacement, failure);
    const NodalSparsity::Values values = bodies_->space().sparsity().open(matrix);
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) values.row(first_dof() + i)[position_ + k] -= factor * force.gradient[k][i] / (point_.arm * point_.arm);
    values.close();
  }

 private:
  bool is_owned() const { return point_.rotation_node < bodies_->mesh()->owned_count(); }
  LocalOrdinal first_dof() const { return bodies_->space().row(point_.rotation_node, 0); }

  OfRotation generalised(double time, const Vector& local_displacement, std::optional<StepFailure>& failure) const {
    const HostReadView u(local_displacement);
    const Eigen::Vector3d theta = Eigen::Vector3d(u.data() + first_dof()) / point_.arm;
    Eigen::Vector3d m;
    for (int i = 0; i < 3; ++i) m[i] = evaluate(moment_[i], time, bodies_->mesh()->coordinates[point_.node], failure);
    return generalised_moment(theta, m);
  }

  std::shared_ptr<const Bodies> bodies_;
  const ReferencePoint& point_;
  std::array<ScalarFunction, 3> moment_;
  LocalOrdinal position_;  ///< of the rotation's own columns in its rows, where it is owned
};

constexpr const char* names[] = {"moment x", "moment y", "moment z"};

}  // namespace

void MomentOptions::describe(Parameters& parameters) {
  parameters.add("set", point, Says("the reference point: the name of a tied set, or \"body/reference\" of a rigid body").required());
  parameters.add("moment", moment, Says("2D, counterclockwise, of t; per model thickness").unit("force length").arguments({"t"}));
  for (int i = 0; i < 3; ++i)
    parameters.add(names[i], moment_vector[i],
                   Says(fmt::format("3D, about an axis along {} that does not turn with the point, of t; left out: none", "xyz"[i]))
                       .unit("force length")
                       .arguments({"t"}));
}

std::unique_ptr<Load> MomentOptions::make(const std::shared_ptr<const Bodies>& bodies) const {
  const Mesh& mesh = *bodies->mesh();
  const bool in_space = mesh.dimension == 3;
  const ReferencePoint* rotating = nullptr;
  look_up(mesh, [&] {
    rotating = &require_rotating_point(mesh, point);
    const char* wanted = in_space ? "\"moment x\", \"moment y\", \"moment z\"" : "\"moment\"";
    if (in_space && moment) throw InputError(moment->place(), fmt::format("\"moment\" is for 2D, the model is in 3D; please give {}", wanted));
    for (int i = 0; i < 3 && !in_space; ++i)
      if (moment_vector[i])
        throw InputError(moment_vector[i]->place(), fmt::format("\"{}\" is for 3D, the model is in 2D; please give {}", names[i], wanted));
    const bool given = moment || std::any_of(moment_vector.begin(), moment_vector.end(), [](const auto& one) { return one.has_value(); });
    if (!given) throw InputError(point.place, fmt::format("a moment on \"{}\" without a value; please give {}", point.value, wanted));
  });
  if (!in_space) return std::make_unique<PlaneMoment>(bodies, *rotating, *moment);
  std::array<ScalarFunction, 3> vector;
  for (int i = 0; i < 3; ++i) vector[i] = moment_vector[i].value_or(ScalarFunction(0.0));
  return std::make_unique<SpaceMoment>(bodies, *rotating, vector);
}

}  // namespace mortise
