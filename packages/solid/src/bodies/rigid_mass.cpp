#include "mortise/solid/rigid_mass.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <Teuchos_CommHelpers.hpp>
#include <array>
#include <cmath>

#include "loads/loaded_side.hpp"

namespace mortise {
namespace {

constexpr double open_surface = 1e-9;  ///< of |integral n dA| over the area: a surface with more is not closed
constexpr double round_off = 1e-9;     ///< of moments that nodes have, over those that they should have

using Moments = Eigen::Matrix<double, 10, 1>;  // 1; x, y, z; xx, yy, zz, xy, yz, xz
using Position = Eigen::Vector3d;

Moments monomials(const Position& x) {
  Moments result;
  result << 1.0, x[0], x[1], x[2], x[0] * x[0], x[1] * x[1], x[2] * x[2], x[0] * x[1], x[1] * x[2], x[0] * x[2];
  return result;
}

/// Those that count: in 2D 1, x, y and xx + yy.
Eigen::VectorXd counted(const Moments& moments, int dimension) {
  if (dimension == 3) return moments;
  return Eigen::Vector4d(moments[0], moments[1], moments[2], moments[4] + moments[5]);
}

Moments moments_of(const RigidMass& mass, const Position& about) {
  const Position c = mass.centre - about;
  const Eigen::Matrix3d E = mass.second_moments + mass.mass * c * c.transpose();
  Moments result;
  result << mass.mass, mass.mass * c, E(0, 0), E(1, 1), E(2, 2), E(0, 1), E(1, 2), E(0, 2);
  return result;
}

}  // namespace

RigidMass rigid_mass(double mass, const Eigen::Vector3d& centre, const Eigen::Vector3d& J) {
  RigidMass result{mass, centre, Eigen::Matrix3d::Zero()};
  result.second_moments.diagonal() = Eigen::Vector3d::Constant(0.5 * J.sum()) - J;
  return result;
}

// integral f dV = integral F . n dA with div F = f: F = (integral f dx_i) e_i / (number of directions).
RigidMass mass_within(const Bodies& bodies, const Located<std::string>& surface, double density) {
  const Mesh& mesh = *bodies.mesh();
  const int dimension = mesh.dimension;
  std::array<double, 14> mine{}, all{};  // moments, integral n dA, area
  double of_rings = 0.0;                 // 2 integral r dr dz = integral r^2 n_r ds
  for (const LoadedSide& side : owned_sides(mesh, surface))
    for (const SidePoint& point : *side.rule) {
      const SidePosition at = side.at(point, mesh, {});
      const Position x = at.position, n = point.weight * at.area;
      of_rings += n[0] * x[0] * x[0];
      for (int i = 0; i < dimension; ++i) {
        const double share = n[i] / dimension;
        mine[0] += share * x[i];
        for (int k = 0; k < 3; ++k) mine[1 + k] += share * x[i] * x[k] / (i == k ? 2.0 : 1.0);
        constexpr std::array<std::array<int, 2>, 6> pairs{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};
        for (int p = 0; p < 6; ++p) {
          const int power = (pairs[p][0] == i ? 1 : 0) + (pairs[p][1] == i ? 1 : 0);
          mine[4 + p] += share * x[i] * x[pairs[p][0]] * x[pairs[p][1]] / (1.0 + power);
        }
        mine[10 + i] += n[i];
      }
      mine[13] += n.norm();
    }
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), all.data());
  if (std::hypot(all[10], all[11], all[12]) > open_surface * all[13] || !(all[0] > 0.0))
    throw InputError(surface.place,
                     "the surface of this rigid body is not closed, so that a density says nothing of its mass; please give \"mass\" and "
                     "\"moments of inertia\"");
  RigidMass result;
  if (bodies.kinematics() == Kinematics::axisymmetric) {  // it moves along the axis alone
    double sum = 0.0;
    Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_SUM, of_rings, Teuchos::outArg(sum));
    result.mass = density * EIGEN_PI * sum;
    return result;
  }
  for (double& moment : all) moment *= bodies.depth(0.0);
  result.mass = density * all[0];
  for (int k = 0; k < 3; ++k) result.centre[k] = all[1 + k] / all[0];
  const Eigen::Matrix3d about_origin = (Eigen::Matrix3d() << all[4], all[7], all[9], all[7], all[5], all[8], all[9], all[8], all[6]).finished();
  result.second_moments = density * (about_origin - all[0] * result.centre * result.centre.transpose());
  return result;
}

std::optional<std::vector<double>> masses_of_nodes(const Mesh& mesh, const std::vector<LocalOrdinal>& nodes, const RigidMass& mass) {
  const int dimension = mesh.dimension;
  // Centred and scaled, so that moments are alike.
  std::array<double, 4> mine{}, sums{};
  for (const LocalOrdinal node : nodes) {
    for (int i = 0; i < 3; ++i) mine[i] += mesh.coordinates[node][i];
    mine[3] += 1.0;
  }
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_SUM, 4, mine.data(), sums.data());
  const Position about(sums[0] / sums[3], sums[1] / sums[3], sums[2] / sums[3]);
  const auto arm = [&](LocalOrdinal node) -> Position { return Eigen::Map<const Position>(mesh.coordinates[node].data()) - about; };
  double largest_here = 0.0, size = 0.0;
  for (const LocalOrdinal node : nodes) largest_here = std::max(largest_here, arm(node).norm());
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MAX, largest_here, Teuchos::outArg(size));
  if (!(size > 0.0)) return std::nullopt;
  const auto of_node = [&](LocalOrdinal node) { return counted(monomials(arm(node) / size), dimension); };

  RigidMass scaled = mass;
  scaled.centre = (mass.centre - about) / size;
  scaled.second_moments /= size * size;
  const Eigen::VectorXd wanted = counted(moments_of(scaled, Position::Zero()), dimension);
  const Eigen::Index count = wanted.size();
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(count, count), product_sums(count, count);
  for (const LocalOrdinal node : nodes) {
    const Eigen::VectorXd p = of_node(node);
    products += p * p.transpose();
  }
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_SUM, static_cast<int>(products.size()), products.data(), product_sums.data());
  // Directions in which the nodes have no extent, as in a plane, carry no moments.
  const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition(product_sums);
  const Eigen::VectorXd coefficients = decomposition.solve(wanted);
  if ((product_sums * coefficients - wanted).norm() > round_off * wanted.norm()) return std::nullopt;
  std::vector<double> masses;
  for (const LocalOrdinal node : nodes) masses.push_back(of_node(node).dot(coefficients));
  return masses;
}

}  // namespace mortise
