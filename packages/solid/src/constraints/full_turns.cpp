#include "mortise/solid/full_turns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/constants/constants.hpp>

#include "bodies/host_view.hpp"
#include "mortise/solid/rotation_vector.hpp"

namespace mortise {

FullTurns::FullTurns(const Bodies& bodies, const std::vector<LocalOrdinal>& prescribed) {
  const Mesh& mesh = *bodies.mesh();
  if (mesh.dimension == 2) return;
  for (const ReferencePoint& point : mesh.reference_points) {
    if (point.rotation_node < 0 || point.rotation_node >= mesh.owned_count()) continue;
    FreeRotation rotation{&point, bodies.space().row(point.rotation_node, 0), {}};
    for (int i = 0; i < 3; ++i)
      rotation.free[i] = !std::binary_search(prescribed.begin(), prescribed.end(), bodies.space().row(point.rotation_node, i));
    if (std::count(rotation.free.begin(), rotation.free.end(), true) > 0) rotations_.push_back(rotation);
  }
}

void FullTurns::check(const Vector& local_displacement, std::optional<StepFailure>& failure) const {
  const HostReadView u(local_displacement);
  for (const auto& [point, first_row, free] : rotations_) {
    const Eigen::Vector3d theta = Eigen::Vector3d(u.data() + first_row) / point->arm;
    if (failure || !theta.allFinite() || least_spin(theta, free) >= smallest_spin) continue;
    failure.emplace(
        FailureKind::linear_solver,
        fmt::format("the rotation vector of \"{}\" has come to {:.4f} degrees, a full turn, where components across its axis do not turn it; "
                    "please prescribe these (\"rotation x\", \"rotation y\", \"rotation z\"), or have it turn by less",
                    point->name, theta.norm() * boost::math::constants::radian<double>()));
  }
}

}  // namespace mortise
