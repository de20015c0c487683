// Bodies where they cannot be, meshes too large to be built, masters the wrong way round.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "scene_support.hpp"

namespace {

using namespace scene_support;

TEST(Kinematics, ABodyBeyondTheAxisIsRefused) {
  const std::string scene = replaced(good_scene, R"xml(value="plane strain")xml", R"xml(value="axisymmetric")xml");
  for (const int ranks : {1, 2}) {
    const files::path directory = files::path(SCRATCH) / fmt::format("beyond_the_axis_np{}", ranks);
    const Ending ending = run(directory, scene, ranks, {"--set", "bodies/lower/mesh/translation=-0.5, 0"});
    EXPECT_EQ(ending.code, 2);
    EXPECT_NE(ending.output.find("body 'lower' reaches x = -0.5, beyond the axis"), std::string::npos) << ending.output;
    EXPECT_FALSE(files::exists(directory / "results"));
  }
}

/// Expects commands to refuse the lower block with so many cells in each direction.
void expect_refused(const std::vector<std::vector<std::string>>& commands, const std::string& cells, const std::string& message) {
  const files::path directory = files::path(SCRATCH) / "too_large";
  files::create_directories(directory);
  std::ofstream(directory / "scene.xml") << good_scene;
  for (const auto& command : commands) {
    std::vector<std::string> words{MORTISE};
    words.insert(words.end(), command.begin(), command.end());
    words.insert(words.end(),
                 {directory / "scene.xml", "--set", "bodies/lower/mesh/cells x=" + cells, "--set", "bodies/lower/mesh/cells y=" + cells});
    const Ending ending = launch(words, 60);
    EXPECT_EQ(ending.code, 2) << ending.output;
    EXPECT_NE(ending.output.find(message), std::string::npos) << ending.output;
  }
}

bool machine_has_more_than(long gib) { return sysconf(_SC_PHYS_PAGES) > gib * 1024 * 1024 * 1024 / sysconf(_SC_PAGESIZE); }

// 1e9 nodes of Q4 take 200 GB or more: each couples with the nodes of an element, 4 blocks of 2 x 2 numbers with their columns, 192 bytes.
TEST(Meshes, ThatNoMemoryHoldsAreRefusedBeforeTheyAreBuilt) {
  if (machine_has_more_than(200)) GTEST_SKIP() << "this machine has more than 200 GiB";
  expect_refused({{"check"}, {"run"}}, "32000",
                 "the mesh of body 'lower' would have 1024000000 elements and 1024064001 nodes; the model would take more than");
}

// A plan has no matrix, but their nodes and elements, 60 bytes each.
TEST(Meshes, ThatNoMemoryHoldsAreNotPlannedEither) {
  if (machine_has_more_than(55)) GTEST_SKIP() << "this machine has more than 55 GiB";
  expect_refused({{"scale", "--plan", "1000"}}, "32000",
                 "the mesh of body 'lower' would have 1024000000 elements and 1024064001 nodes; the mesh alone would take more than");
}

TEST(Meshes, WithMoreDofsThanCanBeNumberedAreNotPlanned) {
  expect_refused({{"scale", "--plan", "2"}}, "100000", "the model's 2e+10 dofs are more than the 4.295e+09 that 2 rank(s) can number");
  expect_refused({{"scale", "--plan", "1000"}}, "100000", "the model's 1e+10 nodes are more than the 2.147e+09 that 1 rank(s) can number");
}

/// A rigid tool comes down on the lower block. Its body lies to the left of the way along the points.
TEST(Masters, ThatTurnTheirBacksAreRefused) {
  const auto with_tool = [](const std::string& points) {
    std::string scene = replaced(
        good_scene, R"xml(<Parameter name="corners" type="string" value="0, 1, 1, 1, 1, 2, 0, 2"/>
        <Parameter name="cells x" type="int" value="2"/>
        <Parameter name="cells y" type="int" value="2"/>)xml",
        R"xml(<Parameter name="points" type="string" value=")xml" + points + R"xml("/><Parameter name="cell size" type="double" value="0.5"/>)xml");
    scene = replaced(scene, R"xml(<Parameter name="material" type="string" value="soft"/>
      <Parameter name="element" type="string" value="Q4"/>)xml",
                     R"xml(<Parameter name="rigid" type="bool" value="true"/>)xml");
    scene = replaced(scene, R"xml(<Parameter name="type" type="string" value="block"/>
        <Parameter name="points")xml",
                     R"xml(<Parameter name="type" type="string" value="profile"/>
        <Parameter name="points")xml");
    scene = replaced(scene, R"xml(value="upper/left"/>)xml",
                     R"xml(value="upper/reference"/><Parameter name="y" type="string" value="-0.01*t"/>
      <Parameter name="rotation" type="double" value="0"/>)xml");
    scene = replaced(scene, R"xml(value="upper/top"/>)xml", R"xml(value="lower/left"/>)xml");
    return replaced(scene, R"xml(value="upper/bottom"/>)xml", R"xml(value="upper/profile"/>)xml");
  };
  const std::string error = "contact/interface: the master \"upper/profile\" turns its back on the slave \"seat\"";
  for (const int ranks : {1, 2})
    for (const char* height : {"1", "1.5"}) {  // touching, and far beyond the reach
      const auto said = [&](const std::string& points, int code) {
        const Ending ending = run(files::path(SCRATCH) / fmt::format("turned_np{}", ranks), with_tool(points), ranks);
        EXPECT_EQ(ending.code, code) << ending.output;
        return ending.output;
      };
      const std::string right = said(fmt::format("-0.5, {0}, 1.5, {0}", height), 0), wrong = said(fmt::format("1.5, {0}, -0.5, {0}", height), 2);
      EXPECT_EQ(right.find(error), std::string::npos) << right;
      EXPECT_NE(wrong.find(error), std::string::npos) << wrong;
    }
}

}  // namespace
