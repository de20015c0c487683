// `mortise study` with points that never end: their time limit, and studies that are interrupted. No process of theirs may be left.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "peer_support.hpp"
#include "study_support.hpp"

namespace {

namespace files = std::filesystem;
using namespace peer_support;
using namespace study_support;
using Json = nlohmann::json;
using ::testing::IsEmpty;

constexpr double grace = 5.0;  // docs/study.md

/// Marks the processes that this one starts from now on, by a variable of the environment.
void mark(const std::string& name) { setenv("MORTISE_TEST_STUDY", name.c_str(), 1); }

/// The processes that were started since mark(name), by their command lines; not those that have ended.
std::vector<std::string> marked(const std::string& name) {
  std::vector<std::string> found;
  for (const auto& process : files::directory_iterator("/proc"))
    if (contains(read_file(process.path() / "environ"), "MORTISE_TEST_STUDY=" + name + '\0'))
      found.push_back(process.path().filename().string() + " " + read_file(process.path() / "cmdline"));
  return found;
}

/// A study whose points take one step, or ten million, on 1 or 2 ranks.
std::string write_endless(const std::string& name, const std::string& steps, const std::string& ranks) {
  files::remove_all(directory + "/" + name);
  return write_study(name, R"(<ParameterList name="axes"><ParameterList name="steps"><ParameterList name="choices">)" + steps +
                               R"(</ParameterList></ParameterList>
<ParameterList name="ranks"><Parameter name="setting" type="string" value="ranks"/><Parameter name="values" type="string" value=")" +
                               ranks +
                               R"("/></ParameterList></ParameterList>
<Parameter name="repeats" type="int" value="2"/>
<ParameterList name="quantities"><ParameterList name="displacement_error"><Parameter name="measure" type="string" value="itself"/></ParameterList></ParameterList>
)");
}

const std::string endless = R"(<ParameterList name="endless"><Parameter name="stepping/step" type="double" value="1e-7"/></ParameterList>)",
                  one = R"(<ParameterList name="one"><Parameter name="time limit" type="double" value="200"/></ParameterList>)";

Json points_of(const std::string& results) { return Json::parse(read_file(results + "/study.json")).at("points"); }

TEST(StudyLimit, EndsAPointWithAllThatItStartedAndRunsItAgainOnlyIfThereIsMoreTime) {
  const std::string results = directory + "/limit", file = write_endless("limit", one + endless, "1, 2");
  const auto call = [&](const std::string& limit) { return launch({MORTISE, "study", file, "-o", results, "--set", "time limit=" + limit}, 240); };
  mark("limit");
  Ending ending = call("2");
  EXPECT_EQ(ending.code, 3) << ending.output;
  EXPECT_THAT(marked("limit"), IsEmpty());
  const Json points = points_of(results);
  for (int i : {0, 1}) EXPECT_EQ(points.at(i).at("status"), "done") << points.at(i);
  for (int i : {2, 3}) {
    const Json& point = points.at(i);
    EXPECT_EQ(point.at("status"), "stopped after 2 s: time limit of the study") << point;
    EXPECT_FALSE(point.at("finished"));
    EXPECT_GE(point.at("wall_s"), 2.0);
    EXPECT_LT(point.at("wall_s"), 2.0 + 2.0 * grace);
    EXPECT_GT(point.at("cpu_s"), 0.0);
    EXPECT_EQ(point.at("memory_mib").is_number(), i == 2) << "the sum over ranks is not known";
    const std::string record = read_file(results + "/points/" + point.at("name").get<std::string>() + "/study-point.json");
    EXPECT_EQ(Json::parse(record).at("repeats").size(), 1u);
  }
  EXPECT_TRUE(contains(ending.output, "endless, ranks = 2: stopped after 2 s: time limit of the study; with a larger one it is run again"))
      << ending.output;
  EXPECT_TRUE(contains(read_file(results + "/study.csv"), ",stopped after 2 s: time limit of the study,endless,2"));
  EXPECT_TRUE(contains(read_file(results + "/report.html"), "stopped after 2 s: time limit of the study"));

  for (const char* limit : {"2", "1"}) {
    ending = call(limit);
    EXPECT_EQ(ending.code, 3) << ending.output;
    for (const char* line : {"1/4 one, ranks = 1: done, results", "4/4 endless, ranks = 2: stopped after 2 s: time limit of the study, results"})
      EXPECT_TRUE(contains(ending.output, line)) << ending.output;
    EXPECT_EQ(points_of(results), points);
  }
  ending = call("2.5");
  EXPECT_TRUE(contains(ending.output, "2/4 one, ranks = 2: done, results")) << ending.output;
  for (int i : {2, 3}) EXPECT_EQ(points_of(results).at(i).at("status"), "stopped after 2.5 s: time limit of the study");
}

TEST(StudyLimit, KillsWhatDoesNotListen) {
  const std::string results = directory + "/deaf", file = write_endless("deaf", endless, "1");
  mark("deaf");
  const Ending ending = launch({"env", "--ignore-signal=TERM", MORTISE, "study", file, "-o", results, "--set", "time limit=2"}, 240);
  EXPECT_EQ(ending.code, 3) << ending.output;
  EXPECT_THAT(marked("deaf"), IsEmpty());
  EXPECT_GE(points_of(results).at(0).at("wall_s"), 2.0 + grace);
  EXPECT_LT(points_of(results).at(0).at("wall_s"), 2.0 + 3.0 * grace);
}

TEST(StudyLimit, EndsAPeerAndCountsIt) {
  const std::string results = peers + "/too_long", file = directory + "/endless_peer.xml";
  const std::string path =
      path_with("endless", "trap '' TERM; [ \"$1\" = -v ] || exec python3 -c 'import time; x = b\"x\" * (250 << 20); time.sleep(3600)'");
  files::remove_all(results);
  files::create_directories(directory);
  std::ofstream(file) << R"(<ParameterList name="endless"><Parameter name="scene" type="string" value=")" << INPUTS
                      << R"(/verification/patch_ratio_1_7.xml"/><Parameter name="time limit" type="int" value="4"/><ParameterList name="axes">
<ParameterList name="peer"><Parameter name="setting" type="string" value="peer"/><Parameter name="values" type="string" value="none, calculix mortar"/>
</ParameterList></ParameterList><ParameterList name="quantities"><ParameterList name="stress_spread"><Parameter name="measure" type="string" value="itself"/>
</ParameterList></ParameterList></ParameterList>)";
  mark("peer");
  const Ending ending = study(file, results, {"env", path});
  EXPECT_EQ(ending.code, 3) << ending.output;
  EXPECT_THAT(marked("peer"), IsEmpty());
  const Json point = points_of(results).at(1);
  EXPECT_EQ(point.at("status"), "stopped after 4 s: time limit of the study") << point;
  EXPECT_GE(point.at("wall_s"), 4.0);
  EXPECT_GE(point.at("memory_mib"), 250.0);  // its own, not only that of the process that started it
  EXPECT_EQ(points_of(results).at(0).at("status"), "done");
}

TEST(StudyLimit, IsANumberOfSeconds) {
  const std::string wrong = R"(<ParameterList name="wrong"><Parameter name="time limit" type="string" value="soon"/></ParameterList>)";
  const std::string file = write_endless("wrong", wrong, "1");
  const Ending ending = launch({MORTISE, "study", file, "-o", directory + "/wrong", "--set", "time limit=0"});
  EXPECT_EQ(ending.code, 2);
  EXPECT_TRUE(contains(ending.output, "\"time limit\" is \"soon\"; it has to be a number of seconds above 0")) << ending.output;
  EXPECT_TRUE(contains(ending.output, "\"time limit\" is 0")) << ending.output;
}

TEST(Study, TakesItsRunsWithItWhenItIsInterrupted) {
  for (const int with : {SIGINT, SIGTERM})
    for (const char* limit : {"", "600"}) {
      const std::string results = directory + "/interrupted", file = write_endless("interrupted", endless, "2");
      mark("interrupted");
      std::vector<std::string> options{"--quiet"};
      if (*limit != '\0') options.insert(options.end(), {"--set", std::string("time limit=") + limit});
      kill_when([&] { return marked("interrupted").size() >= 4; }, file, results, options, with);  // the study, mpirun, two ranks
      wait_until([&] { return marked("interrupted").empty(); });
      EXPECT_THAT(marked("interrupted"), IsEmpty()) << with << limit;
      EXPECT_FALSE(files::exists(results + "/points/steps=endless,ranks=2/study-point.json"));
    }
  const std::string results = directory + "/interrupted", file = directory + "/interrupted.xml";
  const Ending ending = launch({MORTISE, "study", file, "-o", results, "--set", "time limit=1"}, 240);
  EXPECT_EQ(ending.code, 3) << ending.output;
  EXPECT_EQ(points_of(results).at(0).at("status"), "stopped after 1 s: time limit of the study");
}

}  // namespace
