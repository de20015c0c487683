// Nodes on edges and corners of a slave surface in 3D take the master's normal; on any number of ranks the same one.

#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>
#include <map>

#include "exact_derivatives.hpp"
#include "mortise/mortar/coupling/standard_mortar.hpp"
#include "space_pair.hpp"

namespace mortise {
namespace {

using namespace test;

constexpr double degree = 3.14159265358979323846 / 180.0;

/// The lower part of the skin of a unit brick of n^3 cells that is turned, with its lowest node at the origin; a curved or flat master below.
struct Standing {
  int n = 2;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  FacetKind kind = FacetKind::quadrilaterals, master = FacetKind::quadrilaterals;
  double unrest = 0.0;  ///< of the nodes, in shares of a cell
  std::function<double(double, double)> z = [](double, double) { return 0.0; };
  double shear = 0.0;  ///< x += shear z before the turn: edges of 90 degrees less or more

  Surfaces surfaces() const {
    Surfaces result;
    result.dim = 3;
    std::map<std::array<int, 3>, GlobalOrdinal> node_of;
    std::vector<SpatialVector> points;
    const auto node = [&](std::array<int, 3> at) {
      const auto [found, is_new] = node_of.insert({at, static_cast<GlobalOrdinal>(points.size())});
      if (is_new) {
        Eigen::Vector3d x(at[0] + shear * at[2], at[1], at[2]);
        for (std::size_t i = 0; i < 3; ++i) x[static_cast<Eigen::Index>(i)] += unrest * disorder(3 * points.size() + i);
        points.emplace_back(turn * x / n);
      }
      return found->second;
    };
    for (int axis = 0; axis < 3; ++axis)
      for (const int end : {0, n})
        for (int i = 0; i < n; ++i)
          for (int k = 0; k < n; ++k) {
            std::array<std::array<int, 3>, 4> corners{};
            const int of_first[] = {i, i + 1, i + 1, i}, of_second[] = {k, k, k + 1, k + 1};
            for (int a = 0; a < 4; ++a) {
              const int b = end == 0 ? 3 - a : a;  // outwards
              corners[a][axis] = end;
              corners[a][(axis + 1) % 3] = of_first[b];
              corners[a][(axis + 2) % 3] = of_second[b];
            }
            Eigen::Vector3d centre = Eigen::Vector3d::Zero();
            for (const auto& corner : corners) centre += 0.25 * Eigen::Vector3d(corner[0], corner[1], corner[2]);
            if ((turn * centre / n - turn * Eigen::Vector3d::Constant(0.5)).z() > -0.2) continue;
            const GlobalOrdinal a = node(corners[0]), b = node(corners[1]), c = node(corners[2]), d = node(corners[3]);
            if (kind == FacetKind::quadrilaterals) {
              result.slave.push_back({a, b, c, d});
            } else {
              result.slave.push_back({a, b, c});
              result.slave.push_back({a, c, d});
            }
          }
    double lowest = 1e9;
    for (const SpatialVector& x : points) lowest = std::min(lowest, x[2]);
    for (SpatialVector& x : points) x[2] -= lowest;
    result.points = points;
    result.slaves = points.size();
    append_patch({5, 4, -2.13, 2.27, -2.31, 2.19, master, z}, true, 0.0, result, result.master);
    result.options.search_reach = 0.8;
    return result;
  }
};

Eigen::Matrix3d about(const Eigen::Vector3d& axis, double angle) { return Eigen::AngleAxisd(angle * degree, axis.normalized()).toRotationMatrix(); }

Eigen::Matrix3d on_edge(double angle) { return about({1.0, 0.0, 0.0}, angle); }
Eigen::Matrix3d on_corner(double angle) { return about({1.0, -1.0, 0.0}, angle); }

// Searched, split and evaluated; whether the choice was a new one. Collective.
bool split(SurfacePair& pair, const std::vector<SpatialVector>& points) {
  pair.search(points);
  pair.kinks = pair.interface->find_kinks(*pair.owned(points), {}, pair.kinks);
  const bool changed = pair.interface->set_kinks(pair.kinks);
  pair.search(points);
  pair.evaluate(points, true);
  EXPECT_FALSE(pair.failure);
  return changed;
}

std::size_t lowest_node(const Surfaces& surfaces) {
  std::size_t lowest = 0;
  for (std::size_t n = 0; n < surfaces.slaves; ++n)
    if (surfaces.points[n][2] < surfaces.points[lowest][2]) lowest = n;
  return lowest;
}

void expect_exact_derivatives_of(const Surfaces& surfaces) {
  SurfacePair pair(surfaces, alone());
  ASSERT_TRUE(split(pair, surfaces.points));
  expect_exact_derivatives(surfaces, &pair);
}

// A flat master pushes every node that it covers on an edge, or at its end, along its own normal.
TEST(EdgesInSpace, TakeTheNormalOfAFlatMaster) {
  for (const auto kind : {FacetKind::quadrilaterals, FacetKind::triangles})
    for (const Eigen::Matrix3d& turn : {on_edge(10.0), on_edge(30.0), on_edge(45.0), on_corner(10.0), on_corner(30.0), on_corner(54.0)}) {
      Standing standing;
      standing.turn = turn;
      standing.kind = kind;
      const Surfaces surfaces = standing.surfaces();
      SurfacePair pair(surfaces, alone());
      ASSERT_TRUE(split(pair, surfaces.points));
      const DenseCoupling coupling = pair.dense();
      const auto tip = static_cast<Eigen::Index>(lowest_node(surfaces));
      EXPECT_LT((coupling.normal.segment<3>(3 * tip) - Eigen::Vector3d(0.0, 0.0, -1.0)).norm(), 1e-14);
      EXPECT_GT(coupling.D(tip, tip), 0.0);
      EXPECT_LT(std::abs(coupling.gap[tip]), 0.02 * coupling.D(tip, tip));  // the plane is where the tip is
    }
}

// A corner that three sides share alike, on a master that is its own image.
TEST(EdgesInSpace, LeaveSymmetryAlone) {
  Standing standing;
  standing.turn = about({1.0, -1.0, 0.0}, std::atan(std::sqrt(2.0)) / degree);
  standing.turn = about({0.0, 0.0, 1.0}, 45.0) * standing.turn;  // the plane x = 0 is one of symmetry
  Surfaces surfaces = standing.surfaces();
  surfaces.points.resize(surfaces.slaves);
  surfaces.master.clear();
  append_patch({4, 3, -2.0, 2.0, -2.1, 2.3, FacetKind::quadrilaterals, [](double x, double y) { return -0.2 * x * x + 0.1 * y; }}, true, 0.0,
               surfaces, surfaces.master);
  SurfacePair pair(surfaces, alone());
  ASSERT_TRUE(split(pair, surfaces.points));
  const auto tip = static_cast<Eigen::Index>(lowest_node(surfaces));
  const Eigen::Vector3d normal = pair.dense().normal.segment<3>(3 * tip);
  EXPECT_LT(std::min(std::abs(normal[0]), std::abs(normal[1])), 1e-14);
  EXPECT_LT(normal[2], -0.9);
}

TEST(EdgesInSpace, HaveExactDerivatives) {
  constexpr auto quads = FacetKind::quadrilaterals, triangles = FacetKind::triangles;
  for (const auto& [slave, master] : {std::pair(quads, quads), {triangles, quads}, {quads, triangles}, {triangles, triangles}})
    for (const Eigen::Matrix3d& turn : {on_edge(25.0), on_corner(35.0)})
      for (const SharedCoupling& coupling : {coupling_of<DualMortarCoupling>(), coupling_of<StandardMortarCoupling>()}) {
        Standing standing;
        standing.turn = turn;
        standing.kind = slave;
        standing.master = master;
        standing.unrest = 0.03;
        standing.z = [](double x, double y) { return 0.1 * std::sin(1.7 * x) * std::cos(1.3 * y) + 0.1 * x; };
        Surfaces surfaces = standing.surfaces();
        surfaces.options.coupling = coupling;
        expect_exact_derivatives_of(surfaces);
      }
}

// Masters that lean beyond the cone of the sides' normals: followed, less and less, not any more.
TEST(EdgesInSpace, HaveExactDerivativesBesideTheCone) {
  for (const double tilt : {-4.0, -13.0, -17.0, -24.0})
    for (const Eigen::Matrix3d& turn : {on_edge(3.0), on_corner(3.0), Eigen::Matrix3d(on_edge(3.0) * about({0.0, 1.0, 0.0}, 12.0))}) {
      SCOPED_TRACE(tilt);
      Standing standing;
      standing.turn = turn;
      standing.unrest = 0.02;
      standing.z = [tilt](double x, double y) { return std::tan(tilt * degree) * (0.3 * x - y) + 0.02 * x * y; };
      expect_exact_derivatives_of(standing.surfaces());
    }
}

TEST(EdgesInSpace, HaveExactDerivativesOfQuadraticFacets) {
  for (const auto kind : {FacetKind::quadrilaterals, FacetKind::triangles})
    for (const bool curved_master : {false, true}) {
      Standing standing;
      standing.n = 1;
      standing.turn = on_corner(35.0);
      standing.kind = kind;
      standing.unrest = 0.02;
      expect_exact_derivatives_of(quadratic(standing.surfaces(), true, curved_master, 0.02));
    }
}

// Facets on either side of an edge, lying along the master, standing off, and in between, against differences.
TEST(EdgesInSpace, KnowHowTheirFacetsStand) {
  Standing standing;
  standing.turn = on_edge(14.0);
  standing.unrest = 0.03;
  standing.z = [](double x, double y) { return 0.1 * std::sin(1.7 * x) * std::cos(1.3 * y); };
  const Surfaces surfaces = standing.surfaces();
  SurfacePair pair(surfaces, alone());
  ASSERT_TRUE(split(pair, surfaces.points));
  const std::vector<FacetCoupling> at = pair.couplings;
  const double h = 1e-6;
  auto points = surfaces.points;
  double least = 1.0;
  int between = 0;
  for (std::size_t f = 0; f < at.size(); ++f) {
    least = std::min(least, at[f].alignment);
    between += at[f].alignment > 0.0 && at[f].alignment < 1.0;
    if (at[f].facing.rows() == 0) continue;
    ASSERT_EQ(at[f].dalignment.cols(), 3 * static_cast<Eigen::Index>(at[f].columns.size()));
    for (std::size_t c = 0; c < at[f].columns.size(); ++c)
      for (int i = 0; i < 3; ++i) {
        double& coordinate = points[static_cast<std::size_t>(pair.interface->local_nodes()->getGlobalElement(at[f].columns[c]))][i];
        const double here = coordinate;
        coordinate = here + h;
        pair.evaluate(points, false);
        const double up = pair.couplings[f].alignment;
        coordinate = here - h;
        pair.evaluate(points, false);
        EXPECT_NEAR(at[f].dalignment(0, 3 * static_cast<Eigen::Index>(c) + i), (up - pair.couplings[f].alignment) / (2.0 * h), 1e-6);
        coordinate = here;
      }
  }
  EXPECT_EQ(least, 0.0);
  EXPECT_GT(between, 0);
}

// The part of a brick on its edge in front of a plane of symmetry, across the edge or along it.
TEST(EdgesInSpace, HaveExactDerivativesOnPlanesOfSymmetry) {
  for (const int component : {0, 1}) {
    SCOPED_TRACE(component);
    Standing standing;
    standing.turn = on_edge(40.0);
    standing.unrest = 0.02;
    standing.z = [](double x, double y) { return 0.05 * std::sin(1.7 * x) * std::cos(1.3 * y); };
    Surfaces surfaces = standing.surfaces();
    const double at = component == 0 ? 0.5 : surfaces.points[lowest_node(surfaces)][component];
    for (std::size_t n = 0; n < surfaces.slaves; ++n)
      if (std::abs(surfaces.points[n][component] - at) < 0.1) surfaces.points[n][component] = at;
    surfaces.slave.erase(std::remove_if(surfaces.slave.begin(), surfaces.slave.end(),
                                        [&](const SurfaceFacet& facet) {
                                          return std::any_of(facet.begin(), facet.end(), [&](GlobalOrdinal n) {
                                            return surfaces.points[static_cast<std::size_t>(n)][component] < at - 1e-9;
                                          });
                                        }),
                         surfaces.slave.end());
    for (const SurfaceFacet& facet : surfaces.slave)
      for (const GlobalOrdinal n : facet)
        if (std::abs(surfaces.points[static_cast<std::size_t>(n)][component] - at) < 1e-9) fix(surfaces, static_cast<std::size_t>(n), {component});
    expect_exact_derivatives_of(surfaces);
  }
}

TEST(EdgesInSpace, GiveTheValuesOfOneRank) {
  const auto comm = Tpetra::getDefaultComm();
  for (const double balance : {1.0, 100.0}) {
    Standing standing;
    standing.turn = on_corner(30.0);
    standing.unrest = 0.03;
    standing.n = 3;
    standing.z = [](double x, double y) { return 0.1 * std::sin(1.7 * x) * std::cos(1.3 * y); };
    Surfaces surfaces = standing.surfaces();
    surfaces.options.balance = balance;
    SurfacePair serial(surfaces, alone());
    split(serial, surfaces.points);
    const Eigen::VectorXd expected = serial.dense().stacked();
    for (const int blocks : {1, 5}) {
      SurfacePair pair(surfaces, comm, [&](std::size_t n) { return static_cast<int>(n) / blocks % comm->getSize(); });
      EXPECT_TRUE(split(pair, surfaces.points));
      EXPECT_LT((pair.dense().stacked() - expected).cwiseAbs().maxCoeff(), 1e-13);
      for (const FacetCoupling& coupling : pair.couplings)
        for (const LocalOrdinal s : coupling.slave)
          if (static_cast<std::size_t>(s) < pair.interface->slave_nodes().size())
            for (const LocalOrdinal node : coupling.columns)
              EXPECT_TRUE(std::binary_search(pair.interface->coupled_nodes(s).begin(), pair.interface->coupled_nodes(s).end(), node));
    }
  }
}

// A roof upside down, of two sides that turn by `angle` at an edge, and what counts as one.
Surfaces roof(double angle) {
  const double slope = std::tan(0.5 * angle * degree);
  return two_patches({4, 2, -1.0, 1.0, -0.5, 0.5, FacetKind::quadrilaterals, [slope](double x, double) { return slope * std::abs(x); }},
                     {3, 3, -2.0, 2.0, -1.0, 1.0});
}

TEST(EdgesInSpace, AreFoundAndKept) {
  const auto is_split = [](const Surfaces& surfaces) {
    SurfacePair pair(surfaces, alone());
    return split(pair, surfaces.points);
  };
  EXPECT_TRUE(is_split(roof(31.0)));
  EXPECT_FALSE(is_split(roof(29.0)));
  EXPECT_FALSE(is_split(roof(-60.0)));
  const Surfaces steep = roof(60.0), bent = roof(5.5), flat = roof(4.5);
  SurfacePair pair(steep, alone());
  EXPECT_EQ(pair.interface->kinks(*pair.owned(steep.points)), 3);
  EXPECT_TRUE(split(pair, steep.points));
  EXPECT_FALSE(split(pair, bent.points));
  EXPECT_TRUE(split(pair, flat.points));
  const auto averaged = evaluated(flat);
  EXPECT_LT((pair.dense().stacked() - averaged->dense().stacked()).cwiseAbs().maxCoeff(), 1e-14);
}

// Half a roof on the plane of symmetry through its edge is half of it.
TEST(EdgesInSpace, SeeHalfOfAnEdgeInAPlaneOfSymmetry) {
  const auto sides = [](double angle, bool half) {
    const double slope = std::tan(0.5 * angle * degree);
    return two_patches(
        {half ? 2 : 4, 2, half ? 0.0 : -1.0, 1.0, -0.5, 0.5, FacetKind::quadrilaterals, [slope](double x, double) { return slope * std::abs(x); }},
        {half ? 2 : 4, 3, half ? 0.0 : -2.0, 2.0, -1.0, 1.0, FacetKind::quadrilaterals, [](double x, double) { return -0.1 * x * x; }});
  };
  for (const double angle : {40.0, 90.0}) {
    Surfaces whole = sides(angle, false), half = sides(angle, true);
    for (std::size_t j = 0; j < 3; ++j) fix(half, 3 * j, {0});
    SurfacePair of_whole(whole, alone()), of_half(half, alone());
    ASSERT_TRUE(split(of_whole, whole.points));
    ASSERT_TRUE(split(of_half, half.points));
    EXPECT_EQ(of_half.interface->kinks(*of_half.owned(half.points)), 3);
    const DenseCoupling two = of_whole.dense(), one = of_half.dense();
    for (Eigen::Index j = 0; j < 3; ++j) {
      const Eigen::Index h = 3 * j, w = 5 * j + 2;
      EXPECT_NEAR(one.gap[h], 0.5 * two.gap[w], 1e-14);
      EXPECT_NEAR(one.D(h, h), 0.5 * two.D(w, w), 1e-14);
      EXPECT_LT((one.normal.segment<3>(3 * h) - two.normal.segment<3>(3 * w)).norm(), 1e-14);
    }
  }
}

// The numbers of the normals' nodes are those of the last search.
TEST(EdgesInSpace, LeaveNoNormalOfAnEarlierPatternAfterAFailure) {
  Standing standing;
  standing.turn = on_edge(30.0);
  const Surfaces surfaces = standing.surfaces();
  SurfacePair pair(surfaces, alone());
  ASSERT_TRUE(split(pair, surfaces.points));
  std::vector<SpatialVector> moved = surfaces.points;
  for (std::size_t n = surfaces.slaves; n < moved.size(); ++n) moved[n] += Eigen::Vector3d(1.6, 0.4, 0.0);
  ASSERT_TRUE(pair.search(moved));
  const std::size_t tip = lowest_node(surfaces);
  for (const SurfaceFacet& facet : surfaces.slave)
    if (std::find(facet.begin(), facet.end(), static_cast<GlobalOrdinal>(tip)) != facet.end())
      for (const GlobalOrdinal node : facet) moved[static_cast<std::size_t>(node)] = moved[tip];
  pair.evaluate(moved, true);
  ASSERT_TRUE(pair.failure);
  for (std::size_t s = 0; s < pair.interface->slave_nodes().size(); ++s)
    for (const LocalOrdinal node : pair.normals[s].columns)
      EXPECT_TRUE(std::binary_search(pair.interface->coupled_nodes(s).begin(), pair.interface->coupled_nodes(s).end(), node)) << s;
}

// Sides of a brick that are held across themselves, and its bottom, are one slave surface.
TEST(EdgesInSpace, MayBelongToSidesThatAreHeldAside) {
  Standing standing;
  Surfaces surfaces = standing.surfaces();
  for (std::size_t n = 0; n < surfaces.slaves; ++n)
    if (surfaces.points[n][0] == 0.0) fix(surfaces, n, {0});
  SurfacePair pair(surfaces, alone());
  ASSERT_TRUE(split(pair, surfaces.points));
  const DenseCoupling coupling = pair.dense();
  for (std::size_t n = 0; n < surfaces.slaves; ++n)
    if (surfaces.points[n][0] == 0.0 && surfaces.points[n][2] == 0.0) {
      const auto row = static_cast<Eigen::Index>(n);
      EXPECT_LT((coupling.normal.segment<3>(3 * row) - Eigen::Vector3d(0.0, 0.0, -1.0)).norm(), 1e-14);
    }
}

}  // namespace
}  // namespace mortise
