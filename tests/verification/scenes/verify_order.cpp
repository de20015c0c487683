// Runs a scene with variables/n = n, 2 n, 4 n and fits the order of an error: the mean of log2 of the ratios of successive errors.
// Usage: verify_order MORTISE SCENE DIRECTORY N [PATH=VALUE]... QUANTITY ORDER [QUANTITY ORDER]...
// Fails where a fitted order lies below the one given.

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "launch.hpp"

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  const std::string &mortise = words.at(0), &scene = words.at(1), &directory = words.at(2);
  std::size_t first = 4;
  std::vector<std::string> settings;
  for (; words.at(first).find('=') != std::string::npos; ++first) settings.insert(settings.end(), {"--set", words[first]});
  std::vector<nlohmann::json> quantities;
  for (const int factor : {1, 2, 4}) {
    const int n = factor * std::stoi(words.at(3));
    const std::string output = fmt::format("{}/n{}", directory, n);
    std::filesystem::remove_all(output);
    std::vector<std::string> command{mortise, "run", scene, "--set", fmt::format("variables/n={}", n), "-o", output};
    command.insert(command.end(), settings.begin(), settings.end());
    const Ending ending = launch(command);
    if (ending.code != 0) {
      fmt::print("n = {}: exit code {}\n{}\n", n, ending.code, ending.output);
      return 1;
    }
    quantities.push_back(nlohmann::json::parse(read_file(output + "/summary.json")).at("quantities"));
  }
  int failures = 0;
  for (std::size_t i = first; i + 1 < words.size(); i += 2) {
    const auto error = [&](std::size_t run) { return quantities[run].at(words[i]).get<double>(); };
    const double order = 0.5 * std::log2(error(0) / error(2)), wanted = std::stod(words[i + 1]);
    fmt::print("{}: {:.4g}, {:.4g}, {:.4g}: order {:.3f}, wanted at least {}\n", words[i], error(0), error(1), error(2), order, wanted);
    failures += !(order >= wanted);
  }
  return failures == 0 ? 0 : 1;
}
