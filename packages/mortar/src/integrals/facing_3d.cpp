#include "integrals/facing_3d.hpp"

#include <Eigen/LU>

#include "integrals/triangle_points.hpp"
#include "mortise/shape/quadrature.hpp"
#include "mortise/shape/quadrilateral4.hpp"
#include "mortise/shape/quadrilateral8.hpp"
#include "mortise/shape/triangle3.hpp"
#include "mortise/shape/triangle6.hpp"

namespace mortise {
namespace {

using Values = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 8, 1>;
using Slopes = Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::ColMajor, 2, 8>;
using Gradients = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::ColMajor, 24, 2>;  // of all rows, with respect to a place on the plane

template <class Shape>
Slopes gradients_of(const Eigen::Vector2d& xi) {
  const auto gradients = Shape::gradients(std::array<double, 2>{xi[0], xi[1]});
  Slopes result(2, Shape::nodes);
  for (int a = 0; a < Shape::nodes; ++a) result.col(a) << gradients[a][0], gradients[a][1];
  return result;
}

Slopes facet_gradients(std::size_t nodes, const Eigen::Vector2d& xi) {
  switch (nodes) {
    case 3:
      return gradients_of<Triangle3>(xi);
    case 4:
      return gradients_of<Quadrilateral4>(xi);
    case 6:
      return gradients_of<Triangle6>(xi);
    default:
      return gradients_of<Quadrilateral8>(xi);
  }
}

// sum_l c_l d2N_l / dxi2. The gradients are polynomials of at most second degree in each coordinate, of which these differences are exact.
Eigen::Matrix2d curvature(std::size_t nodes, const Eigen::Vector2d& xi, const Values& c) {
  Eigen::Matrix2d result;
  for (int k = 0; k < 2; ++k)
    result.col(k) = (facet_gradients(nodes, xi + 0.5 * Eigen::Vector2d::Unit(k)) - facet_gradients(nodes, xi - 0.5 * Eigen::Vector2d::Unit(k))) * c;
  return result;
}

// A facet at a point: its functions, their slopes on the plane, and those of the map.
struct AtPlace {
  Values N;
  Slopes slope;             // dN_a / ds
  Eigen::Matrix2d inverse;  // dxi / ds

  AtPlace(const FacetVectors& nodes, const Eigen::Vector2d& xi) : N(facet_values(nodes.size(), xi)) {
    const Slopes reference = facet_gradients(nodes.size(), xi);
    Eigen::Matrix2d map = Eigen::Matrix2d::Zero();
    for (std::size_t a = 0; a < nodes.size(); ++a) map += nodes[a].head<2>() * reference.col(static_cast<Eigen::Index>(a)).transpose();
    inverse = map.inverse();
    slope = inverse.transpose() * reference;
  }
};

class Facing {
 public:
  Facing(const FacetVectors& slave, const FacetVectors& master, const Overlap3d& overlap)
      : slave_(slave),
        master_(master),
        overlap_(overlap),
        basis_(non_negative_basis(3, slave.size())),
        n_(static_cast<Eigen::Index>(slave.size())),
        m_(static_cast<Eigen::Index>(master.size())) {}

  void integrate(bool derivatives, FacingIntegrals3d& result) {
    result.value.setZero(3 * n_);
    const auto& rule = triangle_points(slave_.size());
    if (!derivatives) {
      for (const OverlapPoint& point : overlap_.points) result.value += point.weight * integrand(point.xi, point.eta);
      return;
    }
    result.derivative.setZero(3 * n_, 3 * (n_ + m_));
    derivative_ = &result.derivative;
    const std::size_t vertices = overlap_.polygon.size();
    std::vector<Eigen::Vector2d> position;
    Eigen::Vector2d centre = Eigen::Vector2d::Zero();
    for (const ClipVertex& vertex : overlap_.polygon) {
      position.push_back(vertex.position);
      centre += vertex.position / static_cast<double>(vertices);
    }
    position.push_back(centre);
    std::vector<Gradients> of_vertex(vertices + 1, Gradients::Zero(3 * n_, 2));
    for (std::size_t t = 0; t < overlap_.triangles.size(); ++t) {
      const auto& corner = overlap_.triangles[t];
      Eigen::VectorXd of_unit_area = Eigen::VectorXd::Zero(3 * n_);  // it may have none, and grow
      for (std::size_t q = 0; q < rule.size(); ++q) {
        const OverlapPoint& point = overlap_.points[t * rule.size() + q];
        of_unit_area += rule[q].weight * integrand(point.xi, point.eta);
        const Gradients moved = move(point);
        for (int k = 0; k < 3; ++k) of_vertex[corner[k]] += rule[q].share[k] * moved;
      }
      result.value += doubled_area(position[corner[0]], position[corner[1]], position[corner[2]]) * of_unit_area;
      // d(2A) = dv_k . (v_j - v_i turned by +90 degrees), k, i, j in turn
      for (int k = 0; k < 3; ++k) {
        const Eigen::Vector2d edge = position[corner[(k + 2) % 3]] - position[corner[(k + 1) % 3]];
        of_vertex[corner[k]] += of_unit_area * Eigen::RowVector2d(-edge.y(), edge.x());
      }
    }
    for (std::size_t v = 0; v < vertices; ++v) of_vertex[v] += of_vertex[vertices] / static_cast<double>(vertices);
    for (std::size_t v = 0; v < vertices; ++v) hand_out(v, of_vertex[v], position);
  }

 private:
  auto of_node(Eigen::Index node) { return derivative_->middleCols<2>(3 * node); }

  Values functions(const Values& N) const { return basis_ == nullptr ? N : Values(basis_->of_shape * N); }

  // z'
  Eigen::Vector2d tilt(const Slopes& slope) const {
    Eigen::Vector2d h = Eigen::Vector2d::Zero();
    for (Eigen::Index l = 0; l < m_; ++l) h += slope.col(l) * master_[static_cast<std::size_t>(l)].z();
    return h;
  }

  static Eigen::Vector3d faced(const Eigen::Vector2d& h) { return Eigen::Vector3d(-h[0], -h[1], 1.0) / (1.0 + h.squaredNorm()); }

  Eigen::VectorXd integrand(const Eigen::Vector2d& xi, const Eigen::Vector2d& eta) const {
    const Eigen::Vector3d f = faced(tilt(AtPlace(master_, eta).slope));
    const Values N = functions(facet_values(slave_.size(), xi));
    return (f * N.transpose()).reshaped();
  }

  // Change of the integrand, times the weight, with the place s of a point. Its dependence on the nodes goes to them. With J = ds/deta
  //   dN = N' (ds - sum N_a dX_a),   dz' = sum_l N_l' (dz_l - z' . dY_l) + J^-T (sum_l (z_l - z' . Y_l) d2N_l) J^-1 (ds - sum N_l dY_l).
  Gradients move(const OverlapPoint& point) {
    const AtPlace slave(slave_, point.xi), master(master_, point.eta);
    const Eigen::Vector2d h = tilt(master.slope);
    const Eigen::Vector3d f = faced(h);
    const double square = 1.0 + h.squaredNorm();
    Eigen::Matrix<double, 3, 2> of_h = -2.0 / square * f * h.transpose();
    of_h.topRows<2>() -= Eigen::Matrix2d::Identity() / square;
    Values off(m_);
    for (Eigen::Index l = 0; l < m_; ++l) {
      const Eigen::Vector3d& y = master_[static_cast<std::size_t>(l)];
      off[l] = y.z() - h.dot(y.head<2>());
    }
    const Eigen::Matrix2d bend = master.inverse.transpose() * curvature(master_.size(), point.eta, off) * master.inverse;
    const Values N = functions(slave.N);
    const Slopes slope = basis_ == nullptr ? slave.slope : Slopes(slave.slope * basis_->of_shape.transpose());
    Gradients from_slave(3 * n_, 2), from_master(3 * n_, 2);
    for (Eigen::Index j = 0; j < n_; ++j) {
      from_slave.middleRows<3>(3 * j) = point.weight * f * slope.col(j).transpose();
      from_master.middleRows<3>(3 * j) = point.weight * N[j] * of_h * bend;
    }
    for (Eigen::Index a = 0; a < n_; ++a) of_node(a) -= slave.N[a] * from_slave;
    for (Eigen::Index l = 0; l < m_; ++l) {
      of_node(n_ + l) -= master.N[l] * from_master;
      const Eigen::Vector3d with_height = point.weight * of_h * master.slope.col(l);
      for (Eigen::Index j = 0; j < n_; ++j) {
        derivative_->block<3, 2>(3 * j, 3 * (n_ + l)) -= N[j] * with_height * h.transpose();
        derivative_->block<3, 1>(3 * j, 3 * (n_ + l) + 2) += N[j] * with_height;
      }
    }
    return from_slave + from_master;
  }

  // Nodes of the clipped polygons: those of the slave's part, then those of the master's.
  auto of_polygon_node(int node) {
    const auto slaves = static_cast<int>(overlap_.slave_part.size());
    return of_node(node < slaves ? overlap_.slave_part[node] : n_ + overlap_.master_part[node - slaves]);
  }

  void hand_out(std::size_t v, const Gradients& of_vertex, const std::vector<Eigen::Vector2d>& position) {
    PlanePolygon first, second;
    for (const int a : overlap_.slave_part) first.push_back(slave_[a].head<2>());
    for (const int l : overlap_.master_part) second.push_back(master_[l].head<2>());
    const ClipVertex& vertex = overlap_.polygon[v];
    if (const auto node = vertex_node(vertex, first, second)) {
      of_polygon_node(*node) += of_vertex;
      return;
    }
    const EdgeCrossing crossing = edge_crossing(vertex, first, second);
    if (crossing.nearly_parallel()) {
      const std::size_t count = overlap_.polygon.size(), end = vertex.second_leaves ? (v + 1) % count : (v + count - 1) % count;
      add_nearly_parallel(crossing, of_vertex, position[v], position[end], vertex.second_leaves);
      return;
    }
    for (const VertexPart& part : vertex_parts(crossing)) of_polygon_node(part.node) += of_vertex * part.slope;
  }

  // As that of Integrator in segment_3d_kernel.hpp.
  void add_nearly_parallel(const EdgeCrossing& crossing, const Gradients& of_vertex, const Eigen::Vector2d& v, const Eigen::Vector2d& end,
                           bool leaves) {
    Eigen::VectorXd beside = Eigen::VectorXd::Zero(3 * n_);
    for (const LinePoint& point : gauss_legendre(3)) {
      const double share = 0.5 * (1.0 + point.xi);
      const Eigen::Vector2d s = v + share * (end - v);
      beside += 0.5 * point.weight * (1.0 - share) *
                integrand(facet_coordinates(slave_, overlap_.slave_part, s), facet_coordinates(master_, overlap_.master_part, s));
    }
    const double length = (end - v).dot(crossing.other) / crossing.other.squaredNorm();
    beside *= leaves ? -length : length;
    const Gradients sliding = beside * crossing.across().transpose(), staying = of_vertex - sliding;
    for (int e = 0; e < 2; ++e) {
      of_polygon_node(crossing.first_nodes[e]) += (e == 0 ? 1.0 - crossing.t : crossing.t) * staying;
      of_polygon_node(crossing.second_nodes[e]) += (e == 0 ? 1.0 - crossing.u : crossing.u) * sliding;
    }
  }

  const FacetVectors &slave_, &master_;
  const Overlap3d& overlap_;
  const NonNegativeBasis* basis_;
  Eigen::Index n_, m_;
  Eigen::MatrixXd* derivative_ = nullptr;  // of the result
};

}  // namespace

void integrate_facing(const FacetVectors& slave, const FacetVectors& master, const Overlap3d& overlap, bool derivatives, FacingIntegrals3d& result) {
  Facing(slave, master, overlap).integrate(derivatives, result);
}

}  // namespace mortise
