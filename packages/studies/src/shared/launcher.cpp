#include "mortise/studies/launcher.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <boost/algorithm/string.hpp>
#include <cstdlib>
#include <filesystem>

#include "mortise/core/error.hpp"

namespace mortise {
namespace {

constexpr const char* placeholder = "{ranks}";

/// Usual words for the number of ranks.
struct KnownLauncher {
  std::string name;
  std::vector<std::string> ranks;
};

const std::vector<KnownLauncher>& launchers() {
  static const std::vector<KnownLauncher> known{
      {"mpirun", {"-n", placeholder}},  {"mpiexec", {"-n", placeholder}}, {"mpiexec.hydra", {"-n", placeholder}}, {"orterun", {"-n", placeholder}},
      {"prterun", {"-n", placeholder}}, {"srun", {"-n", placeholder}},    {"flux", {"-n", placeholder}},          {"aprun", {"-n", placeholder}},
      {"ibrun", {"-n", placeholder}},   {"jsrun", {"-p", placeholder}}};
  return known;
}

std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  std::string word;
  bool begun = false;
  char quote = '\0';
  for (const char c : text) {
    if (quote != '\0' ? c == quote : c == '\'' || c == '"') {
      quote = quote == '\0' ? c : '\0';
      begun = true;
    } else if (quote == '\0' && (c == ' ' || c == '\t' || c == '\n')) {
      if (begun) words.push_back(word);
      word.clear();
      begun = false;
    } else {
      word += c;
      begun = true;
    }
  }
  if (quote != '\0') throw InputError(Place{}, fmt::format("the launcher \"{}\" has a quote without its end", text));
  if (begun) words.push_back(word);
  return words;
}

}  // namespace

std::vector<std::string> Launcher::command(int ranks, const std::vector<std::string>& program) const {
  std::vector<std::string> all = words;
  if (words.empty() && ranks > 1) all = {"mpirun", "-n", placeholder};
  for (std::string& word : all) boost::algorithm::replace_all(word, placeholder, std::to_string(ranks));
  all.insert(all.end(), program.begin(), program.end());
  return all;
}

Launcher read_launcher(const std::string& text) {
  Launcher launcher{words_of(text)};
  std::vector<std::string>& words = launcher.words;
  if (words.empty()) throw InputError(Place{}, "the launcher is empty; please name a command, or leave the option out");
  if (std::any_of(words.begin(), words.end(), [](const std::string& word) { return boost::algorithm::contains(word, placeholder); })) return launcher;
  const std::string name = std::filesystem::path(words.front()).filename().string();
  const auto known = std::find_if(launchers().begin(), launchers().end(), [&](const KnownLauncher& one) { return one.name == name; });
  if (known == launchers().end())
    throw InputError(Place{}, fmt::format("the launcher \"{}\" does not say where the number of ranks stands; please write {{ranks}} there. Only {} "
                                          "need no such word",
                                          text, fmt::join(known_launchers(), ", ")));
  if (name == "flux" && words.size() == 1) words.push_back("run");
  words.insert(words.end(), known->ranks.begin(), known->ranks.end());
  return launcher;
}

std::vector<std::string> known_launchers() {
  std::vector<std::string> names;
  for (const KnownLauncher& one : launchers()) names.push_back(one.name);
  return names;
}

void require_launcher(const Launcher& launcher) {
  if (launcher.words.empty()) return;
  const std::string& program = launcher.words.front();
  const char* path = std::getenv("PATH");
  std::vector<std::string> directories;
  if (program.find('/') != std::string::npos)
    directories = {""};
  else if (path != nullptr)
    boost::algorithm::split(directories, path, [](char c) { return c == ':'; });
  const bool found = std::any_of(directories.begin(), directories.end(), [&](const std::string& directory) {
    return access((directory.empty() ? program : directory + "/" + program).c_str(), X_OK) == 0;
  });
  if (!found)
    throw FileError(fmt::format("cannot start runs with \"{}\": there is no such program{}", fmt::join(launcher.words, " "),
                                program.find('/') == std::string::npos ? " on the PATH" : ""));
}

}  // namespace mortise
