// Bodies that overlap at the start, against the same bodies moved into this overlap; bodies that pass through one another are reported.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "scene_support.hpp"
#include "scene_text.hpp"

namespace {

using namespace scene_support;
using namespace scene_text;
using Json = nlohmann::json;

/// A block 1 x 1 (x 1) on a base 3 x 1 (x 3); the edges of the block lie within facets of the base.
struct Case {
  double depth = 0.24;
  bool driven = false;  ///< the block begins on the base and is moved in; else it begins in it
  int base_cells = 15, top_cells = 6;
  bool space = false, base_is_slave = false;
  bool same_width = false;  ///< of base and block
  std::string base_height = "1", base_side = "top", base_left = "-1.07";
  std::string element = "Q4", pair = "", step = "1";
};

std::string scene_of(const Case& one) {
  const auto body = [&](const std::string& name, const std::string& width, const std::string& height, int cells, const std::string& translation) {
    const std::string along = std::to_string(cells), layers = one.space ? "2" : "4";
    return list(name, parameter("material", "soft") + parameter("element", one.element) +
                          list("mesh", parameter("type", one.space ? "brick" : "block") + parameter("width", width) + parameter("height", height) +
                                           (one.space ? parameter("depth", width) + parameter("cells z", layers) : "") + parameter("cells x", along) +
                                           parameter("cells y", one.space ? along : layers) + parameter("translation", translation)));
  };
  const std::string height = one.driven ? "0" : fmt::format("{}", -one.depth), motion = one.driven ? fmt::format("{}*t", -one.depth) : "0",
                    level = one.space ? "0, 0, " : "0, ";
  const std::string place = one.space ? "-1.07, -1.07, -1" : (one.same_width ? "0" : one.base_left) + ", -" + one.base_height;
  const auto hold = [&](const std::string& name, const std::string& set, const std::string& across) {
    return list(name,
                parameter("set", set) + parameter("x", "0") + parameter("y", one.space ? "0" : across) + (one.space ? parameter("z", across) : ""));
  };
  return list("overlap",
              parameter("kinematics", one.space ? "three dimensional" : "plane strain") +
                  list("materials",
                       list("soft", parameter("type", "neo hooke") + parameter("young's modulus", "1000") + parameter("poisson's ratio", "0.3"))) +
                  list("bodies", body("base", one.same_width ? "1" : "3", one.base_height, one.base_cells, place) +
                                     body("top", "1", "1", one.top_cells, level + height)) +
                  list("boundary conditions", hold("floor", "base/bottom", "0") + hold("ram", "top/top", motion)) +
                  list("contact", list("joint", parameter("slave", one.base_is_slave ? "base/" + one.base_side : "top/bottom") +
                                                    parameter("master", one.base_is_slave ? "top/bottom" : "base/" + one.base_side) + one.pair)) +
                  list("stepping", parameter("end time", "1") + parameter("step", one.step)) + list("output", parameter("fields", "")) +
                  list("quantities", list("p", parameter("type", "contact force") + parameter("component", one.space ? "z" : "y"))));
}

double force_of(const Case& one, const std::string& name, int ranks = 1) {
  const files::path directory = files::path(SCRATCH) / ("overlap_" + name);
  const Ending ending = run(directory, scene_of(one), ranks);
  EXPECT_EQ(ending.code, 0) << ending.output;
  if (ending.code != 0) return 0.0;
  return Json::parse(read_file((directory / "results" / "summary.json").string())).at("quantities").at("p").get<double>();
}

/// The path does not matter to a hyperelastic body without friction: overlapping at the start and moved into the overlap end in the same state.
void expect_force_of_driven(Case one, const std::string& name, int ranks = 1, const std::string& step = "0.25") {
  const double begun = force_of(one, name, ranks);
  one.driven = true, one.step = step;
  const double driven = force_of(one, name + "_driven");
  EXPECT_GT(std::abs(driven), 0.0);
  EXPECT_NEAR(begun / driven, 1.0, 1e-8) << name;
}

TEST(InitialOverlap, GivesTheForceOfABodyThatIsMovedIn) {
  for (const double depth : {0.002, 0.19, 0.24, 0.4})
    for (const bool base_is_slave : {false, true}) {
      Case one;
      one.depth = depth, one.base_is_slave = one.same_width = base_is_slave;
      if (one.same_width) one.base_cells = 5;
      expect_force_of_driven(one, fmt::format("{}_{}", depth, base_is_slave));
    }
}

// 0.1 is two and a half facets there.
TEST(InitialOverlap, DeeperThanFacetsIsTheSameOnAnyNumberOfRanks) {
  Case one;
  one.depth = 0.1, one.base_cells = 75, one.top_cells = 30;
  for (const int ranks : {1, 2, 3}) expect_force_of_driven(one, fmt::format("fine_np{}", ranks), ranks);
}

TEST(InitialOverlap, In3DGivesTheForceOfABodyThatIsMovedIn) {
  for (const bool base_is_slave : {false, true}) {
    Case one;
    one.space = true, one.element = "H8", one.depth = 0.25, one.base_cells = 15, one.top_cells = 6, one.base_is_slave = base_is_slave;
    expect_force_of_driven(one, fmt::format("space_{}", base_is_slave), 2);
  }
}

// Five facets deep across the edge of the base, where one step does not arrive: smaller ones take up their shares.
TEST(InitialOverlap, IsTakenUpInPartsWhereOneStepIsTooMuch) {
  for (const bool base_is_slave : {false, true}) {
    Case one;
    one.depth = 0.2, one.base_cells = 74, one.top_cells = 25, one.base_left = "-2.9", one.base_is_slave = base_is_slave;
    expect_force_of_driven(one, fmt::format("across_edge_{}", base_is_slave), 1, "0.05");
  }
}

/// A ring of radii 1 and 2 + overlap in one of radii 2 and 3, a quarter of them; the force across the interface along x.
double shrink_fit(double overlap, int cells, bool outer_is_slave) {
  const auto ring = [&](const std::string& name, double inner, double outer, int around) {
    return list(name,
                parameter("material", "elastic") + parameter("element", "Q4") +
                    list("mesh", parameter("type", "ring sector") + parameter("inner radius", fmt::format("{}", inner)) +
                                     parameter("outer radius", fmt::format("{}", outer)) + parameter("cells across", fmt::format("{}", cells / 6)) +
                                     parameter("cells around", std::to_string(around))));
  };
  const auto plane = [](const std::string& name, const std::string& set, const std::string& component) {
    return list(name, parameter("set", set) + parameter(component, "0"));
  };
  const std::string scene =
      list("shrink fit", parameter("kinematics", "plane strain") +
                             list("materials", list("elastic", parameter("type", "neo hooke") + parameter("young's modulus", "1000") +
                                                                   parameter("poisson's ratio", "0.3"))) +
                             list("bodies", ring("inner ring", 1.0, 2.0 + overlap, cells) + ring("outer ring", 2.0, 3.0, 4 * cells / 3)) +
                             list("boundary conditions", plane("inner y", "inner ring/start", "y") + plane("inner x", "inner ring/end", "x") +
                                                             plane("outer y", "outer ring/start", "y") + plane("outer x", "outer ring/end", "x")) +
                             list("contact", list("joint", parameter("slave", outer_is_slave ? "outer ring/inner" : "inner ring/outer") +
                                                               parameter("master", outer_is_slave ? "inner ring/outer" : "outer ring/inner"))) +
                             list("stepping", parameter("end time", "1") + parameter("step", "1")) + list("output", parameter("fields", "")) +
                             list("quantities", list("p", parameter("type", "contact force") + parameter("component", "x"))));
  const files::path directory = files::path(SCRATCH) / "shrink_fit";
  const Ending ending = run(directory, scene, 1);
  EXPECT_EQ(ending.code, 0) << ending.output;
  if (ending.code != 0) return 0.0;
  return std::abs(Json::parse(read_file((directory / "results" / "summary.json").string())).at("quantities").at("p").get<double>());
}

// Lame's rings: overlap = p b / E' ((c^2 + b^2) / (c^2 - b^2) + (b^2 + a^2) / (b^2 - a^2)), E' = E / (1 - nu^2). Strains, and what the theory of
// small ones leaves out, are overlap / b. Facets are from twice to half the overlap.
TEST(InitialOverlap, OfAShrinkFitIsLamesOnAnyMesh) {
  constexpr double a = 1.0, b = 2.0, c = 3.0, overlap = 0.06, modulus = 1000.0 / (1.0 - 0.3 * 0.3);
  constexpr double pressure = overlap * modulus / b / ((c * c + b * b) / (c * c - b * b) + (b * b + a * a) / (b * b - a * a));
  for (const int cells : {24, 48, 96})
    for (const bool outer_is_slave : {false, true})
      EXPECT_NEAR(shrink_fit(overlap, cells, outer_is_slave) / (pressure * b), 1.0, overlap / b) << cells;
}

// The far side of a base that is thinner than a facet is within reach, and faces away.
TEST(InitialOverlap, WithAThinBodyDoesNotCoupleItsFarSide) {
  Case one;
  one.base_height = "0.15", one.depth = 0.05;
  const double near_side = force_of(one, "thin_top");
  one.base_side = "surface";
  EXPECT_NEAR(force_of(one, "thin_surface") / near_side, 1.0, 1e-10);
}

TEST(InitialOverlap, IsToldOrRefused) {
  Case one;
  const Ending told = run(files::path(SCRATCH) / "overlap_told", scene_of(one), 2);
  EXPECT_EQ(told.code, 0);
  EXPECT_NE(told.output.find("contact joint: the surfaces overlap by up to 0.24 at the start, deepest at node "), std::string::npos) << told.output;
  EXPECT_NE(told.output.find("That is more than the longest facet, 0.2"), std::string::npos) << told.output;
  one.pair = parameter("initial overlap", "error");
  const files::path directory = files::path(SCRATCH) / "overlap_refused";
  const Ending refused = run(directory, scene_of(one), 2);
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.output.find("contact/joint: the surfaces overlap by 0.24 at the start"), std::string::npos) << refused.output;
  EXPECT_FALSE(files::exists(directory / "results"));
}

// Couplings of the reference configuration cover nothing beyond the reach. The block, 0.5 above the base, comes down by 0.6.
TEST(BodiesThatPassThrough, WhereNothingIsCoupledFail) {
  for (const int ranks : {1, 2}) {
    Case one;
    one.depth = 0.6, one.driven = true, one.step = "0.1", one.pair = parameter("geometry", "reference");
    const std::string scene = replaced(scene_of(one), R"(value="0, 0"/>)", R"(value="0, 0.5"/>)");
    const Ending ending = run(files::path(SCRATCH) / "frozen", scene, ranks);
    EXPECT_EQ(ending.code, 3) << ending.output;
    EXPECT_NE(ending.output.find("contact \"joint\": node "), std::string::npos) << ending.output;
    EXPECT_NE(ending.output.find("no facet of the master acts on it"), std::string::npos) << ending.output;
  }
}

/// A rigid table, its solid side below, comes up from below the block and out of it on the other side: no facet of it ever faces the slave.
TEST(BodiesThatPassThrough, TheBackOfARigidSurfaceFail) {
  Case one;
  one.depth = -10.0;
  std::string scene = scene_of(one);
  scene = replaced(scene, "<ParameterList name=\"top\">",
                   R"(<ParameterList name="table">
<Parameter name="rigid" type="bool" value="true"/>
<ParameterList name="mesh">
<Parameter name="type" type="string" value="profile"/>
<Parameter name="points" type="string" value="3, 8, -2, 8"/>
<Parameter name="cell size" type="double" value="0.5"/>
</ParameterList>
</ParameterList>
<ParameterList name="top">)");
  scene = replaced(scene, "<ParameterList name=\"ram\">", R"(<ParameterList name="rise">
<Parameter name="set" type="string" value="table/reference"/>
<Parameter name="x" type="string" value="0"/>
<Parameter name="y" type="string" value="2.6*t"/>
<Parameter name="rotation" type="string" value="0"/>
</ParameterList>
<ParameterList name="ram">)");
  scene = replaced(scene, R"(value="top/top"/>)", R"(value="top/left"/>)");
  scene = replaced(scene, R"(value="top/bottom"/>)", R"(value="top/top"/>)");
  scene = replaced(scene, R"(value="base/top"/>)", R"(value="table/profile"/>)");
  for (const int ranks : {1, 2}) {
    const Ending slowly = run(files::path(SCRATCH) / "through_the_back", scene, ranks, {"--set", "stepping/step=0.05"});
    EXPECT_EQ(slowly.code, 3) << slowly.output;
    EXPECT_NE(slowly.output.find("entered through its back"), std::string::npos) << slowly.output;
    const Ending at_once =
        run(files::path(SCRATCH) / "through_at_once", replaced(scene, "2.6*t", "4*t"), ranks, {"--set", "stepping/minimum step=1"});
    EXPECT_EQ(at_once.code, 3) << at_once.output;
    EXPECT_NE(at_once.output.find("the rigid body 'table' turns its back on the slave"), std::string::npos) << at_once.output;
  }
}

}  // namespace
