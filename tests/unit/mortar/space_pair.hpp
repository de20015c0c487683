#pragma once
// Slave and master surfaces in 3D for the tests of the interface.

#include <Eigen/Geometry>

#include "surface_pair.hpp"

namespace mortise::test {

/// mixed: squares of quadrilaterals and of two triangles take turns.
enum class FacetKind { quadrilaterals, triangles, mixed };

/// A grid of facets over [low, high] x [low_y, high_y] at z(x, y).
struct Patch {
  int along = 1, across = 1;
  double low_x = 0.0, high_x = 1.0, low_y = 0.0, high_y = 1.0;
  FacetKind kind = FacetKind::quadrilaterals;
  std::function<double(double, double)> z = [](double, double) { return 0.0; };
};

/// Appends the patch; facets counterclockwise seen from above, or from below. `unrest`: of the nodes, in shares of a facet's edges.
inline void append_patch(const Patch& patch, bool up, double unrest, Surfaces& surfaces, SurfaceFacets& facets) {
  const auto first = static_cast<GlobalOrdinal>(surfaces.points.size());
  const double dx = (patch.high_x - patch.low_x) / patch.along, dy = (patch.high_y - patch.low_y) / patch.across;
  for (int j = 0; j <= patch.across; ++j)
    for (int i = 0; i <= patch.along; ++i) {
      const std::size_t n = surfaces.points.size();
      const double x = patch.low_x + (i + unrest * disorder(3 * n)) * dx, y = patch.low_y + (j + unrest * disorder(3 * n + 1)) * dy;
      surfaces.points.push_back(Eigen::Vector3d(x, y, patch.z(x, y) + unrest * disorder(3 * n + 2) * std::min(dx, dy)));
    }
  const auto add = [&](SurfaceFacet facet) {
    if (!up) std::reverse(facet.begin(), facet.end());
    facets.push_back(facet);
  };
  for (int j = 0; j < patch.across; ++j)
    for (int i = 0; i < patch.along; ++i) {
      const GlobalOrdinal row = patch.along + 1, a = first + i + row * j, b = a + 1, c = b + row, d = a + row;
      if (patch.kind == FacetKind::quadrilaterals || (patch.kind == FacetKind::mixed && (i + j) % 2 == 0)) {
        add({a, b, c, d});
      } else {
        add({a, b, c});
        add({a, c, d});
      }
    }
}

/// The slave above, seen from below; the master below, seen from above.
inline Surfaces two_patches(const Patch& slave, const Patch& master, double unrest = 0.0) {
  Surfaces surfaces;
  surfaces.dim = 3;
  append_patch(slave, false, unrest, surfaces, surfaces.slave);
  surfaces.slaves = surfaces.points.size();
  append_patch(master, true, unrest, surfaces, surfaces.master);
  return surfaces;
}

/// Gently curved, with warped facets off every tie.
inline Surfaces waves(int slaves, int masters, double height, FacetKind slave = FacetKind::quadrilaterals,
                      FacetKind master = FacetKind::quadrilaterals, double low = -0.4, double high = 3.3) {
  Patch upper{slaves, slaves,
              0.13,   2.9,
              0.07,   2.8,
              slave,  [height](double x, double y) {
                return height + 0.04 * (x - 1.2) * (x - 1.2) + 0.03 * (y - 1.7) * (y - 1.7) - 0.02 * x * y; }};
  Patch lower{masters, masters, low, high, -0.3, 3.4, master, [](double x, double y) { return 0.05 * std::sin(1.7 * x) * std::cos(1.3 * y); }};
  Surfaces surfaces = two_patches(upper, lower, 0.03);
  surfaces.options.search_reach = 1.5;
  return surfaces;
}

inline void fix(Surfaces& surfaces, std::size_t node, const std::vector<int>& components) {
  for (const int component : components) surfaces.fixed.push_back({node, component});
}

}  // namespace mortise::test
