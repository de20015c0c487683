// Facets that meet in a kink have their own normals, the node the master's or the nearest facet's; on any number of ranks the same ones.

#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>

#include "exact_derivatives.hpp"
#include "mortise/mortar/coupling/node_to_segment.hpp"
#include "mortise/mortar/coupling/standard_mortar.hpp"
#include "mortise/mortar/coupling/variational_mortar.hpp"

namespace mortise {
namespace {

using namespace test;

constexpr double degree = 3.14159265358979323846 / 180.0, side = 0.5;
constexpr GlobalOrdinal corner = 2, above = 3;
constexpr CornerRule rules[] = {CornerRule::master_normal, CornerRule::nearest_facet};

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

// Not flat, not touching, and in disorder. The master is tilted about the corner.
TwoLines uneven(double angle, double tilt = 0.0) {
  TwoLines lines = folding(angle);
  for (Eigen::Vector2d& x : lines.master) x.y() = std::tan(tilt * degree) * x.x();
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
  pair.kinks = pair.interface->find_kinks(*pair.owned(points), nearest, pair.kinks);
  const bool changed = pair.interface->set_kinks(pair.kinks);
  pair.search(points);
  pair.evaluate(points, true);
  EXPECT_FALSE(pair.failure);
  return changed;
}

// The facet that stands off has a linear gap, so the corner sees the gap at its own place alone, which is zero, and pushes there.
void expect_that_a_corner_sees_its_own_gap(CornerRule rule) {
  for (const double angle : {35.0, 50.0, 65.0, 75.0}) {
    TwoLines lines = folding(angle);
    lines.options.corners = rule;
    const Surfaces surfaces = lines;
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
    if (rule == CornerRule::master_normal && angle < 60.0) {  // half of either facet, which is all covered, seen along the master's normal
      EXPECT_NEAR(coupling.D(corner, corner), 0.5 * (0.7 + side * std::cos(angle * degree)), 1e-13);
    }
    EXPECT_FALSE(split(pair, surfaces.points));
  }
}

TEST(SplitKinks, LetACornerSeeItsOwnGap) {
  for (const CornerRule rule : rules) expect_that_a_corner_sees_its_own_gap(rule);
}

// The far end of the side that stands off is held: its function is nobody's, and the corner sees its own gap still. Along the master it is the
// corner's.
TEST(SplitKinks, LeaveTheFunctionOfAHeldNodeThatStandsOff) {
  for (const double angle : {35.0, 50.0}) {
    TwoLines lines = folding(angle);
    lines.fixed_x = lines.fixed_y = {static_cast<std::size_t>(above)};
    SurfacePair pair(lines, alone());
    ASSERT_TRUE(split(pair, Surfaces(lines).points));
    const DenseCoupling coupling = pair.dense();
    EXPECT_LT(std::abs(coupling.gap[corner]), 1e-13) << angle;
    EXPECT_EQ(coupling.D(corner, above), 0.0) << angle;
    EXPECT_NEAR(coupling.D(corner, corner), 0.5 * (0.7 + side * std::cos(angle * degree)), 1e-13) << angle;
    for (Eigen::Vector2d& x : lines.master) x.y() = std::tan(angle * degree) * x.x();
    for (Eigen::Vector2d& x : lines.slave) x.y() += 0.01;
    SurfacePair along(lines, alone());
    ASSERT_TRUE(split(along, Surfaces(lines).points));
    EXPECT_NEAR(along.dense().D(corner, above), 0.5 * side, 1e-13) << angle;
  }
}

// A node that is coupled by itself takes the master's normal too, and of its facets what is seen along it; of a wall nothing.
TEST(SplitKinks, LetANodeFaceTheMaster) {
  for (const double angle : {35.0, 50.0, 75.0, 90.0}) {
    TwoLines lines = folding(angle);
    lines.options.coupling = coupling_of<NodeToSegmentCoupling>();
    lines.options.search_reach = 0.6;
    for (Eigen::Vector2d& x : lines.slave) x.y() += 0.01;
    const Surfaces surfaces = lines;
    SurfacePair pair(surfaces, alone());
    ASSERT_TRUE(split(pair, surfaces.points));
    const DenseCoupling coupling = pair.dense();
    const double seen = 0.5 * (0.7 + side * std::cos(angle * degree));
    EXPECT_LT((coupling.normal.segment<2>(2 * corner) - Eigen::Vector2d(0.0, -1.0)).norm(), 1e-15) << angle;
    EXPECT_NEAR(coupling.D(corner, corner), seen, 1e-14) << angle;
    EXPECT_NEAR(coupling.gap[corner], 0.01 * seen, 1e-14) << angle;
    lines.options.corners = CornerRule::averaged;
    EXPECT_NEAR(evaluated(lines)->dense().normal[2 * corner], std::sin(0.5 * angle * degree), 1e-14) << angle;
  }
}

void expect_exact_derivatives_of(const TwoLines& lines, bool curved_slave, bool curved_master = false) {
  const Surfaces surfaces = curved_slave || curved_master ? quadratic(lines, curved_slave, curved_master, 0.02) : Surfaces(lines);
  SurfacePair pair(surfaces, alone());
  ASSERT_TRUE(split(pair, surfaces.points));
  expect_exact_derivatives(surfaces, &pair);
}

TEST(SplitKinks, HasExactDerivativesOfANodeThatFacesTheMaster) {
  for (const double tilt : {30.0, 55.0, 66.0, 4.0, -5.0, -14.0})
    for (const bool axisymmetric : {false, true}) {
      SCOPED_TRACE(tilt);
      TwoLines lines = uneven(60.0, tilt);
      lines.options.coupling = coupling_of<NodeToSegmentCoupling>();
      lines.options.search_reach = 0.6;
      lines.measure.axisymmetric = axisymmetric;
      expect_exact_derivatives_of(lines, false);
    }
}

// A wall that leans over begins to be covered at 87 degrees. The corner's multiplier acts along it, if it is a standard one, from nothing on.
TEST(SplitKinks, BeginSmoothlyWhereAWallFacesTheMaster) {
  for (const SharedCoupling& coupling : {coupling_of<DualMortarCoupling>(), coupling_of<StandardMortarCoupling>()}) {
    const auto row_at = [&](double angle) {
      TwoLines lines = folding(angle);
      lines.options.coupling = coupling;
      lines.options.search_reach = 1.0;
      const Surfaces surfaces = lines;
      SurfacePair pair(surfaces, alone());
      split(pair, surfaces.points);
      return std::pair(pair.dense().D(corner, corner), pair.dense().gap[corner]);
    };
    const double begins = 90.0 - std::asin(0.05) / degree;
    const auto [before, gap_before] = row_at(begins + 0.01);
    const auto [after, gap_after] = row_at(begins - 0.01);
    EXPECT_NEAR(before, after, 1e-6);  // w = 0.05 S((c - 0.05) / 0.1), c - 0.05 = 0.01 degrees: 5e-7
    EXPECT_NEAR(gap_before, gap_after, 1e-6);
    const double diagonal = coupling->has_dual_multipliers() ? 1.0 / 2.0 : 1.0 / 3.0;  // int phi N of a side over its length
    EXPECT_GT(row_at(80.0).first, diagonal * (0.7 + 0.6 * side * std::cos(80.0 * degree)));  // most of the share seen by then
  }
}

// Two sides that are one another's image in a master that is its own: so is everything of the corner.
TEST(SplitKinks, LeaveSymmetryAlone) {
  for (const double angle : {20.0, 45.0, 70.0})
    for (const double depth : {-0.02, 0.1}) {
      TwoLines lines;
      lines.slave = {-2.0 * side * towards(-angle), -side * towards(-angle), {0.0, 0.0}, side * towards(angle), 2.0 * side * towards(angle)};
      for (Eigen::Vector2d& x : lines.slave) x.y() += depth;
      lines.master = line(
          8, -4.0, 4.0, [](double x) { return -0.1 * x * x; }, true);
      lines.options.search_reach = 0.3;
      SurfacePair pair(lines, alone());
      split(pair, Surfaces(lines).points);
      const DenseCoupling coupling = pair.dense();
      EXPECT_NEAR(coupling.normal[2 * corner], 0.0, 1e-15) << angle;
      EXPECT_NEAR(coupling.normal[2 * corner + 1], -1.0, 1e-15) << angle;
      EXPECT_LT(std::abs(coupling.gap[above] - coupling.gap[corner - 1]), 1e-15);
      EXPECT_LT((coupling.M.row(corner) - coupling.M.row(corner).reverse()).cwiseAbs().maxCoeff(), 1e-14);
    }
}

// A flat master under a corner between facets along x and at 60 degrees. The corner takes the master's normal inside the wedge of theirs and up to 10
// degrees beyond it. It takes that of the nearer facet from 20 degrees on, and between these angles one in between.
TEST(SplitKinks, TakeTheMastersNormalNearTheWedge) {
  const auto angle_of_normal = [](double tilt) {  // from the first facet's normal
    TwoLines lines = folding(60.0);
    for (Eigen::Vector2d& x : lines.master) x.y() = std::tan(tilt * degree) * x.x();
    lines.options.search_reach = 1.0;
    SurfacePair pair(lines, alone());
    split(pair, Surfaces(lines).points);
    const Eigen::Vector2d normal = pair.dense().normal.segment<2>(2 * corner);
    EXPECT_NEAR(normal.norm(), 1.0, 1e-15);
    return std::atan2(normal.x(), -normal.y()) / degree;
  };
  for (const double inside : {-9.5, -4.0, 0.0, 20.0, 59.0, 69.5}) EXPECT_NEAR(angle_of_normal(inside), inside, 1e-12);
  for (const double beyond : {-20.5, -35.0}) EXPECT_NEAR(angle_of_normal(beyond), 0.0, 1e-12);
  EXPECT_NEAR(angle_of_normal(80.5), 60.0, 1e-12);
  EXPECT_NEAR(angle_of_normal(-15.0), -7.5, 1e-12);  // half of what it leaves by, in the middle of the transition
  EXPECT_NEAR(angle_of_normal(75.0), 67.5, 1e-12);
}

// Half of it, with the corner on the line of symmetry, is half of it.
TEST(SplitKinks, SeeHalfOfACornerOnALineOfSymmetry) {
  for (const double angle : {16.0, 45.0, 70.0})
    for (const bool axisymmetric : {false, true})
      for (const bool ends_there : {false, true}) {
        TwoLines whole, half;
        whole.slave = {-2.0 * side * towards(-angle), -side * towards(-angle), {0.0, 0.0}, side * towards(angle), 2.0 * side * towards(angle)};
        whole.master = line(
            8, -4.0, 4.0, [](double x) { return -0.1 * x * x; }, true);
        whole.options.search_reach = half.options.search_reach = 0.3;
        const auto part = [&](const Points& points) {
          return ends_there ? Points(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(points.size() + 1) / 2)
                            : Points(points.end() - static_cast<std::ptrdiff_t>(points.size() + 1) / 2, points.end());
        };
        half.slave = part(whole.slave);
        Points left = whole.master;
        std::reverse(left.begin(), left.end());  // ascending in x
        half.master = part(left);
        std::reverse(half.master.begin(), half.master.end());
        half.fixed_x = {ends_there ? half.slave.size() - 1 : 0};
        half.measure.axisymmetric = axisymmetric && !ends_there;
        SurfacePair of_half(half, alone()), of_whole(whole, alone());
        ASSERT_TRUE(split(of_half, Surfaces(half).points));
        if (!half.measure.axisymmetric) {
          ASSERT_TRUE(split(of_whole, Surfaces(whole).points));
          const DenseCoupling one = of_half.dense(), two = of_whole.dense();
          const auto h = static_cast<Eigen::Index>(half.fixed_x.front());
          EXPECT_NEAR(one.gap[h], 0.5 * two.gap[corner], 1e-14) << angle;
          EXPECT_NEAR(one.D(h, h), 0.5 * two.D(corner, corner), 1e-14) << angle;
          EXPECT_EQ(one.normal.segment<2>(2 * h), Eigen::Vector2d(0.0, -1.0));
        }
        for (std::size_t n = 0; n < half.slave.size(); ++n)
          if (n != half.fixed_x.front()) half.slave[n] += Eigen::Vector2d(0.0, 0.01 * disorder(n));
        for (Eigen::Vector2d& x : half.slave) x.y() += 0.013;
        SurfacePair uneven_half(half, alone());
        ASSERT_TRUE(split(uneven_half, Surfaces(half).points));
        expect_exact_derivatives(half, &uneven_half);
      }
}

TEST(SplitKinks, HasExactDerivatives) {
  for (const CornerRule rule : rules)
    for (const double angle : {35.0, 70.0})
      for (const bool axisymmetric : {false, true})
        for (const bool curved : {false, true})
          for (const bool standard : {false, true}) {
            TwoLines lines = uneven(angle);
            lines.measure.axisymmetric = axisymmetric;
            lines.options.corners = rule;
            if (standard) lines.options.gap_weighting = GapWeighting::standard;
            expect_exact_derivatives_of(lines, curved);
          }
}

// The master's normal inside the wedge of the sides' normals, at its edges, where it is followed less and less, and where it is not any more.
// Standard multipliers and curved masters are covered too.
TEST(SplitKinks, HasExactDerivativesOfTheMastersNormal) {
  for (const double tilt : {30.0, 55.0, 66.0, 76.0, 4.0, -5.0, -14.0, -17.0, -25.0})
    for (const SharedCoupling& coupling : {coupling_of<DualMortarCoupling>(), coupling_of<StandardMortarCoupling>()}) {
      SCOPED_TRACE(tilt);
      TwoLines lines = uneven(60.0, tilt);
      lines.options.coupling = coupling;
      expect_exact_derivatives_of(lines, false);
      expect_exact_derivatives_of(lines, true, true);
    }
}

// Facets between two corners, and one that is prescribed.
TEST(SplitKinks, HasExactDerivativesOfSeveralCorners) {
  TwoLines lines = uneven(35.0);
  lines.options.search_reach = 1.0;
  lines.slave[above + 1] = lines.slave[above] + side * towards(70.0);
  lines.slave.front() = lines.slave[1] + Eigen::Vector2d(-0.7, 0.5);
  expect_exact_derivatives_of(lines, false);
  expect_exact_derivatives_of(lines, true);
  lines.fixed_x = lines.fixed_y = {static_cast<std::size_t>(above)};
  expect_exact_derivatives_of(lines, false);
}

TEST(SplitKinks, HasExactSecondDerivatives) {
  for (const double angle : {35.0, 70.0})
    for (const bool curved : {false, true}) {
      TwoLines lines = uneven(angle);
      lines.options.coupling = coupling_of<VariationalMortarCoupling>();
      const Surfaces surfaces = curved ? quadratic(lines, true, false, 0.02) : Surfaces(lines);
      SurfacePair pair(surfaces, alone());
      ASSERT_TRUE(split(pair, surfaces.points));
      expect_exact_curvatures(surfaces, &pair);
    }
}

void expect_the_values_of_one_rank(CornerRule rule, double balance) {
  const auto comm = Tpetra::getDefaultComm();
  TwoLines lines = uneven(60.0);
  lines.options.balance = balance;
  lines.options.corners = rule;
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
  for (const FacetCoupling& coupling : pair.couplings)
    for (const LocalOrdinal s : coupling.slave)
      if (static_cast<std::size_t>(s) < pair.interface->slave_nodes().size())
        for (const LocalOrdinal node : coupling.columns)
          EXPECT_TRUE(std::binary_search(pair.interface->coupled_nodes(s).begin(), pair.interface->coupled_nodes(s).end(), node));
  if (balance == 1.0 && comm->getSize() > 1) {
    int moved = 0;
    Teuchos::reduceAll(*comm, Teuchos::REDUCE_MAX, pair.interface->load().redistributions, Teuchos::outArg(moved));
    EXPECT_GT(moved, 0);
  }
}

TEST(SplitKinks, GiveTheValuesOfOneRank) {
  for (const CornerRule rule : rules)
    for (const double balance : {1.0, 100.0}) expect_the_values_of_one_rank(rule, balance);
}

// A bend of less than the angle of a kink, a concave corner, one on a line of symmetry. A corner stays split until it is almost flat.
void expect_corners_between(CornerRule rule, double sharp, double almost_flat) {
  const auto with_rule = [&](TwoLines lines) {
    lines.options.corners = rule;
    return lines;
  };
  const auto one = [&](double angle) {
    TwoLines lines = with_rule(folding(angle));
    lines.slave.back() = lines.slave[above] + side * towards(angle);  // no bend
    return lines;
  };
  const auto is_split = [](const TwoLines& lines) {
    const Surfaces surfaces = lines;
    SurfacePair pair(surfaces, alone());
    return split(pair, surfaces.points);
  };
  EXPECT_TRUE(is_split(one(sharp + 1.0)));
  EXPECT_FALSE(is_split(one(sharp - 1.0)));
  TwoLines concave = one(0.0);
  concave.slave[above] = side * towards(-40.0);
  concave.slave[above + 1] = 2.0 * side * towards(-40.0);
  EXPECT_FALSE(is_split(concave));
  TwoLines fixed = one(60.0);
  fixed.fixed_x = {static_cast<std::size_t>(corner)};
  EXPECT_FALSE(is_split(fixed));

  const Surfaces steep = one(60.0), bent = one(almost_flat + 0.5), flat = one(almost_flat - 0.5);
  SurfacePair pair(steep, alone());
  EXPECT_TRUE(split(pair, steep.points));
  EXPECT_FALSE(split(pair, bent.points));
  EXPECT_TRUE(split(pair, flat.points));
  const auto averaged = evaluated(flat);
  EXPECT_LT((pair.dense().stacked() - averaged->dense().stacked()).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(SplitKinks, LeaveBendsConcaveAndFixedCorners) {
  expect_corners_between(CornerRule::master_normal, 30.0, 5.0);
  expect_corners_between(CornerRule::nearest_facet, 30.0, 5.0);
}

}  // namespace
}  // namespace mortise
