// Bodies that begin in one another: found whatever the depth, told where, refused where no side is the nearest.

#include "mortise/simulation/model/surfaces_at_start.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>

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
  EXPECT_THAT(examine(one).error, AllOf(HasSubstr("contact/joint: the surfaces begin by 0.24 in one another, deepest at node "),
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
  EXPECT_THAT(examine(one).error, AllOf(HasSubstr("by 0.6 in one another"), HasSubstr("more than half of the 1 that body 'base' is thick there")));
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

}  // namespace
}  // namespace mortise
