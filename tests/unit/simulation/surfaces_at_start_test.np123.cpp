// Bodies that overlap at the start: found whatever the depth, reported with the place, refused where no side is the nearest.

#include "mortise/simulation/model/surfaces_at_start.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>
#include <algorithm>
#include <cmath>

#include "mortise/simulation/model/model.hpp"
#include "scene_text.hpp"

namespace mortise {
namespace {

using namespace test;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A block 1 x 1 (x 1) on a base 3 x 1 (x 3) whose top is y = 0 (z = 0): the block begins `depth` in it. Both are clamped on the far side.
struct Case {
  double depth = 0.0;
  int base_cells = 15, top_cells = 6;
  bool space = false;
  std::string element = "";
  std::string pair = "";  ///< more parameters of the pair
  std::string slave = "top/bottom", master = "base/top";
  double shift = 0.0;        ///< of the block along x
  double base_height = 1.0;  ///< from there down
  bool with_pair = true;
  std::string more_bodies = "", more_conditions = "";
};

std::string number(const std::string& name, const std::string& value) { return parameter(name, "string", value); }

std::string block(const Case& one, const std::string& name, double width, double height, int cells, double x, double z) {
  const std::string along = fmt::format("{}", width), up = fmt::format("{}", height), count = fmt::format("{}", cells);
  const std::string element = one.element.empty() ? (one.space ? "H8" : "Q4") : one.element;
  std::string mesh = number("width", along) + number("height", up) + number("cells x", count) + number("cells y", one.space ? count : "4");
  if (one.space)
    mesh += number("type", "brick") + number("depth", along) + number("cells z", "3") + number("translation", fmt::format("{0}, {0}, {1}", x, z));
  else
    mesh += number("type", "block") + number("translation", fmt::format("{}, {}", x, z));
  return list(name, number("material", "soft") + number("element", element) + list("mesh", mesh));
}

std::string scene_text(const Case& one) {
  const std::string bodies = block(one, "base", 3.0, one.base_height, one.base_cells, -1.0, -one.base_height) +
                             block(one, "top", 1.0, 1.0, one.top_cells, one.shift, -one.depth) + one.more_bodies;
  const auto clamp = [&](const std::string& name, const std::string& set) {
    return list(name, number("set", set) + number("x", "0") + number("y", "0") + (one.space ? number("z", "0") : ""));
  };
  const std::string pair = list("joint", number("slave", one.slave) + number("master", one.master) + one.pair);
  return list(
      "overlap",
      number("kinematics", one.space ? "three dimensional" : "plane strain") +
          list("materials", list("soft", number("type", "neo hooke") + number("young's modulus", "1000") + number("poisson's ratio", "0.3"))) +
          list("bodies", bodies) + list("boundary conditions", clamp("floor", "base/bottom") + clamp("ram", "top/top") + one.more_conditions) +
          (one.with_pair ? list("contact", pair) : ""));
}

struct Found {
  SurfacesAtStart start;
  std::string error;
};

Found examine(const Case& one) {
  Found found;
  try {
    const Model model(Tpetra::getDefaultComm(), read_text(scene_text(one)), Timers());
    found.start = model.surfaces_at_start();
  } catch (const InputError& error) {
    found.error = error.what();
  }
  return found;
}

// From a hundredth of a facet to more than two, with facets of either side far smaller and far larger than the overlap.
TEST(InitialOverlap, OfAnyDepthIsFoundWithItsPlace) {
  for (const double depth : {0.002, 0.05, 0.19, 0.24, 0.4})
    for (const auto& [base_cells, top_cells] : {std::pair{15, 6}, std::pair{3, 40}, std::pair{90, 1}}) {
      Case one;
      one.depth = depth, one.base_cells = base_cells, one.top_cells = top_cells;
      for (const bool exchanged : {false, true}) {
        if (exchanged) std::swap(one.slave, one.master);
        const Found found = examine(one);
        ASSERT_EQ(found.error, "") << depth;
        const PairAtStart& pair = found.start.pairs.front();
        EXPECT_NEAR(pair.overlap.depth, depth, 1e-9);
        EXPECT_NEAR(pair.longest, std::max(3.0 / base_cells, 1.0 / top_cells), 1e-12);
        if (depth > pair.longest) {
          ASSERT_TRUE(pair.reach);
          EXPECT_GT(*pair.reach, depth);
        }
        if (depth < 0.4 * pair.longest) EXPECT_FALSE(pair.reach) << "shallow overlaps leave the search as it is";
        const bool on_block = pair.overlap.surface == "top/bottom";
        EXPECT_NEAR(pair.overlap.place[1], on_block ? -depth : 0.0, 1e-12);
        EXPECT_THAT(found.start.strays, IsEmpty());
      }
    }
}

TEST(InitialOverlap, In3DHoldsForEveryFacet) {
  for (const char* element : {"H8", "Tet4", "Tet10", "H20", "W6", "W15"})
    for (const double depth : {0.02, 0.24, 0.4}) {
      Case one;
      one.space = true, one.element = element, one.depth = depth, one.base_cells = 5, one.top_cells = 2;
      const Found found = examine(one);
      ASSERT_EQ(found.error, "") << element;
      EXPECT_NEAR(found.start.pairs.front().overlap.depth, depth, 1e-9) << element;
    }
}

TEST(InitialOverlap, OfSurfacesThatTouchOrAreApartIsNoneAndTheGapIsTold) {
  for (const double gap : {0.0, 0.001, 0.3, 5.0})
    for (const bool space : {false, true}) {
      Case one;
      one.depth = -gap, one.space = space;
      if (space) one.base_cells = 5, one.top_cells = 2;
      const Found found = examine(one);
      ASSERT_EQ(found.error, "");
      EXPECT_EQ(found.start.pairs.front().overlap.depth, 0.0);
      ASSERT_TRUE(found.start.pairs.front().gap);
      EXPECT_NEAR(*found.start.pairs.front().gap, gap, 1e-9);
    }
}

// Beside the base, at its edge, flush with its flank: not in it.
TEST(InitialOverlap, OfBodiesSideBySideIsNone) {
  for (const double shift : {2.0, 2.5, -2.0, -4.0}) {
    Case one;
    one.depth = 0.3, one.shift = shift;
    const Found found = examine(one);
    EXPECT_EQ(found.error, "") << shift;
    ASSERT_EQ(found.start.pairs.size(), 1u);
    EXPECT_EQ(found.start.pairs.front().overlap.depth, 0.0) << shift;
  }
  Case flush;
  flush.depth = 0.3, flush.shift = 1.0;
  EXPECT_NEAR(examine(flush).start.pairs.front().overlap.depth, 0.3, 1e-9) << "flank on flank, but within";
}

TEST(InitialOverlap, IsRefusedWhereThePairSaysSo) {
  Case one;
  one.depth = 0.24, one.pair = number("initial overlap", "error");
  EXPECT_THAT(examine(one).error, AllOf(HasSubstr("contact/joint: the surfaces overlap by 0.24 at the start, deepest at node "),
                                        HasSubstr("of \"top/bottom\" at (0, -0.24)"), HasSubstr("\"initial overlap\" says that this is an error")));
  one.depth = 0.0;
  EXPECT_EQ(examine(one).error, "");
}

TEST(InitialOverlap, BeyondAGivenReachIsRefused) {
  Case one;
  one.depth = 0.24, one.pair = number("search reach", "0.2");
  EXPECT_THAT(examine(one).error, AllOf(HasSubstr("0.24"), HasSubstr("beyond the search reach 0.2")));
  one.pair = number("search reach", "0.3");
  const Found found = examine(one);
  EXPECT_EQ(found.error, "");
  EXPECT_FALSE(found.start.pairs.front().reach) << "a given one stays";
}

TEST(InitialOverlap, BeyondTheMiddleOfTheOtherBodyIsRefused) {
  Case one;
  one.depth = 0.6;
  EXPECT_THAT(examine(one).error,
              AllOf(HasSubstr("overlap by 0.6 at the start"), HasSubstr("more than half of the 1 that body 'base' is thick there")));
}

TEST(InitialOverlap, OfABodyWhollyWithinAnotherIsRefused) {
  Case one;
  one.depth = 2.0, one.base_height = 5.0;
  EXPECT_THAT(examine(one).error, AllOf(HasSubstr("the slave \"top/bottom\" begins within body 'base'"), HasSubstr("(0, -2)")));
}

TEST(InitialOverlap, OfBodiesWithoutAPairIsTold) {
  Case one;
  one.depth = 0.24, one.with_pair = false;
  const Found found = examine(one);
  ASSERT_EQ(found.error, "");
  ASSERT_EQ(found.start.strays.size(), 1u);
  EXPECT_EQ(found.start.strays.front().first, "base");
  EXPECT_EQ(found.start.strays.front().second, "top");
  EXPECT_NEAR(found.start.strays.front().overlap.depth, 0.24, 1e-9);
  one.depth = 0.0;
  EXPECT_THAT(examine(one).start.strays, IsEmpty()) << "bodies that touch";
  one.depth = 2.0, one.base_height = 5.0;
  const Found within = examine(one);
  ASSERT_EQ(within.start.strays.size(), 1u);
  EXPECT_EQ(within.start.strays.front().overlap.depth, 0.0);
}

enum class SolidSide { below, above };

/// The block, from y = 10 to y = 11, and a rigid table from -half to half at a height. A profile's body lies to the left of the way along its points.
Found on_table(double height, SolidSide side, double half = 4.0) {
  Case one;
  const std::string points =
      side == SolidSide::below ? fmt::format("{1}, {0}, -{1}, {0}", height, half) : fmt::format("-{1}, {0}, {1}, {0}", height, half);
  one.more_bodies = list(
      "table", parameter("rigid", "bool", "true") + list("mesh", number("type", "profile") + number("points", points) + number("cell size", "0.5")));
  one.more_conditions = list("hold", number("set", "table/reference") + number("x", "0") + number("y", "0") + number("rotation", "0"));
  one.depth = -10.0;
  one.master = "table/profile";
  return examine(one);
}

TEST(RigidSurfaces, HaveASolidSideThatNothingMayBeginBehind) {
  const Found touching = on_table(10.0, SolidSide::below), apart = on_table(9.0, SolidSide::below), in = on_table(10.15, SolidSide::below);
  ASSERT_EQ(touching.error + apart.error + in.error, "");
  EXPECT_EQ(touching.start.pairs.front().overlap.depth, 0.0);
  ASSERT_TRUE(apart.start.pairs.front().gap);
  EXPECT_NEAR(*apart.start.pairs.front().gap, 1.0, 1e-9);
  EXPECT_NEAR(in.start.pairs.front().overlap.depth, 0.15, 1e-9);
  EXPECT_THAT(on_table(12.0, SolidSide::below).error, HasSubstr("begins behind the rigid body 'table'"));
  EXPECT_EQ(on_table(12.0, SolidSide::below, 0.3).error, "") << "a part of the block is behind it only";
  for (const double height : {10.0, 9.0, 10.02})
    EXPECT_THAT(on_table(height, SolidSide::above).error, HasSubstr("the master \"table/profile\" turns its back on the slave \"top/bottom\""))
        << height;
}

/// Rings about the origin, quarters of them: the inner one from 1 to 2, the outer one from 2 + `clearance` to 3.
Found rings(double clearance, const std::string& element, int inner, int outer, const std::string& more = "", bool revolved = false) {
  const auto ring = [&](const std::string& name, double from, double to, int count) {
    const std::string plane = number("type", "ring sector") + number("inner radius", fmt::format("{:.17g}", from)) +
                              number("outer radius", fmt::format("{:.17g}", to)) + number("cells across", "2") +
                              number("cells around", std::to_string(count));
    const std::string turned =
        number("type", "revolved") + number("angle", "90") + number("cells around", std::to_string(count)) + list("profile", plane);
    return list(name, number("material", "soft") + number("element", element) + list("mesh", revolved ? turned : plane));
  };
  const auto clamp = [&](const std::string& name, const std::string& set) {
    return list(name, number("set", set) + number("x", "0") + number("y", "0") + (revolved ? number("z", "0") : ""));
  };
  const std::string text =
      list("rings",
           number("kinematics", revolved ? "three dimensional" : "plane strain") +
               list("materials", list("soft", number("type", "neo hooke") + number("young's modulus", "1000") + number("poisson's ratio", "0.3"))) +
               list("bodies", ring("inner", 1.0, 2.0, inner) + ring("outer", 2.0 + clearance, 3.0, outer)) +
               list("boundary conditions", clamp("i", "inner/inner") + clamp("o", "outer/outer")) +
               list("contact", list("c", number("slave", "inner/outer") + number("master", "outer/inner") + more)));
  Found found;
  try {
    found.start = Model(Tpetra::getDefaultComm(), read_text(text), Timers()).surfaces_at_start();
  } catch (const InputError& error) {
    found.error = error.what();
  }
  return found;
}

double sagitta(double radius, int cells) { return radius * (1.0 - std::cos(0.25 * M_PI / cells)); }  // of a quarter's chords

// A parabola through three points of an arc of radius R leaves it by h^4 / 512 R^3, its chords by h^2 / 8 R.
TEST(RoundSurfaces, OfQuadraticElementsAreMeasuredAsCurvedAsTheyAre) {
  for (const auto& [inner, outer] : {std::pair{4, 4}, std::pair{4, 5}, std::pair{9, 6}})
    for (const double clearance : {0.05, 0.3}) {
      const Found found = rings(clearance, "Q8", inner, outer);
      ASSERT_EQ(found.error, "");
      const double h = 0.5 * M_PI * 2.3 / std::min(inner, outer), leaves = 2.0 * std::pow(h, 4) / (512.0 * 8.0);
      ASSERT_TRUE(found.start.pairs[0].gap);
      EXPECT_NEAR(*found.start.pairs[0].gap, clearance, leaves) << inner << " " << outer;
    }
  const std::string refuse = number("initial overlap", "error");
  for (const auto& [inner, outer] : {std::pair{6, 5}, std::pair{5, 6}, std::pair{3, 8}}) {
    EXPECT_EQ(rings(0.0, "Q8", inner, outer, refuse).error, "");
    EXPECT_LT(rings(0.0, "Q8", inner, outer).start.pairs[0].overlap.depth, 2.0 * std::pow(M_PI / std::min(inner, outer), 4) / 4096.0);
    EXPECT_THAT(rings(-0.05, "Q8", inner, outer, refuse).error, HasSubstr("\"initial overlap\" says that this is an error")) << "that is one";
  }
  EXPECT_THAT(rings(0.0, "Q4", 6, 5, refuse).error, HasSubstr("overlap by")) << "linear facets are what they are";
  EXPECT_EQ(rings(0.0, "Q4", 6, 5, refuse + number("facets", "round")).error, "");
}

// All nodes lie on one sphere. Quadrilaterals of 8 nodes leave it by at most h^4 / 64 R^3 inside and h^4 / 512 R^3 at their edges.
TEST(RoundSurfaces, OfSpheresThatTouchLieInOneAnotherToFourthOrder) {
  const Found found = rings(0.0, "H20", 6, 5, number("initial overlap", "error"), true);
  ASSERT_EQ(found.error, "");
  const double h = 0.5 * M_PI * 2.0 / 5.0;
  EXPECT_LT(found.start.pairs[0].overlap.depth, 2.0 * std::pow(h, 4) / (64.0 * 8.0));
}

// On the pin of radius 2 facets leave 2/3 of their sagitta on average, which is nearer to the hole. The hole's facets are as long, or a half or twice
// as long. A node there with dual weights 2 - 3 s sees on average between 1/6 and 7/6 of the sagitta, and 2/3 where its own are much longer.
TEST(RoundSurfaces, OfLinearFacetsChangeGapsByWhatTheFacetsLeave) {
  for (const auto& [inner, outer] : {std::pair{12, 12}, std::pair{12, 24}, std::pair{24, 12}, std::pair{6, 48}}) {
    const Found found = rings(0.02, "Q4", inner, outer, number("facets", "round"));
    ASSERT_EQ(found.error, "");
    const double pin = sagitta(2.0, inner), hole = sagitta(2.02, outer);
    const PairAtStart& pair = found.start.pairs[0];
    EXPECT_NEAR(pair.arcs[0], pin, 0.02 * pin);
    EXPECT_NEAR(pair.arcs[1], hole, 0.02 * hole);
    ASSERT_TRUE(pair.facet_gaps);
    const double exact = 0.03 * (pin + hole);  // chords are not parabolas
    EXPECT_GT((*pair.facet_gaps)[0], std::min(0.0, -2.0 / 3.0 * pin + hole / 6.0) - exact) << inner << " " << outer;
    EXPECT_LT((*pair.facet_gaps)[1], std::max(0.0, -2.0 / 3.0 * pin + 7.0 / 6.0 * hole) + exact) << inner << " " << outer;
    if (inner == 24) {
      EXPECT_NEAR((*pair.facet_gaps)[1], -2.0 / 3.0 * pin + 7.0 / 6.0 * hole, exact) << "over the middle of a chord";
    }
    if (inner == 6) {
      EXPECT_NEAR((*pair.facet_gaps)[0], -2.0 / 3.0 * (pin - hole), exact);
    }
  }
  const Found flat = rings(0.02, "Q4", 12, 24);
  EXPECT_FALSE(flat.start.pairs[0].facet_gaps);
  const Found cubes = rings(0.02, "H8", 8, 12, number("facets", "round"), true);
  ASSERT_EQ(cubes.error, "");
  EXPECT_GT((*cubes.start.pairs[0].facet_gaps)[0], -2.0 * (sagitta(2.0, 8) + sagitta(2.0, 8)) * 2.0 / 3.0) << "of both directions";
  EXPECT_LT((*cubes.start.pairs[0].facet_gaps)[0], -0.5 * sagitta(2.0, 8));
}

// A plate's top falls by a degree or two to the left, and so does the bottom of a body above it. A line from the plate's right side runs out of the
// plate and into that body at angles at which facets are hardly met. It leaves that body at its far end. The bodies are apart.
TEST(InitialOverlap, IsNotToldByLinesThatRunWithinAFace) {
  for (const double tilt : {0.5, 1.0, 2.0, 2.7})
    for (const double up : {0.001, 0.01, 0.02}) {
      const double slope = std::tan(tilt * M_PI / 180.0);
      const auto quadrilateral = [&](const std::string& name, const std::string& corners) {
        return list(name, number("material", "soft") + number("element", "Q4") +
                              list("mesh", number("type", "block") + number("corners", corners) + number("cells x", "4") + number("cells y", "2")));
      };
      const std::string text =
          list("plates",
               list("materials", list("soft", number("type", "neo hooke") + number("young's modulus", "1000") + number("poisson's ratio", "0.3"))) +
                   list("bodies", quadrilateral("plate", fmt::format("-1, 0, 1, 0, 1, 1, -1, {:.12g}", 1.0 - 2.0 * slope)) +
                                      quadrilateral("beside", fmt::format("-5, {:.12g}, 1.2, {:.12g}, 1.2, 2, -5, 2", 1.0 + up - 6.0 * slope,
                                                                          1.0 + up + 0.2 * slope))) +
                   list("boundary conditions", list("a", number("set", "plate/bottom") + number("x", "0") + number("y", "0")) +
                                                   list("b", number("set", "beside/top") + number("x", "0") + number("y", "0"))));
      const Model model(Tpetra::getDefaultComm(), read_text(text), Timers());
      EXPECT_THAT(model.surfaces_at_start().strays, IsEmpty()) << tilt << " " << up;
    }
}

}  // namespace
}  // namespace mortise
