// `mortise study`: the table and the page, runs that fail, studies that are killed.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "study_support.hpp"

namespace {

namespace files = std::filesystem;
using namespace study_support;
using Json = nlohmann::json;

/// A CSV file without quoted cells: column -> cells.
std::map<std::string, std::vector<std::string>> table(const std::string& path) {
  const auto cells_of = [](const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    return cells;
  };
  std::istringstream text(read_file(path));
  std::string line;
  std::getline(text, line);
  const std::vector<std::string> names = cells_of(line);
  std::map<std::string, std::vector<std::string>> columns;
  while (std::getline(text, line)) {
    const std::vector<std::string> cells = cells_of(line);
    for (std::size_t c = 0; c < names.size(); ++c) columns[names[c]].push_back(c < cells.size() ? cells[c] : "");
  }
  return columns;
}

std::map<std::string, files::file_time_type> records(const std::string& results) {
  std::map<std::string, files::file_time_type> found;
  if (files::exists(results + "/points"))
    for (const auto& point : files::directory_iterator(results + "/points"))
      if (files::exists(point.path() / "study-point.json"))
        found[point.path().filename()] = files::last_write_time(point.path() / "study-point.json");
  return found;
}

TEST(Study, IsKilledAndResumedWithoutRunningAPointTwice) {
  const std::string results = directory + "/killed";
  files::remove_all(results);
  const std::string file = write_study("killed",
                                       "<ParameterList name=\"axes\">\n<ParameterList name=\"ranks\"><Parameter name=\"setting\" type=\"string\" "
                                       "value=\"ranks\"/><Parameter name=\"values\" type=\"string\" value=\"1, 2\"/></ParameterList>" +
                                           meshes + R"(</ParameterList>
<ParameterList name="quantities"><ParameterList name="displacement_error"><Parameter name="measure" type="string" value="itself"/></ParameterList></ParameterList>
)");
  kill_when([&] { return records(results).size() >= 2; }, file, results, {"--quiet"});
  const auto before = records(results);
  ASSERT_GE(before.size(), 2u);
  ASSERT_LT(before.size(), 4u);
  EXPECT_FALSE(files::exists(results + "/study.csv"));

  Ending ending = study(file, results);
  EXPECT_EQ(ending.code, 0) << ending.output;
  EXPECT_TRUE(contains(ending.output, "1/4 ranks = 1, n = 6: done, results of an earlier call")) << ending.output;
  EXPECT_TRUE(contains(ending.output, "4/4 ranks = 2, n = 12: done, ")) << ending.output;
  EXPECT_FALSE(contains(ending.output, "4/4 ranks = 2, n = 12: done, results")) << ending.output;
  EXPECT_TRUE(contains(ending.output, "cheapest configuration within 1 % of displacement_error: ")) << ending.output;
  const auto after = records(results);
  EXPECT_EQ(after.size(), 4u);
  for (const auto& [name, time] : before) EXPECT_EQ(after.at(name), time) << name << " ran twice";

  // Times come from the records: the report of finished points never changes.
  std::map<std::string, std::string> said;
  for (const char* name : {"study.csv", "study.json", "report.html"}) said[name] = read_file(results + "/" + name);
  ending = study(file, results);
  EXPECT_EQ(ending.code, 0) << ending.output;
  EXPECT_EQ(records(results), after);
  for (const auto& [name, text] : said) EXPECT_TRUE(read_file(results + "/" + name) == text) << name;

  auto columns = table(results + "/study.csv");
  for (int n : {6, 12}) EXPECT_EQ(Json::parse(read_file(fmt::format("{}/points/ranks=2,n={}/summary.json", results, n))).at("ranks"), 2);

  // Afresh: the first point runs again, and nothing is left of the others.
  const auto old = after.at("ranks=1,n=6");
  const auto ran_again = [&] {
    const auto now = records(results);
    return now.count("ranks=1,n=6") > 0 && now.at("ranks=1,n=6") > old;
  };
  kill_when(ran_again, file, results, {"--fresh"});
  EXPECT_TRUE(ran_again());
  EXPECT_LT(records(results).size(), 4u);
  EXPECT_FALSE(files::exists(results + "/study.csv"));

  EXPECT_EQ(columns["formulation"], std::vector<std::string>(4, "dual mortar"));
  EXPECT_EQ(columns["element"], std::vector<std::string>(4, "Q4"));
  EXPECT_EQ(columns["axis_ranks"], (std::vector<std::string>{"1", "1", "2", "2"}));
  EXPECT_EQ(columns["axis_n"], (std::vector<std::string>{"6", "12", "6", "12"}));
  EXPECT_EQ(columns["status"], std::vector<std::string>(4, "done"));
  for (int i : {0, 1}) {  // ranks change nothing
    const double one = std::stod(columns["error_displacement_error"][i]), two = std::stod(columns["error_displacement_error"][i + 2]);
    EXPECT_NEAR(one, two, 1e-8 * one);
    EXPECT_EQ(columns["dofs"][i], columns["dofs"][i + 2]);
  }
  for (int i = 0; i < 4; ++i) {
    EXPECT_GT(std::stod(columns["wall_s"][i]), 0.0);
    EXPECT_GT(std::stod(columns["cpu_s"][i]), 0.0);
    EXPECT_GT(std::stod(columns["memory_mib"][i]), 10.0);
  }
}

TEST(Study, MeasuresErrorsAndWritesDownWhatFails) {
  const std::string results = directory + "/measured";
  files::remove_all(results);
  const std::string file = write_study("measured", R"(<ParameterList name="settings">
  <ParameterList name="quantities"><ParameterList name="force">
    <Parameter name="type" type="string" value="contact force"/><Parameter name="component" type="string" value="x"/></ParameterList></ParameterList>
</ParameterList>
<ParameterList name="axes"><ParameterList name="tolerance"><ParameterList name="choices">
    <ParameterList name="usual"><Parameter name="newton/gap tolerance" type="double" value="1e-9"/></ParameterList>
    <ParameterList name="none"><Parameter name="newton/gap tolerance" type="double" value="1e-300"/></ParameterList></ParameterList></ParameterList>
  <ParameterList name="n"><Parameter name="setting" type="string" value="variables/n"/><Parameter name="values" type="string" value="6, 12, 24"/></ParameterList>
</ParameterList>
<ParameterList name="exclude"><ParameterList name="slow"><Parameter name="tolerance" type="string" value="none"/>
  <Parameter name="n" type="string" value="12, 24"/></ParameterList></ParameterList>
<ParameterList name="finest"><Parameter name="variables/n" type="int" value="36"/></ParameterList>
<ParameterList name="quantities">
  <ParameterList name="displacement"><Parameter name="measure" type="string" value="displacement"/></ParameterList>
  <ParameterList name="gradient"><Parameter name="measure" type="string" value="displacement gradient"/></ParameterList>
  <ParameterList name="pressure"><Parameter name="measure" type="string" value="pressure profile"/></ParameterList>
  <ParameterList name="force"><Parameter name="reference" type="string" value="richardson"/></ParameterList>
</ParameterList>
)");
  const Ending ending = study(file, results);
  EXPECT_EQ(ending.code, 3) << ending.output;
  EXPECT_TRUE(contains(ending.output, "5/5 none, n = 6: not converged")) << ending.output;
  auto columns = table(results + "/study.csv");
  ASSERT_EQ(columns["status"], (std::vector<std::string>{"done", "done", "done", "not converged"}));
  EXPECT_EQ(columns["error_displacement"][3], "");
  const auto value = [&](const std::string& name, int row) { return std::stod(columns.at(name).at(row)); };

  // Lame's solution is known: the triangle inequality bounds how far errors against the finest run are from those against it.
  const auto exact = [&](const std::string& run) {
    return Json::parse(read_file(results + "/" + run + "/summary.json")).at("quantities").at("displacement_error").get<double>();
  };
  for (int row : {0, 1, 2}) {
    const double other = exact("points/tolerance=usual,n=" + columns["axis_n"][row]);
    EXPECT_NEAR(value("error_displacement", row), other, 1.05 * exact("finest")) << row;
  }
  for (const char* name : {"error_displacement", "error_gradient", "error_pressure"}) {
    EXPECT_LT(value(name, 1), value(name, 0)) << name;
    EXPECT_LT(value(name, 2), value(name, 1)) << name;
  }
  // With errors c h^p those against the finest run are between c (h^p - h_finest^p) and c (h^p + h_finest^p); p is 1 for gradients, 2 for
  // displacements.
  const auto least = [](double p) { return (std::pow(6, -p) - std::pow(36, -p)) / (std::pow(12, -p) + std::pow(36, -p)); };
  EXPECT_GT(value("error_gradient", 0) / value("error_gradient", 1), least(1.0));
  EXPECT_GT(value("error_displacement", 0) / value("error_displacement", 1), least(2.0));
  const Json json = Json::parse(read_file(results + "/study.json"));
  // The pressure between the rings times the radius 2 is the force on a quarter: p a^2 / (b^2 - a^2) (b^2 / r^2 - 1) = 15.625 of 100.
  const Json& force = json.at("errors").at(3);
  const double limit = force.at("reference").at(0).get<double>(), on_finest = force.at("value").at(2).get<double>();
  EXPECT_LT(std::abs(std::abs(limit) - 31.25), std::abs(std::abs(on_finest) - 31.25));

  const std::string page = read_file(results + "/report.html");
  for (const char* expected : {"<table>", "<img src=\"data:image/svg+xml;base64,", "<b>none, n = 6</b>: not converged",
                               "not converged; the last converged state", "finest (reference)", "Environment", "<li>force: within 1 %",
                               "A run counts as within a bound only if all finer runs", "mortise run scene.xml --set "})
    EXPECT_TRUE(contains(page, expected)) << expected;
  EXPECT_LT(page.find("class=\"answer\""), page.find("<img"));
  EXPECT_LT(page.find("<img"), page.find("<table>"));
  // Settings with spaces are one word of the shell each.
  EXPECT_TRUE(contains(page, "--set 'newton/gap tolerance=1e-9'"));
  // Gradients converge; the one point of the other curve has no error.
  const Json& gradient = json.at("errors").at(1);
  EXPECT_EQ(gradient.at("no_order"), Json({"", "no errors"}));
  EXPECT_TRUE(gradient.at("orders").at(0).is_number() && gradient.at("orders").at(1).is_null());
  for (const char* outside : {"src=\"http", "src=\"/", "href=", "<script", "<link"}) EXPECT_FALSE(contains(page, outside)) << outside;
  for (const char* image : {"error_force", "time_force", "cost", "newton"})
    EXPECT_TRUE(files::exists(fmt::format("{}/plots/{}.svg", results, image)));
}

}  // namespace
