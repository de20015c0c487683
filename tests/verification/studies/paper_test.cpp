// `mortise paper`: the page, its figures and numbers, runs that fail, bad usage.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "launch.hpp"

namespace {

namespace files = std::filesystem;
using Json = nlohmann::json;

const std::string directory = std::string(SCRATCH) + "/paper";

Ending paper(std::vector<std::string> words, const std::vector<std::string>& before = {}) {
  std::vector<std::string> command = before;
  command.insert(command.end(), {MORTISE, "paper"});
  command.insert(command.end(), words.begin(), words.end());
  return launch(command, 240);
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

Json summary_of(const std::string& run) { return Json::parse(read_file(run + "/summary.json")); }

TEST(Paper, PageHoldsFiguresAndTheNumbersOfTheSummary) {
  files::remove_all(directory);
  const Ending ending = paper({"--only", "patch_test,block_pile_axisymmetric,hertz_elastic", "-o", directory});
  ASSERT_EQ(ending.code, 0) << ending.output;
  EXPECT_TRUE(contains(ending.output, "1/3 patch_test: done")) << ending.output;
  EXPECT_TRUE(contains(ending.output, "3/3 hertz_elastic: done")) << ending.output;
  const std::string page = read_file(directory + "/paper.html");
  EXPECT_TRUE(contains(page, "Figure 4")) << page.substr(0, 1000);
  EXPECT_TRUE(contains(page, "Figure 6"));
  EXPECT_TRUE(contains(page, "<table>"));
  EXPECT_TRUE(contains(page, "<img src=\"data:image/svg+xml;base64,"));
  // One file: nothing is fetched from elsewhere.
  for (const char* outside : {"src=\"http", "src=\"/", "href=", "<script", "<link"}) EXPECT_FALSE(contains(page, outside)) << outside;
  EXPECT_TRUE(contains(page, "Figure 8"));
  // Hertz with the stated materials, and the exact stress of the pile.
  for (const char* expected : {"<td>1367</td>", "<td>2.3285</td>", "<td>-1239</td>"}) EXPECT_TRUE(contains(page, expected)) << expected;
  for (const char* run : {"patch_test", "block_pile_axisymmetric", "hertz_elastic"}) {
    const Json summary = summary_of(directory + "/" + run);
    for (const char* name : {"stress_spread", "axial_stress", "lateral_stretch", "peak_pressure", "half_width"})
      if (summary.at("quantities").contains(name)) {
        const double found = summary.at("quantities").at(name);
        const std::string value = found != 0.0 && std::abs(found) < 1e-6 ? fmt::format("<td>{:.1e}", found) : fmt::format("<td>{:.5g}", found);
        EXPECT_TRUE(contains(page, value)) << run << ": " << name << " " << value;
      }
  }
  // The answer comes first, then the figures, then the tables.
  const auto at = [&](const char* part) { return page.find(part); };
  EXPECT_LT(at("results of the paper are met"), at("<img"));
  EXPECT_LT(at("<img"), at("<table>"));
  EXPECT_TRUE(contains(page, "mortise run scenes/hertz_elastic.xml --set variables/mu=0.1 --set variables/n=16 -o again/hertz_elastic</pre>"));
  // Examples that were not asked for are not there.
  EXPECT_FALSE(contains(page, "Hertz problem, plastic"));
}

TEST(Paper, ReusesWhatIsThereOnlyIfItIsTheSame) {
  const std::string results = directory + "_reused";
  files::remove_all(results);
  ASSERT_EQ(paper({"--only", "patch_test", "-o", results}).code, 0);
  const auto written = [&] { return files::last_write_time(results + "/patch_test/summary.json"); };
  const auto first = written();
  Ending ending = paper({"--only", "patch_test", "-o", results, "--reuse"});
  EXPECT_EQ(ending.code, 0) << ending.output;
  EXPECT_TRUE(contains(ending.output, "results of an earlier call")) << ending.output;
  EXPECT_EQ(written(), first);
  // Two ranks are another run.
  ending = paper({"--only", "patch_test", "-o", results, "--reuse", "-n", "2"});
  EXPECT_EQ(ending.code, 0) << ending.output;
  EXPECT_NE(written(), first);
  EXPECT_EQ(summary_of(results + "/patch_test").at("ranks"), 2);
}

TEST(Paper, AMissThatThePaperIsRightAboutIsSaidToBeExpected) {
  const std::string results = directory + "_expected";
  files::remove_all(results);
  const Ending ending = paper({"--only", "patch_test_node_to_segment", "-o", results});
  EXPECT_EQ(ending.code, 0) << ending.output;
  EXPECT_TRUE(contains(ending.output, "exit code 4, a check missed as expected: nodes on segments do not pass a uniform pressure on"))
      << ending.output;
  const std::string page = read_file(results + "/paper.html");
  EXPECT_TRUE(contains(page, "is expected to miss checks of its scene: nodes on segments do not pass a uniform pressure on"));
  EXPECT_TRUE(contains(page, "uniform stress: stress_spread = "));
  EXPECT_FALSE(contains(page, "class=\"failed\""));
  EXPECT_TRUE(contains(page, "1 of 1 results of the paper are met"));
}

TEST(Paper, ARunThatFailsIsWrittenDownAndTheNextOneStarts) {
  const std::string results = directory + "_failing";
  files::remove_all(results);
  ASSERT_EQ(paper({"--only", "patch_test", "-o", results}).code, 0);
  // Someone writes where the first run's results should go.
  const Ending ending = paper({"--only", "patch_test,patch_test_plastic", "-o", results}, {"flock", results + "/patch_test/.mortise.lock"});
  EXPECT_EQ(ending.code, 3) << ending.output;
  EXPECT_TRUE(contains(ending.output, "patch_test: exit code 5")) << ending.output;
  EXPECT_TRUE(contains(ending.output, "2/2 patch_test_plastic: done")) << ending.output;
  const std::string page = read_file(results + "/paper.html");
  EXPECT_TRUE(contains(page, "<b>patch_test</b> ended with exit code 5"));
  EXPECT_TRUE(contains(page, "it is being written by another process"));
  EXPECT_TRUE(contains(page, "patch test, plastic form"));
  EXPECT_FALSE(contains(page, "patch test, elastic form"));
}

TEST(Paper, BadUsageIsCode1AndNamesTheChoices) {
  Ending ending = paper({"--only", "patch_tst"});
  EXPECT_EQ(ending.code, 1);
  for (const auto& entry : files::directory_iterator(PAPER_SCENES))
    EXPECT_TRUE(contains(ending.output, entry.path().stem().string())) << entry.path() << ": " << ending.output;
  ending = paper({"-n", "0"});
  EXPECT_EQ(ending.code, 1) << ending.output;
  ending = paper({"--only", "patch_test", "-o", directory + "_mpi"}, {MPIEXEC, "-n", "2"});
  EXPECT_EQ(ending.code, 1) << ending.output;
  EXPECT_TRUE(contains(ending.output, "please call it without mpirun")) << ending.output;
  EXPECT_FALSE(files::exists(directory + "_mpi"));
}

TEST(Paper, WithoutMatplotlibNothingIsRunAndOneLineSaysWhatToInstall) {
  const std::string results = directory + "_no_python";
  files::remove_all(results);
  const Ending ending = paper({"--only", "patch_test", "-o", results}, {"env", "MORTISE_PYTHON=/nowhere/python3"});
  EXPECT_EQ(ending.code, 5) << ending.output;
  EXPECT_TRUE(contains(ending.output, "please install python3-matplotlib and python3-h5py")) << ending.output;
  EXPECT_FALSE(files::exists(results + "/patch_test"));
  EXPECT_EQ(paper({"-o", "/proc/nowhere"}).code, 5);
}

}  // namespace
