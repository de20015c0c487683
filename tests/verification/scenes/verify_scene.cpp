// Runs a scene on several numbers of ranks and checks
// * exit code 0 (so all its checks hold) on each,
// * quantities equal to 1e-10 of their scale (their value on the first number of ranks, or what --scale says),
// * equal Newton counts,
// * times of contact where there is contact.
//
// Ranks may be followed by a linear solver, "2:iterative". Iterative solvers have to agree to 1e-8 and may need other numbers of Newton iterations.
// With --reference the first run is one that an earlier call made in the same directory.
// verify_scene MPIEXEC MORTISE SCENE DIRECTORY RANKS[:SOLVER]... [--reference RANKS[:SOLVER]] [--set path=value]... [--scale quantity=scale]...

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "launch.hpp"

namespace {

using Json = nlohmann::json;
constexpr double tolerance = 1e-10, iterative_tolerance = 1e-8;

struct Arguments {
  std::string mpiexec, mortise, scene, directory, reference;
  std::vector<std::string> ranks, settings;
  std::map<std::string, double> scales;
};

Arguments parse(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  Arguments arguments{words.at(0), words.at(1), words.at(2), words.at(3), {}, {}, {}, {}};
  for (std::size_t i = 4; i < words.size(); ++i) {
    if (words[i] == "--set") {
      arguments.settings.push_back(words.at(++i));
    } else if (words[i] == "--reference") {
      arguments.reference = words.at(++i);
    } else if (words[i] == "--scale") {
      const std::string& scale = words.at(++i);
      const auto equals = scale.find('=');
      arguments.scales[scale.substr(0, equals)] = std::stod(scale.substr(equals + 1));
    } else {
      arguments.ranks.push_back(words[i]);
    }
  }
  return arguments;
}

/// The linear solver of "2:iterative", empty for "2".
std::string solver_of(const std::string& ranks) {
  const auto colon = ranks.find(':');
  return colon == std::string::npos ? "" : ranks.substr(colon + 1);
}

/// Where the run on "2:iterative" is written: np2iterative.
std::string directory_of(const std::string& ranks, const Arguments& arguments) {
  return arguments.directory + "/np" + ranks.substr(0, ranks.find(':')) + solver_of(ranks);
}

/// A last iteration that moves nothing by more than this share of the step's first correction only confirmed the iterate before it.
constexpr double confirmation = 1e-8;

/// Newton iterations of each step, but for one that only confirmed: whether it is needed may be round-off's choice where a residual stands at the
/// bound.
std::vector<std::size_t> newton_counts(const Json& summary) {
  std::vector<std::size_t> counts;
  for (const auto& step : summary.at("steps")) {
    const Json& iterates = step.at("newton");
    const auto correction = [&](std::size_t iteration) { return iterates.at(iteration).at("increment").get<double>(); };
    const std::size_t last = iterates.size() - 1;
    counts.push_back(last > 1 && correction(last) <= confirmation * correction(1) ? last - 1 : last);
  }
  return counts;
}

/// True if the cost of contact can be read, in whole and in parts.
bool contact_is_timed(const Json& summary) {
  if (summary.at("slave_nodes") == 0) return true;
  const Json& time = summary.at("time");
  double parts = 0.0;
  for (const char* part : {"search", "contact_integrals", "contact_graph", "contact_residual"}) {
    if (time.value(part, 0.0) <= 0.0) return false;
    parts += time.at(part).get<double>();
  }
  return time.value("condensation", 0.0) > 0.0 && time.value("contact", 0.0) >= (1.0 - tolerance) * parts;
}

/// Round-off says how many of a few iterations a step takes whose start solves it: whether a predicted state needs one, and when states at the bound
/// of friction settle at rest.
template <class Counts>
bool are_alike(const Counts& a, const Counts& b) {
  constexpr int few = 3;
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
    const int one = static_cast<int>(x), other = static_cast<int>(y);
    return one == other || (std::max(one, other) <= few && std::abs(one - other) == 1);
  });
}

int compare(const Json& reference, const Json& other, const std::string& ranks, const Arguments& arguments, bool iterative) {
  int failures = 0;
  if (!iterative && !are_alike(newton_counts(reference), newton_counts(other))) {
    fmt::print("{} ranks: other Newton counts\n", ranks);
    ++failures;
  }
  for (const auto& [name, value] : reference.at("quantities").items()) {
    const double a = value.get<double>(), b = other.at("quantities").at(name).get<double>();
    const auto given = arguments.scales.find(name);
    const double scale = given == arguments.scales.end() ? std::abs(a) : given->second;
    const bool equal = std::abs(a - b) <= (iterative ? iterative_tolerance : tolerance) * scale;
    fmt::print("{} ranks: {} = {:.16g}, difference {:.2e} of its scale{}\n", ranks, name, b, std::abs(a - b) / scale, equal ? "" : " TOO LARGE");
    failures += !equal;
  }
  return failures;
}

}  // namespace

int main(int argc, char** argv) {
  const Arguments arguments = parse(argc, argv);
  int failures = 0;
  Json reference;
  if (!arguments.reference.empty()) reference = Json::parse(read_file(directory_of(arguments.reference, arguments) + "/summary.json"));
  for (const auto& ranks : arguments.ranks) {
    const std::string solver = solver_of(ranks), directory = directory_of(ranks, arguments);
    std::filesystem::remove_all(directory);
    std::vector<std::string> command{arguments.mpiexec, "-n", ranks.substr(0, ranks.find(':')), arguments.mortise, "run", arguments.scene, "-o", directory};
    for (const auto& setting : arguments.settings) command.insert(command.end(), {"--set", setting});
    if (!solver.empty()) command.insert(command.end(), {"--set", "linear solver/type=" + solver});
    const Ending ending = launch(command);
    if (ending.code != 0) {
      fmt::print("{} ranks: exit code {}\n{}\n", ranks, ending.code, ending.output);
      ++failures;
      continue;
    }
    const Json summary = Json::parse(read_file(directory + "/summary.json"));
    if (summary.at("checks").empty()) {
      fmt::print("{} has no checks\n", arguments.scene);
      ++failures;
    }
    if (!contact_is_timed(summary)) {
      fmt::print("{} ranks: times of contact are missing: {}\n", ranks, summary.at("time").dump());
      ++failures;
    }
    for (const auto& check : summary.at("checks")) fmt::print("{} ranks: check {}\n", ranks, check.dump());
    if (reference.is_null())
      reference = summary;
    else
      failures += compare(reference, summary, ranks, arguments, solver == "iterative");
  }
  return failures == 0 ? 0 : 1;
}
