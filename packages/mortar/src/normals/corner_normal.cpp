#include "normals/corner_normal.hpp"

#include <Eigen/Geometry>
#include <Sacado.hpp>
#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <optional>

namespace mortise {
namespace {

/// Angle beyond the wedge up to which the master's normal is followed, and over which that ceases.
constexpr double followed = 10.0 * boost::math::double_constants::degree;

/// From a to b, to the left.
double angle(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)); }

Eigen::RowVector2d to_the_left_of(const Eigen::Vector2d& v) { return {-v[1], v[0]}; }

Eigen::Vector2d turned(const Eigen::Vector2d& v, double by) {
  return {std::cos(by) * v.x() - std::sin(by) * v.y(), std::sin(by) * v.x() + std::cos(by) * v.y()};
}

// d (v / |v|) / dv
Eigen::Matrix3d of_direction(const Eigen::Vector3d& v) {
  const Eigen::Vector3d unit = v.normalized();
  return (Eigen::Matrix3d::Identity() - unit * unit.transpose()) / v.norm();
}

/// Part of a cone that is nearest to a direction: a generator, or an arc between two.
struct Nearest {
  double angle;
  std::size_t a;
  std::optional<std::size_t> b;
};

// All generators and all arcs between two of them: what is not on an outer one is not nearest. Within 10 degrees the answer does not matter.
Nearest nearest_of_cone(const Eigen::Vector3d& direction, const std::vector<Eigen::Vector3d>& generators) {
  Nearest nearest{4.0, 0, {}};
  const auto offer = [&](const Eigen::Vector3d& place, std::size_t a, std::optional<std::size_t> b) {
    const double angle = std::atan2(direction.cross(place).norm(), direction.dot(place));
    if (angle < nearest.angle) nearest = {angle, a, b};
  };
  for (std::size_t a = 0; a < generators.size(); ++a) offer(generators[a], a, {});
  for (std::size_t a = 0; a < generators.size(); ++a)
    for (std::size_t b = a + 1; b < generators.size(); ++b) {
      const Eigen::Vector3d across = generators[a].cross(generators[b]);
      constexpr double one = 1e-3;  // facets that lie flat beside one another
      if (!(across.norm() > one)) continue;
      const Eigen::Vector3d w = across.normalized(), place = direction - direction.dot(w) * w;
      if (w.dot(generators[a].cross(place)) > 0.0 && w.dot(place.cross(generators[b])) > 0.0) offer(place.normalized(), a, b);
    }
  return nearest;
}

// True if one of the cones of three generators holds it.
bool inside_cone(const Eigen::Vector3d& direction, const std::vector<Eigen::Vector3d>& generators) {
  for (std::size_t a = 0; a < generators.size(); ++a)
    for (std::size_t b = a + 1; b < generators.size(); ++b)
      for (std::size_t c = b + 1; c < generators.size(); ++c) {
        const Eigen::Vector3d &u = generators[a], &v = generators[b], &w = generators[c];
        const double volume = u.dot(v.cross(w)), first = direction.dot(v.cross(w)), second = direction.dot(w.cross(u)),
                     third = direction.dot(u.cross(v));
        if (first * volume > 0.0 && second * volume > 0.0 && third * volume > 0.0) return true;
      }
  return false;
}

using Dual = Sacado::Fad::SFad<double, 9>;  // of m_j / |m_j| and the generators a, b
using DualVector = std::array<Dual, 3>;

Dual dot(const DualVector& a, const DualVector& b) { return Dual(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]); }

// a + s b
DualVector sum(const DualVector& a, const Dual& s, const DualVector& b) {
  return {Dual(a[0] + s * b[0]), Dual(a[1] + s * b[1]), Dual(a[2] + s * b[2])};
}

Dual length(const DualVector& v) {
  using std::sqrt;
  return Dual(sqrt(dot(v, v)));
}

DualVector unit(const DualVector& v) {
  const Dual scale = 1.0 / length(v);
  return {Dual(scale * v[0]), Dual(scale * v[1]), Dual(scale * v[2])};
}

DualVector cross(const DualVector& a, const DualVector& b) {
  return {Dual(a[1] * b[2] - a[2] * b[1]), Dual(a[2] * b[0] - a[0] * b[2]), Dual(a[0] * b[1] - a[1] * b[0])};
}

// cos(e') p + sin(e') o
DualVector beside_cone(const DualVector& direction, const DualVector& a, const DualVector* b) {
  using std::atan2;
  using std::cos;
  using std::sin;
  DualVector p = a;
  if (b != nullptr) {
    const DualVector w = unit(cross(a, *b));
    p = unit(sum(direction, Dual(-dot(direction, w)), w));
  }
  const Dual along = dot(direction, p);
  const DualVector off = sum(direction, Dual(-along), p);
  const Dual across = length(off), e = atan2(across, along), t = e / followed - 1.0;
  Dual kept = 0.0;
  if (t.val() < 1.0) kept = e * (1.0 - t * t * (3.0 - 2.0 * t));
  const Dual of_p = cos(kept), of_off = sin(kept) / across;
  return sum({Dual(of_p * p[0]), Dual(of_p * p[1]), Dual(of_p * p[2])}, of_off, off);
}

}  // namespace

// The surface turns to the left at a convex corner, and so do the normals. Where it has become concave since it was found to be a corner the wedge is
// the middle of the two. The angle of n_j changes by  of_master dmu + of_before dnu_1 + of_behind dnu_2  with those of m_j and of the normals.
CornerNormal<2> corner_normal(const Eigen::Vector2d& facing, const Eigen::Vector2d& before, const Eigen::Vector2d& behind) {
  CornerNormal<2> result;
  const Eigen::Vector2d middle = (before + behind).normalized();
  const bool convex = angle(before, behind) > 0.0, to_the_left = angle(middle, facing) > 0.0;
  const Eigen::Vector2d edge = !convex ? middle : (to_the_left ? behind : before);
  const double side = to_the_left ? 1.0 : -1.0, beyond = side * angle(edge, facing);
  double of_master = 1.0, of_before = 0.0, of_behind = 0.0;
  result.normal = facing.normalized();
  if (beyond > followed) {
    const double t = std::fmin(beyond / followed - 1.0, 1.0), kept = 1.0 - t * t * (3.0 - 2.0 * t);
    result.normal = turned(edge, side * beyond * kept);
    of_master = kept - beyond * 6.0 * t * (1.0 - t) / followed;
    const double of_edge = 1.0 - of_master;
    of_before = of_edge * (!convex ? 0.5 : (to_the_left ? 0.0 : 1.0));
    of_behind = of_edge - of_before;
  }
  const Eigen::Vector2d left = to_the_left_of(result.normal).transpose();
  result.of_facing = left * (of_master / facing.squaredNorm() * to_the_left_of(facing));
  result.of_facets = {left * (of_before * to_the_left_of(before)), left * (of_behind * to_the_left_of(behind))};
  return result;
}

CornerNormal<3> corner_normal(const Eigen::Vector3d& facing, const std::vector<Eigen::Vector3d>& facets) {
  CornerNormal<3> result;
  const Eigen::Vector3d direction = facing.normalized();
  result.of_facets.assign(facets.size(), Eigen::Matrix3d::Zero());
  const Nearest nearest = nearest_of_cone(direction, facets);
  if (nearest.angle <= followed || inside_cone(direction, facets)) {
    result.normal = direction;
    result.of_facing = of_direction(facing);
    return result;
  }
  DualVector d, a, b;
  for (int i = 0; i < 3; ++i) {
    d[i] = Dual(9, i, direction[i]);
    a[i] = Dual(9, 3 + i, facets[nearest.a][i]);
    if (nearest.b) b[i] = Dual(9, 6 + i, facets[*nearest.b][i]);
  }
  const DualVector normal = beside_cone(d, a, nearest.b ? &b : nullptr);
  Eigen::Matrix3d of_direction_itself;
  for (int i = 0; i < 3; ++i) {
    result.normal[i] = normal[i].val();
    for (int k = 0; k < 3; ++k) {
      of_direction_itself(i, k) = normal[i].dx(k);
      result.of_facets[nearest.a](i, k) = normal[i].dx(3 + k);
      if (nearest.b) result.of_facets[*nearest.b](i, k) = normal[i].dx(6 + k);
    }
  }
  result.of_facing = of_direction_itself * of_direction(facing);
  return result;
}

}  // namespace mortise
