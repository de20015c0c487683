// Loads that a structure cannot bear are named, and other failures are not taken for them.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "launch.hpp"

namespace {

using Settings = std::vector<std::string>;

struct Stop {
  int code = -1;
  double time = 0.0;  ///< of the last converged state
  std::string output;
  bool names_a_limit() const { return output.find("no equilibrium beyond this load") != std::string::npos; }
};

Stop run(const std::string& scene, const std::string& name, const Settings& settings, int ranks = 1) {
  const std::string directory = std::string(SCRATCH) + "/" + name;
  std::filesystem::remove_all(directory);
  std::vector<std::string> command{MPIEXEC, "-n",     std::to_string(ranks), MORTISE, "run", std::string(INPUTS) + "/verification/" + scene,
                                   "-o",    directory};
  for (const auto& setting : settings) command.insert(command.end(), {"--set", setting});
  const Ending ending = launch(command, 300);
  Stop stop{ending.code, 0.0, ending.output};
  std::ifstream stream(directory + "/summary.json");
  const auto summary = nlohmann::json::parse(stream);
  if (!summary.at("steps").empty()) stop.time = summary.at("steps").back().at("time").get<double>();
  return stop;
}

// Between the load at which yield begins and the limit load of small strain, 1.5 t each.
TEST(LimitLoad, IsNamedWithWhatFlows) {
  constexpr double nu = 0.3;
  for (const int ranks : {1, 2}) {
    const Stop stop = run("limit_load.xml", "perfect" + std::to_string(ranks), {}, ranks);
    EXPECT_EQ(stop.code, 3);
    EXPECT_GT(1.5 * stop.time, 1.0 / std::sqrt(1.0 - nu + nu * nu));
    EXPECT_LT(1.5 * stop.time, 2.0 / std::sqrt(3.0));
    EXPECT_TRUE(stop.names_a_limit()) << stop.output;
    EXPECT_NE(stop.output.find("plastic flow in 100 % of body 'bar'"), std::string::npos) << stop.output;
  }
}

// With hardening every load has an equilibrium; too few iterations are no limit.
TEST(LimitLoad, IsNotSeenInABarThatHardens) {
  const Settings hardens{"materials/metal/hardening/type=linear", "materials/metal/hardening/modulus=10"};
  EXPECT_EQ(run("limit_load.xml", "hardens", hardens).code, 0);
  Settings few = hardens;
  few.insert(few.end(), {"newton/maximum iterations=1", "newton/momentum tolerance=1e-13"});
  const Stop stop = run("limit_load.xml", "few", few);
  EXPECT_EQ(stop.code, 3);
  EXPECT_FALSE(stop.names_a_limit()) << stop.output;
}

// An arch under a tool with a dead load: in the failed tries the tool comes loose, as contact alone holds it.
TEST(LimitLoad, OfAnArchThatSnapsThroughIsNamed) {
  for (const int ranks : {1, 2}) {
    const Stop stop = run("../hard/arch.xml", "arch" + std::to_string(ranks), {"variables/steps=10"}, ranks);
    EXPECT_EQ(stop.code, 3);
    EXPECT_TRUE(stop.names_a_limit()) << stop.output;
    EXPECT_NE(stop.output.find("no point flows"), std::string::npos) << stop.output;
  }
}

// Moved instead, the tool passes the maximum of its force.
TEST(LimitLoad, IsPassedUnderPrescribedDisplacements) {
  EXPECT_EQ(run("../hard/arch.xml", "arch_moved", {"boundary conditions/tool/y=-rise*t", "loads/weight/y=0"}).code, 0);
}

}  // namespace
