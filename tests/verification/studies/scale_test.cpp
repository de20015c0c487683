// `mortise scale`: series of runs, their efficiencies and reasons of failure; plans.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "launch.hpp"

namespace {

using Json = nlohmann::json;

const std::string scene = std::string(INPUTS) + "/scaling/pressed_blocks.xml";

Ending scale(const std::string& results, const std::vector<std::string>& more) {
  std::vector<std::string> command{MORTISE, "scale", scene, "-o", results};
  command.insert(command.end(), more.begin(), more.end());
  return launch(command, 240);
}

std::string fresh(const std::string& name) {
  const std::string path = std::string(SCRATCH) + "/scale/" + name;
  std::filesystem::remove_all(path);
  std::filesystem::create_directories(path);
  return path;
}

std::size_t lines(const std::string& path) {
  std::istringstream text(read_file(path));
  std::size_t count = 0;
  for (std::string line; std::getline(text, line);) ++count;
  return count;
}

TEST(Scale, RunsBothSeriesAndTellsEfficiencies) {
  const std::string results = fresh("series");
  const Ending ending = scale(results, {"--set", "variables/n=8", "--ranks", "2", "--weak", "n:4"});
  ASSERT_EQ(ending.code, 0) << ending.output;
  const Json json = Json::parse(read_file(results + "/scale.json"));
  ASSERT_EQ(json["points"].size(), 4u);
  for (std::size_t p = 0; p < 4; ++p) {
    const Json& point = json["points"][p];
    const Json& first = json["points"][p < 2 ? 0 : 2];
    EXPECT_EQ(point["series"], p < 2 ? "strong" : "weak");
    EXPECT_EQ(point["ranks"], p % 2 + 1);
    EXPECT_TRUE(point["finished"]);
    EXPECT_GT(point["bandwidth_gb_s"].get<double>(), 0.0);
    double sum = 0.0;
    for (const auto& [name, phase] : point["phases"].items()) sum += phase["seconds"].get<double>();
    EXPECT_NEAR(sum, point["seconds"].get<double>(), 1e-9 * sum);
    const double per_rank =
        point["dofs"].get<double>() / (p < 2 ? first["dofs"].get<double>() : point["ranks"].get<double>() * first["dofs"].get<double>());
    const double share = p < 2 ? 1.0 / point["ranks"].get<double>() : per_rank;
    EXPECT_NEAR(point["efficiency"].get<double>(), share * first["seconds"].get<double>() / point["seconds"].get<double>(), 1e-12);
    EXPECT_TRUE(std::filesystem::exists(results + "/runs/" + point["series"].get<std::string>() + "_" + std::to_string(p % 2 + 1) + "/summary.json"));
  }
  EXPECT_EQ(json["points"][0]["dofs"], json["points"][1]["dofs"]);
  EXPECT_EQ(json["points"][3]["settings"].back(), "variables/n=12");  // 8 * 2^(1/3) to the nearest multiple of 4
  EXPECT_EQ(lines(results + "/scale.csv"), 5u);
  const std::string page = read_file(results + "/report.html");
  EXPECT_LT(page.find("<b>Strong scaling:</b> 2 ranks take"), page.find("<b>Weak scaling:</b> 2 ranks take"));
  EXPECT_LT(page.find("<b>Weak scaling:</b> 2 ranks take"), page.find("<img"));
  EXPECT_LT(page.find("<img"), page.find("<table>"));
  EXPECT_NE(page.find("mpirun -n 2 mortise run " + scene + " --set variables/n=8 -o again/strong_2</pre>"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(results + "/scale.svg"));
}

TEST(Scale, GivesNoWeakEfficiencyWhereTheUnknownsDoNotGrow) {
  const std::string results = fresh("flat");
  const Ending ending = scale(results, {"--set", "variables/n=4", "--ranks", "2", "--weak", "n:4"});  // 4 * 2^(1/3) is 4 again
  ASSERT_EQ(ending.code, 0) << ending.output;
  EXPECT_NE(ending.output.find("--weak n: the number of unknowns did not grow"), std::string::npos) << ending.output;
  const Json points = Json::parse(read_file(results + "/scale.json"))["points"];
  EXPECT_EQ(points[3]["dofs"], points[2]["dofs"]);
  EXPECT_TRUE(points[3]["efficiency"].is_null());
  const std::string page = read_file(results + "/report.html");
  EXPECT_NE(page.find("<b>Weak scaling:</b> the number of unknowns did not grow"), std::string::npos);
  EXPECT_EQ(page.find("The scene grows with the ranks"), std::string::npos);
}

TEST(Scale, WritesDownWhyARunFailed) {
  const std::string results = fresh("failure");
  const Ending ending = scale(results, {"--set", "variables/n=4", "--set", "newton/maximum iterations=1", "--ranks", "1"});
  EXPECT_EQ(ending.code, 3) << ending.output;
  const Json point = Json::parse(read_file(results + "/scale.json"))["points"][0];
  EXPECT_FALSE(point["finished"]);
  EXPECT_NE(point["said"].get<std::string>().find("not converged"), std::string::npos);
}

TEST(Scale, SaysWhatIsWrongBeforeItRuns) {
  const std::string results = fresh("wrong");
  const Ending unknown = scale(results, {"--weak", "m"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.output.find("--weak m: the scene has no variable \"m\""), std::string::npos) << unknown.output;
  EXPECT_EQ(scale(results, {"--weak", "n:0"}).code, 1);
  EXPECT_EQ(scale(results, {"--plan", "4", "--ranks", "2"}).code, 1);
  EXPECT_FALSE(std::filesystem::exists(results + "/scale.json"));
}

TEST(Scale, PlansForMoreRanksThanThereAre) {
  const std::string results = fresh("plan");
  const Ending ending = scale(results, {"--set", "variables/n=16", "--plan", "16"});
  ASSERT_EQ(ending.code, 0) << ending.output;
  const Json plan = Json::parse(read_file(results + "/plan.json")), &contact = plan["contact"]["joint"], &of_rank = plan["per_rank"];
  EXPECT_EQ(lines(results + "/plan.csv"), 17u);
  EXPECT_EQ(of_rank["elements"]["total"], 16 * 16 * 16 + 12 * 12 * 12);
  EXPECT_EQ(of_rank["nodes"]["total"], 17 * 17 * 17 + 13 * 13 * 13);
  EXPECT_EQ(contact["slave_facets"], 12 * 12);
  EXPECT_EQ(of_rank["slave_facets"]["total"], contact["slave_facets"]);
  EXPECT_EQ(of_rank["slave_work"]["total"], contact["slave_work"]);
  EXPECT_NEAR(contact["imbalance"].get<double>(), of_rank["slave_work"]["max_over_mean"].get<double>(), 1e-12);
  EXPECT_GE(contact["imbalance"].get<double>(), contact["least_imbalance"].get<double>() - 1e-12);
  EXPECT_LE(contact["imbalance"].get<double>(), 1.5);  // the pair's bound

  const Ending too_many = scale(results, {"--set", "variables/n=4", "--plan", "64"});
  EXPECT_EQ(too_many.code, 0) << too_many.output;
  EXPECT_NE(too_many.output.find("9 slave facets cannot keep 64 ranks busy"), std::string::npos) << too_many.output;
}

}  // namespace
