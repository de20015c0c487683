#include "mortise/mortar/edge_crossing.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Sacado.hpp>
#include <algorithm>
#include <cmath>
#include <limits>

namespace mortise {
namespace {

using Point = Eigen::Vector3d;

constexpr double degree = M_PI / 180.0;
/// Edges that cross at less are parallel: they touch along a line, which weighted gaps see. Above the second angle they count fully.
constexpr double parallel[2] = {2.5 * degree, 5.0 * degree};
/// A facet that leaves the plane of contact by less lies on it, and weighted gaps see that. Above the second angle it counts fully. As for kinks.
constexpr double flush[2] = {10.0 * degree, 20.0 * degree};

double smooth_step(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// The section of a wedge that a plane across its normal cuts, a depth 1 below its edge: width, and the least angle of its facets to the plane.
struct Section {
  double width = 0.0, angle = 0.0;
};

// Seen along the edge the facets run along u from it. They are -u.n deep below it and u.(n x t) beside it.
std::optional<Section> section_of(const EdgePiece& piece, const Point& outward) {
  const Point along = (piece.ends[1] - piece.ends[0]).normalized(), across = outward.cross(along);
  std::array<double, 2> place{};
  double least = 1.0;
  for (std::size_t f = 0; f < 2; ++f) {
    Point u = piece.beside[f] - piece.ends[0];
    u = (u - u.dot(along) * along).normalized();
    const double depth = -u.dot(outward);
    if (!(depth > 0.0)) return std::nullopt;
    place[f] = u.dot(across) / depth;
    least = std::min(least, depth);
  }
  return Section{std::abs(place[0] - place[1]), std::asin(std::min(1.0, least))};
}

Point tangent_at(const EdgeLine& line, std::size_t k, const std::vector<Point>& x) {
  const auto& [before, behind] = line.tangent[k];
  return x[static_cast<std::size_t>(behind)] - x[static_cast<std::size_t>(before)];
}

const Point& point_at(const EdgeLine& line, std::size_t k, const std::vector<Point>& x) { return x[static_cast<std::size_t>(line.nodes[k])]; }

/// The point y(m) of an edge with (y - x) . t(m) = 0: of several the nearest. Beyond its ends the edge goes on straight.
struct Foot {
  std::size_t piece = 0;
  double m = 0.0;  ///< below 0 or above 1: beyond an end
  Point place;
};

Foot foot_of(const EdgeLine& line, const Point& x, const std::vector<Point>& positions) {
  const std::size_t last = line.nodes.size() - 1;
  const auto ahead = [&](std::size_t l) { return (point_at(line, l, positions) - x).dot(tangent_at(line, l, positions)); };
  std::optional<Foot> best;
  double distance = std::numeric_limits<double>::max();
  const auto take = [&](std::size_t piece, double m, const Point& place) {
    if ((place - x).norm() >= distance) return;
    distance = (place - x).norm();
    best = Foot{piece, m, place};
  };
  double q0 = ahead(0);
  for (std::size_t l = 0; l < last; ++l) {
    const double q1 = ahead(l + 1);
    if (q0 <= 0.0 && q1 > 0.0) {  // q(m) = q0 + b m + a m^2 has one root there
      const Point along = point_at(line, l + 1, positions) - point_at(line, l, positions),
                  turn = tangent_at(line, l + 1, positions) - tangent_at(line, l, positions);
      const double a = along.dot(turn), b = q1 - q0 - a;
      const double m = std::clamp(q0 == 0.0 ? 0.0 : -2.0 * q0 / (b + std::sqrt(std::max(0.0, b * b - 4.0 * a * q0))), 0.0, 1.0);
      take(l, m, point_at(line, l, positions) + m * along);
    }
    q0 = q1;
  }
  if (best) return *best;
  const std::size_t end = ahead(0) > 0.0 ? 0 : last, piece = end == 0 ? 0 : last - 1;
  const Point t = tangent_at(line, end, positions);
  const double by = -ahead(end) / t.squaredNorm();
  return {piece, end == 0 ? std::min(by, -1e-300) : 1.0 + std::max(by, 1e-15), point_at(line, end, positions) + by * t};
}

/// (y - x(s)) . t(s) with the foot y of x(s) on the master.
double ahead_on_slave(const EdgePair& pair, std::size_t k, double s, const std::vector<Point>& x, Foot& foot) {
  const Point place = (1.0 - s) * point_at(pair.slave, k, x) + s * point_at(pair.slave, k + 1, x);
  const Point t = (1.0 - s) * tangent_at(pair.slave, k, x) + s * tangent_at(pair.slave, k + 1, x);
  foot = foot_of(pair.master, place, x);
  return (foot.place - place).dot(t);
}

/// The places of the 8 nodes: of either edge the ends of the piece, and what their tangents are taken between beside them.
std::array<int, 8> nodes_of(const EdgePair& pair, std::size_t k, std::size_t l) {
  const auto of = [](const EdgeLine& line, std::size_t at) {
    return std::array<int, 4>{line.nodes[at], line.nodes[at + 1], line.tangent[at][0], line.tangent[at + 1][1]};
  };
  const auto slave = of(pair.slave, k), master = of(pair.master, l);
  return {slave[0], slave[1], slave[2], slave[3], master[0], master[1], master[2], master[3]};
}

/// Quantities of a crossing, of a scalar type. x: 8 points.
template <class S>
struct Crossed {
  using Vector = std::array<S, 3>;
  Vector x, y, w, of_slave, of_master;  ///< points, way between, tangents
  Vector slave_along, master_along, slave_turn, master_turn;
};

template <class S>
S dot(const std::array<S, 3>& a, const std::array<S, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// t at the first node runs from the node before it to the second one, at the second node from the first one to the node behind.
template <class S>
Crossed<S> crossed(const std::array<std::array<S, 3>, 8>& p, const S& s, const S& m) {
  Crossed<S> c;
  for (std::size_t i = 0; i < 3; ++i) {
    c.slave_along[i] = p[1][i] - p[0][i];
    c.master_along[i] = p[5][i] - p[4][i];
    const S first = p[1][i] - p[2][i], second = p[3][i] - p[0][i], third = p[5][i] - p[6][i], fourth = p[7][i] - p[4][i];
    c.slave_turn[i] = second - first;
    c.master_turn[i] = fourth - third;
    c.of_slave[i] = first + s * c.slave_turn[i];
    c.of_master[i] = third + m * c.master_turn[i];
    c.x[i] = p[0][i] + s * c.slave_along[i];
    c.y[i] = p[4][i] + m * c.master_along[i];
    c.w[i] = c.y[i] - c.x[i];
  }
  return c;
}

/// d(w.t_slave, w.t_master)/d(s, m).
Eigen::Matrix2d slope_of(const Crossed<double>& c) {
  Eigen::Matrix2d J;
  J << dot(c.w, c.slave_turn) - dot(c.slave_along, c.of_slave), dot(c.master_along, c.of_slave), -dot(c.slave_along, c.of_master),
      dot(c.w, c.master_turn) + dot(c.master_along, c.of_master);
  return J;
}

std::array<std::array<double, 3>, 8> places_of(const std::array<int, 8>& nodes, const std::vector<Point>& positions) {
  std::array<std::array<double, 3>, 8> p{};
  for (std::size_t n = 0; n < 8; ++n)
    for (std::size_t i = 0; i < 3; ++i) p[n][i] = positions[static_cast<std::size_t>(nodes[n])][static_cast<Eigen::Index>(i)];
  return p;
}

template <class S>
S mixed(const EdgePair& pair, std::size_t k, std::size_t l, const S& s, const S& m) {
  const auto K = [&](std::size_t a, std::size_t b) { return pair.stiffness(static_cast<Eigen::Index>(k + a), static_cast<Eigen::Index>(l + b)); };
  return (1.0 - s) * ((1.0 - m) * K(0, 0) + m * K(0, 1)) + s * ((1.0 - m) * K(1, 0) + m * K(1, 1));
}

}  // namespace

// Let two wedges cross at the angle phi and overlap by a depth g. The section of their overlap across the normal is a quadrilateral. Its diagonals
// along the edges are g w_1/sin phi and g w_2/sin phi, w the widths of the wedges at unit depth. So
//   A = g^2 w_1 w_2 / (2 sin phi).
// Two bodies that would overlap in similar sections A ~ g^2 press on one another like a cone on a half space (Sneddon 1965). For a cone of the same
// area, pi g^2 tan^2(a) = A, the force is F = 2/pi E* tan(a) g^2:
//   F = 2/pi^(3/2) E* sqrt(A) g,   1/E* = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2.
// Of a square pyramid this is 5 % too little (Barber and Billings 1990).
WedgeContact wedge_contact(const EdgePiece& slave, const EdgePiece& master) {
  WedgeContact result;
  const Point n = (slave.ends[1] - slave.ends[0]).normalized().cross((master.ends[1] - master.ends[0]).normalized());
  const double sine = n.norm(), compliance = slave.compliance + master.compliance;
  if (!(sine > std::sin(parallel[0])) || !(compliance > 0.0)) return result;
  for (const double sign : {1.0, -1.0}) {
    const Point outward = sign * n / sine;
    const auto one = section_of(slave, outward), other = section_of(master, -outward);
    if (!one || !other) continue;
    result.sign = sign;
    result.area = one->width * other->width / (2.0 * sine);
    const double counts = smooth_step((std::min(one->angle, other->angle) - flush[0]) / (flush[1] - flush[0])) *
                          smooth_step((std::asin(std::min(1.0, sine)) - parallel[0]) / (parallel[1] - parallel[0]));
    result.stiffness = counts * 2.0 / std::pow(M_PI, 1.5) * std::sqrt(result.area) / compliance;
  }
  return result;
}

std::vector<EdgeCrossing> crossings_of(const EdgePair& pair, const std::vector<Point>& positions) {
  std::vector<EdgeCrossing> found;
  Foot foot;
  double before = ahead_on_slave(pair, 0, 0.0, positions, foot);
  for (std::size_t k = 0; k + 1 < pair.slave.nodes.size(); ++k) {
    const double behind =
        k + 2 < pair.slave.nodes.size() ? ahead_on_slave(pair, k + 1, 0.0, positions, foot) : ahead_on_slave(pair, k, 1.0, positions, foot);
    const bool crosses = before > 0.0 && behind <= 0.0;
    before = behind;
    if (!crosses) continue;
    double low = 0.0, high = 1.0;
    for (int halving = 0; halving < 54 && low < high; ++halving) {
      const double middle = 0.5 * (low + high);
      (ahead_on_slave(pair, k, middle, positions, foot) > 0.0 ? low : high) = middle;
    }
    double s = 0.5 * (low + high);
    ahead_on_slave(pair, k, s, positions, foot);
    if (foot.m < 0.0 || foot.m > 1.0) continue;  // beyond an end of the master's edge
    double m = foot.m;
    const std::array<int, 8> nodes = nodes_of(pair, k, foot.piece);
    Crossed<double> c = crossed(places_of(nodes, positions), s, m);
    for (int step = 0; step < 2; ++step) {
      const Eigen::Matrix2d J = slope_of(c);
      if (!(std::abs(J.determinant()) > 0.0)) break;
      const Eigen::Vector2d change = J.inverse() * Eigen::Vector2d(dot(c.w, c.of_slave), dot(c.w, c.of_master));
      s -= change[0];
      m -= change[1];
      c = crossed(places_of(nodes, positions), s, m);
    }
    const Point of_slave(c.of_slave.data()), of_master(c.of_master.data());
    const Point across = of_slave.cross(of_master);
    const double sine = across.norm() / (of_slave.norm() * of_master.norm());
    if (!(sine > std::sin(parallel[0]))) continue;  // where parallel edges are nearest they do not cross
    EdgeCrossing& crossing = found.emplace_back();
    crossing.slave = k;
    crossing.master = foot.piece;
    crossing.s = s;
    crossing.m = m;
    crossing.normal = pair.sign * across.normalized();
    crossing.gap = crossing.normal.dot(Point(c.w.data()));
    crossing.stiffness = mixed(pair, k, foot.piece, s, m);
    crossing.on_slave = Point(c.x.data());
    crossing.on_master = Point(c.y.data());
  }
  return found;
}

// The places s and m carry first derivatives by one step of Newton's method from the root, with the slope of double:
//   ds/dp = -J^-1 d(w.t)/dp.
std::optional<CrossingForce> force_of(const EdgePair& pair, const EdgeCrossing& crossing, const std::vector<Point>& positions) {
  if (!(crossing.gap < 0.0) || !(crossing.stiffness > 0.0)) return std::nullopt;
  using Derivative = Sacado::Fad::SFad<double, 24>;
  CrossingForce result;
  result.nodes = nodes_of(pair, crossing.slave, crossing.master);
  const auto values = places_of(result.nodes, positions);
  const Eigen::Matrix2d inverse = slope_of(crossed(values, crossing.s, crossing.m)).inverse();
  std::array<std::array<Derivative, 3>, 8> p;
  for (int n = 0; n < 8; ++n)
    for (int i = 0; i < 3; ++i)
      p[static_cast<std::size_t>(n)][static_cast<std::size_t>(i)] =
          Derivative(24, 3 * n + i, values[static_cast<std::size_t>(n)][static_cast<std::size_t>(i)]);
  Derivative s = crossing.s, m = crossing.m;
  Crossed<Derivative> c = crossed<Derivative>(p, s, m);
  const Derivative first = dot(c.w, c.of_slave), second = dot(c.w, c.of_master);
  s -= inverse(0, 0) * first + inverse(0, 1) * second;
  m -= inverse(1, 0) * first + inverse(1, 1) * second;
  c = crossed<Derivative>(p, s, m);
  std::array<Derivative, 3> n;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    n[i] = pair.sign * (c.of_slave[j] * c.of_master[k] - c.of_slave[k] * c.of_master[j]);
  }
  const Derivative length = sqrt(dot(n, n));
  for (Derivative& component : n) component /= length;
  const Derivative gap = dot(n, c.w);
  const Derivative force = mixed<Derivative>(pair, crossing.slave, crossing.master, s, m) * gap * gap;
  const std::array<Derivative, 4> share{Derivative((1.0 - s) * force), Derivative(s * force), Derivative((m - 1.0) * force), Derivative(-m * force)};
  result.residual.setZero();
  result.tangent.setZero();
  for (const int a : {0, 1, 2, 3}) {
    const int node = a < 2 ? a : a + 2;
    for (int i = 0; i < 3; ++i) {
      const Derivative value = share[static_cast<std::size_t>(a)] * n[static_cast<std::size_t>(i)];
      result.residual[3 * node + i] = value.val();
      for (int q = 0; q < 24; ++q) result.tangent(3 * node + i, q) = value.dx(q);
    }
  }
  return result;
}

}  // namespace mortise
