// A scene can be run again in the same process, alone or among runs of other scenes. Each run leaves the same files, byte for byte on one rank. On
// several ranks MUMPS adds up in the order in which messages come, so that numbers differ by round-off from run to run, also in a process of their
// own.

#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <sstream>

#include "mortise/input/parameter_tree.hpp"
#include "mortise/simulation/run/output/step_evaluation.hpp"
#include "mortise/simulation/run/run.hpp"
#include "mortise/simulation/scene/read_scene.hpp"

namespace mortise {
namespace {

/// A scene below inputs/, made small.
struct Case {
  const char* name;
  const char* file;
  std::vector<std::string> settings;
};

void PrintTo(const Case& one, std::ostream* stream) { *stream << one.name; }

const Case friction{"friction", "verification/sliding_block.xml", {"stepping/end time=0.25"}};
const Case reference_points{"reference_points", "verification/3d/turned_bars.xml", {}};
const Case stick_and_slip{"stick_and_slip", "verification/stick_slip_block.xml", {"stepping/end time=0.4", "stepping/output times=0.15"}};
const std::vector<Case> cases{
    friction,
    reference_points,
    stick_and_slip,
    {"plasticity", "tutorial/press_4_plasticity.xml", {}},
    {"plasticity_without_contact", "verification/thick_cylinder.xml", {"variables/n=5"}},
    {"augmented_lagrange", "verification/large_sliding.xml", {"contact/interface/formulation/type=augmented lagrange", "stepping/end time=0.2"}},
    {"exact_solution", "verification/cb1.xml", {"variables/n=4", "variables/steps=2", "variables/mu=0.1"}},
    {"partial_slip", "verification/partial_slip.xml", {"variables/n=4", "variables/steps=4", "stepping/end time=1.5"}},
    {"rigid_body", "verification/rolling_disk.xml", {"variables/n=2", "stepping/end time=1.5"}},
    {"rings", "paper/conical_extrusion.xml", {"variables/steps=100", "stepping/end time=0.05"}},
    {"pile", "paper/block_pile.xml", {"stepping/end time=0.2"}},
    {"inertia", "dynamics/block_to_rest.xml", {"stepping/end time=0.02", "stepping/output times=0.01"}},
    {"spin", "dynamics/spinning_box.xml", {"stepping/end time=0.02"}},
    {"springs_and_dashpots", "verification/spring_bed.xml", {"stepping/end time=1"}},
    {"stabilisation", "verification/stabilised_block.xml", {}},
    {"heat", "heat/hot_billet.xml", {"stepping/end time=0.05"}},
    {"oscillator", "dynamics/damped_oscillator.xml", {"stepping/end time=0.1"}},
    {"iterative_solver", "verification/3d/hertz_sphere.xml", {"variables/n=2", "linear solver/type=iterative"}},
    {"iterative_solver_with_friction", "verification/3d/bar_on_plane.xml", {"linear solver/type=iterative", "stepping/end time=0.5"}},
};

RCP<const Communicator> comm() { return Tpetra::getDefaultComm(); }

Scene read(const Case& one) { return read_scene(*comm(), std::string(INPUTS) + "/" + one.file, one.settings); }

std::string spelled_out(const Scene& scene) {
  return to_scene_xml(collect_parameters(scene.name, scene, CollectParameters::What::values), symbol_lists(scene.symbols));
}

std::string content(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Rows of cells, of which the first holds the names of the columns.
using Table = std::vector<std::vector<std::string>>;

Table table(const std::string& text) {
  Table rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

/// The same table but for its column of seconds.
std::string without_seconds(const std::string& text) {
  Table rows = table(text);
  const auto names = rows.at(0);
  const auto seconds = std::find(names.begin(), names.end(), "seconds") - names.begin();
  for (auto& row : rows) row.erase(row.begin() + seconds);
  return fmt::format("{}", rows);
}

void expect_same_but_for_round_off(const std::string& first, const std::string& second) {
  const Table a = table(first), b = table(second);
  ASSERT_EQ(a.size(), b.size());
  ASSERT_EQ(a.at(0), b.at(0));
  for (std::size_t column = 0; column < a[0].size(); ++column) {
    // A predicted state may solve the next step to round-off: then round-off says whether one iteration is made, or none.
    const double least = a[0][column] == "newton_iterations" ? 1.0 : -std::numeric_limits<double>::infinity();
    double scale = 1.0;
    for (std::size_t row = 1; row < a.size(); ++row) scale = std::fmax(scale, std::abs(std::stod(a[row].at(column))));
    for (std::size_t row = 1; row < a.size(); ++row) {
      const double x = std::stod(a[row][column]), y = std::stod(b[row].at(column));
      if (!std::isnan(x) || !std::isnan(y)) EXPECT_NEAR(std::max(x, least), std::max(y, least), 1e-8 * scale) << a[0][column] << " in row " << row;
    }
  }
}

/// Outcome of a run: its exit code and, on rank 0, its results, by file.
using Outcome = std::map<std::string, std::string>;

Outcome run(const Scene& scene, const Case& one, const std::string& directory) {
  RunOptions options;
  options.scene = one.file;
  options.directory = "run_twice_np" + std::to_string(comm()->getSize()) + "/" + one.name + "/" + directory;
  options.verbosity = Verbosity::quiet;
  if (comm()->getRank() == 0) std::filesystem::remove_all(options.directory);
  comm()->barrier();
  Outcome outcome{{"exit code", std::to_string(static_cast<int>(run_scene(comm(), scene, options)))}};
  if (comm()->getRank() != 0) return outcome;
  const std::filesystem::path results = options.directory;
  for (const char* file : {"history.csv", "fields.xdmf", "profiles.csv", "effective.xml"}) outcome[file] = content(results / file);
  for (const auto& entry : std::filesystem::directory_iterator(results / "fields"))
    outcome["fields/" + entry.path().filename().string()] = content(entry.path());
  outcome["newton.csv"] = without_seconds(content(results / "newton.csv"));
  EXPECT_GT(outcome["history.csv"].size(), 50U) << "no steps were done";
  return outcome;
}

void expect_same(const Outcome& first, const Outcome& second) {
  const bool is_exact = comm()->getSize() == 1;
  for (const auto& [file, text] : first)
    if (is_exact || file == "exit code" || file == "fields.xdmf" || file == "effective.xml")
      EXPECT_TRUE(text == second.at(file)) << file << " differs";
  if (!is_exact && comm()->getRank() == 0) expect_same_but_for_round_off(first.at("history.csv"), second.at("history.csv"));
}

class RunTwice : public ::testing::TestWithParam<Case> {};

TEST_P(RunTwice, LeavesTheSame) {
  const Scene scene = read(GetParam());
  const std::string before = spelled_out(scene);
  const Outcome first = run(scene, GetParam(), "first");
  expect_same(first, run(scene, GetParam(), "second"));
  EXPECT_EQ(spelled_out(scene), before);
}

INSTANTIATE_TEST_SUITE_P(Scenes, RunTwice, ::testing::ValuesIn(cases), [](const auto& info) { return std::string(info.param.name); });

TEST(RunTwice, CasesHoldEveryKindOfQuantity) {
  std::set<std::string> found;
  for (const Case& one : cases)
    for (const auto& quantity : read(one).quantities) found.insert(quantity.value.quantity.type);
  for (const auto& kind : quantity_registry().entries()) EXPECT_EQ(found.count(kind.name), 1U) << kind.name;
}

TEST(RunAmongOthers, LeavesTheSame) {
  const std::vector<Case> all{friction, reference_points, stick_and_slip};
  std::vector<Scene> scenes;
  for (const Case& one : all) scenes.push_back(read(one));
  std::vector<Outcome> first;
  for (std::size_t i = 0; i < all.size(); ++i) first.push_back(run(scenes[i], all[i], "among_others_first"));
  for (std::size_t i = 0; i < all.size(); ++i) expect_same(first[i], run(scenes[i], all[i], "among_others_second"));
}

/// Quantities of all steps as a table. `interruption` is called after the second step.
std::string steps_of(const Scene& scene, const std::function<void()>& interruption) {
  const Timers timers;
  const Model model(comm(), scene, timers);
  SemiSmoothSystem system(model.parts(), timers);
  StepEvaluation evaluation(scene, model, system);
  std::string steps = fmt::format("{}\n", fmt::join(evaluation.names(), ","));
  int count = 0;
  StepperObserver observer;
  observer.accepted = [&](const StepReport&, const SystemEvaluation& at) {
    steps += fmt::format("{}\n", fmt::join(evaluation.quantities(at), ","));
    if (++count == 2) interruption();
  };
  SteppingState state(system.initial_state(Vector(system.map())));
  std::optional<StepFailure> failure;
  const auto start = [&](const AcceptedState& from, double time, const Vector& d, Vector& z) { return system.start_step(from, time, d, z); };
  EXPECT_TRUE(run_steps(system, scene.stepping, scene.newton, state, start, observer, failure)) << (failure ? failure->what() : "");
  EXPECT_GT(count, 2);
  return steps;
}

// Two runs of one scene, and one of another scene, that are under way at the same time.
TEST(RunWithinAnother, LeavesTheSame) {
  const Scene scene = read(friction), other = read(stick_and_slip);
  const std::string alone = steps_of(scene, [] {});
  std::string within;
  const std::string interrupted = steps_of(scene, [&] { within = steps_of(scene, [&] { run(other, stick_and_slip, "within_another"); }); });
  expect_same({{"history.csv", interrupted}}, {{"history.csv", alone}});
  expect_same({{"history.csv", within}}, {{"history.csv", alone}});
}

}  // namespace
}  // namespace mortise
