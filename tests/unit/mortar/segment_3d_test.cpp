// Overlaps of facets in 3D, the integrals over them, and their derivatives.

#include "mortise/mortar/segment_3d.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace mortise {
namespace {

double disorder(int n) { return std::sin(12.9898 * n + 78.233); }

PlanePolygon square(double half, double angle, bool clockwise) {
  PlanePolygon polygon;
  for (int a = 0; a < 4; ++a) {
    const double at = angle + (clockwise ? -a : a) * M_PI / 2.0;
    polygon.push_back(std::sqrt(2.0) * half * Eigen::Vector2d(std::cos(at), std::sin(at)));
  }
  return polygon;
}

double area(const ClipPolygon& polygon) {
  double sum = 0.0;
  for (std::size_t v = 2; v < polygon.size(); ++v) sum += 0.5 * doubled_area(polygon[0].position, polygon[v - 1].position, polygon[v].position);
  return sum;
}

// Two concentric squares of side 2, one turned by t. They make an octagon about the unit circle whose sides' normals are t and pi/2 - t apart in
// turn; area = sum of tan(half of the angle between neighbours).
TEST(ConvexClip, MeasuresTurnedSquares) {
  for (const double t : {0.1, 0.3, M_PI / 4.0, 1.2}) {
    const ClipPolygon polygon = clip_convex(square(1.0, 0.0, false), square(1.0, t, true));
    EXPECT_EQ(polygon.size(), 8u);
    EXPECT_NEAR(area(polygon), 4.0 * (std::tan(0.5 * t) + std::tan(0.25 * M_PI - 0.5 * t)), 1e-14);
  }
}

TEST(ConvexClip, KeepsMatchingFacetsWhole) {
  for (const double t : {0.0, 0.3, 1.1}) {
    for (int turn = 0; turn < 4; ++turn) {
      const ClipPolygon polygon = clip_convex(square(1.0, t, false), square(1.0 + 3e-16, t + 0.5 * M_PI * turn + 1e-16, true));
      EXPECT_EQ(polygon.size(), 4u);
      EXPECT_NEAR(area(polygon), 4.0, 1e-14);
    }
    // a neighbour that shares an edge covers nothing
    PlanePolygon moved = square(1.0, t, true);
    const double normal = t + 0.25 * M_PI;
    for (auto& x : moved) x += 2.0 * Eigen::Vector2d(std::cos(normal), std::sin(normal));
    EXPECT_NEAR(area(clip_convex(square(1.0, t, false), moved)), 0.0, 1e-12);
  }
  EXPECT_EQ(clip_convex(square(1.0, 0.2, false), square(0.5, 0.7, true)).size(), 4u);
  EXPECT_NEAR(area(clip_convex(square(1.0, 0.2, false), square(0.5, 0.7, true))), 1.0, 1e-14);
}

struct Pair {
  std::string name;
  FacetVectors slave, normals, master;
};

// A slave facet seen from above and a master facet under it, warped and moved off every tie.
Pair pair(const std::string& name, int slave_nodes, int master_nodes, double size, const Eigen::Vector2d& shift, double warp) {
  Pair result;
  result.name = name;
  for (int a = 0; a < slave_nodes; ++a) {
    const double at = 0.4 + 2.0 * M_PI * a / slave_nodes;
    result.slave.push_back({std::cos(at) + 0.1 * disorder(a), std::sin(at) + 0.1 * disorder(a + 5), warp * disorder(a + 9)});
    result.normals.push_back(Eigen::Vector3d(0.2 * disorder(a + 20), 0.2 * disorder(a + 30), 1.0).normalized());
  }
  for (int l = 0; l < master_nodes; ++l) {
    const double at = -0.1 - 2.0 * M_PI * l / master_nodes;
    result.master.push_back({shift.x() + size * std::cos(at) + 0.1 * disorder(l + 40), shift.y() + size * std::sin(at) + 0.1 * disorder(l + 50),
                             0.3 + warp * disorder(l + 60)});
  }
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.8, Eigen::Vector3d(1.0, -2.0, 0.5).normalized()).toRotationMatrix();
  for (FacetVectors* vectors : {&result.slave, &result.normals, &result.master})
    for (Eigen::Vector3d& v : *vectors) v = turn * v;
  return result;
}

std::vector<Pair> pairs() {
  std::vector<Pair> all;
  for (const int slave : {3, 4})
    for (const int master : {3, 4}) {
      const std::string name = std::to_string(slave) + " on " + std::to_string(master);
      all.push_back(pair(name, slave, master, 1.0, {0.1, 0.2}, 0.15));
      all.push_back(pair(name + ", flat", slave, master, 1.0, {-0.2, 0.1}, 0.0));
      all.push_back(pair(name + ", run off", slave, master, 1.0, {0.9, 0.5}, 0.15));
      all.push_back(pair(name + ", master inside", slave, master, 0.3, {0.0, 0.0}, 0.05));
      all.push_back(pair(name + ", slave inside", slave, master, 4.0, {0.2, 0.1}, 0.15));
    }
  return all;
}

/// The integrals as a function of all positions and normals in 3D, plane and basis included in what moves and what stays.
Eigen::VectorXd evaluate(const Pair& p, const Eigen::MatrixXd& basis, Eigen::MatrixXd* derivative = nullptr) {
  const auto plane = make_auxiliary_plane(p.slave);
  FacetVectors normals, master;
  for (const auto& v : p.normals) normals.push_back(plane->frame * v);
  for (const auto& v : p.master) master.push_back(plane->to_frame(v));
  std::vector<Overlap3d> overlaps;
  find_overlaps(plane->slave, master, overlaps);
  SegmentIntegrals3d result;
  integrate_segment(plane->slave, normals, master, overlaps.at(0), basis, derivative != nullptr, result);
  if (derivative != nullptr) {
    *derivative = result.derivative;
    std::vector<Eigen::Vector3d> vectors(plane->slave.begin(), plane->slave.end());
    vectors.insert(vectors.end(), normals.begin(), normals.end());
    vectors.insert(vectors.end(), master.begin(), master.end());
    plane->to_global(vectors, *derivative);
  }
  return result.value;
}

TEST(SegmentInSpace, DerivativesAgreeWithCentralDifferences) {
  for (const Pair& original : pairs()) {
    SCOPED_TRACE(original.name);
    const auto n = static_cast<Eigen::Index>(original.slave.size());
    Eigen::MatrixXd basis = Eigen::MatrixXd::Identity(n, n);
    basis(0, 1) = 0.4;
    basis(2, 0) = -0.7;
    Eigen::MatrixXd exact;
    const Eigen::VectorXd value = evaluate(original, basis, &exact);
    EXPECT_LT((value - evaluate(original, basis)).cwiseAbs().maxCoeff(), 1e-15);
    Eigen::MatrixXd difference(exact.rows(), exact.cols());
    const double h = 1e-6;
    for (Eigen::Index c = 0; c < exact.cols(); ++c) {
      const auto moved = [&](double by) {
        Pair p = original;
        const Eigen::Index v = c / 3;
        (v < n ? p.slave[v] : v < 2 * n ? p.normals[v - n] : p.master[v - 2 * n])[c % 3] += by;
        return evaluate(p, basis);
      };
      difference.col(c) = (moved(h) - moved(-h)) / (2.0 * h);
    }
    for (Eigen::Index r = 0; r < exact.rows(); ++r)
      EXPECT_LT((exact.row(r) - difference.row(r)).cwiseAbs().maxCoeff(), 1e-6 * exact.row(r).cwiseAbs().maxCoeff()) << r;
  }
}

// Masters that cover a facet measure it together, wherever their edges are. One of them lies along the facet's edge, to within t, with a node in its
// middle. The place of a crossing there, and its derivative, is known to round-off over the distance of the edges.
TEST(SegmentInSpace, DoesNotDependOnMastersThatShareIt) {
  for (const double t : {1e-3, 1e-6, 1e-9, 1e-11, 1e-12, 1e-13, 1e-15, 0.0})
    for (std::size_t seed = 0; seed < 50; ++seed) {
      FacetVectors slave{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, normals(4, Eigen::Vector3d::UnitZ());
      std::vector<Eigen::Vector3d> nodes;
      for (const double y : {-1.0, 0.4, 2.0})
        for (const double x : {-1.0, 1.0, 3.0}) nodes.push_back({x, y, 0.3});
      for (std::size_t i = 0; i < 2; ++i) {
        const auto c = static_cast<Eigen::Index>(i);
        for (std::size_t a = 0; a < slave.size(); ++a) slave[a][c] += t * disorder(7 * (2 * a + i) + 13 * seed);
        for (std::size_t l = 0; l < nodes.size(); ++l) nodes[l][c] += t * disorder(7 * (2 * l + i) + 13 * seed + 3);
      }
      Eigen::MatrixXd of_nodes = Eigen::MatrixXd::Zero(10, 27);  // of int N_i N_j over the facet
      double area = 0.0;
      for (const std::array<int, 4>& facet : std::vector<std::array<int, 4>>{{0, 3, 4, 1}, {1, 4, 5, 2}, {3, 6, 7, 4}, {4, 7, 8, 5}}) {
        FacetVectors master;
        for (const int l : facet) master.push_back(nodes[static_cast<std::size_t>(l)]);
        std::vector<Overlap3d> overlaps;
        find_overlaps(slave, master, overlaps);
        for (const Overlap3d& overlap : overlaps) {
          SegmentIntegrals3d result;
          integrate_segment(slave, normals, master, overlap, Eigen::MatrixXd::Identity(4, 4), true, result);
          for (int l = 0; l < 4; ++l) of_nodes.middleCols<3>(3 * facet[static_cast<std::size_t>(l)]) += result.derivative.block<10, 3>(0, 24 + 3 * l);
          for (const OverlapPoint& point : overlap.points) area += point.weight;
        }
      }
      EXPECT_NEAR(area, 1.0, 4.0 * t + 2e-12);
      EXPECT_LT(of_nodes.cwiseAbs().maxCoeff(), 1e-14 / std::max(t, 1e-12)) << t;
    }
}

// Unit normals, integrals of a flat facet over a plane: the rule is exact for what it has to be exact for.
TEST(SegmentInSpace, MeasuresAFlatGap) {
  Pair p;
  p.slave = {{0.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, {2.0, 1.0, 0.0}, {0.0, 1.0, 0.0}};
  for (int a = 0; a < 4; ++a) p.normals.push_back(Eigen::Vector3d::UnitZ());
  p.master = {{-1.0, -1.0, 0.25}, {-1.0, 3.0, 0.25}, {1.5, 3.0, 0.25}, {1.5, -1.0, 0.25}};
  const Eigen::VectorXd value = evaluate(p, Eigen::MatrixXd::Identity(4, 4));
  EXPECT_NEAR(value.head<10>().sum() * 2.0 - value[0] - value[4] - value[7] - value[9], 1.5, 1e-14);  // sum_ij int N_i N_j
  EXPECT_NEAR(value.segment<16>(10).sum(), 1.5, 1e-14);
  EXPECT_NEAR(value.tail<4>().sum(), 1.5 * 0.25, 1e-14);
  EXPECT_NEAR(value[0], (1.0 - std::pow(0.25, 3)) * 2.0 / 9.0, 1e-14);  // int (1 - x/2)^2 dx int (1 - y)^2 dy
}

TEST(SegmentInSpace, IgnoresWhatDoesNotFace) {
  Pair p = pair("", 4, 4, 1.0, {0.0, 0.0}, 0.0);
  const auto plane = make_auxiliary_plane(p.slave);
  FacetVectors master, back;
  for (const auto& v : p.master) master.push_back(plane->to_frame(v));
  back.assign(master.rbegin(), master.rend());
  const auto overlaps = [&](const FacetVectors& nodes) {
    std::vector<Overlap3d> found;
    find_overlaps(plane->slave, nodes, found);
    return found.size();
  };
  EXPECT_EQ(overlaps(master), 1u);
  EXPECT_EQ(overlaps(back), 0u);
  for (auto& y : master) y.x() += 10.0;
  EXPECT_EQ(overlaps(master), 0u);
  EXPECT_FALSE(make_auxiliary_plane({{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {2.0, 0.0, 0.0}}));
  EXPECT_FALSE(make_auxiliary_plane({{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.2, 0.2, 0.0}, {0.0, 1.0, 0.0}}));  // not convex
}

}  // namespace
}  // namespace mortise
