// Models far from the origin, graded meshes and slaves much stiffer than their masters: right, or named.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "launch.hpp"

namespace {

struct Result {
  Ending ending;
  nlohmann::json quantities;
  double force() const { return quantities.at("p").get<double>(); }
  int iterations = 0;
  bool says(const std::string& text) const { return ending.output.find(text) != std::string::npos; }
};

Result run(const std::string& scene, const std::string& name, const std::vector<std::string>& settings, int ranks = 1) {
  const std::string directory = std::string(SCRATCH) + "/" + name;
  std::filesystem::remove_all(directory);
  std::vector<std::string> command{MPIEXEC, "-n",     std::to_string(ranks), MORTISE, "run", std::string(INPUTS) + "/verification/" + scene,
                                   "-o",    directory};
  for (const auto& setting : settings) command.insert(command.end(), {"--set", setting});
  Result result{launch(command, 300), {}};
  std::ifstream stream(directory + "/summary.json");
  const auto summary = nlohmann::json::parse(stream);
  result.quantities = summary.at("quantities");
  for (const auto& step : summary.at("steps")) result.iterations += static_cast<int>(step.at("newton").size()) - 1;
  return result;
}

// Only the meshes are known less well there: to eps times the distance over the length of a facet, 0.1.
TEST(FarFromTheOrigin, ContactIsWhatItIsThere) {
  const std::vector<std::string> cells{"variables/slave_cells=10", "variables/master_cells=16"};
  const Result there = run("fine_slave.xml", "there", cells);
  EXPECT_EQ(there.ending.code, 0);
  EXPECT_FALSE(there.says("away from the origin"));
  for (const int ranks : {1, 2}) {
    auto settings = cells;
    settings.push_back("variables/away=1e8");
    const Result far = run("fine_slave.xml", "far" + std::to_string(ranks), settings, ranks);
    EXPECT_EQ(far.ending.code, 0);
    EXPECT_TRUE(far.says("away from the origin")) << far.ending.output;
    EXPECT_NEAR(far.force(), there.force(), 1e8 * std::numeric_limits<double>::epsilon() / 0.1 * there.force());
    EXPECT_LE(far.iterations, there.iterations + 2);
  }
}

// A homogeneous state is the same on every mesh. Cells of 1e-9 beside some of the size of the body leave |b - A x| / |b| above 1e-8 however well the
// system is solved.
TEST(GradedMesh, IsNoSingularMatrix) {
  const std::vector<std::string> elastic{"materials/metal/hardening/yield stress=1e6", "bodies/bar/element=Q4"};
  auto graded = elastic;
  for (const std::string axis : {"x", "y"})
    for (const std::string& setting : {"cells " + axis + "=0", "grading " + axis + "/smallest cell=1e-9", "grading " + axis + "/growth=1.5"})
      graded.push_back("bodies/bar/mesh/" + setting);
  const Result even = run("limit_load.xml", "even", elastic), fine = run("limit_load.xml", "graded", graded);
  EXPECT_EQ(even.ending.code, 0);
  ASSERT_EQ(fine.ending.code, 0) << fine.ending.output;
  const double uy = even.quantities.at("uy").get<double>();
  EXPECT_NEAR(fine.quantities.at("uy").get<double>(), uy, 1e-7 * uy);
}

TEST(StiffSlave, IsWarnedOfWhereItsTractionsAreRoundOff) {
  const std::string warning = "round-off of its displacements leaves its tractions";
  EXPECT_TRUE(run("stiff_slave.xml", "too_stiff", {"variables/stiffness_ratio=1e10"}).says(warning));
  EXPECT_FALSE(run("stiff_slave.xml", "stiff", {}).says(warning));
}

}  // namespace
