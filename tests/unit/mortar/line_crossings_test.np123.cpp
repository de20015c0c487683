// Where lines cross surfaces whose facets are spread over the ranks.

#include "mortise/mortar/line_crossings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>
#include <cmath>

namespace mortise {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double pi = 3.14159265358979323846;

/// Every facet of `all` on one rank.
std::vector<TaggedFacet> of_this_rank(const std::vector<TaggedFacet>& all) {
  const auto comm = Tpetra::getDefaultComm();
  std::vector<TaggedFacet> mine;
  for (std::size_t f = 0; f < all.size(); ++f)
    if (static_cast<int>(f) % comm->getSize() == comm->getRank()) mine.push_back(all[f]);
  return mine;
}

/// A ring about the origin with a hole: radii 1 and 2, the body between them.
std::vector<TaggedFacet> ring(int count, bool quadratic) {
  std::vector<TaggedFacet> facets;
  const auto at = [&](double radius, double place) {
    const double angle = 2.0 * pi * place / count;
    return Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), 0.0);
  };
  for (int f = 0; f < count; ++f)
    for (const bool outer : {true, false}) {  // the body lies to the left of the way
      const double radius = outer ? 2.0 : 1.0, from = outer ? f : f + 1, to = outer ? f + 1 : f;
      FacetPlaces points{at(radius, from), at(radius, to)};
      if (quadratic) points.push_back(at(radius, f + 0.5));
      facets.push_back({points, outer ? 1 : 2});
    }
  return facets;
}

std::vector<Crossing> along(const std::vector<TaggedFacet>& facets, int dimension, const LineSegment& line) {
  return crossings(*Tpetra::getDefaultComm(), dimension, of_this_rank(facets), {line}).front();
}

MATCHER_P3(Crosses, s, leaves, tag, "") { return std::abs(arg.s - s) < 1e-12 && arg.leaves == leaves && arg.tag == tag; }

// Through nodes, where two facets meet, a crossing may stand twice; between them once.
TEST(LineCrossings, OfARingSayWhereALineEntersAndLeaves) {
  const double chord = std::cos(pi / 8);  // distance of the middle of a facet from the centre, over the radius
  const Eigen::Vector3d d(std::cos(pi / 8), std::sin(pi / 8), 0.0);
  EXPECT_THAT(along(ring(8, false), 2, {{0.0, 0.0, 0.0}, d, 0.0, 10.0}), ElementsAre(Crosses(chord, false, 2), Crosses(2.0 * chord, true, 1)));
  EXPECT_THAT(along(ring(8, false), 2, {1.5 * d, -d, 0.0, 3.0}), ElementsAre(Crosses(1.5 - chord, true, 2), Crosses(1.5 + chord, false, 2)));
  EXPECT_THAT(along(ring(8, false), 2, {{0.0, 0.0, 0.0}, d, 0.0, 0.9}), IsEmpty()) << "too short";
  const auto through_nodes = along(ring(8, false), 2, {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 0.0, 1.5});
  ASSERT_FALSE(through_nodes.empty()) << "no line passes between two facets";
  EXPECT_THAT(through_nodes.front(), Crosses(1.0, false, 2));
}

// The parabola through (-a, 0), (a, 0) and (0, f) is y = f (1 - x^2/a^2): a line x = const, or a slanted one, meets it where a quadratic equation
// says.
TEST(LineCrossings, OfQuadraticLinesAreThoseOfTheParabola) {
  const double a = 0.7, f = 0.2, x = 0.31;
  const std::vector<TaggedFacet> arch{{{Eigen::Vector3d(a, 0.0, 0.0), Eigen::Vector3d(-a, 0.0, 0.0), Eigen::Vector3d(0.0, f, 0.0)}, 4}};
  const double height = f * (1.0 - x * x / (a * a)), slope = -2.0 * f * x / (a * a);
  const auto up = along(arch, 2, {{x, -1.0, 0.0}, {0.0, 1.0, 0.0}, 0.0, 5.0});
  ASSERT_EQ(up.size(), 1u);
  EXPECT_THAT(up[0], Crosses(1.0 + height, true, 4));
  EXPECT_NEAR((up[0].normal - Eigen::Vector3d(-slope, 1.0, 0.0).normalized()).norm(), 0.0, 1e-14);
  const auto chord = along(arch, 2, {{-1.0, 0.5 * f, 0.0}, {1.0, 0.0, 0.0}, 0.0, 5.0});  // in and out again
  ASSERT_EQ(chord.size(), 2u);
  EXPECT_THAT(chord, ElementsAre(Crosses(1.0 - a * std::sqrt(0.5), false, 4), Crosses(1.0 + a * std::sqrt(0.5), true, 4)));
  EXPECT_THAT(along(arch, 2, {{-1.0, 1.01 * f, 0.0}, {1.0, 0.0, 0.0}, 0.0, 5.0}), IsEmpty());
}

/// A facet with all nodes on the sphere of radius R about the origin.
FacetPlaces on_sphere(std::size_t nodes, double R, double size) {
  const auto place = [&](double u, double v) { return Eigen::Vector3d(R * Eigen::Vector3d(u * size, v * size, 1.0).normalized()); };
  FacetPlaces points{place(0, 0), place(1, 0), place(1, 1)};
  if (nodes == 6) points.insert(points.end(), {place(0.5, 0), place(1, 0.5), place(0.5, 0.5)});
  if (nodes == 8) points.insert(points.end(), {place(0, 1), place(0.5, 0), place(1, 0.5), place(0.5, 1), place(0, 0.5)});
  return points;
}

// A quadratic facet leaves the sphere by a length of fourth order, its linear parts by one of second.
TEST(LineCrossings, OfQuadraticFacetsLieOnTheSphereToFourthOrder) {
  for (const std::size_t nodes : {6u, 8u}) {
    double last = 0.0;
    for (const double size : {0.4, 0.2}) {
      const Eigen::Vector3d at = Eigen::Vector3d(0.55 * size, 0.3 * size, 1.0).normalized();
      const auto found = along({{on_sphere(nodes, 2.0, size), 1}}, 3, {0.5 * at, at, 0.0, 9.0});
      ASSERT_EQ(found.size(), 1u) << nodes;
      const double error = std::abs(found[0].s - 1.5), of_normal = (found[0].normal - at).norm();
      EXPECT_TRUE(found[0].leaves);
      EXPECT_LT(error, 2.0 * std::pow(size, 3) / 30.0) << nodes;  // h^2/8R of chords is 0.02 at 0.4
      EXPECT_LT(of_normal, 0.3 * size * size) << nodes;
      if (last > 0.0) {
        EXPECT_LT(error, last / 7.0) << nodes;
      }
      last = error;
    }
  }
}

TEST(LineCrossings, AtGrazingAnglesAreCountedIfThatIsAskedFor) {
  const std::vector<TaggedFacet> flank{{{Eigen::Vector3d(0.0, 0.0, 0.0), Eigen::Vector3d(0.01, 1.0, 0.0)}, 7}};
  const LineSegment line{{0.005, -1.0, 0.0}, {0.0, 1.0, 0.0}, 0.0, 5.0};
  EXPECT_THAT(along(flank, 2, line), IsEmpty());
  const auto found = crossings(*Tpetra::getDefaultComm(), 2, of_this_rank(flank), {line}, Grazing::counted).front();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].s, 1.5, 1e-12);
  EXPECT_LT(std::abs(found[0].along), grazing_angle);
}

TEST(LineCrossings, PassByWhatRunsAlongTheLine) {
  const std::vector<TaggedFacet> flank{{{Eigen::Vector3d(0.0, 0.0, 0.0), Eigen::Vector3d(0.0, 1.0, 0.0)}, 7}};
  EXPECT_THAT(along(flank, 2, {{0.0, -1.0, 0.0}, {0.0, 1.0, 0.0}, 0.0, 5.0}), IsEmpty());
}

/// The sides z = 0 and z = 1 of a unit cube as facets of n nodes.
std::vector<TaggedFacet> top_and_bottom(std::size_t nodes) {
  std::vector<TaggedFacet> facets;
  for (const double z : {0.0, 1.0}) {
    std::vector<Eigen::Vector3d> c{{0.0, 0.0, z}, {1.0, 0.0, z}, {1.0, 1.0, z}, {0.0, 1.0, z}};  // anticlockwise seen from above
    if (z == 0.0) std::swap(c[1], c[3]);
    const auto middle = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return Eigen::Vector3d(0.5 * (a + b)); };
    const int tag = z > 0.0 ? 1 : 2;
    if (nodes % 4 == 0) {
      FacetPlaces points{c[0], c[1], c[2], c[3]};
      if (nodes == 8)
        for (int a = 0; a < 4; ++a) points.push_back(middle(c[a], c[(a + 1) % 4]));
      facets.push_back({points, tag});
      continue;
    }
    for (const auto& t : {std::array<int, 3>{0, 1, 2}, std::array<int, 3>{0, 2, 3}}) {
      FacetPlaces points{c[t[0]], c[t[1]], c[t[2]]};
      if (nodes == 6)
        for (int a = 0; a < 3; ++a) points.push_back(middle(c[t[a]], c[t[(a + 1) % 3]]));
      facets.push_back({points, tag});
    }
  }
  return facets;
}

TEST(LineCrossings, In3DHoldForFacetsOfAnyShape) {
  for (const std::size_t nodes : {3u, 4u, 6u, 8u}) {
    const auto facets = top_and_bottom(nodes);
    EXPECT_THAT(along(facets, 3, {{0.37, 0.21, 0.25}, {0.0, 0.0, 1.0}, 0.0, 5.0}), ElementsAre(Crosses(0.75, true, 1))) << nodes;
    EXPECT_THAT(along(facets, 3, {{0.37, 0.21, 0.25}, {0.0, 0.0, -1.0}, -1.0, 5.0}), ElementsAre(Crosses(-0.75, false, 1), Crosses(0.25, true, 2)))
        << nodes;
    EXPECT_THAT(along(facets, 3, {{1.3, 0.2, 0.25}, {0.0, 0.0, 1.0}, 0.0, 5.0}), IsEmpty()) << nodes;
    const Eigen::Vector3d slanted = Eigen::Vector3d(0.4, 0.3, 0.75).normalized();
    EXPECT_THAT(along(facets, 3, {{0.37, 0.21, 0.25}, slanted, 0.0, 5.0}), ElementsAre(Crosses(0.75 / slanted.z(), true, 1))) << nodes;
  }
}

TEST(SurfacePoints, LieOnTheFacetBesideItsCornersAndHaveItsNormal) {
  const auto line = surface_points(2, {Eigen::Vector3d(1.0, 0.0, 0.0), Eigen::Vector3d(3.0, 0.0, 0.0)});
  ASSERT_EQ(line.size(), 3u);
  EXPECT_THAT(line[0].normal, Eigen::Vector3d(0.0, -1.0, 0.0));
  EXPECT_NEAR(line[0].x.x(), 1.0, 1e-4);
  EXPECT_GT(line[0].x.x(), 1.0);
  EXPECT_EQ(line[1].node, 1);
  for (const std::size_t nodes : {3u, 4u, 6u, 8u})
    for (const TaggedFacet& facet : top_and_bottom(nodes))
      for (const SurfacePoint& point : surface_points(3, facet.points)) {
        EXPECT_NEAR(point.normal.z(), facet.tag == 1 ? 1.0 : -1.0, 1e-14);
        EXPECT_NEAR(point.x.z(), facet.tag == 1 ? 1.0 : 0.0, 1e-14);
        EXPECT_LT(std::abs(point.x.x() - 0.5), 0.5);
      }
}

TEST(Box, CutsALine) {
  Box3 box;
  EXPECT_TRUE(box.empty());
  box.enclose({0.0, 0.0, 0.0});
  box.enclose({2.0, 1.0, 0.0});
  LineSegment line{{-1.0, 0.5, 0.0}, {1.0, 0.0, 0.0}, 0.0, 10.0};
  ASSERT_TRUE(box.cut(line));
  EXPECT_EQ(line.low, 1.0);
  EXPECT_EQ(line.high, 3.0);
  LineSegment beside{{-1.0, 1.5, 0.0}, {1.0, 0.0, 0.0}, 0.0, 10.0};
  EXPECT_FALSE(box.cut(beside));
}

}  // namespace
}  // namespace mortise
