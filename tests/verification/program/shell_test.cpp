// Support for shells and man: completions and the manual page.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "launch.hpp"

namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::UnorderedElementsAre;
namespace files = std::filesystem;

/// A directory with a scene, a table and a directory.
files::path some_files() {
  const files::path directory = files::path(SCRATCH) / "completion";
  files::create_directories(directory / "results");
  for (const char* file : {"scene.xml", "table.csv"}) std::ofstream(directory / file) << "\n";
  return directory;
}

/// Completions that bash offers for the last of the words.
std::vector<std::string> completions(const std::vector<std::string>& words) {
  std::string script = "source <('" MORTISE "' completion); cd '" + some_files().string() + "'; COMP_WORDS=(mortise";
  for (const std::string& word : words) script += " '" + word + "'";
  script += "); COMP_CWORD=" + std::to_string(words.size()) + "; complete -p mortise >/dev/null && _mortise; printf '%s\\n' \"${COMPREPLY[@]}\"";
  const Ending ending = launch({"bash", "-c", script}, 60);
  EXPECT_EQ(ending.code, 0) << ending.output;
  std::istringstream lines(ending.output);
  std::vector<std::string> offered;
  for (std::string line; std::getline(lines, line);)
    if (!line.empty()) offered.push_back(line);
  return offered;
}

TEST(Shell, CompletesCommandsAndOptions) {
  EXPECT_THAT(completions({""}), AllOf(Contains("run"), Contains("check"), Contains("describe"), Contains("completion"), Contains("--version")));
  EXPECT_THAT(completions({"pe"}), ElementsAre("peer"));
  EXPECT_THAT(completions({"run", "--"}), AllOf(Contains("--set"), Contains("--output"), Contains("--keep"), Not(Contains("--fresh"))));
  EXPECT_THAT(completions({"study", "--f"}), ElementsAre("--fresh"));
}

TEST(Shell, CompletesWhatMayBeChosen) {
  EXPECT_THAT(completions({"list", "m"}), UnorderedElementsAre("materials", "meshes"));
  EXPECT_THAT(completions({"describe", "contact", "--format", ""}), UnorderedElementsAre("text", "md", "rng", "json"));
  EXPECT_THAT(completions({"peer", "--by", "calculix m"}), ElementsAre("calculix\\ mortar"));
  EXPECT_THAT(completions({"peer", "--by", "\"calculix n"}), ElementsAre("calculix node to surface"));
  EXPECT_THAT(completions({"paper", "--only", "patch_test"}), Contains("patch_test"));
  EXPECT_THAT(completions({"paper", "--only", "patch_test,bl"}), Contains("patch_test,block_pile"));
  EXPECT_THAT(completions({"describe", "con"}), ElementsAre("contact"));
  EXPECT_THAT(completions({"describe", "--format", "=", "m"}), ElementsAre("md"));
  EXPECT_THAT(completions({"describe", "--format", "="}), UnorderedElementsAre("text", "md", "rng", "json"));
}

TEST(Shell, CompletesFiles) {
  EXPECT_THAT(completions({"run", ""}), UnorderedElementsAre("scene.xml", "results"));
  EXPECT_THAT(completions({"study", "s"}), ElementsAre("scene.xml"));
  EXPECT_THAT(completions({"run", "scene.xml", "-o", ""}), ElementsAre("results"));
  EXPECT_THAT(completions({"run", "scene.xml", "--set", ""}), IsEmpty());
  EXPECT_THAT(completions({"doctor", ""}), IsEmpty());
}

TEST(Shell, HasAManualPage) {
  const Ending page = launch({MORTISE, "man"}, 60);
  ASSERT_EQ(page.code, 0) << page.output;
  // Warnings of all kinds, which go to standard error.
  const Ending warnings = launch({"bash", "-c", "set -o pipefail; '" MORTISE "' man | groff -man -Tutf8 -ww 2>&1 >/dev/null"}, 60);
  EXPECT_EQ(warnings.code, 0);
  EXPECT_EQ(warnings.output, "");
  const Ending shown = launch({"bash", "-c", "'" MORTISE "' man | groff -man -Tascii -P-cbou"}, 60);
  EXPECT_THAT(shown.output, AllOf(HasSubstr("MORTISE(1)"), HasSubstr("mortise run"), HasSubstr("-o, --output DIR"), HasSubstr("path=value"),
                                  HasSubstr("text, md, rng, json)"), HasSubstr("70 internal")));
}

}  // namespace
