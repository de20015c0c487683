// Facets that meet in a kink have their own normals; on any number of ranks the same ones.

#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>

#include "exact_derivatives.hpp"

namespace mortise {
namespace {

using namespace test;

constexpr double degree = 3.14159265358979323846 / 180.0, side = 0.5;
constexpr GlobalOrdinal corner = 2, above = 3;

Eigen::Vector2d towards(double angle) { return {std::cos(angle * degree), std::sin(angle * degree)}; }

// Two facets along the master, and two of the free side behind the corner at (0, 0), which stand off by `angle` and by 20 degrees more: a kink and a
// bend. The master's facets match none of them.
TwoLines folding(double angle) {
  TwoLines lines;
  const Eigen::Vector2d side_node = side * towards(angle);
  lines.slave = {{-1.5, 0.0}, {-0.7, 0.0}, {0.0, 0.0}, side_node, side_node + side * towards(angle + 20.0)};
  lines.master = line(
      23, -4.1, 4.3, [](double) { return 0.0; }, true);
  lines.options.search_reach = 0.2;  // the upper facet is out of it
  return lines;
}

// Not flat, not touching, and in disorder.
TwoLines uneven(double angle) {
  TwoLines lines = folding(angle);
  for (std::size_t n = 0; n < lines.slave.size(); ++n)
    lines.slave[n] += Eigen::Vector2d(2.0 + 0.01 * disorder(n), 0.03 + 0.02 * disorder(n + 7));  // off the axis of rotation too
  for (std::size_t n = 0; n < lines.master.size(); ++n) lines.master[n] += Eigen::Vector2d(2.0, 0.02 * disorder(n + 31));
  return lines;
}

// Searched, split with the last facet along the master as the corner's nearest, and evaluated; whether the choice was a new one. Collective.
bool split(SurfacePair& pair, const std::vector<SpatialVector>& points) {
  pair.search(points);
  const Map& local = *pair.interface->local_nodes();
  std::vector<Facet<LocalOrdinal>> nearest(pair.interface->slave_nodes().size());
  for (std::size_t s = 0; s < nearest.size(); ++s)
    if (pair.interface->slave_nodes()[s].id == corner) nearest[s] = {local.getLocalElement(corner - 1), local.getLocalElement(corner)};
  const bool changed = pair.interface->split_kinks(*pair.owned(points), nearest);
  pair.search(points);
  pair.evaluate(points, true);
  EXPECT_FALSE(pair.failure);
  return changed;
}

// The facet that stands off has a linear gap, so the corner sees the gap at its own place alone, which is zero, and pushes there.
TEST(SplitKinks, LetACornerSeeItsOwnGap) {
  for (const double angle : {35.0, 50.0, 65.0, 75.0}) {
    const Surfaces surfaces = folding(angle);
    const auto averaged = evaluated(surfaces);
    EXPECT_GT(std::abs(averaged->dense().gap[corner]), 1e-3 * side * side) << angle;  // what the matter is

    SurfacePair pair(surfaces, alone());
    EXPECT_TRUE(split(pair, surfaces.points));
    const DenseCoupling coupling = pair.dense();
    const double reach = *surfaces.options.search_reach + side + 1.0;  // of the master facets that take part
    EXPECT_LT(std::abs(coupling.gap[corner]), 1e-13) << angle;
    EXPECT_NEAR(coupling.gap[above], coupling.D(above, above) * side * std::tan(angle * degree), 1e-13) << angle;
    double moment = 0.0;
    for (Eigen::Index l = 0; l < coupling.M.cols(); ++l) moment += coupling.M(corner, l) * surfaces.points[surfaces.slaves + l].x();
    EXPECT_LT(std::abs(moment), 1e-13 * reach) << angle;
    EXPECT_EQ(coupling.normal.segment<2>(2 * corner), Eigen::Vector2d(0.0, -1.0)) << angle;
    EXPECT_FALSE(split(pair, surfaces.points));
  }
}

TEST(SplitKinks, HasExactDerivatives) {
  for (const double angle : {35.0, 70.0})
    for (const bool axisymmetric : {false, true})
      for (const bool curved : {false, true})
        for (const bool standard : {false, true}) {
          TwoLines lines = uneven(angle);
          lines.measure.axisymmetric = axisymmetric;
          if (standard) lines.options.gap_weighting = GapWeighting::standard;
          const Surfaces surfaces = curved ? quadratic(lines, true, false, 0.02) : Surfaces(lines);
          SurfacePair pair(surfaces, alone());
          ASSERT_TRUE(split(pair, surfaces.points));
          expect_exact_derivatives(surfaces, &pair);
        }
}

TEST(SplitKinks, HasExactSecondDerivatives) {
  for (const double angle : {35.0, 70.0})
    for (const bool curved : {false, true}) {
      TwoLines lines = uneven(angle);
      lines.options.coupling = Coupling::variational_mortar;
      const Surfaces surfaces = curved ? quadratic(lines, true, false, 0.02) : Surfaces(lines);
      SurfacePair pair(surfaces, alone());
      ASSERT_TRUE(split(pair, surfaces.points));
      expect_exact_curvatures(surfaces, &pair);
    }
}

TEST(SplitKinks, GiveTheValuesOfOneRank) {
  const auto comm = Tpetra::getDefaultComm();
  for (const double balance : {1.0, 100.0}) {
    TwoLines lines = uneven(60.0);
    lines.options.balance = balance;
    const Surfaces surfaces = lines;
    SurfacePair serial(surfaces, alone());
    split(serial, surfaces.points);
    const DenseCoupling expected = serial.dense();
    for (const int blocks : {1, 2}) {
      SurfacePair pair(surfaces, comm, [&](std::size_t n) { return static_cast<int>(n) / blocks % comm->getSize(); });
      EXPECT_TRUE(split(pair, surfaces.points));
      EXPECT_LT((pair.dense().stacked() - expected.stacked()).cwiseAbs().maxCoeff(), 1e-13);
    }
    SurfacePair pair(surfaces, comm, [&](std::size_t n) { return n < surfaces.slaves ? 0 : comm->getSize() - 1; });  // one owns it all
    EXPECT_TRUE(split(pair, surfaces.points));
    EXPECT_LT((pair.dense().stacked() - expected.stacked()).cwiseAbs().maxCoeff(), 1e-13);
    if (balance == 1.0 && comm->getSize() > 1) {
      int moved = 0;
      Teuchos::reduceAll(*comm, Teuchos::REDUCE_MAX, pair.interface->load().redistributions, Teuchos::outArg(moved));
      EXPECT_GT(moved, 0);
    }
  }
}

// A bend of less than 30 degrees, a concave corner, one on a line of symmetry. A corner stays split until it is almost flat.
TEST(SplitKinks, LeaveBendsConcaveAndFixedCorners) {
  const auto is_split = [](const TwoLines& lines) {
    const Surfaces surfaces = lines;
    SurfacePair pair(surfaces, alone());
    return split(pair, surfaces.points);
  };
  EXPECT_TRUE(is_split(folding(31.0)));
  EXPECT_FALSE(is_split(folding(29.0)));
  TwoLines concave = folding(0.0);
  concave.slave[above] = side * towards(-40.0);
  concave.slave[above + 1] = 2.0 * side * towards(-40.0);
  EXPECT_FALSE(is_split(concave));
  TwoLines fixed = folding(60.0);
  fixed.fixed_x = {static_cast<std::size_t>(corner)};
  EXPECT_FALSE(is_split(fixed));

  const Surfaces sharp = folding(60.0), bent = folding(6.0), flat = folding(4.0);
  SurfacePair pair(sharp, alone());
  EXPECT_TRUE(split(pair, sharp.points));
  EXPECT_FALSE(split(pair, bent.points));
  EXPECT_TRUE(split(pair, flat.points));
  const auto averaged = evaluated(flat);
  EXPECT_LT((pair.dense().stacked() - averaged->dense().stacked()).cwiseAbs().maxCoeff(), 1e-14);
}

}  // namespace
}  // namespace mortise
