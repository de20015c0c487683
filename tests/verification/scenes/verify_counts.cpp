// Runs a scene with several sets of settings. The Newton counts and the sizes of the active set of every iteration have to be equal in all.
// Usage: verify_counts MORTISE SCENE DIRECTORY SETTINGS SETTINGS..., SETTINGS being path=value,path=value,...

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "launch.hpp"

namespace {

/// For each step the closed nodes of each iteration.
std::vector<std::vector<int>> path_of(const nlohmann::json& summary) {
  std::vector<std::vector<int>> path;
  for (const auto& step : summary.at("steps")) {
    path.emplace_back();
    for (const auto& iteration : step.at("newton")) path.back().push_back(iteration.at("active").get<int>());
  }
  return path;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  std::vector<std::vector<int>> first;
  int failures = 0;
  for (std::size_t i = 3; i < words.size(); ++i) {
    const std::string directory = fmt::format("{}/{}", words.at(2), i);
    std::filesystem::remove_all(directory);
    std::vector<std::string> command{words[0], "run", words[1], "-o", directory};
    std::istringstream settings(words[i]);
    for (std::string setting; std::getline(settings, setting, ',');) command.insert(command.end(), {"--set", setting});
    const Ending ending = launch(command);
    if (ending.code != 0) {
      fmt::print("{}: exit code {}\n{}\n", words[i], ending.code, ending.output);
      return 1;
    }
    const auto path = path_of(nlohmann::json::parse(read_file(directory + "/summary.json")));
    if (i == 3) first = path;
    std::size_t iterations = 0;
    for (const auto& step : path) iterations += step.size() - 1;
    fmt::print("{}: {} steps, {} Newton iterations{}\n", words[i], path.size(), iterations, path == first ? "" : ", NOT those of the first");
    failures += path != first;
  }
  return failures == 0 && !first.empty() ? 0 : 1;
}
