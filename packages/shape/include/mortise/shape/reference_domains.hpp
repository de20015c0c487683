#pragma once
// Reference cells without regard to nodes beside their corners: what linear and quadratic cells share.

#include <array>
#include <vector>

#include "mortise/shape/quadrature.hpp"

namespace mortise {

/// A side of a cell: which nodes of the cell it has, in the order of its own shape.
template <class Side>
struct SideNodes {
  using Shape = Side;                  ///< the type that describes the side's shape
  std::array<int, Side::nodes> nodes;  ///< numbers in the cell
};

/// [-1, 1]. A line has no sides that are cells.
struct ReferenceLine {
  static constexpr int dimension = 1;                                  ///< number of reference coordinates
  static constexpr int corners = 2;                                    ///< the first nodes
  static constexpr double measure = 2.0;                               ///< its length
  static constexpr std::array<double, 1> centroid{0.0};                ///< reference coordinates
  static constexpr std::array<std::array<int, 2>, 1> edges{{{0, 1}}};  ///< corners at the ends of each edge

  /// The Gauss-Legendre rule with so many points.
  static std::vector<CellPoint> rule(int points);
  /// Is the point inside, or outside by at most the tolerance?
  static bool contains(const std::array<double, 1>& xi, double tolerance);
};

/// (0,0), (1,0), (0,1).
struct ReferenceTriangle {
  static constexpr int dimension = 2;                                                  ///< number of reference coordinates
  static constexpr int corners = 3;                                                    ///< the first nodes
  static constexpr double measure = 0.5;                                               ///< its area
  static constexpr std::array<double, 2> centroid{1.0 / 3.0, 1.0 / 3.0};               ///< reference coordinates
  static constexpr std::array<std::array<int, 2>, 3> edges{{{0, 1}, {1, 2}, {2, 0}}};  ///< corners at the ends of each edge

  /// triangle_rule.
  static std::vector<CellPoint> rule(int points) { return triangle_rule(points); }
  /// Is the point inside, or outside by at most the tolerance?
  static bool contains(const std::array<double, 2>& xi, double tolerance);
};

/// [-1, 1]^2, counterclockwise from (-1,-1).
struct ReferenceSquare {
  static constexpr int dimension = 2;                                                          ///< number of reference coordinates
  static constexpr int corners = 4;                                                            ///< the first nodes
  static constexpr double measure = 4.0;                                                       ///< its area
  static constexpr std::array<double, 2> centroid{0.0, 0.0};                                   ///< reference coordinates
  static constexpr std::array<std::array<int, 2>, 4> edges{{{0, 1}, {1, 2}, {2, 3}, {3, 0}}};  ///< corners at the ends of each edge

  /// The tensor product rule with so many points in all. Throws std::invalid_argument if there is none.
  static std::vector<CellPoint> rule(int points);
  /// Is the point inside, or outside by at most the tolerance?
  static bool contains(const std::array<double, 2>& xi, double tolerance);
};

/// (0,0,0), (1,0,0), (0,1,0), (0,0,1).
struct ReferenceTetrahedron {
  static constexpr int dimension = 3;                                 ///< number of reference coordinates
  static constexpr int corners = 4;                                   ///< the first nodes
  static constexpr double measure = 1.0 / 6.0;                        ///< its volume
  static constexpr std::array<double, 3> centroid{0.25, 0.25, 0.25};  ///< reference coordinates
  /// Corners at the ends of each edge: of the base, then the upright ones.
  static constexpr std::array<std::array<int, 2>, 6> edges{{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};

  /// tetrahedron_rule.
  static std::vector<CellPoint> rule(int points) { return tetrahedron_rule(points); }
  /// Is the point inside, or outside by at most the tolerance?
  static bool contains(const std::array<double, 3>& xi, double tolerance);
};

/// [-1, 1]^3: the corners of the bottom (those of ReferenceSquare at zeta = -1), then of the top.
struct ReferenceCube {
  static constexpr int dimension = 3;                              ///< number of reference coordinates
  static constexpr int corners = 8;                                ///< the first nodes
  static constexpr double measure = 8.0;                           ///< its volume
  static constexpr std::array<double, 3> centroid{0.0, 0.0, 0.0};  ///< reference coordinates
  /// Corners at the ends of each edge: of the bottom, of the top, upright.
  static constexpr std::array<std::array<int, 2>, 12> edges{
      {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};

  /// The tensor product rule with so many points in all. Throws std::invalid_argument if there is none.
  static std::vector<CellPoint> rule(int points);
  /// Is the point inside, or outside by at most the tolerance?
  static bool contains(const std::array<double, 3>& xi, double tolerance);
};

/// (0,0), (1,0), (0,1) times [-1, 1]: the corners of the bottom (those of ReferenceTriangle at zeta = -1), then of the top.
struct ReferenceWedge {
  static constexpr int dimension = 3;                                          ///< number of reference coordinates
  static constexpr int corners = 6;                                            ///< the first nodes
  static constexpr double measure = 1.0;                                       ///< its volume
  static constexpr std::array<double, 3> centroid{1.0 / 3.0, 1.0 / 3.0, 0.0};  ///< reference coordinates
  /// Corners at the ends of each edge: of the bottom, of the top, upright.
  static constexpr std::array<std::array<int, 2>, 9> edges{{{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}};

  /// The wedge_rule with so many points in all: 6 (3 x 2), 21 (7 x 3). Throws std::invalid_argument for any other number.
  static std::vector<CellPoint> rule(int points);
  /// Is the point inside, or outside by at most the tolerance?
  static bool contains(const std::array<double, 3>& xi, double tolerance);
};

/// |xi|, |eta| <= 1 - zeta, 0 <= zeta <= 1: the corners of the base (those of ReferenceSquare at zeta = 0), then the apex (0, 0, 1).
struct ReferencePyramid {
  static constexpr int dimension = 3;                               ///< number of reference coordinates
  static constexpr int corners = 5;                                 ///< the first nodes
  static constexpr double measure = 4.0 / 3.0;                      ///< its volume
  static constexpr std::array<double, 3> centroid{0.0, 0.0, 0.25};  ///< reference coordinates
  /// Corners at the ends of each edge: of the base, then the upright ones.
  static constexpr std::array<std::array<int, 2>, 8> edges{{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}}};

  /// Where the ray from the apex through a point meets the base: u = xi / (1 - zeta), v = eta / (1 - zeta). At the apex itself, which round-off
  /// misses by some 1e-16, the axis is taken: u = v = 0.
  template <class T>
  static constexpr std::array<T, 2> ray(const std::array<T, 3>& xi) {
    constexpr double at_apex = 1e-14;
    const T height = 1.0 - xi[2];
    if (height > at_apex || height < -at_apex) return {xi[0] / height, xi[1] / height};
    return {T(0.0), T(0.0)};
  }

  /// The pyramid_rule with so many points in all: 8 (4 x 2), or one point along the height. Throws std::invalid_argument if there is none.
  static std::vector<CellPoint> rule(int points);
  /// Is the point inside, or outside by at most the tolerance?
  static bool contains(const std::array<double, 3>& xi, double tolerance);
};

}  // namespace mortise
