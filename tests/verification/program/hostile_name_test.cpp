// Names in scenes are texts: nothing that reads them, a page, a plot, a deck, a shell or a terminal, obeys them.

#include <gmock/gmock.h>

#include <set>

#include "peer_support.hpp"
#include "scene_support.hpp"

namespace {

using namespace scene_support;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::vector<std::string> hostile{"<script>alert(1)</script>",
                                       "a\"b'c",
                                       "$x_{",
                                       "\\$\\frac{",
                                       "$(touch pwned)",
                                       "`touch pwned`",
                                       "*INCLUDE, INPUT=/etc/passwd",
                                       "../x",
                                       "..",
                                       "-o",
                                       "--fresh",
                                       "_hidden",
                                       "a|b",
                                       std::string(300, 'n')};

/// As an attribute of XML has it.
std::string xml(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '<' ? "&lt;" : c == '"' ? "&quot;" : c == '&' ? "&amp;" : std::string(1, c);
  return result;
}

std::string list(const std::string& name, const std::string& content) {
  return "<ParameterList name=\"" + xml(name) + "\">\n" + content + "</ParameterList>\n";
}

std::string text(const std::string& name, const std::string& value) {
  return "<Parameter name=\"" + xml(name) + "\" type=\"string\" value=\"" + xml(value) + "\"/>\n";
}

/// A directory with nothing but the directory "here", where commands are called.
files::path fresh(const std::string& name) {
  const files::path directory = files::path(SCRATCH) / "hostile" / name;
  files::remove_all(directory);
  files::create_directories(directory / "here");
  return directory / "here";
}

std::set<std::string> names_in(const files::path& directory) {
  std::set<std::string> names;
  for (const auto& entry : files::directory_iterator(directory)) names.insert(entry.path().filename());
  return names;
}

Ending in_directory(const files::path& directory, std::vector<std::string> words, const std::vector<std::string>& environment = {}) {
  words.insert(words.begin(), MORTISE);
  words.insert(words.begin(), environment.begin(), environment.end());
  words.insert(words.begin(), {"env", "-C", directory});
  return launch(words, 240);
}

/// Nothing was made beside the results, and nothing in the directory above.
void expect_made_only(const std::string& results, const files::path& directory, std::set<std::string> inputs) {
  inputs.insert(results);
  EXPECT_EQ(names_in(directory), inputs);
  EXPECT_EQ(names_in(directory.parent_path()), std::set<std::string>{"here"});
}

/// The good scene with a name of its own and a quantity by each hostile name.
std::string hostile_scene() {
  std::string quantities;
  for (const std::string& name : hostile) quantities += list(name, text("type", "reaction") + text("set", "lower/bottom") + text("component", "y"));
  return replaced(replaced(good_scene, "two blocks", xml(hostile.front())), "<ParameterList name=\"contact\">",
                  list("quantities", quantities) + "<ParameterList name=\"contact\">");
}

TEST(HostileNames, AreTextOnThePageOfAStudy) {
  const files::path directory = fresh("study");
  std::string choices, quantities;
  for (std::size_t i = 0; i < hostile.size(); ++i) {
    choices += list(hostile[i], text("bodies/lower/mesh/cells x", std::to_string(2 + i)));
    quantities += list(hostile[i], text("value", "2"));
  }
  std::ofstream(directory / "scene.xml") << hostile_scene();
  std::ofstream(directory / "study.xml") << list(
      hostile.front(),
      text("scene", "scene.xml") + text("h", "1") + list("axes", list(hostile.front(), list("choices", choices))) + list("quantities", quantities));
  const Ending ending = in_directory(directory, {"study", "study.xml", "-o", "out", "--quiet"});
  EXPECT_EQ(ending.code, 0) << ending.output;
  const std::string page = read_file(directory / "out/report.html");
  EXPECT_THAT(page, AllOf(Not(HasSubstr("<script")), HasSubstr("&lt;script&gt;alert(1)&lt;/script&gt;"), HasSubstr("$x_{")));
  for (const std::string& name : names_in(directory / "out/plots")) EXPECT_THAT(read_file(directory / "out/plots" / name), Not(HasSubstr("<script")));
  EXPECT_EQ(names_in(directory / "out/points").size(), hostile.size() + 1);
  expect_made_only("out", directory, {"scene.xml", "study.xml"});
}

TEST(HostileNames, AreTextInPlots) {
  const files::path directory = fresh("plots");
  std::set<std::string> inputs{"scene.xml"};
  std::ofstream(directory / "scene.xml") << replaced(good_scene, "two blocks", "$x_{");
  Ending ending = in_directory(directory, {"scale", "scene.xml", "--plan", "2", "-o", "out"});
  EXPECT_EQ(ending.code, 0) << ending.output;
  EXPECT_TRUE(files::exists(directory / "out/plan.svg"));
  for (const std::string name : {"$x_{", "\\$\\frac{", "-o", "<script>alert(1)</script>"}) {
    std::ofstream(directory / "point.xml") << list(
        name, text("stress unit", name) + list("material", text("type", "hencky") + text("young's modulus", "1") + text("poisson's ratio", "0.3")) +
                  list("path", text("type", "uniaxial") + text("final stretch", "1.1")));
    ending = in_directory(directory, {"point", "point.xml", "-o", "point"});
    EXPECT_EQ(ending.code, 0) << name << "\n" << ending.output;
    EXPECT_THAT(read_file(directory / "point/point.svg"), AllOf(HasSubstr("<svg"), Not(HasSubstr("<script")))) << name;
  }
  inputs.insert({"point.xml", "point"});
  expect_made_only("out", directory, inputs);
}

TEST(HostileNames, AreTextOnThePagesOfHardCases) {
  const files::path directory = fresh("hard");
  std::string cases;
  for (const std::string& name : hostile)
    cases += list(name, text("scene", "scene.xml") + text("hard", name) + text("expectation", name) + text("source", name) +
                            list("expected", list(name, text("figure", "t") + text("low", "0"))));
  std::ofstream(directory / "scene.xml") << good_scene;
  std::ofstream(directory / "ledger.xml") << list("ledger", list("cases", cases));
  const Ending ending = in_directory(directory, {"hard", "ledger.xml", "-o", "out", "--quiet"});
  EXPECT_EQ(ending.code, 0) << ending.output;
  for (const char* page : {"hard-cases.html", "hard-cases.md"})
    EXPECT_THAT(read_file(directory / "out" / page), AllOf(Not(HasSubstr("<script")), HasSubstr("&lt;script"))) << page;
  expect_made_only("out", directory, {"scene.xml", "ledger.xml"});
}

// Characters that files cannot have are replaced in their names: two names could share a directory, and the second run would replace the first.
TEST(HostileNames, ThatWouldShareADirectoryAreRefused) {
  const files::path directory = fresh("shared");
  std::ofstream(directory / "scene.xml") << good_scene;
  const std::string what = text("scene", "scene.xml") + text("hard", "h") + text("expectation", "e") + text("source", "s") +
                           list("expected", list("end", text("figure", "t") + text("low", "0")));
  const auto refused = [&](const std::string& cases, const std::string& message, const std::vector<std::string>& more = {}) {
    std::ofstream(directory / "ledger.xml") << list("ledger", list("cases", cases));
    std::vector<std::string> words{"hard", "ledger.xml", "-o", "out"};
    words.insert(words.end(), more.begin(), more.end());
    const Ending ending = in_directory(directory, words);
    EXPECT_EQ(ending.code, 2) << ending.output;
    EXPECT_THAT(ending.output, HasSubstr(message));
    EXPECT_FALSE(files::exists(directory / "out"));
  };
  refused(list("a case", what) + list("another", what) + list("a/case", what),
          "ledger.xml:27: error: cases/a/case: \"a case\" and \"a/case\" would share the name \"a_case\" among the files; please rename one of them");
  refused(list("a case", what) + list("a:case", what), "would share the name \"a_case\"", {"--only", "a case"});
  refused(list("ledger.csv", what), "a page of the ledger and \"ledger.csv\" would share the name");
  refused(list("one", what + list("companions", list("np1", text("follows axes", "false")))),
          "the run on 1 rank(s) and \"np1\" would share the name");
  refused(list("one", what + list("axes", list("cells", list("choices", list("4 5", text("bodies/lower/mesh/cells x", "2")) +
                                                                            list("4_5", text("bodies/lower/mesh/cells x", "3")))))),
          "\"4 5\" and \"4_5\" would share the name \"4_5\"", {"--sweeps"});
  std::ofstream(directory / "study.xml") << list(
      "study", text("scene", "scene.xml") + text("h", "1") +
                   list("axes", list("cells", text("setting", "bodies/lower/mesh/cells x") + text("values", "2, 3"))) +
                   list("quantities", list("a|b", text("value", "2")) + list("a_b", text("value", "2"))));
  const Ending study = in_directory(directory, {"study", "study.xml", "-o", "out"});
  EXPECT_EQ(study.code, 2) << study.output;
  EXPECT_THAT(study.output, HasSubstr("\"a|b\" and \"a_b\" would share the name \"a_b\""));
}

TEST(HostileNames, AreCommentsInADeck) {
  const std::string patch = read_file(std::string(INPUTS) + "/verification/patch_ratio_1_7.xml"), include = "*INCLUDE, INPUT=/etc/passwd";
  const auto from = patch.find("<ParameterList name=\"") + 21;
  for (const std::string& name : {include, std::string(5000, 'n'), std::string("a\"b'c")}) {
    const files::path directory = fresh("deck");
    std::string scene = patch;
    scene.replace(from, patch.find('"', from) - from, xml(name));
    if (name == include)
      for (auto at = scene.find("lower"); at != std::string::npos; at = scene.find("lower", at + 1)) scene.replace(at, 5, "*INCLUDE, INPUT=passwd");
    std::ofstream(directory / "scene.xml") << scene;
    const Ending ending = in_directory(directory, {"peer", "scene.xml", "-o", "out"});
    EXPECT_EQ(ending.code, peer_support::installed() ? 0 : 5) << ending.output;
    if (!peer_support::installed()) continue;
    std::istringstream deck(read_file(directory / "out/peer.inp"));
    for (std::string line; std::getline(deck, line);) {
      EXPECT_NE(line.rfind("*INCLUDE", 0), 0u);
      EXPECT_LT(line.size(), 1320u);
    }
  }
}

TEST(HostileNames, WithControlCharactersAreRefusedWithTheirLine) {
  const files::path directory = fresh("control");
  for (const std::string character : {"&#10;", "&#13;", "&#9;", "&#127;", "&#155;", "&#x85;"}) {
    const std::string marker = "<ParameterList name=\"upper";
    const std::string scene = replaced(good_scene, marker + "\"", marker + character + "*INCLUDE\"");
    std::ofstream(directory / "scene.xml") << scene;
    const Ending ending = in_directory(directory, {"run", "scene.xml"});
    EXPECT_EQ(ending.code, 2) << character << ending.output;
    EXPECT_THAT(ending.output, AllOf(HasSubstr("scene.xml:" + std::to_string(line_of(scene, marker)) + ": error: "),
                                     HasSubstr("\"name\" of <ParameterList> has a control character"), HasSubstr("\"upper?*INCLUDE\"")));
    for (const char c : ending.output) EXPECT_TRUE(static_cast<unsigned char>(c) >= 0x20 || c == '\n') << static_cast<int>(c);
    EXPECT_EQ(ending.output.find("\u009b"), std::string::npos);
  }
  std::ofstream(directory / "scene.xml") << good_scene;
  const Ending set = in_directory(directory, {"run", "scene.xml", "--set", "bodies/up\x1b[2Jper/material=soft"});
  EXPECT_EQ(set.code, 1) << set.output;
  EXPECT_THAT(set.output, AllOf(HasSubstr("has a control character"), HasSubstr("up?[2Jper"), Not(HasSubstr("\x1b"))));
  EXPECT_EQ(names_in(directory), std::set<std::string>{"scene.xml"});
}

// Modules and settings in the working directory are not those of a python that draws.
TEST(HostileDirectory, GivesNothingToPython) {
  const files::path directory = fresh("modules");
  std::set<std::string> inputs{"matplotlibrc", "scene.xml"};
  for (const char* name : {"csv", "json", "html", "numpy", "h5py", "matplotlib", "sitecustomize", "usercustomize", "sys", "os", "io"}) {
    const std::string file = std::string(name) + ".py";
    std::ofstream(directory / file) << "open('pwned', 'w')\nraise SystemExit(1)\n";
    inputs.insert(file);
  }
  std::ofstream(directory / "matplotlibrc") << "text.usetex: True\nbackend: module://html\nfigure.figsize: 1, 1\n";
  std::ofstream(directory / "scene.xml") << good_scene;
  for (const std::vector<std::string>& environment : {std::vector<std::string>{}, {"PYTHONPATH=."}}) {
    const Ending plan = in_directory(directory, {"scale", "scene.xml", "--plan", "2", "-o", "out"}, environment);
    EXPECT_EQ(plan.code, 0) << plan.output;
    EXPECT_TRUE(files::exists(directory / "out/plan.svg")) << plan.output;
    const Ending page = in_directory(directory, {"scale", "scene.xml", "--ranks", "1", "-o", "out"}, environment);
    EXPECT_EQ(page.code, 0) << page.output;
    EXPECT_TRUE(files::exists(directory / "out/report.html")) << page.output;
    expect_made_only("out", directory, inputs);
  }
}

}  // namespace
