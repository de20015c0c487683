// Directories for results: what is another's stays, and one run writes at a time.

#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <map>

#include "scene_support.hpp"
#include "study_support.hpp"

namespace {

using namespace scene_support;
using ::testing::AllOf;
using ::testing::HasSubstr;

files::path fresh(const std::string& name) {
  const files::path directory = files::path(SCRATCH) / name;
  files::remove_all(directory);
  files::create_directories(directory);
  return directory;
}

/// All files below a directory with what they hold.
std::map<std::string, std::string> content_of(const files::path& directory) {
  std::map<std::string, std::string> content;
  for (const auto& entry : files::recursive_directory_iterator(directory))
    content[entry.path()] = entry.is_directory() ? "" : read_file(entry.path());
  return content;
}

/// The program with these words, called in a directory.
Ending in_directory(const files::path& directory, std::vector<std::string> words, int seconds = 120) {
  words.insert(words.begin(), {"env", "-C", directory, MORTISE});
  return launch(words, seconds);
}

struct Command {
  std::string name;
  std::vector<std::string> words;
  std::vector<std::string> makes;  ///< names that it cannot do without
};

const std::string point_file = R"xml(<ParameterList name="point">
  <ParameterList name="material">
    <Parameter name="type" type="string" value="hencky"/>
    <Parameter name="young's modulus" type="double" value="1000"/>
    <Parameter name="poisson's ratio" type="double" value="0.3"/>
  </ParameterList>
  <ParameterList name="path">
    <Parameter name="type" type="string" value="uniaxial"/>
    <Parameter name="final stretch" type="double" value="1.1"/>
  </ParameterList>
</ParameterList>
)xml";

std::vector<Command> commands() {
  std::vector<Command> all{{"run", {"run", "input.xml"}, {"history.csv", "summary.json", "log.txt", "effective.xml", "fields.xdmf"}},
                           {"point", {"point", "point.xml"}, {"point.csv", "summary.json"}},
                           {"study", {"study", "study.xml"}, {"points", "scene.xml", "study.csv", "report.html", "plots"}},
                           {"scale", {"scale", "input.xml", "--ranks", "1"}, {"runs", "scale.csv", "report.html"}},
                           {"plan", {"scale", "input.xml", "--plan", "2"}, {"plan.csv", "plan.svg"}},
                           {"paper", {"paper", "--only", "patch_test"}, {"paper.html", "scenes", "patch_test"}},
                           {"hard", {"hard", "ledger.xml"}, {"ledger.csv", "hard-cases.html", "a_case"}},
                           {"describe", {"describe", "--format", "rng"}, {"scene.rng"}}};
  if (launch({"ccx", "-v"}).code != 127)
    all.push_back({"peer", {"peer", std::string(INPUTS) + "/verification/patch_ratio_1_7.xml"}, {"peer.inp", "peer.frd", "summary.json"}});
  return all;
}

const std::string input = replaced(good_scene, R"xml(<ParameterList name="contact">)xml", R"xml(<ParameterList name="quantities">
    <ParameterList name="force">
      <Parameter name="type" type="string" value="reaction"/>
      <Parameter name="set" type="string" value="lower/bottom"/>
      <Parameter name="component" type="string" value="y"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="contact">)xml");

void write_inputs(const files::path& directory) {
  std::ofstream(directory / "input.xml") << input;
  std::ofstream(directory / "point.xml") << point_file;
  std::ofstream(directory / "study.xml") << R"xml(<ParameterList name="study">
  <Parameter name="scene" type="string" value="input.xml"/>
  <Parameter name="h" type="string" value="1"/>
  <ParameterList name="axes"><ParameterList name="cells">
    <Parameter name="setting" type="string" value="bodies/lower/mesh/cells x"/><Parameter name="values" type="string" value="2, 3"/>
  </ParameterList></ParameterList>
  <ParameterList name="quantities"><ParameterList name="force">
    <Parameter name="value" type="string" value="2"/>
  </ParameterList></ParameterList>
</ParameterList>
)xml";
  std::ofstream(directory / "ledger.xml") << R"xml(<ParameterList name="ledger"><ParameterList name="cases"><ParameterList name="a case">
  <Parameter name="scene" type="string" value="input.xml"/><Parameter name="hard" type="string" value="nothing"/>
  <Parameter name="expectation" type="string" value="an end"/><Parameter name="source" type="string" value="closed form"/>
  <ParameterList name="expected"><ParameterList name="end"><Parameter name="figure" type="string" value="t"/>
    <Parameter name="low" type="string" value="0"/></ParameterList></ParameterList>
</ParameterList></ParameterList></ParameterList>
)xml";
}

class Directories : public ::testing::TestWithParam<Command> {};

TEST_P(Directories, WhatTheUserPutThereStaysAndStopsTheCommand) {
  const Command& command = GetParam();
  for (const std::string& name : command.makes) {
    const files::path directory = fresh(command.name);
    write_inputs(directory);
    if (name.find('.') == std::string::npos) {
      files::create_directory(directory / name);
      std::ofstream(directory / name / "thesis.tex") << "years of work";
    } else {
      std::ofstream(directory / name) << "years of work";
    }
    const auto before = content_of(directory);
    std::vector<std::string> words = command.words;
    words.insert(words.end(), {"-o", "."});
    const Ending ending = in_directory(directory, words);
    EXPECT_EQ(ending.code, 5) << name << "\n" << ending.output;
    EXPECT_THAT(ending.output, AllOf(HasSubstr(name + " in it was not made by this program"), HasSubstr("choose another directory (-o)"))) << name;
    EXPECT_EQ(content_of(directory), before) << name;
  }
}

TEST_P(Directories, AreReplacedWithoutWhatTheUserAdded) {
  const Command& command = GetParam();
  const files::path directory = fresh(command.name + "_again");
  write_inputs(directory);
  std::vector<std::string> words = command.words;
  words.insert(words.end(), {"-o", "."});
  if (command.name == "study" || command.name == "hard") words.push_back("--fresh");
  ASSERT_EQ(in_directory(directory, words).code, 0);
  for (const std::string& name : command.makes) {
    EXPECT_TRUE(files::exists(directory / name)) << name;
    if (files::is_directory(directory / name)) std::ofstream(directory / name / "notes.txt") << "mine";
  }
  const std::string list = read_file(directory / ".mortise");
  for (const auto& entry : files::directory_iterator(directory)) {
    const std::string name = entry.path().filename();
    const bool is_input = name == "input.xml" || name == "point.xml" || name == "study.xml" || name == "ledger.xml", is_list = name == ".mortise";
    EXPECT_TRUE(is_input || is_list || list.find("\n" + name + "\n") != std::string::npos) << name << " is not listed in\n" << list;
  }
  const Ending again = in_directory(directory, words);
  EXPECT_EQ(again.code, 0) << again.output;
  for (const std::string& name : command.makes)
    if (files::is_directory(directory / name)) EXPECT_EQ(read_file(directory / name / "notes.txt"), "mine") << name;
  EXPECT_EQ(read_file(directory / "input.xml"), input);
}

INSTANTIATE_TEST_SUITE_P(OfCommands, Directories, ::testing::ValuesIn(commands()), [](const auto& one) { return one.param.name; });

TEST(Directory, OfAnotherSceneOfTheSameNameIsNotTakenByDefault) {
  const files::path directory = fresh("same_name");
  for (const char* folder : {"a", "b"}) {
    files::create_directory(directory / folder);
    std::ofstream(directory / folder / "press.xml") << good_scene;
  }
  ASSERT_EQ(in_directory(directory, {"run", "a/press.xml"}).code, 0);
  const std::string before = read_file(directory / "results/press/summary.json");
  const Ending other = in_directory(directory, {"run", "b/press.xml"});
  EXPECT_EQ(other.code, 5) << other.output;
  EXPECT_THAT(other.output, HasSubstr("it holds results of a/press.xml, and these are of b/press.xml; please choose another directory (-o)"));
  EXPECT_EQ(read_file(directory / "results/press/summary.json"), before);
  EXPECT_EQ(in_directory(directory, {"run", "a/press.xml"}).code, 0);
  EXPECT_EQ(in_directory(directory, {"run", "b/press.xml", "-o", "results/press"}).code, 0);
}

TEST(Directory, OfAStudyIsNotTakenByARun) {
  const files::path directory = fresh("kinds");
  write_inputs(directory);
  ASSERT_EQ(in_directory(directory, {"study", "study.xml", "-o", "out"}).code, 0);
  const auto before = content_of(directory);
  const Ending ending = in_directory(directory, {"run", "input.xml", "-o", "out"});
  EXPECT_EQ(ending.code, 5);
  EXPECT_THAT(ending.output, HasSubstr("it holds results of kind \"study\" of study.xml, and these are of kind \"run\""));
  EXPECT_EQ(content_of(directory), before);
}

/// Starts a run that takes longer than this test; the caller ends it.
pid_t start(const std::vector<std::string>& words) {
  std::vector<std::string> copy = words;
  std::vector<char*> arguments;
  for (std::string& word : copy) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    execvp(arguments[0], arguments.data());
    _exit(127);
  }
  return child;
}

TEST(Directory, IsWrittenByOneRunUntilThatEndsOrIsKilled) {
  const files::path directory = fresh("two_at_once");
  std::ofstream(directory / "scene.xml") << good_scene;
  const std::string results = directory / "results";
  const std::vector<std::string> words{MORTISE, "run", directory / "scene.xml", "-o", results, "--quiet"};
  std::vector<std::string> slow = words;
  slow.insert(slow.end(), {"--set", "stepping/step=1e-5"});
  const pid_t first = start(slow);
  const auto rows = [&] {
    const std::string table = read_file(results + "/history.csv");
    return std::count(table.begin(), table.end(), '\n');
  };
  study_support::wait_until([&] { return rows() > 2; });
  for (const int ranks : {1, 2}) {
    std::vector<std::string> second{MPIEXEC, "-n", std::to_string(ranks)};
    second.insert(second.end(), words.begin(), words.end());
    const Ending ending = launch(second, 60);
    EXPECT_EQ(ending.code, 5) << ending.output;
    EXPECT_THAT(ending.output, AllOf(HasSubstr("it is being written by process " + std::to_string(first) + " on host "),
                                     HasSubstr("please wait, or choose another directory")));
  }
  const auto seen = rows();
  study_support::wait_until([&] { return rows() > seen; });
  EXPECT_GT(rows(), seen) << "the first run goes on";
  std::istringstream table(read_file(results + "/history.csv"));
  std::string line;
  for (int row = 0; std::getline(table, line) && !table.eof(); ++row)
    if (row > 0) EXPECT_EQ(line.substr(0, line.find(',')), std::to_string(row)) << "rows of the first run alone";

  kill(first, SIGKILL);
  waitpid(first, nullptr, 0);
  EXPECT_TRUE(files::exists(results + "/.mortise.lock"));
  const Ending next = launch(words, 60);
  EXPECT_EQ(next.code, 0) << next.output;
  EXPECT_EQ(rows(), 2);
  EXPECT_FALSE(files::exists(results + "/.mortise.lock"));
}

}  // namespace
