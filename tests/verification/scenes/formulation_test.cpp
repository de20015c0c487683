// The formulations of contact from outside: which of them pass the patch test, and how the others fail it.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "launch.hpp"

namespace {

using Json = nlohmann::json;

constexpr int done = 0, not_converged = 3, check_missed = 4;

struct Outcome {
  int code = 0;
  std::string said;
  Json quantities, steps;
};

Outcome run(const std::string& scene, const std::string& name, std::vector<std::string> settings) {
  const std::string results = std::string(SCRATCH) + "/formulation/" + name;
  std::filesystem::remove_all(results);
  std::vector<std::string> words{MORTISE, "run", std::string(INPUTS) + "/" + scene, "-o", results, "--set", "output/fields="};
  for (const std::string& setting : settings) words.insert(words.end(), {"--set", setting});
  const Ending ending = launch(words, 120);
  const Json summary = Json::parse(read_file(results + "/summary.json"));
  return {ending.code, ending.output, summary.at("quantities"), summary.at("steps")};
}

const std::string list = "contact/interface/formulation/";

TEST(PatchTest, StandardMortarPassesToRoundOff) {
  const Outcome outcome = run("paper/patch_test.xml", "standard", {list + "type=standard mortar"});
  EXPECT_EQ(outcome.code, done) << outcome.said;
}

TEST(PatchTest, VariationalMortarPassesToRoundOff) {
  const Outcome outcome = run("paper/patch_test.xml", "variational", {list + "type=variational mortar"});
  EXPECT_EQ(outcome.code, done) << outcome.said;
}

// Normal forces -z dg/dd do the work -sum z Dg. Between states with g = 0 it is zero but for the error of the trapezoidal rule. In each step this
// error is the integral of z' dg/dt, of third order, as g vanishes at both ends. Where a node of the base passes a corner of the block within the
// step its second derivative has a jump. The error then has the same order, times a factor that depends on when. So the sum is of order two. One that
// is of the first order or stays has a fitted order of one or none, and 1.5 lies between. Forces through D and M leave the work that the mesh makes
// of the corners.
TEST(SlidingBlock, NormalForcesOfVariationalMortarLoseWorkToStepsOnly) {
  const auto order = [](const std::string& type) {
    std::vector<double> errors;
    for (const int steps : {60, 240}) {
      const Outcome outcome = run("verification/sliding_block.xml", "block " + type + std::to_string(steps),
                                  {"contact/joint/formulation/type=" + type, "stepping/step=1/" + std::to_string(steps), "checks/work/low=-1"});
      EXPECT_EQ(outcome.code, done) << outcome.said;
      errors.push_back(std::abs(outcome.quantities.at("energy_error").get<double>()));
    }
    return 0.5 * std::log2(errors[0] / errors[1]);
  };
  EXPECT_GE(order("variational mortar"), 1.5);
  EXPECT_LT(order("dual mortar"), 0.5);
}

// A uniform penetration is a state that both sides can take: its traction is uniform whatever the stiffness is.
TEST(PatchTest, MortarPenaltyPassesToRoundOff) {
  for (const std::string discretisation : {"dual mortar", "standard mortar"}) {
    const Outcome outcome =
        run("paper/patch_test.xml", "penalty " + discretisation, {list + "type=penalty", list + "discretisation=" + discretisation});
    EXPECT_LE(outcome.quantities.at("stress_spread").get<double>(), 1e-10) << outcome.said;
  }
}

// Multipliers are wrong by up to `tolerance` of the largest. Stresses in a facet's corner follow from differences of a few of them: ten times that.
TEST(PatchTest, AugmentedLagrangePassesToItsTolerance) {
  const double tolerance = 1e-10;
  for (const std::string discretisation : {"dual mortar", "standard mortar"}) {
    const Outcome outcome = run("paper/patch_test.xml", "augmented " + discretisation,
                                {list + "type=augmented lagrange", list + "discretisation=" + discretisation, list + "tolerance=1e-10"});
    for (const Json& step : outcome.steps) EXPECT_EQ(step.at("undone"), Json::array()) << outcome.said;
    EXPECT_LE(outcome.quantities.at("stress_spread").get<double>(), 10.0 * tolerance) << outcome.said;
  }
}

// Each update of the multipliers is one more solve, whose starting state is no iteration.
TEST(PatchTest, IterationsOfAllSolvesAreCounted) {
  const Outcome outcome = run("paper/patch_test.xml", "counted", {list + "type=augmented lagrange"});
  std::size_t iterations = 0, solves = 0;
  for (const Json& step : outcome.steps) {
    solves += step.at("solves").get<std::size_t>();
    iterations += step.at("newton").size() - step.at("solves").get<std::size_t>();
  }
  EXPECT_GT(solves, outcome.steps.size());
  EXPECT_NE(outcome.said.find(" " + std::to_string(iterations) + " Newton iterations"), std::string::npos) << outcome.said;
}

// Forces at nodes that do not fit those of a uniform traction on the other side. Errors are of the order of the stress itself in a facet's corner;
// momentum is kept (Taylor, Papadopoulos 1991).
TEST(PatchTest, NodeToSegmentFailsInOnePass) {
  const Outcome outcome = run("paper/patch_test.xml", "single pass", {list + "type=node to segment"});
  EXPECT_EQ(outcome.code, check_missed) << outcome.said;
  EXPECT_GT(outcome.quantities.at("stress_spread").get<double>(), 0.01);
  EXPECT_LE(outcome.quantities.at("momentum_imbalance").get<double>(), 1e-12);
}

// Where nodes lie opposite one another the point loads are the consistent ones.
TEST(PatchTest, NodeToSegmentPassesOnMatchingMeshes) {
  const Outcome outcome = run("verification/patch_ratio_1_1.xml", "matching", {list + "type=node to segment"});
  EXPECT_LE(outcome.quantities.at("stress_spread").get<double>(), 1e-10) << outcome.said;
}

// n_1 + n_2 conditions of which at most n_1 + n_2 - 2 are independent: both gaps vanish for any straight motion of the flat surfaces. Newton lets go
// of the nodes that are too many, or the system is singular, and the program says why.
TEST(PatchTest, TwoPassesOverConstrainFlatSurfaces) {
  const Outcome outcome = run("paper/patch_test.xml", "two passes", {list + "type=node to segment", list + "passes=two"});
  if (outcome.code == done) return;  // the checks of the scene are met
  EXPECT_EQ(outcome.code, not_converged) << outcome.said;
  EXPECT_NE(outcome.said.find("over-constrains"), std::string::npos) << outcome.said;
}

// The node-to-segment pressure of Hertz' problem goes up and down from node to node, that of mortar falls from the middle outwards.
TEST(Hertz, PressuresOscillateFromNodeToNodeOnSegmentsOnly) {
  const std::vector<std::string> choices{"variables/n=8", "variables/mu=0", "variables/steps=4"};
  const auto with = [&](const std::string& name) {
    std::vector<std::string> settings = choices;
    settings.push_back(list + "type=" + name);
    return run("paper/hertz_elastic.xml", "hertz " + name, settings);
  };
  const Outcome dual = with("dual mortar"), standard = with("standard mortar"), nodes = with("node to segment");
  EXPECT_EQ(dual.code, done) << dual.said;
  EXPECT_EQ(standard.code, done) << standard.said;
  EXPECT_LE(std::abs(standard.quantities.at("oscillation").get<double>()), 0.01);
  EXPECT_GT(nodes.quantities.at("oscillation").get<double>(), 0.1);
  for (const Outcome* one : {&dual, &standard, &nodes}) EXPECT_NEAR(one->quantities.at("contact_force").get<double>(), 2500.0, 1e-6);
}

// The punch's edges run through facets and cover some of their nodes by a few per cent. An update divides gaps by 1 + stiffness = 11 where a node
// moves by h/E times its traction. So gaps of a facet's length are within 1e-6 h after 6 updates. The body is stiffer against tractions that vary
// from node to node: twice as many. The remaining gaps are 1e-6 h of an indentation of about a facet: the force agrees to 1e-5.
TEST(Punch, AugmentedLagrangeFindsTheForceOfExactConditionsInFewUpdates) {
  const auto with = [&](const std::string& type) {
    return run("verification/3d/punch.xml", "punch " + type, {"contact/face/formulation/type=" + type});
  };
  const Outcome exact = with("dual mortar"), augmented = with("augmented lagrange");
  for (const Outcome* one : {&exact, &augmented}) ASSERT_EQ(one->code, done) << one->said;
  const double force = exact.quantities.at("force");
  EXPECT_NEAR(augmented.quantities.at("force").get<double>(), force, 1e-5 * std::abs(force));
  EXPECT_EQ(augmented.steps.size(), exact.steps.size());
  for (const Json& step : augmented.steps) {
    EXPECT_EQ(step.at("undone"), Json::array());
    EXPECT_LE(step.at("solves").get<int>() - 1, 12);
  }
}

// Three layers, a thin soft one between two blocks, in confined compression of small strain: u M / (1/E1 + h2/E2 + 1/E3) whatever the displacement.
// The thin layer is far stiffer against a gap than its facets, so that updates settle slowly. Friction has nothing to do. The force is right to the
// tolerance of the multipliers.
TEST(Layers, AugmentedLagrangeFindsTheClosedFormAtEveryScale) {
  const double modulus = 0.7 / (1.3 * 0.4), compliance = 1.0 / 1000.0 + 0.001 / 10.0 + 1.0 / 1000.0;
  for (const std::string mu : {"0", "0.3"})
    for (const std::string u : {"1e-2", "1e-3", "1e-4", "1e-5", "1e-6", "1e-7", "1e-8"}) {
      const Outcome outcome = run("hard/layers.xml", "layers " + mu + " " + u,
                                  {"contact/lower/formulation/type=augmented lagrange", "contact/upper/formulation/type=augmented lagrange",
                                   "variables/mu=" + mu, "variables/u=" + u, "variables/E2=10", "variables/h2=0.001", "checks/balance/high=1"});
      EXPECT_EQ(outcome.code, done) << outcome.said;
      const double exact = std::stod(u) * modulus / compliance;
      EXPECT_NEAR(outcome.quantities.at("stress").get<double>(), exact, 1e-6 * exact) << mu << ", " << u;
    }
}

// A state that is not exact after so many updates is no solution, and the run says how far off it is.
TEST(Layers, AugmentedLagrangeThatIsCutShortIsNotAccepted) {
  const Outcome outcome = run("hard/layers.xml", "layers cut short",
                              {"contact/lower/formulation/type=augmented lagrange", "contact/upper/formulation/type=augmented lagrange",
                               "contact/lower/formulation/augmentations=2", "variables/E2=10", "variables/h2=0.001", "variables/u=1e-6"});
  EXPECT_EQ(outcome.code, not_converged) << outcome.said;
  EXPECT_NE(outcome.said.find("after 2 updates of the multipliers, one more would change them by"), std::string::npos) << outcome.said;
}

// Nodes that start to slip, stick again and open: a stiffness that is a multiple of the bodies' must not throw them from slip one way to slip the
// other.
TEST(SlidingCylinder, RegularisedFrictionUndoesNoStep) {
  const std::string joint = "contact/joint/formulation/";
  for (const std::string type : {"penalty", "augmented lagrange"})
    for (const std::string discretisation : {"dual mortar", "node to segment"}) {
      const Outcome outcome = run("verification/sliding_cylinder.xml", "cylinder " + type + " " + discretisation,
                                  {joint + "type=" + type, joint + "discretisation=" + discretisation, "variables/N=50", "stepping/end time=0.2"});
      EXPECT_EQ(outcome.steps.size(), 10u) << outcome.said;
      for (const Json& step : outcome.steps) EXPECT_EQ(step.at("undone"), Json::array()) << type << ", " << discretisation;
    }
}

}  // namespace
