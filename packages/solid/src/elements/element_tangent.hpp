#pragma once
// An element's force and stiffness from what its points have, in 2D and 3D.

#include <array>
#include <type_traits>

#include "elements/space_products.hpp"
#include "mortise/material/tensor_components.hpp"
#include "mortise/solid/deformation.hpp"
#include "mortise/solid/element_points.hpp"

namespace mortise {

/// f += weight x stress : grad eta.
template <class Geometry>
void add_point_force(const typename Geometry::Point& at, const Matrix3& stress, double weight,
                     std::array<double, Geometry::dimension * Geometry::nodes>& force) {
  for (int a = 0; a < Geometry::nodes; ++a) {
    const auto& g = at.gradient[a];
    if constexpr (Geometry::dimension == 3)
      for (int i = 0; i < 3; ++i) force[3 * a + i] += weight * (stress(i, 0) * g[0] + stress(i, 1) * g[1] + stress(i, 2) * g[2]);
    else
      for (int i = 0; i < 2; ++i) force[2 * a + i] += weight * (stress(i, 0) * g[0] + stress(i, 1) * g[1]);
    if constexpr (Geometry::axisymmetric) force[2 * a] += weight * stress(2, 2) * at.hoop[a];
  }
}

/// Sums K += G^T A G over the points of an element. F-bar adds  G^T q (tr G0 - tr G),  q = (1/n) A:(I x I) + (1/n) (1 - n) tau x I. Here n is the
/// number of directions that F-bar scales: 2 in plane strain, 3 (with the hoop) if axisymmetric and in 3D.
template <class Geometry, class Components, bool f_bar>
class ElementTangent {
 public:
  static constexpr int nodes = Geometry::nodes, dimension = Geometry::dimension, dofs = dimension * nodes, size = Components::size;
  using Point = typename Geometry::Point;
  struct Nothing {};
  using Centre = std::conditional_t<f_bar, Point, Nothing>;
  /// In 2D columns run as rows do; in 3D the nodes run first, filled up: the innermost loops are over them.
  static constexpr int width = filled_up(nodes);
  static constexpr int column(int b, int k) { return dimension == 3 ? k * width + b : dimension * b + k; }

  /// The sum, for ElementLoop.
  struct Stiffness {
    static constexpr int components = dimension;
    std::array<std::array<double, dimension == 3 ? 3 * width : dofs>, dofs> rows{};  ///< rows dimension * a + i, columns column(b, k)
    double operator()(int a, int i, int b, int k) const { return rows[dimension * a + i][column(b, k)]; }
  };

  /// `centre`, pushed forward, and `stiffness` have to outlive this object.
  ElementTangent(const Centre& centre, Stiffness& stiffness) : centre_(centre), stiffness_(stiffness.rows) {}

  /// A point after push_forward.
  void add(const Point& at, const StressAndTangent<Components>& response, double weight) {
    if constexpr (dimension == 3)
      add_in_space(at, response, weight);
    else
      add_in_plane(at, response, weight);
  }

  /// After the last point.
  void finish() {
    if constexpr (dimension == 3 && f_bar)
      for (int row = 0; row < dofs; ++row)
        for (int k = 0; k < 3; ++k)
          for (int b = 0; b < nodes; ++b) stiffness_[row][column(b, k)] += volumetric_[row] * centre_.gradient[b][k];
  }

 private:
  static std::array<double, size> volumetric_response(const StressAndTangent<Components>& response) {
    std::array<double, size> q{};
    double n = 0.0;
    for (int r = 0; r < size; ++r) {
      if (Components::row[r] != Components::column[r]) continue;
      n += 1.0;
      for (int p = 0; p < size; ++p) q[p] += response.tangent(p, r);
    }
    for (int p = 0; p < size; ++p) q[p] = (q[p] + (1.0 - n) * response.stress(Components::row[p], Components::column[p])) / n;
    return q;
  }

  void add_in_plane(const Point& at, const StressAndTangent<Components>& response, double weight) {
    constexpr bool axisymmetric = Geometry::axisymmetric;
    const auto& A = response.tangent;
    [[maybe_unused]] std::array<double, size> q;
    if constexpr (f_bar) q = volumetric_response(response);
    for (int b = 0; b < nodes; ++b)
      for (int k = 0; k < 2; ++k) {
        // Change of (weight x stress, less the geometric part) with the dof (b, k), whose L has the row k = dN_b/dx and, for k = 0, L_33 = N_b/r.
        std::array<double, size> change;
        const double* gradient = at.gradient[b].data();
        for (int p = 0; p < size; ++p) {
          change[p] = A(p, 2 * k) * gradient[0] + A(p, 2 * k + 1) * gradient[1];
          if constexpr (axisymmetric)
            if (k == 0) change[p] += A(p, 4) * at.hoop[b];
        }
        if constexpr (f_bar) {
          double trace = centre_.gradient[b][k] - gradient[k];
          if constexpr (axisymmetric)
            if (k == 0) trace += centre_.hoop[b] - at.hoop[b];
          for (int p = 0; p < size; ++p) change[p] += q[p] * trace;
        }
        for (int p = 0; p < size; ++p) change[p] *= weight;
        for (int a = 0; a < nodes; ++a) {
          for (int i = 0; i < 2; ++i)
            stiffness_[2 * a + i][column(b, k)] += at.gradient[a][0] * change[2 * i] + at.gradient[a][1] * change[2 * i + 1];
          if constexpr (axisymmetric) stiffness_[2 * a][column(b, k)] += at.hoop[a] * change[4];
        }
      }
  }

  /// The centre's gradients are the same for all points: what multiplies them is summed and their part added in finish().
  void add_in_space(const Point& at, const StressAndTangent<Components>& response, double weight) {
    double g[3][width]{};
    for (int b = 0; b < nodes; ++b)
      for (int l = 0; l < 3; ++l) g[l][b] = at.gradient[b][l];
    double A[9][filled_up(9)]{};  // weight A, by rows
    for (int q = 0; q < 9; ++q)
      for (int p = 0; p < 9; ++p) A[p][q] = weight * response.tangent(p, q);
    if constexpr (f_bar) {
      std::array<double, size> q = volumetric_response(response);
      for (double& entry : q) entry *= weight;
      add_space_products<nodes>(g, A, q.data(), stiffness_.front().data(), volumetric_.data());
    } else {
      add_space_products<nodes>(g, A, nullptr, stiffness_.front().data(), nullptr);
    }
  }

  const Centre& centre_;
  decltype(Stiffness::rows)& stiffness_;
  std::array<double, dimension == 3 && f_bar ? dofs : 0> volumetric_{};
};

}  // namespace mortise
