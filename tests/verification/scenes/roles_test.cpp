// Consequences of the choice of the slave: corners of the master in slave facets, slaves that are stiffer and finer.

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "launch.hpp"

namespace {

using Json = nlohmann::json;

struct Outcome {
  Ending ending;
  Json quantities;
  bool says(const std::string& text) const { return ending.output.find(text) != std::string::npos; }
};

Outcome run(const std::string& scene, const std::string& name, const std::vector<std::string>& settings, int ranks = 1) {
  const std::string results = std::string(SCRATCH) + "/roles/" + name;
  std::filesystem::remove_all(results);
  std::vector<std::string> words{MPIEXEC, "-n", std::to_string(ranks), MORTISE, "run", std::string(INPUTS) + "/hard/" + scene, "-o", results};
  for (const std::string& setting : settings) words.insert(words.end(), {"--set", setting});
  Outcome outcome{launch(words, 120), {}};
  outcome.quantities = Json::parse(read_file(results + "/summary.json")).at("quantities");
  return outcome;
}

const std::vector<std::string> corner_is_master{"variables/E_square=100000", "contact/c/slave=block/top", "contact/c/master=skin"};

std::vector<std::string> with(std::vector<std::string> settings, const std::string& more) {
  settings.push_back(more);
  return settings;
}

// The corner of a stiff square, 0.2 deep in the middle of a facet of 0.67: contact would begin at 3/8 of that.
TEST(CornerInASlaveFacet, WithoutForceIsNotAccepted) {
  for (const int ranks : {1, 2, 3}) {
    const Outcome outcome = run("corner.xml", "no_force_np" + std::to_string(ranks), with(corner_is_master, "variables/nb=3"), ranks);
    EXPECT_EQ(outcome.ending.code, 3) << outcome.ending.output;
    EXPECT_TRUE(outcome.says("node 36 of the master at (")) << outcome.ending.output;
    EXPECT_TRUE(outcome.says("a corner, lies 0.199 deep in a slave facet of length 0.667 whose nodes carry no force; please make the slave finer"))
        << outcome.ending.output;
  }
}

// The depth under load is 3/8 of the facet, 0.107, but for what the facet bends.
TEST(CornerInASlaveFacet, WithForceIsWarnedOf) {
  const Outcome outcome = run("corner.xml", "late", with(corner_is_master, "variables/nb=7"));
  EXPECT_EQ(outcome.ending.code, 0) << outcome.ending.output;
  EXPECT_TRUE(outcome.says("deep in a slave facet of length 0.286")) << outcome.ending.output;
  EXPECT_GT(outcome.quantities.at("force"), 0.0);
}

TEST(CornerInASlaveFacet, IsNotSeenWhereThereIsNone) {
  for (const std::string nodes : {"variables/nb=4", "variables/nb=15"}) {  // a node below the corner; the corner is the slave
    const Outcome outcome =
        nodes == "variables/nb=4" ? run("corner.xml", "on_node", with(corner_is_master, nodes)) : run("corner.xml", "slave", {nodes});
    EXPECT_EQ(outcome.ending.code, 0) << outcome.ending.output;
    EXPECT_FALSE(outcome.says("deep in a slave facet")) << outcome.ending.output;
  }
}

// A corner of the slave between facets of 1/3, its sides at 30 and 60 degrees to a rigid plane. Standard weights see it when it is
// 1/3 (sin 30 + sin 60)/2 h deep, 0.076; it is pressed by 0.05. Dual weights hold it off at once.
TEST(CornerOfTheSlave, ThatStandardWeightsDoNotSeeIsNotAccepted) {
  const std::vector<std::string> coarse{"variables/n=3", "variables/steps=4"};
  const std::string standard = "contact/c/formulation/type=standard mortar", variational = "contact/c/formulation/type=variational mortar";
  for (const std::string& weights : {standard, variational, std::string("contact/c/gap weighting=standard")})
    for (const int ranks : {1, 2}) {
      const Outcome outcome = run("corner_on_plane.xml", "slave_corner_" + std::to_string(ranks), with(coarse, weights), ranks);
      EXPECT_EQ(outcome.ending.code, 3) << weights << outcome.ending.output;
      EXPECT_TRUE(outcome.says("of the slave at (")) << outcome.ending.output;
      EXPECT_TRUE(
          outcome.says("a corner between facets of length 0.333, lies 0.05 deep in the master, where dual weights would hold it off, and these "
                       "facets' nodes carry no force; please"))
          << outcome.ending.output;
    }
  const Outcome deeper = run("corner_on_plane.xml", "slave_corner_deeper", with(with(coarse, standard), "variables/press=0.1"));
  EXPECT_EQ(deeper.ending.code, 0) << deeper.ending.output;
  EXPECT_TRUE(deeper.says("a corner between facets of length 0.333, lies")) << deeper.ending.output;
  const Outcome dual = run("corner_on_plane.xml", "slave_corner_dual", coarse);
  EXPECT_EQ(dual.ending.code, 0) << dual.ending.output;
  EXPECT_FALSE(dual.says("warning")) << dual.ending.output;
}

// The ball's lowest point is 0.02 below a node of the block, its facets, which lean by 8 degrees there, by 0.0198; but standard weights see it
// 0.25^2/(6 * 0.4) = 0.026 above: per direction h^2/(12 R).
TEST(BallOnCoarseFacets, WithoutForceIsNotAccepted) {
  for (const int ranks : {1, 2, 3}) {
    const Outcome outcome = run("ball_on_coarse_3d.xml", "ball_np" + std::to_string(ranks), {"contact/c/formulation/type=standard mortar"}, ranks);
    EXPECT_EQ(outcome.ending.code, 3) << outcome.ending.output;
    EXPECT_EQ(outcome.quantities.at("force"), 0.0);
    EXPECT_TRUE(outcome.says("lies 0.0198 deep in the other body, and the pair carries no force; please make the slave finer"))
        << outcome.ending.output;
  }
}

TEST(BallOnCoarseFacets, ThatBeginsTooEarlyIsWarnedOf) {
  for (const int ranks : {1, 2}) {
    const Outcome coarse = run("ball_on_coarse_3d.xml", "ball_dual_np" + std::to_string(ranks), {}, ranks);
    EXPECT_EQ(coarse.ending.code, 0) << coarse.ending.output;
    EXPECT_TRUE(coarse.says("its force acts on 1 slave node at facets of length 0.25")) << coarse.ending.output;
  }
  const Outcome fine = run("ball_on_coarse_3d.xml", "ball_fine", {"variables/n=16", "variables/c=12"});
  EXPECT_EQ(fine.ending.code, 0) << fine.ending.output;
  EXPECT_FALSE(fine.says("its force acts on")) << fine.ending.output;
}

// On facets longer than its edges, whose sides are hidden behind the edge, as on a fine mesh.
TEST(RoundedStamp, SinksUnderItsLoad) {
  for (const std::string cells : {"variables/n=8", "variables/n=16", "variables/n=32"}) {
    const Outcome outcome = run("stamp.xml", "stamp", {cells});
    EXPECT_EQ(outcome.ending.code, 0) << outcome.ending.output;
    EXPECT_LT(outcome.quantities.at("rise"), 0.0) << cells;
  }
}

// A block four times as fine as its base.
TEST(SlaveThatIsStifferAndFiner, IsWarnedOfWithTheExcess) {
  for (const int stiffer : {1, 3, 10, 1000}) {
    const Outcome outcome = run("block_on_base.xml", "stiffer_" + std::to_string(stiffer),
                                {"variables/nt=20", "variables/E_block=" + std::to_string(1000 * stiffer), "variables/steps=2"});
    EXPECT_EQ(outcome.ending.code, 0) << outcome.ending.output;
    const std::string percent = stiffer == 1 ? "" : stiffer == 3 ? "30 %" : stiffer == 10 ? "100 %" : "300 %";
    EXPECT_EQ(outcome.says("peaks of pressure may be too high by about " + percent), stiffer > 1) << outcome.ending.output;
  }
}

TEST(AutomaticRoles, TakeTheSofterSideThenTheFinerOneThenTheGivenOne) {
  struct Case {
    std::string name, settings, chosen;
  };
  const std::string automatic = "contact/c/roles=automatic";
  for (const auto& [name, setting, chosen] : {Case{"softer", "variables/E_block=100000", "the slave is \"base/top\": its body is softer"},
                                              Case{"finer", "variables/nb=30", "the slave is \"base/top\": its facets are shorter"},
                                              Case{"given", "variables/nb=15", "the slave is \"block/bottom\": both are alike"}}) {
    const Outcome outcome = run("block_on_base.xml", name, {automatic, setting, "variables/steps=2"});
    EXPECT_EQ(outcome.ending.code, 0) << outcome.ending.output;
    EXPECT_TRUE(outcome.says(chosen)) << outcome.ending.output;
  }
  const std::vector<std::string> stiff{"variables/E_block=100000", "variables/nt=20", "variables/steps=2"};
  const double automatically = run("block_on_base.xml", "automatic", with(stiff, automatic)).quantities.at("peak"),
               by_hand = run("block_on_base.xml", "by_hand", with(with(stiff, "contact/c/slave=base/top"), "contact/c/master=block/bottom"))
                             .quantities.at("peak");
  EXPECT_EQ(automatically, by_hand);
}

// Each wall bears mu N = 0.02 by friction, and the disk is heavier by a twentieth. Normals of a coarse disk lean, and bear the rest.
TEST(LeaningNormals, AreSaidWhereTheyBearALoad) {
  for (const int ranks : {1, 2}) {
    const Outcome outcome = run("disk_between_walls.xml", "leans_np" + std::to_string(ranks), {"variables/part=1.05"}, ranks);
    EXPECT_TRUE(outcome.says("contact \"cl\" bears 0.021 along the master, where friction bears 0.020")) << outcome.ending.output;
    EXPECT_TRUE(outcome.says("of what acts on body 'd'; please make the slave finer there")) << outcome.ending.output;
  }
  const Outcome light = run("disk_between_walls.xml", "does_not_lean", {"variables/part=0.9"});
  EXPECT_EQ(light.ending.code, 0) << light.ending.output;
  EXPECT_FALSE(light.says("normals lean")) << light.ending.output;
}

// With facets half as long it falls.
TEST(LeaningNormals, DoNotBearItOnAFinerSlave) {
  const Outcome outcome = run("disk_between_walls.xml", "falls", {"variables/part=1.05", "variables/n=16"});
  EXPECT_EQ(outcome.ending.code, 3) << outcome.ending.output;
}

// A roller of radius 0.5 presses a cantilever of facets of 0.25 down. It is lifted again before the end, where nothing touches. Its force is a
// quarter too high over 3 E I d/a^3 with d = 0.19. The end of the run, and of a restarted one, reports the error where it pressed hardest.
TEST(RollerOnCoarseFacets, ThatIsLiftedBeforeTheEndIsWarnedOf) {
  const std::vector<std::string> lifted{"bodies/b/element=Q4", "bodies/b/mesh/cells x=40", "variables/above=0.01", "output/checkpoints/every step=1",
                                        "output/checkpoints/keep=5"};
  for (const int ranks : {1, 2}) {
    const std::string name = "lifted_np" + std::to_string(ranks);
    const Outcome outcome = run("roller_on_cantilever.xml", name, lifted, ranks);
    EXPECT_EQ(outcome.ending.code, 0) << outcome.ending.output;
    EXPECT_EQ(outcome.quantities.at("F"), 0.0);
    EXPECT_TRUE(outcome.says("contact \"c\": at t = 1 its force acts on 1 slave node at facets of length 0.25")) << outcome.ending.output;
    if (ranks > 1) continue;
    std::vector<std::string> again{
        MORTISE, "run", std::string(INPUTS) + "/hard/roller_on_cantilever.xml", "-o", std::string(SCRATCH) + "/roles/" + name, "--restart"};
    const auto steps = Json::parse(read_file(std::string(SCRATCH) + "/roles/" + name + "/summary.json")).at("steps").size();
    again.push_back(std::to_string(steps - 3));
    for (const std::string& setting : lifted) again.insert(again.end(), {"--set", setting});
    const Ending ending = launch(again, 120);
    EXPECT_EQ(ending.code, 0) << ending.output;
    EXPECT_NE(ending.output.find("at t = 1 its force acts on 1 slave node"), std::string::npos) << ending.output;
  }
}

// Over one facet the roller turns by 60 degrees: dual weights of quadratic facets see a gap where there is none, and the other way round.
TEST(RollerOnCoarseFacets, ThatFindsNoEquilibriumSaysWhy) {
  const Outcome outcome = run("roller_on_cantilever.xml", "cycles", {"stepping/minimum step=0.05"});
  if (outcome.ending.code == 0) {
    EXPECT_NEAR(outcome.quantities.at("F").get<double>(), 0.0, 1e-9);  // it found one
    return;
  }
  EXPECT_EQ(outcome.ending.code, 3);
  EXPECT_TRUE(outcome.says("the slave is too coarse for the master's curvature: contact is sought at")) << outcome.ending.output;
}

}  // namespace
