#pragma once
// Two boxes of hexahedra, one on the other.

#include <array>
#include <vector>

namespace embed {

using Point = std::array<double, 3>;

struct Mesh {
  struct Side {
    std::vector<std::array<long, 4>> quads;  // counterclockwise from outside
  };

  // n_lower^3 and n_upper^3 cells; the upper box is shifted along x.
  Mesh(int n_lower, int n_upper, double shift) {
    lower_top = addBox(n_lower, {0.0, 0.0, 0.0}, true);
    first_upper = static_cast<long>(points.size());
    upper_bottom = addBox(n_upper, {shift, 0.0, 1.0}, false);
  }

  std::vector<Point> points;
  std::vector<std::array<long, 8>> cells;  // in the order of shards::Hexahedron<8>
  long first_upper = 0;
  Side lower_top, upper_bottom;

  bool isClamped(long node) const { return points[node][2] == 0.0; }
  bool isDriven(long node) const { return points[node][2] == 2.0; }

 private:
  Side addBox(int n, const Point& origin, bool top) {
    const long first = static_cast<long>(points.size());
    const auto id = [&](int i, int j, int k) { return first + i + (n + 1) * (j + (n + 1) * static_cast<long>(k)); };
    for (int k = 0; k <= n; ++k)
      for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) points.push_back({origin[0] + double(i) / n, origin[1] + double(j) / n, origin[2] + double(k) / n});
    Side side;
    for (int k = 0; k < n; ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
          cells.push_back({id(i, j, k), id(i + 1, j, k), id(i + 1, j + 1, k), id(i, j + 1, k), id(i, j, k + 1), id(i + 1, j, k + 1),
                           id(i + 1, j + 1, k + 1), id(i, j + 1, k + 1)});
          const auto& c = cells.back();
          if (top && k == n - 1) side.quads.push_back({c[4], c[5], c[6], c[7]});
          if (!top && k == 0) side.quads.push_back({c[0], c[3], c[2], c[1]});
        }
    return side;
  }
};

}  // namespace embed
