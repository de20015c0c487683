// The commands and the exit codes of the program.

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "launch.hpp"

namespace {

Ending mortise(std::vector<std::string> words, int ranks = 1) {
  std::vector<std::string> command{MPIEXEC, "-n", std::to_string(ranks), MORTISE};
  command.insert(command.end(), words.begin(), words.end());
  return launch(command, 60);
}

/// A block pressed by `force`; its outermost list contains `more`.
std::string write_scene(const std::string& name, const std::string& more) {
  const std::filesystem::path directory = std::filesystem::path(SCRATCH) / "commands";
  std::filesystem::create_directories(directory);
  const auto path = directory / (name + ".xml");
  std::ofstream(path) << R"(<ParameterList name="block">
  <ParameterList name="variables"><Parameter name="force" type="double" value="1"/></ParameterList>
  <ParameterList name="materials"><ParameterList name="soft">
    <Parameter name="type" type="string" value="neo hooke"/>
    <Parameter name="young's modulus" type="double" value="1000"/>
    <Parameter name="poisson's ratio" type="double" value="0.3"/>
  </ParameterList></ParameterList>
  <ParameterList name="bodies"><ParameterList name="block">
    <Parameter name="material" type="string" value="soft"/>
    <ParameterList name="mesh">
      <Parameter name="type" type="string" value="block"/>
      <Parameter name="cells x" type="int" value="3"/>
      <Parameter name="cells y" type="int" value="2"/>
    </ParameterList>
  </ParameterList></ParameterList>
  <ParameterList name="boundary conditions"><ParameterList name="floor">
    <Parameter name="set" type="string" value="block/bottom"/>
    <Parameter name="x" type="double" value="0"/>
    <Parameter name="y" type="double" value="0"/>
  </ParameterList></ParameterList>
  <ParameterList name="loads"><ParameterList name="press">
    <Parameter name="type" type="string" value="dead traction"/>
    <Parameter name="set" type="string" value="block/top"/>
    <Parameter name="y" type="string" value="-force*t"/>
  </ParameterList></ParameterList>
  <ParameterList name="quantities"><ParameterList name="support">
    <Parameter name="type" type="string" value="reaction"/>
    <Parameter name="set" type="string" value="block/bottom"/>
    <Parameter name="component" type="string" value="y"/>
  </ParameterList></ParameterList>
)" << more << "</ParameterList>\n";
  return path;
}

std::string check_list(const std::string& bounds) {
  return R"(<ParameterList name="checks"><ParameterList name="support"><Parameter name="quantity" type="string" value="support"/>)" + bounds +
         "</ParameterList></ParameterList>\n";
}

nlohmann::json summary_of(const std::string& directory) { return nlohmann::json::parse(read_file(directory + "/summary.json")); }

TEST(Program, HelpHasExamples) {
  const Ending ending = mortise({"--help"});
  EXPECT_EQ(ending.code, 0);
  EXPECT_NE(ending.output.find("Examples:"), std::string::npos);
}

TEST(Program, WrongUsageIsCode1) {
  EXPECT_EQ(mortise({}).code, 1);
  EXPECT_EQ(mortise({"rum"}).code, 1);
  EXPECT_EQ(mortise({"run"}).code, 1);
  EXPECT_EQ(mortise({"run", "scene.xml", "--colour"}, 2).code, 1);
  EXPECT_EQ(mortise({"list", "animals"}).code, 1);
  const std::string scene = write_scene("usage", "");
  for (const char* setting : {"", "a", "=3", "variables/=3"}) {
    const Ending ending = mortise({"check", scene, "--set", setting});
    EXPECT_EQ(ending.code, 1) << setting;
    EXPECT_NE(ending.output.find("please write path=value"), std::string::npos) << ending.output;
  }
  const Ending ending = mortise({"run", scene, "-o", ""});
  EXPECT_EQ(ending.code, 1);
  EXPECT_NE(ending.output.find("the name of the directory is empty"), std::string::npos) << ending.output;
}

TEST(Program, SaysWhatIsWrongWithAnOption) {
  struct Case {
    std::vector<std::string> words;
    std::string said;
  };
  for (const auto& [words, said] :
       {Case{{"--verison"}, "did you mean \"--version\""}, Case{{"paper", "-n", "0"}, "has to be a whole number above 0, not 0"},
        Case{{"describe", "contact", "--format", "xml"}, "there is no format \"xml\"; known: text, md, rng, json"},
        Case{{"list", "animals"}, "there is no topic \"animals\"; known: materials"},
        Case{{"peer", "a.xml", "--by", "abaqus"}, "there is no peer \"abaqus\"; known: calculix"}}) {
    const Ending ending = mortise(words);
    EXPECT_EQ(ending.code, 1) << ending.output;
    EXPECT_NE(ending.output.find(said), std::string::npos) << ending.output;
  }
}

TEST(Program, OneOfAllRanksSaysWhatIsWrongWithTheCommandLine) {
  const std::string scene = write_scene("ranks", ""), study = std::string(INPUTS) + "/studies/hertz_elastic.xml";
  struct Case {
    std::vector<std::string> words;
    std::string said;
    int code;
  };
  for (const auto& [words, said, code] :
       {Case{{"run", scene, "--colour"}, "The following argument was not expected: --colour", 1},
        Case{{"study", study}, "please call it without mpirun", 1},
        Case{{"run", scene, "--set", "stepping/farce=1", "-o", std::string(SCRATCH) + "/commands/ranks"}, "unknown parameter", 2}}) {
    const Ending ending = mortise(words, 3);
    EXPECT_EQ(ending.code, code) << ending.output;
    const std::size_t first = ending.output.find(said);
    ASSERT_NE(first, std::string::npos) << ending.output;
    EXPECT_EQ(ending.output.find(said, first + 1), std::string::npos) << ending.output;
  }
}

// Alone, the input is read without MPI; with mpirun all ranks read it.
TEST(Program, SaysTheSameWithAndWithoutMpirun) {
  const std::string scene = write_scene("alone", "");
  for (const auto& [setting, code] : {std::pair{"variables/force=2", 0}, {"variables/force=two", 2}, {"bodies/block/material=hard", 2}}) {
    const std::string results = std::filesystem::path(SCRATCH) / "commands/alone";
    std::filesystem::remove_all(results);
    const std::vector<std::string> words{"run", scene, "--set", setting, "--quiet", "-o", results};
    std::vector<std::string> alone{MORTISE};
    alone.insert(alone.end(), words.begin(), words.end());
    const Ending one = launch(alone, 60), two = mortise(words, 2);
    EXPECT_EQ(one.code, code) << one.output;
    EXPECT_EQ(two.code, code) << two.output;
    EXPECT_EQ(two.output.find(one.output), 0u) << one.output << two.output;
  }
}

TEST(Program, DescribesAListInEveryFormat) {
  for (const char* format : {"text", "md", "rng"}) {
    const Ending ending = mortise({"describe", "stepping", "--format", format});
    EXPECT_EQ(ending.code, 0);
    EXPECT_NE(ending.output.find("end time"), std::string::npos) << ending.output;
  }
  const Ending ending = mortise({"describe", "steping"});
  EXPECT_EQ(ending.code, 2);
  EXPECT_NE(ending.output.find("did you mean \"stepping\""), std::string::npos) << ending.output;
}

TEST(Program, ListsWhatCanBeChosen) {
  EXPECT_NE(mortise({"list", "materials"}).output.find("neo hooke"), std::string::npos);
  EXPECT_NE(mortise({"list", "exact"}).output.find("hertz line contact"), std::string::npos);
  EXPECT_NE(mortise({"list", "quantities"}).output.find("momentum imbalance"), std::string::npos);
}

TEST(Program, DoctorNamesTheSolvers) {
  const Ending ending = mortise({"doctor"}, 2);
  EXPECT_EQ(ending.code, 0) << ending.output;
  EXPECT_NE(ending.output.find("Trilinos"), std::string::npos);
  EXPECT_NE(ending.output.find("klu2"), std::string::npos);
}

// The pieces of XML on the page about scene files are, put together, a scene that runs.
TEST(Program, TheDocumentedSceneRuns) {
  const std::string page = read_file(std::string(DOCS) + "/scenes.md"), begin = "```xml\n", end = "```";
  std::string scene;
  for (std::size_t at = page.find(begin); at != std::string::npos; at = page.find(begin, at)) {
    at += begin.size();
    scene += page.substr(at, page.find(end, at) - at);
  }
  const std::filesystem::path directory = std::filesystem::path(SCRATCH) / "documented";
  std::filesystem::remove_all(directory);
  std::filesystem::create_directories(directory);
  std::ofstream(directory / "stamp.xml") << scene;
  for (const int ranks : {1, 2}) {
    const Ending ending = mortise({"run", directory / "stamp.xml", "-o", directory / "results"}, ranks);
    EXPECT_EQ(ending.code, 0) << ending.output;
  }
  const Ending set = mortise({"check", directory / "stamp.xml", "--set", "variables/n=8", "--set", "contact/interface/gap weighting=standard"});
  EXPECT_EQ(set.code, 0) << set.output;
  const Ending wrong = mortise({"check", directory / "stamp.xml", "--set", "materials/rubber/poisson's ratio=0.7"});
  EXPECT_EQ(wrong.code, 2);
  const std::string message = wrong.output.substr(wrong.output.find("command line:"));
  EXPECT_NE(page.find(message.substr(0, message.find('\n'))), std::string::npos) << message;
}

TEST(Program, CheckSolvesAndWritesNothing) {
  const std::string scene = write_scene("only_checked", "");
  const Ending ending = mortise({"check", scene}, 2);
  EXPECT_EQ(ending.code, 0) << ending.output;
  EXPECT_NE(ending.output.find("24 dofs"), std::string::npos) << ending.output;
  EXPECT_NE(ending.output.find("MiB"), std::string::npos) << ending.output;
}

// Factors of a cube of N nodes take 8 * 9 * 2 * 12.75 N^(4/3) bytes and more. The run ends before there are any: its load has no value after t = 0.
TEST(Program, RunAndCheckWarnOfFactorsThatDoNotFitIntoMemory) {
  const double memory = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  if (memory > 64e9) GTEST_SKIP() << "this machine has so much memory that it would take too long";
  const std::string scene = write_scene("too_large", ""), cells = std::to_string(static_cast<int>(std::ceil(std::pow(memory / 1836.0, 0.25))));
  std::vector<std::string> words{"",      scene,
                                 "--set", "kinematics=three dimensional",
                                 "--set", "bodies/block/element=H8",
                                 "--set", "bodies/block/mesh/type=brick",
                                 "--set", "linear solver/type=mumps",
                                 "--set", "boundary conditions/floor/z=0",
                                 "--set", "loads/press/y=1/(t<=0)",
                                 "--set", "stepping/minimum step=1"};
  for (const char* direction : {"x", "y", "z"})
    words.insert(words.end(), {"--set", std::string("bodies/block/mesh/cells ") + direction + "=" + cells});
  const std::string directory = std::string(SCRATCH) + "/commands/too_large";
  std::filesystem::remove_all(directory);
  const std::string about = "until here, ", warning = "that is more than the ",
                    advice = " MiB here; please make the meshes coarser, take another solver";
  for (const auto& [command, code] : {std::pair<std::string, int>{"check", 0}, {"run", 2}}) {
    words.front() = command;
    if (command == "run") words.insert(words.end(), {"-o", directory});
    const Ending ending = mortise(words);
    EXPECT_EQ(ending.code, code) << ending.output;
    for (const std::string& said : {about, warning, advice}) EXPECT_NE(ending.output.find(said), std::string::npos) << ending.output;
  }
}

TEST(Program, RunLeavesItsFilesAndABalancedSupport) {
  const std::string directory = std::string(SCRATCH) + "/commands/balanced";
  std::filesystem::remove_all(directory);
  for (const int ranks : {1, 2}) {
    const Ending ending = mortise({"run", write_scene("balanced", check_list(R"(<Parameter name="low" type="double" value="1.999"/>)")), "--set",
                                   "variables/force=2", "-o", directory},
                                  ranks);
    EXPECT_EQ(ending.code, 0) << ending.output;
    for (const char* file :
         {"summary.json", "newton.csv", "history.csv", "effective.xml", "log.txt", "fields.xdmf", "fields/mesh.h5", "fields/step-000001.h5"})
      EXPECT_TRUE(std::filesystem::exists(directory + "/" + file)) << file;
    const auto summary = summary_of(directory);
    EXPECT_EQ(summary.at("ranks"), ranks);
    EXPECT_EQ(summary.at("dofs"), 24);
    EXPECT_EQ(summary.at("exit"), 0);
    EXPECT_EQ(summary.at("converged"), true);
    EXPECT_NEAR(summary.at("quantities").at("support").get<double>(), 2.0, 1e-8);
    EXPECT_TRUE(summary.at("effects").at("contact").empty());
    EXPECT_EQ(summary.at("slave_nodes"), 0);
    EXPECT_GT(summary.at("time").at("total").get<double>(), 0.0);
    EXPECT_GT(summary.at("calls").at("bulk").get<long>(), 1);
    EXPECT_GT(summary.at("memory_peak_mib").get<double>(), 1.0);
  }
}

/// No force acts on a block that its support carries along: what round-off leaves of forces is in balance.
TEST(Program, ABodyThatOnlyMovesIsInBalance) {
  const std::string directory = std::string(SCRATCH) + "/commands/moved";
  std::filesystem::remove_all(directory);
  const std::string checks = R"(<ParameterList name="checks"><ParameterList name="balance"><Parameter name="quantity" type="string" value="largest"/>
    <Parameter name="high" type="double" value="1e-12"/></ParameterList></ParameterList>)";
  const Ending ending =
      mortise({"run", write_scene("moved", checks), "-o", directory, "--set", "variables/force=0", "--set", "boundary conditions/floor/x=0.3*t",
               "--set", "boundary conditions/floor/y=0.7*t", "--set", "stepping/step=0.1", "--set", "quantities/balance/type=momentum imbalance",
               "--set", "quantities/largest/type=over time", "--set", "quantities/largest/quantity=balance"},
              2);
  EXPECT_EQ(ending.code, 0) << ending.output;
  EXPECT_NE(summary_of(directory)["quantities"]["support"], 0.0) << "there has to be round-off";
}

TEST(Program, EffectiveSceneGivesTheSameRun) {
  const std::string directory = std::string(SCRATCH) + "/commands/";
  for (const char* name : {"first", "again"}) std::filesystem::remove_all(directory + name);
  ASSERT_EQ(mortise({"run", write_scene("first", ""), "-o", directory + "first"}).code, 0);
  const Ending again = mortise({"run", directory + "first/effective.xml", "-o", directory + "again"});
  ASSERT_EQ(again.code, 0) << again.output;
  EXPECT_EQ(summary_of(directory + "first").at("quantities"), summary_of(directory + "again").at("quantities"));
  EXPECT_EQ(read_file(directory + "first/effective.xml"), read_file(directory + "again/effective.xml"));
}

TEST(Program, AMissedCheckIsCode4) {
  const std::string directory = std::string(SCRATCH) + "/commands/missed";
  std::filesystem::remove_all(directory);
  for (const int ranks : {1, 2}) {
    const Ending ending =
        mortise({"run", write_scene("missed", check_list(R"(<Parameter name="low" type="double" value="3"/>)")), "-o", directory}, ranks);
    EXPECT_EQ(ending.code, 4) << ending.output;
    const auto summary = summary_of(directory);
    EXPECT_EQ(summary.at("exit"), 4);
    EXPECT_EQ(summary.at("checks").at(0).at("ok"), false);
  }
}

TEST(Program, ARunThatDoesNotConvergeIsCode3AndKeepsTheLastGoodState) {
  // Pulling with a dead load of ten times the modulus turns elements over long before the end.
  const std::string directory = std::string(SCRATCH) + "/commands/diverging";
  std::filesystem::remove_all(directory);
  for (const int ranks : {1, 2}) {
    const Ending ending =
        mortise({"run", write_scene("diverging", R"(<ParameterList name="stepping"><Parameter name="step" type="double" value="0.01"/>
      <Parameter name="minimum step" type="double" value="0.005"/></ParameterList>)"),
                 "--set", "variables/force=100000", "-o", directory},
                ranks);
    EXPECT_EQ(ending.code, 3) << ending.output;
    const auto summary = summary_of(directory);
    EXPECT_EQ(summary.at("exit"), 3);
    EXPECT_EQ(summary.at("converged"), false);
  }
}

// The block begins 0.02 in the wall and 0.03 above the floor.
TEST(Program, SurfacesThatBeginInOneAnotherAreTold) {
  for (const int ranks : {1, 3}) {
    const Ending ending =
        mortise({"check", std::string(INPUTS) + "/verification/held_by_contact.xml", "--set", "bodies/block/mesh/translation=-0.02,0.03"}, ranks);
    EXPECT_EQ(ending.code, 0) << ending.output;
    EXPECT_NE(ending.output.find("contact on wall: the surfaces overlap by up to 0.02 at the start"), std::string::npos) << ending.output;
    EXPECT_EQ(ending.output.find("contact on floor: the surfaces overlap by"), std::string::npos) << ending.output;
  }
}

// The block is pulled off the wall from t = 0.5 on; nothing but the wall holds it in x.
TEST(Program, ABodyThatComesFreeIsNamed) {
  const std::string directory = std::string(SCRATCH) + "/commands/freed";
  std::filesystem::remove_all(directory);
  for (const int ranks : {1, 2}) {
    const Ending ending = mortise({"run", std::string(INPUTS) + "/verification/held_by_contact.xml", "--set", "loads/left/x=p*(2*t-1)", "--set",
                                   "stepping/step=0.1", "-o", directory},
                                  ranks);
    EXPECT_EQ(ending.code, 3) << ending.output;
    const std::string last = ending.output.substr(ending.output.find("not converged; the last converged state is that of time 0.5"));
    EXPECT_NE(last.find("no equilibrium: body 'block' (translation in x"), std::string::npos) << ending.output;
    EXPECT_NE(last.find("no force of contact \"on floor\", \"on wall\" acts against it"), std::string::npos) << ending.output;
  }
}

// Friction of 0.3 on the floor, pressed by 4 t, bears the pull of 4 (2 t - 1) up to t = 1 / 1.7. The run stops within the last twenty of the smallest
// steps, 0.1 / 1024, before.
TEST(Program, FrictionThatCanBearNoMoreIsNamed) {
  const double limit = 1.0 / 1.7;
  for (const int ranks : {1, 2}) {
    const std::string directory = std::string(SCRATCH) + "/commands/slipped", pair = "contact/on floor/friction/";
    std::filesystem::remove_all(directory);
    const Ending ending = mortise({"run", std::string(INPUTS) + "/verification/held_by_contact.xml", "--set", "loads/left/x=p*(2*t-1)", "--set",
                                   pair + "type=coulomb", "--set", pair + "coefficient=0.3", "--set", "stepping/step=0.1", "-o", directory},
                                  ranks);
    EXPECT_EQ(ending.code, 3) << ending.output;
    const double last = summary_of(directory).at("steps").back().at("time");
    EXPECT_LT(last, limit);
    EXPECT_GT(last, limit - 20.0 * 0.1 / 1024.0);
    const std::string end = ending.output.substr(ending.output.find("not converged; the last converged state"));
    EXPECT_NE(end.find("no equilibrium: friction is used up by body 'block' (translation in x)"), std::string::npos) << ending.output;
  }
}

TEST(Program, KeepRefusesADirectoryWithResults) {
  const std::string directory = std::string(SCRATCH) + "/commands/kept", scene = write_scene("kept", "");
  std::filesystem::remove_all(directory);
  ASSERT_EQ(mortise({"run", scene, "-o", directory, "--keep"}).code, 0);
  const std::string before = read_file(directory + "/summary.json");
  EXPECT_EQ(mortise({"run", scene, "-o", directory, "--keep"}, 2).code, 5);
  EXPECT_EQ(read_file(directory + "/summary.json"), before);
}

TEST(Program, BadInputLeavesEarlierResultsAlone) {
  const std::string directory = std::string(SCRATCH) + "/commands/earlier";
  std::filesystem::remove_all(directory);
  ASSERT_EQ(mortise({"run", write_scene("earlier", ""), "-o", directory}).code, 0);
  const std::string before = read_file(directory + "/summary.json");
  EXPECT_EQ(mortise({"run", write_scene("earlier_bad", "<Parameter name=\"colour\" type=\"int\" value=\"1\"/>"), "-o", directory}).code, 2);
  EXPECT_EQ(read_file(directory + "/summary.json"), before);
}

TEST(Program, ARankThatFailsAloneEndsAllWithCode70) {
  for (const int ranks : {2, 3}) {
    const Ending ending = launch({MPIEXEC, "-n", std::to_string(ranks), ONE_RANK_FAILS}, 60);
    EXPECT_EQ(ending.code, 70) << ending.output;
    EXPECT_NE(ending.output.find("this rank alone"), std::string::npos) << ending.output;
  }
}

}  // namespace
