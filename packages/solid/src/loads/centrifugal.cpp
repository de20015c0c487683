// The force of a frame that rotates with the bodies.

#include <fmt/format.h>

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>

#include "bodies/host_view.hpp"
#include "loads/load_support.hpp"
#include "mortise/core/trilinos_versions.hpp"
#include "mortise/solid/nodal_mass.hpp"

namespace mortise {
namespace {

/// f_a = omega^2 sum_b M_ab P (x_b - c) with the consistent mass M and a point c of the axis. P = 1 - e e^T for an axis along e. In 2D e is across
/// the plane; axisymmetric P leaves the radius alone. The force stands on current positions: d f_a / d x_b = omega^2 M_ab P.
class Centrifugal final : public Load {
 public:
  Centrifugal(std::shared_ptr<const Bodies> bodies, const CentrifugalOptions& options)
      : bodies_(std::move(bodies)), speed_(options.speed), mass_(consistent_mass(*bodies_)) {
    look_up(*bodies_->mesh(), [&] { set_axis(options); });
    const Mesh& mesh = *bodies_->mesh();
    bool is_known = false, has_mass = false;
    for (const BodyProperties& body : bodies_->properties()) {
      if (!options.body.value.empty() && options.body.value != body.name) continue;
      is_known = true;
      has_mass = has_mass || (!body.is_rigid() && body.material->density > 0.0);
    }
    if (!is_known) {
      std::string names;
      for (const MeshBody& body : mesh.bodies) names += (names.empty() ? "" : ", ") + body.name;
      throw InputError(options.body.place, fmt::format("there is no body \"{}\"; the bodies are: {}", options.body.value, names));
    }
    if (!has_mass)
      throw InputError(options.body.place, "no body that the load acts on has a \"density\", so that there would be no force; please give one");
    for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node)
      turns_.push_back(node < mesh.owned_body_count() &&
                       (options.body.value.empty() || mesh.bodies[mesh.body_of_node[node]].name == options.body.value));
    for (const ReferencePoint& point : mesh.reference_points)  // point masses
      if (point.node < mesh.owned_count() && (options.body.value.empty() || mesh.bodies[mesh.body_of_node[point.node]].name == options.body.value))
        turns_[static_cast<std::size_t>(point.node)] = true;
  }

  bool follows() const override { return true; }

  void add_residual(double time, const Vector& local_displacement, Vector& residual, std::optional<StepFailure>& failure) const override {
    const double square = square_of_speed(time, failure);
    const HostReadView u(local_displacement);
    const HostWriteView r(residual);
    for_each_entry([&](LocalOrdinal node, LocalOrdinal other, double mass) {
      const Eigen::Vector3d force = square * mass * across_ * (position(other, u) - point_);
      for (int i = 0; i < bodies_->dimension(); ++i) r.data()[bodies_->space().row(node, i)] -= force(i);
    });
  }

  void add_jacobian(double time, const Vector&, Matrix& matrix, std::optional<StepFailure>& failure, double factor) const override {
    const double square = factor * square_of_speed(time, failure);
    const NodalSparsity& sparsity = bodies_->space().sparsity();
    const NodalSparsity::Values values = sparsity.open(matrix);
    for_each_entry([&](LocalOrdinal node, LocalOrdinal other, double mass) {
      const LocalOrdinal place = sparsity.position(node, other);
      if (place < 0) return;
      for (int i = 0; i < bodies_->dimension(); ++i) {
        double* const entries = values.row(bodies_->space().row(node, i)) + place;
        for (int j = 0; j < bodies_->dimension(); ++j) entries[j] -= square * mass * across_(i, j);
      }
    });
    values.close();
  }

 private:
  void set_axis(const CentrifugalOptions& options) {
    const std::size_t dimension = static_cast<std::size_t>(bodies_->dimension());
    const bool is_axisymmetric = bodies_->kinematics() == Kinematics::axisymmetric;
    if (is_axisymmetric && !options.point.empty())
      throw InputError(options.body.place, "\"point\" has no meaning here: axisymmetric bodies turn about their axis; please leave it out");
    if (!options.point.empty() && options.point.size() != dimension)
      throw InputError(options.body.place,
                       fmt::format("\"point\" has {} numbers; this {}D model needs {}", options.point.size(), dimension, dimension));
    for (std::size_t i = 0; i < options.point.size(); ++i) point_(static_cast<Eigen::Index>(i)) = options.point[i];
    if (dimension == 2) {
      if (!options.axis.empty()) throw InputError(options.body.place, "\"axis\" is for 3D: bodies of a plane turn in it; please leave it out");
      across_.setIdentity();
      if (is_axisymmetric) across_(1, 1) = 0.0;
      return;
    }
    Eigen::Vector3d axis = Eigen::Vector3d::Zero();
    if (options.axis.size() == 3) axis = Eigen::Map<const Eigen::Vector3d>(options.axis.data());
    if (!(axis.norm() > 0.0) || !axis.allFinite())
      throw InputError(options.body.place, "\"axis\" has to be a direction in 3D, \"x, y, z\", of any length above 0");
    axis.normalize();
    across_ = Matrix3::Identity() - axis * axis.transpose();
  }

  double square_of_speed(double time, std::optional<StepFailure>& failure) const {
    const double speed = evaluate(speed_, time, {}, failure);
    return speed * speed;
  }

  Eigen::Vector3d position(LocalOrdinal node, const HostReadView& u) const {
    Eigen::Vector3d x = Eigen::Map<const Eigen::Vector3d>(bodies_->mesh()->coordinates[static_cast<std::size_t>(node)].data());
    for (int i = 0; i < bodies_->dimension(); ++i) x(i) += u.data()[bodies_->space().row(node, i)];
    return x;
  }

  /// visit(owned node, local node, entry of the mass), and the masses of points.
  template <class Visit>
  void for_each_entry(const Visit& visit) const {
    const auto local = mass_->getLocalMatrixHost();
    for (LocalOrdinal node = 0; node < static_cast<LocalOrdinal>(local_row_count(*mass_)); ++node)
      for (std::size_t k = local.graph.row_map(node); turns_[static_cast<std::size_t>(node)] && k < local.graph.row_map(node + 1); ++k)
        if (local.values(k) != 0.0) visit(node, local.graph.entries(k), local.values(k));
    const std::vector<double>& of_points = bodies_->point_masses();
    for (std::size_t node = 0; node < of_points.size(); ++node)
      if (turns_[node] && of_points[node] != 0.0) visit(static_cast<LocalOrdinal>(node), static_cast<LocalOrdinal>(node), of_points[node]);
  }

  std::shared_ptr<const Bodies> bodies_;
  ScalarFunction speed_;
  RCP<const Matrix> mass_;   ///< [owned nodes x local nodes]
  std::vector<bool> turns_;  ///< [owned nodes]
  Eigen::Vector3d point_ = Eigen::Vector3d::Zero();
  Matrix3 across_ = Matrix3::Zero();  ///< P
};

}  // namespace

void CentrifugalOptions::describe(Parameters& parameters) {
  parameters.add("body", body, Says("the body that turns; left out: every body with a density"));
  parameters.add("speed", speed, Says("speed of rotation in radians, of t").unit("1 / time").arguments({"t"}));
  parameters.add("point", point, "a point of the axis, \"x, y\" or \"x, y, z\"; left out: the origin. Axisymmetric: none");
  parameters.add("axis", axis, "direction of the axis in 3D, \"x, y, z\", of any length");
}

std::unique_ptr<Load> CentrifugalOptions::make(const std::shared_ptr<const Bodies>& bodies) const {
  return std::make_unique<Centrifugal>(bodies, *this);
}

}  // namespace mortise
