#include "inverted_elements.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <limits>

namespace mortise {
namespace {

/// The smallest value of det J that was seen, and where.
struct Smallest {
  double determinant = std::numeric_limits<double>::infinity();
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  void add(double value, const Eigen::Vector3d& x) {
    if (!(value >= determinant)) determinant = value, position = x;
  }
};

using Corners = std::array<Eigen::Vector3d, 8>;

/// At the corners: on a bilinear cell det J is linear in each reference coordinate without a mixed term, so that it is positive everywhere if it is
/// so there. Reference edges have length 2 in quadrilaterals and 1 in triangles.
Smallest of_plane_cell(const Corners& x, int n) {
  Smallest smallest;
  for (int a = 0; a < n; ++a) {
    const Eigen::Vector3d next = x[(a + 1) % n] - x[a], previous = x[(a + n - 1) % n] - x[a];
    const double cross = next[0] * previous[1] - next[1] * previous[0];
    smallest.add(n == 4 ? 0.25 * cross : cross, x[a]);
  }
  return smallest;
}

Smallest of_tetrahedron(const Corners& x) {
  Smallest smallest;
  smallest.add((x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]), x[0]);
  return smallest;
}

/// At the corners and at the points of the 2 x 2 x 2 Gauss rule: J's columns are (1/8) sum_a xi_ai (1 + xi_aj xi_j) (1 + xi_ak xi_k) x_a.
Smallest of_hexahedron(const Corners& x) {
  constexpr double sign[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}};
  Smallest smallest;
  for (const double r : {1.0, std::sqrt(1.0 / 3.0)})
    for (const auto& point : sign) {
      Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
      Eigen::Vector3d position = Eigen::Vector3d::Zero();
      for (int a = 0; a < 8; ++a) {
        const double f[3] = {1.0 + r * sign[a][0] * point[0], 1.0 + r * sign[a][1] * point[1], 1.0 + r * sign[a][2] * point[2]};
        for (int i = 0; i < 3; ++i) jacobian.col(i) += 0.125 * sign[a][i] * f[(i + 1) % 3] * f[(i + 2) % 3] * x[a];
        position += 0.125 * f[0] * f[1] * f[2] * x[a];
      }
      smallest.add(jacobian.determinant(), position);
    }
  return smallest;
}

Smallest smallest_determinant(const Mesh& mesh, const Block& block, LocalOrdinal element) {
  const CellTopology& cell = topology(block.shape);
  Corners corners;
  for (int a = 0; a < cell.corners; ++a) corners[a] = Eigen::Vector3d::Map(mesh.coordinates[block.nodes(element)[a]].data());
  if (cell.dimension == 2) return of_plane_cell(corners, cell.corners);
  return cell.corners == 4 ? of_tetrahedron(corners) : of_hexahedron(corners);
}

}  // namespace

std::vector<Diagnostic> inverted_elements(const Mesh& mesh, const BodySet& set, const std::vector<BodyDescription>& bodies) {
  std::vector<Diagnostic> diagnostics;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const auto& block = mesh.blocks[b];
    const int dimension = topology(block.shape).dimension;
    if (dimension == 1) continue;
    for (LocalOrdinal e = 0; e < block.owned; ++e) {
      const Smallest smallest = smallest_determinant(mesh, block, e);
      if (smallest.determinant > 0.0) continue;
      const auto& x = smallest.position;
      const std::string at = dimension == 2 ? fmt::format("({:.6g}, {:.6g})", x[0], x[1]) : fmt::format("({:.6g}, {:.6g}, {:.6g})", x[0], x[1], x[2]);
      const char* const rule = dimension == 2 ? "corners have to go round counterclockwise and edges must not cross" : "its sides must not cross";
      diagnostics.push_back(
          {bodies[b].place, fmt::format("body \"{}\": element {} is inverted: det J = {:.6g} at {}; {}", block.name,
                                        block.element_ids[e] - set.first_element(static_cast<int>(b)), smallest.determinant, at, rule)});
      break;
    }
  }
  return diagnostics;
}

}  // namespace mortise
