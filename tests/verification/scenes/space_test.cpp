// Contact in 3D from outside, against the results of 2D and of other programs.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "launch.hpp"

namespace {

using Json = nlohmann::json;

Json summary(const std::string& scene, const std::string& name, const std::vector<std::string>& settings) {
  const std::string results = std::string(SCRATCH) + "/space_" + name;
  std::filesystem::remove_all(results);
  std::vector<std::string> words{MORTISE, "run", std::string(INPUTS) + "/" + scene, "-o", results, "--set", "output/fields="};
  for (const std::string& setting : settings) words.insert(words.end(), {"--set", setting});
  const Ending ending = launch(words, 240);
  EXPECT_EQ(ending.code, 0) << ending.output;
  return Json::parse(read_file(results + "/summary.json"));
}

Json quantities(const std::string& scene, const std::string& name, const std::vector<std::string>& settings) {
  return summary(scene, name, settings).at("quantities");
}

/// Largest relative difference of what a layer of hexahedra and plane strain find.
double difference_of_layer_and_plane(const std::vector<std::string>& settings) {
  const Json space = quantities("verification/3d/pressed_layer.xml", "layer", settings),
             plane = quantities("verification/3d/pressed_plane.xml", "plane", settings);
  double difference = 0.0;
  for (const char* name : {"reaction", "shear", "peak_pressure", "stored_energy", "friction_work"})
    difference = std::max(difference, std::abs(space.at(name).get<double>() / plane.at(name).get<double>() - 1.0));
  EXPECT_EQ(space.at("closed").get<double>(), 2.0 * plane.at("closed").get<double>());
  return difference;
}

// The nodes of the layer lie on two symmetry planes; friction acts along them.
TEST(Layer, FlatIsPlaneStrain) { EXPECT_LE(difference_of_layer_and_plane({}), 1e-8); }

// Auxiliary planes in 3D, nodal normals in 2D: the same but for the curvature within a facet.
TEST(Layer, CurvedDiffersByWhatFallsWithTheMesh) {
  const double coarse = difference_of_layer_and_plane({"contact/joint/geometry=current"}),
               fine = difference_of_layer_and_plane({"contact/joint/geometry=current", "variables/n=16"});
  EXPECT_LT(fine, coarse);
}

// CalculiX 2.20 finds 6.809 in four increments, and 6.771 in one.
TEST(PressedBlocks, OneStepIsEnough) {
  const Json found = quantities("scaling/pressed_blocks.xml", "blocks", {"variables/n=16", "linear solver/type=iterative"});
  EXPECT_NEAR(found.at("reaction_z").get<double>(), 6.809, 0.001 * 6.809);
}

int newton_iterations(const std::string& geometry) {
  const std::vector<std::string> settings{"variables/stiffness_ratio=1000", "variables/mu=0.2", "variables/n=24", "linear solver/type=iterative",
                                          "contact/joint/geometry=" + geometry};
  int iterations = 0;
  for (const Json& step : summary("scaling/pressed_blocks.xml", "stiff_" + geometry, settings).at("steps"))
    iterations += static_cast<int>(step.at("newton").size()) - 1;
  return iterations;
}

// All nodes closed, as they start, a stiff slave is over-constrained: tractions of either sign a thousand times those of the solution. They must not
// lead the states astray, which where geometry stands still they cannot.
TEST(PressedBlocks, StiffSlavesFindTheirStatesAsIfGeometryStoodStill) { EXPECT_LE(newton_iterations("current"), newton_iterations("reference") + 1); }

/// Most iterations of a solve to 1e-10.
int most_iterations(const std::string& stiffness_ratio, const std::string& mu, const std::string& n = "8") {
  int most = 0;
  const std::vector<std::string> settings{"variables/stiffness_ratio=" + stiffness_ratio, "variables/mu=" + mu, "variables/n=" + n,
                                          "linear solver/type=iterative", "linear solver/largest tolerance=1e-10"};
  for (const Json& step : summary("scaling/pressed_blocks.xml", "ratio_" + stiffness_ratio + "_" + mu + "_" + n, settings).at("steps"))
    for (const Json& iteration : step.at("newton")) most = std::max(most, iteration.at("linear_iterations").get<int>());
  return most;
}

// A preconditioner that does not depend on the ratio takes as many iterations. Half as many again are allowed for the shape of the surfaces in
// contact, and ten more for the hierarchy of an earlier matrix.
TEST(PressedBlocks, StiffSlavesTakeAsManyIterations) {
  for (const char* mu : {"0", "0.2"}) EXPECT_LE(most_iterations("1000", mu), 1.5 * most_iterations("1", mu) + 10) << mu;
}

// From 3216 to 21330 unknowns, that of a mesh of two levels to one of three.
TEST(PressedBlocks, FinerMeshesTakeAsManyIterations) {
  for (const char* ratio : {"1", "1000"})
    for (const char* mu : {"0", "0.2"}) EXPECT_LE(most_iterations(ratio, mu, "16"), 1.5 * most_iterations(ratio, mu)) << ratio << ", " << mu;
}

}  // namespace
