// An octant of a ball: an inner block, so that no cell degenerates at the centre, and three blocks between it and the sphere.

#include <Eigen/Core>
#include <boost/math/constants/constants.hpp>
#include <cmath>

#include "mortise/mesh/volume_generators.hpp"

namespace mortise {
namespace {

using Eigen::Vector3d;

double between(double a, double b, double share) { return (1.0 - share) * a + share * b; }

/// Positions in coordinates a, b, c >= 0, of which c points to the lowest point. Block 0 is the inner one; block 1 + n lies between it and the sphere
/// in direction n, which is its radial one; the others are those of the inner block.
class Octant {
 public:
  Octant(double radius, PolarCells::Spacings spacings)
      : radius_(radius), cells_{spacings.along.cells(), spacings.along.cells(), spacings.beyond.cells()}, spacings_(std::move(spacings)) {}

  const std::array<int, 3>& inner_cells() const { return cells_; }
  int radial_cells() const { return spacings_.across.cells(); }

  Vector3d operator()(const VolumeComplex::GridPoint& point) const {
    Vector3d share;  // of the way through the inner block
    for (int d = 0; d < 3; ++d) share[d] = 0.5 * point.at[d] / cells_[d];
    if (point.block == 0) return inner(share);
    const int radial = point.block - 1;
    share[radial] = 1.0;
    const Vector3d start = inner(share), end = on_sphere(point.at, share, radial);
    const double even = 0.5 * point.at[radial] / radial_cells();
    if (radial != 2) return between(start, end, even);
    // At the lowest point as "grading across" says, at the block's other edges equal.
    const double graded = 1.0 - spacings_.across.doubled_position(2 * radial_cells() - point.at[radial]);
    return between(start, end, between(even, graded, (1.0 - share[0]) * (1.0 - share[1])));
  }

 private:
  static Vector3d between(const Vector3d& a, const Vector3d& b, double share) { return (1.0 - share) * a + share * b; }
  static double between(double a, double b, double share) { return mortise::between(a, b, share); }

  /// The trilinear block with corners on the axes, on the diagonals of faces and on the space diagonal, in shares of the radius.
  Vector3d inner(const Vector3d& share) const {
    constexpr double face_diagonal = 0.38, space_diagonal = 0.32;
    Vector3d position = Vector3d::Zero();
    for (int corner = 1; corner < 8; ++corner) {
      double weight = 1.0;
      int ends = 0;
      for (int d = 0; d < 3; ++d) {
        const bool is_end = corner >> d & 1;
        weight *= is_end ? share[d] : 1.0 - share[d];
        ends += is_end;
      }
      for (int d = 0; d < 3; ++d)
        if (corner >> d & 1) position[d] += weight * (ends == 1 ? PolarCells::inner : ends == 2 ? face_diagonal : space_diagonal);
    }
    return radius_ * position;
  }

  /// The direction (tan alpha, tan beta, 1) and its permutations: coordinate lines are great circles, and on the symmetry planes angles are arc
  /// lengths.
  Vector3d on_sphere(const std::array<int, 3>& at, const Vector3d& share, int radial) const {
    // Toward the lowest point cells are graded; at the equator they are equal.
    const double graded = radial == 2 ? 1.0 : share[2];
    Vector3d direction;
    for (int d = 0; d < 3; ++d) {
      double angle = share[d];
      if (d != radial && d != 2) angle = between(share[d], spacings_.along.doubled_position(at[d]), graded);
      direction[d] = d == radial ? 1.0 : std::tan(angle * boost::math::constants::quarter_pi<double>());
    }
    return radius_ * direction.normalized();
  }

  double radius_;
  std::array<int, 3> cells_;
  PolarCells::Spacings spacings_;
};

/// (a, b, c) is (y, x, -z), which keeps right-handed blocks right-handed.
SpatialPoint placed_octant(const Vector3d& x) { return {x[1], x[0], -x[2]}; }

}  // namespace

BodyComplex SphereOctantMesh::build(CellShape cell, const Place& place) const {
  if (!VolumeComplex::is_made_of(cell))
    throw InputError(place, "a sphere octant cannot be made of wedges or pyramids; please choose an element of hexahedra or tetrahedra, as \"H8\"");
  const Octant octant(radius, spacings(place));
  const std::array<std::string, 3> planes{"y plane", "x plane", "equator"};
  // Corners of the inner block by their number i + 2 j + 4 k; the sphere's, 7 + those of them that are not the origin.
  std::vector<VolumeComplex::Block> blocks(4);
  blocks[0] = {{0, 1, 2, 3, 4, 5, 6, 7}, octant.inner_cells(), {planes[0], "", planes[1], "", planes[2], ""}};
  for (int radial = 0; radial < 3; ++radial) {
    auto& block = blocks[1 + radial];
    for (int corner = 0; corner < 8; ++corner) {
      const int outer = 1 << radial;
      block.corners[corner] = (corner & outer) ? corner + 7 : corner + outer;
    }
    block.cells = octant.inner_cells();
    block.cells[radial] = octant.radial_cells();
    for (int d = 0; d < 3; ++d)
      if (d != radial) block.sides[2 * d] = planes[d];
    block.sides[2 * radial + 1] = "sphere";
  }
  const auto position = [octant](const VolumeComplex::GridPoint& point) { return placed_octant(octant(point)); };
  return VolumeComplex(cell, std::move(blocks), position, placement());
}

// The outer faces of the three outer blocks, whose directions i and j are the two after the radial one.
ShellComplex SphereOctantMesh::build_surface(const Place& place) const {
  const Octant octant(radius, spacings(place));
  std::vector<ShellComplex::Patch> patches;
  for (int radial = 0; radial < 3; ++radial) {
    const int i = (radial + 1) % 3, j = (radial + 2) % 3, first = 1 << radial;
    // Corners by those of the inner block that are not the origin.
    patches.push_back({{first - 1, first + (1 << i) - 1, 6, first + (1 << j) - 1}, {octant.inner_cells()[i], octant.inner_cells()[j]}, "sphere"});
  }
  const auto position = [octant](const ShellComplex::GridPoint& point) {
    const int radial = point.patch;
    VolumeComplex::GridPoint outside{1 + radial, {}};
    outside.at[radial] = 2 * octant.radial_cells();
    outside.at[(radial + 1) % 3] = 2 * point.at[0];
    outside.at[(radial + 2) % 3] = 2 * point.at[1];
    return placed_octant(octant(outside));
  };
  return ShellComplex(std::move(patches), position, placement());
}

}  // namespace mortise
