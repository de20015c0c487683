// Edges that cross: found once wherever they cross, balanced forces, exact derivatives, the area of two wedges' overlap.

#include "mortise/mortar/edge_crossing.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Tpetra_Core.hpp>
#include <cmath>

namespace mortise {
namespace {

using Point = Eigen::Vector3d;

constexpr double degree = M_PI / 180.0;

EdgeLine line(int first, int count) {
  EdgeLine result;
  for (int k = 0; k < count; ++k) {
    result.nodes.push_back(first + k);
    result.tangent.push_back({first + std::max(0, k - 1), first + std::min(count - 1, k + 1)});
  }
  return result;
}

/// A bent edge along x, 3 pieces, and one along another direction above it, 2 pieces; they overlap by a depth.
struct Crossed {
  EdgePair pair{line(0, 4), line(4, 3), Eigen::MatrixXd(4, 3), 1.0};
  std::vector<Point> x;

  explicit Crossed(double depth, double shift = 0.0) {
    for (int k = 0; k < 4; ++k) x.emplace_back(k - 1.4 + shift, 0.1 * k, -0.05 * k * k);
    for (int l = 0; l < 3; ++l) x.emplace_back(0.1 * l, 1.3 * l - 1.5, 0.04 * l - depth - 0.1);
    for (Eigen::Index k = 0; k < 4; ++k)
      for (Eigen::Index l = 0; l < 3; ++l) pair.stiffness(k, l) = 2.0 + 0.3 * static_cast<double>(k) - 0.2 * static_cast<double>(l);
  }
  /// The sum of all forces, in rows of all positions.
  Eigen::VectorXd residual(Eigen::MatrixXd* tangent = nullptr) const {
    const auto size = static_cast<Eigen::Index>(3 * x.size());
    Eigen::VectorXd r = Eigen::VectorXd::Zero(size);
    if (tangent != nullptr) tangent->setZero(size, size);
    for (const EdgeCrossing& crossing : crossings_of(pair, x))
      if (const auto force = force_of(pair, crossing, x))
        for (int a = 0; a < 8; ++a) {
          r.segment<3>(3 * force->nodes[static_cast<std::size_t>(a)]) += force->residual.segment<3>(3 * a);
          for (int b = 0; b < 8 && tangent != nullptr; ++b)
            tangent->block<3, 3>(3 * force->nodes[static_cast<std::size_t>(a)], 3 * force->nodes[static_cast<std::size_t>(b)]) +=
                force->tangent.block<3, 3>(3 * a, 3 * b);
        }
    return r;
  }
};

TEST(EdgeCrossing, DerivativesAreThoseOfDifferences) {
  Crossed edges(0.3);
  ASSERT_EQ(crossings_of(edges.pair, edges.x).size(), 1u);
  Eigen::MatrixXd tangent;
  edges.residual(&tangent);
  ASSERT_GT(tangent.norm(), 0.0);
  const double step = 1e-6;
  for (std::size_t n = 0; n < edges.x.size(); ++n)
    for (int i = 0; i < 3; ++i) {
      Crossed more = edges, less = edges;
      more.x[n][i] += step;
      less.x[n][i] -= step;
      const Eigen::VectorXd slope = (more.residual() - less.residual()) / (2.0 * step);
      EXPECT_LT((slope - tangent.col(3 * static_cast<Eigen::Index>(n) + i)).norm(), 1e-7 * tangent.norm()) << n << ' ' << i;
    }
}

TEST(EdgeCrossing, ForcesAndMomentsBalance) {
  const Crossed edges(0.3);
  const Eigen::VectorXd r = edges.residual();
  Point force = Point::Zero(), moment = Point::Zero();
  for (std::size_t n = 0; n < edges.x.size(); ++n) {
    const Point f = r.segment<3>(3 * static_cast<Eigen::Index>(n));
    force += f;
    moment += edges.x[n].cross(f);
  }
  EXPECT_GT(r.norm(), 0.05);
  EXPECT_LT(force.norm(), 1e-14);
  EXPECT_LT(moment.norm(), 1e-14);
}

// Wherever the slave stands there is one crossing, and its force is continuous where it goes from a piece to the next.
TEST(EdgeCrossing, GoesOnFromPieceToPiece) {
  double last = 0.0;
  int places = 0;
  for (double shift = -1.3; shift < 1.1; shift += 1e-3) {
    const Crossed edges(0.3, shift);
    const auto found = crossings_of(edges.pair, edges.x);
    ASSERT_EQ(found.size(), 1u) << shift;
    const double force = edges.residual().norm();
    if (places++ > 0) {
      EXPECT_NEAR(force, last, 5e-3) << shift;
    }
    last = force;
  }
}

TEST(EdgeCrossing, IsOneWhereNodesMeet) {
  Crossed edges(0.0);
  for (int k = 0; k < 4; ++k) edges.x[static_cast<std::size_t>(k)] = {k - 1.0, 0.0, 0.0};
  for (int l = 0; l < 3; ++l) edges.x[static_cast<std::size_t>(4 + l)] = {0.0, l - 1.0, -0.1};
  const auto found = crossings_of(edges.pair, edges.x);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].gap, -0.1, 1e-15);
}

TEST(EdgeCrossing, IsNoneBeyondAnEnd) {
  for (const double shift : {-2.0, 1.6}) EXPECT_TRUE(crossings_of(Crossed(0.3, shift).pair, Crossed(0.3, shift).x).empty()) << shift;
}

/// A piece of a wedge along `along`, pointing up (or down), with facets that fall by the angle from the plane across.
EdgePiece wedge(const Point& along, double angle, bool up, double compliance) {
  const Point across = Point::UnitZ().cross(along);
  const double height = (up ? -1.0 : 1.0) * std::sin(angle);
  return {{0, 1},
          {Point(-along), along},
          {Point(-along + std::cos(angle) * across + height * Point::UnitZ()), Point(-along - std::cos(angle) * across + height * Point::UnitZ())},
          compliance};
}

// Two wedges of 90 degrees that cross at phi: the section of their overlap at unit depth is a rhombus with diagonals 2/sin phi.
TEST(WedgeContact, HasTheAreaOfTheOverlap) {
  for (const double phi : {10.0, 30.0, 60.0, 90.0}) {
    const Point other(std::cos(phi * degree), std::sin(phi * degree), 0.0);
    const WedgeContact found = wedge_contact(wedge(Point::UnitX(), 45.0 * degree, true, 0.01), wedge(other, 45.0 * degree, false, 0.03));
    EXPECT_NEAR(found.area, 2.0 / std::sin(phi * degree), 1e-12);
    EXPECT_NEAR(found.stiffness, 2.0 / std::pow(M_PI, 1.5) * std::sqrt(found.area) / 0.04, 1e-10);
    EXPECT_EQ(found.sign, 1.0);
    EXPECT_EQ(wedge_contact(wedge(Point::UnitX(), 45.0 * degree, true, 0.01), wedge(-other, 45.0 * degree, false, 0.03)).sign, -1.0);
  }
}

TEST(WedgeContact, IsNoneOfFlatParallelOrTurnedEdges) {
  const auto stiffness = [](const EdgePiece& one, const EdgePiece& other) { return wedge_contact(one, other).stiffness; };
  const EdgePiece ridge = wedge(Point::UnitX(), 45.0 * degree, true, 1.0);
  EXPECT_GT(stiffness(ridge, wedge(Point::UnitY(), 21.0 * degree, false, 1.0)), 0.0);
  EXPECT_EQ(stiffness(ridge, wedge(Point::UnitY(), 9.0 * degree, false, 1.0)), 0.0);  // lies on it
  EXPECT_EQ(stiffness(ridge, wedge(Point::UnitY(), 45.0 * degree, true, 1.0)), 0.0);  // both point upwards
  EXPECT_EQ(stiffness(ridge, wedge(Point(1.0, 0.01, 0.0).normalized(), 45.0 * degree, false, 1.0)), 0.0);
  EdgePiece rigid = ridge, other = wedge(Point::UnitY(), 45.0 * degree, false, 0.0);
  rigid.compliance = 0.0;
  EXPECT_EQ(stiffness(rigid, other), 0.0);
}

// Each rank finds of its own slave pieces all that are near, whichever rank has them.
TEST(NearPieces, AreFoundOnAllRanks) {
  const auto comm = Tpetra::getDefaultComm();
  const int rank = comm->getRank(), ranks = comm->getSize();
  const auto piece = [](GlobalOrdinal first, const Point& a, const Point& b) { return EdgePiece{{first, first + 1}, {a, b}, {a, b}, 0.5}; };
  std::vector<EdgePiece> slaves, masters;
  for (int k = 0; k < 12; ++k) {
    if (k % ranks == rank) slaves.push_back(piece(100 + 2 * k, {1.0 * k, 0.0, 0.0}, {k + 1.0, 0.0, 0.0}));
    if ((k + 1) % ranks == rank) masters.push_back(piece(200 + 2 * k, {k + 0.5, -1.0, 0.2}, {k + 0.5, 1.0, 0.2}));
  }
  std::size_t count = 0;
  for (const NearPieces& near : near_pieces(*comm, slaves, masters, 0.3)) {
    EXPECT_EQ(near.master.nodes[0] - 200, slaves[near.slave].nodes[0] - 100);
    EXPECT_EQ(near.master.compliance, 0.5);
    EXPECT_NEAR(distance(slaves[near.slave], near.master), 0.2, 1e-15);
    ++count;
  }
  EXPECT_EQ(count, slaves.size());
}

}  // namespace
}  // namespace mortise
