#include "mortise/solid/rigid_mass.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "mortise/core/over_ranks.hpp"
#include "mortise/solid/loaded_side.hpp"

namespace mortise {
namespace {

constexpr double open_surface = 1e-9;  ///< of |integral n dA| over the area: a surface with more is not closed
constexpr double round_off = 1e-9;     ///< of moments that nodes have, over those that they should have
constexpr double flat = 1e-6;          ///< extent of nodes in a direction over their largest one, below which they have none

using Position = Eigen::Vector3d;

Position position_of(const Mesh& mesh, LocalOrdinal node) { return Eigen::Map<const Position>(mesh.coordinates[node].data()); }

/// The node of all ranks with the largest value, the first by id of those that are alike.
struct Furthest {
  double value = 0.0;
  GlobalOrdinal node = -1;
  Position at = Position::Zero();
};
template <class Value>
Furthest furthest(const Mesh& mesh, const std::vector<LocalOrdinal>& nodes, const Value& value) {
  double mine = 0.0;
  for (const LocalOrdinal node : nodes) mine = std::max(mine, value(position_of(mesh, node)));
  Furthest result;
  result.value = most_over_ranks(*mesh.comm, mine);
  constexpr double alike = 1.0 - 1e-9;
  GlobalOrdinal first = std::numeric_limits<GlobalOrdinal>::max();
  LocalOrdinal of_first = -1;
  for (const LocalOrdinal node : nodes)
    if (const GlobalOrdinal id = mesh.local_nodes->getGlobalElement(node); id < first && value(position_of(mesh, node)) >= alike * result.value) {
      first = id;
      of_first = node;
    }
  result.node = least_over_ranks(*mesh.comm, first);
  result.at = sum_over_ranks(*mesh.comm, result.node == first ? position_of(mesh, of_first) : Position(Position::Zero()));
  return result;
}

/// Nodes far apart that span what all nodes span, [1 to dimension + 1].
std::vector<Furthest> spanning_nodes(const Mesh& mesh, const std::vector<LocalOrdinal>& nodes) {
  std::vector<Furthest> result;
  if (sum_over_ranks(*mesh.comm, static_cast<double>(nodes.size())) == 0.0) return result;
  Eigen::Vector4d mine = Eigen::Vector4d::Zero();
  for (const LocalOrdinal node : nodes) mine += (Eigen::Vector4d() << position_of(mesh, node), 1.0).finished();
  const Eigen::Vector4d sums = sum_over_ranks(*mesh.comm, mine);
  const Position middle = sums.head<3>() / sums[3];
  const auto from_middle = [&](const Position& x) { return (x - middle).norm(); };
  result.push_back(furthest(mesh, nodes, from_middle));
  std::vector<Position> along;  // orthonormal
  const auto beside = [&](const Position& x) {
    Position arm = x - result.front().at;
    for (const Position& direction : along) arm -= arm.dot(direction) * direction;
    return arm;
  };
  while (along.size() < static_cast<std::size_t>(mesh.dimension)) {
    const Furthest next = furthest(mesh, nodes, [&](const Position& x) { return beside(x).norm(); });
    if (!(next.value > flat * result.front().value)) break;
    along.push_back(beside(next.at).normalized());
    result.push_back(next);
  }
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

std::optional<MassBlock> mass_on_nodes(const Mesh& mesh, const std::vector<LocalOrdinal>& nodes, const RigidMass& mass) {
  const std::vector<Furthest> spanning = spanning_nodes(mesh, nodes);
  if (spanning.empty()) return std::nullopt;
  // About a node and scaled, so that moments are alike.
  const Eigen::Index dimension = mesh.dimension, count = static_cast<Eigen::Index>(spanning.size());
  const Position about = spanning.front().at;
  const double size = std::max(spanning.size() > 1 ? spanning[1].value : 0.0, (mass.centre - about).norm());
  MassBlock block;
  Eigen::MatrixXd P = Eigen::MatrixXd::Ones(1 + dimension, count), Q(1 + dimension, 1 + dimension);
  for (Eigen::Index n = 0; n < count; ++n) {
    block.nodes.push_back(spanning[static_cast<std::size_t>(n)].node);
    if (size > 0.0) P.col(n).tail(dimension) = (spanning[static_cast<std::size_t>(n)].at - about).head(dimension) / size;
  }
  const Position c = size > 0.0 ? Position((mass.centre - about) / size) : Position(Position::Zero());
  Eigen::Matrix3d about_centre = mass.second_moments;
  if (dimension == 2 && count == 2) {  // turns about z see the trace alone: nodes on a line bear it
    const Position along = (spanning[1].at - about).normalized();
    about_centre = mass.second_moments.topLeftCorner<2, 2>().trace() * along * along.transpose();
  }
  Eigen::Matrix3d E = Eigen::Matrix3d::Zero();
  if (size > 0.0) E = about_centre / (size * size) + mass.mass * c * c.transpose();
  Q(0, 0) = mass.mass;
  Q.bottomLeftCorner(dimension, 1) = mass.mass * c.head(dimension);
  Q.topRightCorner(1, dimension) = Q.bottomLeftCorner(dimension, 1).transpose();
  Q.bottomRightCorner(dimension, dimension) = E.topLeftCorner(dimension, dimension);
  const Eigen::MatrixXd inverse = P.completeOrthogonalDecomposition().pseudoInverse();
  block.mass = inverse * Q * inverse.transpose();
  if ((P * block.mass * P.transpose() - Q).norm() > round_off * Q.norm()) return std::nullopt;
  return block;
}

void add_block(const Mesh& mesh, const MassBlock& block, MassRows& rows) {
  for (std::size_t a = 0; a < block.nodes.size(); ++a) {
    const LocalOrdinal row = mesh.owned_nodes->getLocalElement(block.nodes[a]);
    for (std::size_t b = 0; b < block.nodes.size() && row >= 0; ++b)
      rows[static_cast<std::size_t>(row)][block.nodes[b]] += block.mass(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
  }
}

}  // namespace mortise
