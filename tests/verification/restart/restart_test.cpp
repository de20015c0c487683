// A run that was cut in two is the run in one piece: quantities, Newton counts, files. And what is refused.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>

#include "launch.hpp"
#include "scene_support.hpp"

namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using Words = std::vector<std::string>;
using Table = std::vector<Words>;

Table read_table(const fs::path& path) {
  Table table;
  std::istringstream text(read_file(path));
  for (std::string line; std::getline(text, line);) {
    Words row;
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
    table.push_back(row);
  }
  return table;
}

Words names_in(const fs::path& directory) {
  Words names;
  for (const auto& entry : fs::directory_iterator(directory))
    if (const std::string name = entry.path().filename(); name.front() != '.') names.push_back(name);
  std::sort(names.begin(), names.end());
  return names;
}

nlohmann::json summary_of(const fs::path& directory) { return nlohmann::json::parse(read_file(directory / "summary.json")); }

/// A scene that is run straight, and again from a checkpoint.
struct Cut {
  std::string name, scene;
  Words settings;
  int ranks = 1, ranks_after = 1;
  double tolerance = 1e-12;  ///< of the scale of each quantity
};

Ending run(const std::string& scene, const Words& settings, int ranks, const fs::path& results, const Words& more = {}) {
  Words command{MPIEXEC, "-n", std::to_string(ranks), MORTISE, "run", scene, "-o", results};
  for (const std::string& setting : settings) command.insert(command.end(), {"--set", setting});
  command.insert(command.end(), more.begin(), more.end());
  return launch(command, 300);
}

Words with_checkpoints(Words settings, int every_step, int keep) {
  settings.push_back("output/checkpoints/every step=" + std::to_string(every_step));
  settings.push_back("output/checkpoints/keep=" + std::to_string(keep));
  return settings;
}

fs::path scratch(const std::string& name) {
  const fs::path path = fs::path(SCRATCH) / name;
  fs::remove_all(path);
  fs::create_directories(path.parent_path());
  return path;
}

/// Rows, columns and Newton counts have to be the same, values to a tolerance of the largest of their column. Errors and imbalances are relative:
/// their scale is 1.
void expect_same_history(const fs::path& straight, const fs::path& cut, double tolerance) {
  const Table one = read_table(straight / "history.csv"), other = read_table(cut / "history.csv");
  ASSERT_EQ(one.size(), other.size());
  EXPECT_EQ(one.front(), other.front());
  for (std::size_t column = 0; column < one.front().size(); ++column) {
    double scale = 0.0, worst = 0.0;
    for (std::size_t row = 1; row < one.size(); ++row) {
      const double value = std::stod(one[row][column]), again = std::stod(other[row][column]);
      if (std::isnan(value) && std::isnan(again)) continue;
      scale = std::max(scale, std::abs(value));
      worst = std::max(worst, std::isnan(value) != std::isnan(again) ? INFINITY : std::abs(again - value));
    }
    const std::string& name = one.front()[column];
    for (const std::string relative : {"error", "imbalance", "spread", "oscillation", "penetration"})
      if (name.find(relative) != std::string::npos) scale = std::max(scale, 1.0);
    EXPECT_LE(worst, name == "newton_iterations" ? 0.0 : tolerance * scale) << name;
  }
}

void expect_seamless(const Cut& cut) {
  SCOPED_TRACE(cut.name);
  const fs::path straight = scratch(cut.name), again = scratch(cut.name + "_again");
  const std::string scene = std::string(INPUTS) + "/" + cut.scene;
  const Ending whole = run(scene, with_checkpoints(cut.settings, 1, 1000), cut.ranks, straight);
  ASSERT_EQ(whole.code, 0) << whole.output;
  const std::size_t steps = read_table(straight / "history.csv").size() - 1;
  ASSERT_GE(steps, 3U);
  for (const std::size_t step : {std::size_t{1}, steps / 2, steps - 1}) {
    SCOPED_TRACE("step " + std::to_string(step));
    fs::remove_all(again);
    fs::copy(straight, again, fs::copy_options::recursive);
    const Ending rest = run(scene, with_checkpoints(cut.settings, 1, 1000), cut.ranks_after, again, {"--restart", std::to_string(step)});
    ASSERT_EQ(rest.code, 0) << rest.output;
    expect_same_history(straight, again, cut.tolerance);
    EXPECT_EQ(read_table(straight / "newton.csv").size(), read_table(again / "newton.csv").size());
    EXPECT_EQ(names_in(straight / "fields"), names_in(again / "fields"));
    EXPECT_EQ(names_in(straight / "checkpoints"), names_in(again / "checkpoints"));
    const auto before = summary_of(straight), after = summary_of(again);
    EXPECT_EQ(before["steps"].size(), after["steps"].size());
    EXPECT_EQ(after["parts"].size(), 2U);
    EXPECT_EQ(after["parts"][1]["from_step"], step);
    for (std::size_t n = 0; n < before["steps"].size(); ++n) EXPECT_EQ(before["steps"][n]["newton"].size(), after["steps"][n]["newton"].size()) << n;
  }
}

const Words short_hertz{"variables/n=2", "variables/F=800", "variables/mu=0.1", "variables/steps=4"};

TEST(Restart, Friction) {
  expect_seamless({"friction", "verification/sliding_block.xml", {}});
  expect_seamless({"hertz_friction", "paper/hertz_elastic.xml", short_hertz});
  Words strong = short_hertz;
  strong[2] = "variables/mu=5";
  expect_seamless({"strong_friction", "paper/hertz_elastic.xml", strong});
}
TEST(Restart, Plasticity) { expect_seamless({"plasticity", "paper/block_pile.xml", {}}); }
TEST(Restart, AugmentedLagrange) {
  expect_seamless({"augmented",
                   "verification/sliding_block.xml",
                   {"contact/joint/formulation/type=augmented lagrange", "checks/work/low=-1", "checks/work/high=1"}});
}
// In the middle of an impact, to the last bit.
TEST(Restart, Inertia) {
  expect_seamless({"impact",
                   "dynamics/matched_impedance.xml",
                   {"variables/n=10", "stepping/end time=0.5", "checks/the striker gives all of its momentum/high=0"},
                   1,
                   1,
                   0.0});
  expect_seamless({"gap_rate", "dynamics/bouncing_bar.xml", {"variables/n=20", "variables/steps=40"}, 1, 1, 0.0});
}
TEST(Restart, RigidBodies) { expect_seamless({"rigid", "verification/rolling_disk.xml", {"variables/n=3"}}); }
TEST(Restart, QuadraticFacets) {
  expect_seamless({"quadratic",
                   "verification/3d/punch.xml",
                   {"bodies/base/element=H20", "variables/n=2", "boundary conditions/press/rotation x=0", "boundary conditions/press/rotation y=0",
                    "boundary conditions/press/rotation z=0", "stepping/end time=0.75"}});
}
TEST(Restart, SpringsAndDashpots) { expect_seamless({"springs", "verification/spring_bed.xml", {}}); }
TEST(Restart, DashpotsWithInertia) { expect_seamless({"oscillator", "dynamics/damped_oscillator.xml", {"variables/steps=40"}}); }
TEST(Restart, Stabilisation) { expect_seamless({"stabilisation", "verification/stabilised_block.xml", {}}); }
TEST(Restart, KinksOfTheNearestFacet) { expect_seamless({"kinks", "verification/dragged_corner.xml", {}}); }
TEST(Restart, BodiesHeldByContact) { expect_seamless({"held", "hard/dwell.xml", {}}); }
// Data that the iterative solver keeps of earlier steps changes results within its tolerance alone.
TEST(Restart, IterativeSolver) {
  expect_seamless({"iterative", "verification/3d/punch.xml", {"linear solver/type=iterative", "variables/n=2", "stepping/end time=0.75"}});
}
// Sums over other ranks go in another order.
TEST(Restart, OnOtherNumbersOfRanks) {
  expect_seamless({"one_to_three", "paper/block_pile.xml", {}, 1, 3, 1e-9});
  expect_seamless({"three_to_two", "verification/sliding_block.xml", {}, 3, 2, 1e-9});
}

/// Signals a run whose history has some rows.
Ending run_with_signal(const std::string& scene, const Words& settings, int ranks, const fs::path& results, const std::string& signal, int rows,
                       const std::string& target) {
  const std::string watch = "while [ \"$(wc -l < '" + (results / "history.csv").string() + "' 2>/dev/null || echo 0)\" -le " + std::to_string(rows) +
                            " ]; do sleep 0.02; done; " + target + " -" + signal;
  std::string command = ranks > 1 ? std::string(MPIEXEC) + " -n " + std::to_string(ranks) + " " : "";
  command += std::string(MORTISE) + " run '" + scene + "' -o '" + results.string() + "'";
  for (const std::string& setting : settings) command += " --set '" + setting + "'";
  return launch({"bash", "-c", "set -m; " + command + " & run=$!; " + watch + " $run; wait $run"}, 120);
}

TEST(Stop, ASignalEndsTheRunAfterItsStepAndARestartGoesOn) {
  const std::string scene = std::string(INPUTS) + "/verification/sliding_block.xml";
  const fs::path straight = scratch("stop_straight"), stopped = scratch("stopped");
  ASSERT_EQ(run(scene, {}, 1, straight).code, 0);
  for (const std::string signal : {"TERM", "INT", "USR1"}) {
    SCOPED_TRACE(signal);
    fs::remove_all(stopped);
    const Ending first = run_with_signal(scene, {}, 1, stopped, signal, 3, "kill");
    EXPECT_EQ(first.code, 3) << first.output;
    EXPECT_THAT(first.output, HasSubstr("stopped by SIG" + signal));
    EXPECT_THAT(first.output, HasSubstr("to go on: mortise run " + scene + " -o " + stopped.string() + " --restart"));
    EXPECT_EQ(summary_of(stopped)["stopped"], "SIG" + signal);
    const std::size_t done = read_table(stopped / "history.csv").size();
    EXPECT_LT(done, read_table(straight / "history.csv").size());
    const Ending rest = run(scene, {}, 1, stopped, {"--restart"});
    EXPECT_EQ(rest.code, 0) << rest.output;
    expect_same_history(straight, stopped, 1e-12);
    EXPECT_EQ(names_in(straight / "fields"), names_in(stopped / "fields"));
  }
}

TEST(Stop, ASignalToOneRankStopsAll) {
  const std::string scene = std::string(INPUTS) + "/verification/sliding_block.xml";
  const fs::path stopped = scratch("stopped_rank");
  const Ending first = run_with_signal(scene, {}, 2, stopped, "USR1", 3, "pkill -P");  // one child of mpirun and the other
  EXPECT_EQ(first.code, 3) << first.output;
  EXPECT_THAT(first.output, HasSubstr("stopped by SIGUSR1"));
  EXPECT_EQ(run(scene, {}, 2, stopped, {"--restart"}).code, 0);
}

TEST(Stop, ACheckpointOnDemandGoesOn) {
  const std::string scene = std::string(INPUTS) + "/verification/sliding_block.xml";
  const fs::path results = scratch("on_demand");
  const Ending ending = run_with_signal(scene, {}, 1, results, "USR2", 3, "kill");
  EXPECT_EQ(ending.code, 0) << ending.output;
  EXPECT_GE(names_in(results / "checkpoints").size(), 1U);
}

TEST(Stop, ATimeLimitIsKept) {
  const std::string scene = std::string(INPUTS) + "/hard/cyclic.xml";
  const fs::path results = scratch("limited");
  const auto begin = std::chrono::steady_clock::now();
  const Ending ending = run(scene, {}, 1, results, {"--time-limit", "1"});
  EXPECT_EQ(ending.code, 3) << ending.output;
  EXPECT_THAT(ending.output, HasSubstr("stopped by time limit"));
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), 30.0);
  EXPECT_EQ(names_in(results / "checkpoints").size(), 1U);
  const fs::path enough = scratch("within_the_limit");  // its last step ends later than another one would have been begun
  const Ending whole = run(std::string(INPUTS) + "/paper/patch_test.xml", {"stepping/step=1"}, 1, enough, {"--time-limit", "0.001"});
  EXPECT_EQ(whole.code, 0) << whole.output;
  EXPECT_TRUE(summary_of(enough)["stopped"].is_null());
}

const Words fine_bar{"bodies/bar/mesh/cells x=16", "bodies/bar/mesh/cells y=32", "stepping/step=0.75", "stepping/minimum step=0.1"};

/// A run none of whose files may have more than 64 KiB. Of those of the fine bar a checkpoint alone has more. MPI has no shared memory then.
Ending run_with_small_files(const std::string& scene, const Words& settings, int ranks, const fs::path& results, const Words& more = {}) {
  Words command{MPIEXEC, "-n", std::to_string(ranks), "env", "OMPI_MCA_btl=self,tcp", "bash", "-c", "ulimit -f 64; exec \"$@\"", "bash"};
  command.insert(command.end(), {MORTISE, "run", scene, "-o", results, "--set", "output/fields="});
  for (const std::string& setting : settings) command.insert(command.end(), {"--set", setting});
  command.insert(command.end(), more.begin(), more.end());
  return launch(command, 300);
}

// The reason of a failed step is reported, with its exit code: the last checkpoint that could not be written is the lesser news.
TEST(Stop, TheReasonIsToldWhereTheLastCheckpointCannotBeWritten) {
  const std::string scene = std::string(INPUTS) + "/verification/limit_load.xml";
  const fs::path results = scratch("reason");
  for (const int ranks : {1, 2}) {
    SCOPED_TRACE(ranks);
    const Ending ending = run_with_small_files(scene, fine_bar, ranks, results);
    EXPECT_EQ(ending.code, 3) << ending.output;
    EXPECT_THAT(ending.output, HasSubstr("no equilibrium beyond this load"));
    EXPECT_THAT(ending.output, HasSubstr("warning: cannot write " + (results / "checkpoints").string()));
    const auto summary = summary_of(results);
    EXPECT_THAT(summary["reason"].get<std::string>(), HasSubstr("no equilibrium beyond this load"));
    EXPECT_EQ(summary["converged"], false);
    EXPECT_EQ(summary["exit"], 3);
    EXPECT_EQ(names_in(results / "checkpoints"), Words());
  }
}

// A run that is stopped or comes to its end has no other failure to tell of.
TEST(Stop, AMissingLastCheckpointOfARunWithoutFailureIsAFileError) {
  const std::string scene = std::string(INPUTS) + "/verification/limit_load.xml";
  const fs::path results = scratch("no_failure");
  const auto expect_file_error = [&](const Ending& ending, bool converged) {
    EXPECT_EQ(ending.code, 5) << ending.output;
    const std::string reason = "cannot write " + (results / "checkpoints").string();
    EXPECT_THAT(ending.output, HasSubstr(reason));
    EXPECT_EQ(ending.output.find("to go on"), std::string::npos) << ending.output;
    const auto summary = summary_of(results);
    EXPECT_THAT(summary["reason"].get<std::string>(), HasSubstr(reason));
    EXPECT_EQ(summary["converged"], converged);
    EXPECT_EQ(summary["stopped"].is_null(), converged);
    EXPECT_EQ(summary["exit"], 5);
  };
  expect_file_error(run_with_small_files(scene, fine_bar, 1, results, {"--time-limit", "0.001"}), false);
  Words ends = with_checkpoints(fine_bar, 1000, 2);
  ends.push_back("stepping/end time=0.2");
  expect_file_error(run_with_small_files(scene, ends, 1, results), true);
}

// The end may move, loads may change later on; nothing else may.
TEST(Restart, RefusesAnotherScene) {
  const fs::path folder = scratch("changes");
  fs::create_directories(folder);
  const std::string file = folder / "scene.xml";
  const std::string stepping = R"xml(<ParameterList name="stepping">
    <Parameter name="end time" type="double" value="1"/><Parameter name="step" type="double" value="0.25"/>
  </ParameterList><ParameterList name="loads">)xml";
  const std::string scene = scene_support::replaced(scene_support::good_scene, "<ParameterList name=\"loads\">", stepping);
  const auto write = [&](const std::string& text) { std::ofstream(file) << text; };
  write(scene);
  const fs::path results = folder / "results";
  ASSERT_EQ(run(file, with_checkpoints({}, 1, 10), 1, results).code, 0);
  const auto restart = [&](const std::string& from, const std::string& to, const std::string& step = "2") {
    write(scene_support::replaced(scene, from, to));
    fs::remove_all(folder / "copy");
    fs::copy(results, folder / "copy", fs::copy_options::recursive);
    return run(file, with_checkpoints({}, 1, 10), 1, folder / "copy", {"--restart", step});
  };
  const std::string ramp = "name=\"values\" type=\"string\" value=\"0, 1\"";
  Ending ending = restart("value=\"1000\"", "value=\"1001\"");
  EXPECT_EQ(ending.code, 2);
  EXPECT_THAT(ending.output, HasSubstr("\"materials/soft/young's modulus\" is 1001; it was 1000"));
  EXPECT_THAT(ending.output, HasSubstr("what may change is"));
  EXPECT_EQ(read_file(results / "history.csv"), read_file(folder / "copy" / "history.csv"));
  ending = restart("name=\"cells x\" type=\"int\" value=\"2\"", "name=\"cells x\" type=\"int\" value=\"4\"");
  EXPECT_EQ(ending.code, 2) << ending.output;
  ending = restart(ramp, "name=\"values\" type=\"string\" value=\"0, 1.5\"");
  EXPECT_EQ(ending.code, 2);
  EXPECT_THAT(ending.output, HasSubstr("loads at time 0.5, that of the checkpoint, differ"));
  ending = restart("<Parameter name=\"x\" type=\"double\" value=\"0\"/>", "<Parameter name=\"x\" type=\"double\" value=\"1\"/>");
  EXPECT_EQ(ending.code, 2);
  EXPECT_THAT(ending.output, HasSubstr("prescribed displacements at time 0.5"));
  ending = restart("name=\"end time\" type=\"double\" value=\"1\"", "name=\"end time\" type=\"double\" value=\"0.4\"");
  EXPECT_EQ(ending.code, 2);
  EXPECT_THAT(ending.output, HasSubstr("\"end time\" is 0.4, before that of the checkpoint"));
  ending = restart("value=\"0, 1\"", "value=\"0, 1\"", "9");
  EXPECT_EQ(ending.code, 5);
  EXPECT_THAT(ending.output, HasSubstr("holds no checkpoint of step 9; there are those of the steps 1, 2, 3, 4"));

  // Changes that are allowed.
  const std::string later = scene_support::replaced(scene, "value=\"0, 1\"/>\n      " + std::string("<Parameter ") + ramp,
                                                    "value=\"0, 0.5, 2\"/>\n      <Parameter name=\"values\" type=\"string\" value=\"0, 0.5, 8\"");
  write(scene_support::replaced(later, "name=\"end time\" type=\"double\" value=\"1\"", "name=\"end time\" type=\"double\" value=\"1.5\""));
  fs::remove_all(folder / "copy");
  fs::copy(results, folder / "copy", fs::copy_options::recursive);
  ending = run(file, with_checkpoints({"newton/momentum tolerance=1e-10"}, 1, 10), 1, folder / "copy", {"--restart", "2"});
  EXPECT_EQ(ending.code, 0) << ending.output;
  EXPECT_EQ(read_table(folder / "copy" / "history.csv").size(), 1U + 6U);
}

// `balance` says which rank integrates a facet: sums go in another order.
TEST(Restart, BalanceOfContactMayChange) {
  const std::string scene = std::string(INPUTS) + "/paper/hertz_elastic.xml";
  const fs::path straight = scratch("balance_straight"), results = scratch("balance");
  const std::string pair = "interface", balance = "contact/" + pair + "/balance=";
  Words settings = with_checkpoints(short_hertz, 1, 10), other = settings;
  settings.push_back(balance + "1e6");
  other.push_back(balance + "1");
  ASSERT_EQ(run(scene, settings, 3, straight).code, 0);
  fs::copy(straight, results, fs::copy_options::recursive);
  const Ending ending = run(scene, other, 3, results, {"--restart", "2"});
  ASSERT_EQ(ending.code, 0) << ending.output;
  EXPECT_EQ(summary_of(straight)["contact"][pair]["redistributions"], 0);
  EXPECT_GT(summary_of(results)["contact"][pair]["redistributions"], 0);
  expect_same_history(straight, results, 1e-9);
}

// A damaged checkpoint is named, and the one before it is taken.
TEST(Restart, GoesBackToTheLastWholeCheckpoint) {
  const std::string scene = std::string(INPUTS) + "/paper/hertz_elastic.xml";
  const fs::path results = scratch("damaged");
  ASSERT_EQ(run(scene, with_checkpoints(short_hertz, 1, 3), 1, results).code, 0);
  EXPECT_EQ(names_in(results / "checkpoints"), (Words{"step-000002.h5", "step-000003.h5", "step-000004.h5"}));
  const fs::path newest = results / "checkpoints" / "step-000004.h5";
  std::string bytes = read_file(newest);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  std::ofstream(newest, std::ios::binary) << bytes;
  Ending ending = run(scene, with_checkpoints(short_hertz, 1, 3), 1, results, {"--restart", "4"});
  EXPECT_EQ(ending.code, 5);
  EXPECT_THAT(ending.output, HasSubstr("it is damaged"));
  ending = run(scene, with_checkpoints(short_hertz, 1, 3), 1, results, {"--restart"});
  EXPECT_EQ(ending.code, 0) << ending.output;
  EXPECT_THAT(ending.output, HasSubstr("not whole, and left out: " + newest.string()));
  EXPECT_THAT(ending.output, HasSubstr("goes on from " + (results / "checkpoints" / "step-000003.h5").string()));
}

// Results of later steps belong to another run, whether or not this part writes fields and profiles.
TEST(Restart, CutsFieldsAndProfilesOfARunThatGoesOnWithoutThem) {
  const std::string scene = std::string(INPUTS) + "/paper/hertz_elastic.xml";
  const fs::path straight = scratch("cut_straight"), results = scratch("cut");
  Words settings = with_checkpoints(short_hertz, 1, 10);
  settings.insert(settings.end(), {"output/contact profiles=true", "stepping/output times=0.25, 0.5, 0.75, 1"});
  ASSERT_EQ(run(scene, settings, 1, straight).code, 0);
  fs::copy(straight, results, fs::copy_options::recursive);
  Words without = settings;
  without.insert(without.end(), {"output/fields=", "output/contact profiles=false"});
  ASSERT_EQ(run(scene, without, 1, results, {"--restart", "2"}).code, 0);
  EXPECT_EQ(names_in(results / "fields"), (Words{"mesh.h5", "step-000001.h5", "step-000002.h5"}));
  EXPECT_EQ(read_file(results / "fields.xdmf").find("step-000003"), std::string::npos);
  EXPECT_LT(read_table(results / "profiles.csv").size(), read_table(straight / "profiles.csv").size());
  ASSERT_EQ(run(scene, settings, 1, results, {"--restart", "2"}).code, 0);
  EXPECT_EQ(names_in(results / "fields"), names_in(straight / "fields"));
  EXPECT_EQ(read_file(results / "profiles.csv"), read_file(straight / "profiles.csv"));
}

// Files of fields are large, and a user may remove some: the run goes on and says which are missing, once.
TEST(Restart, NamesStepsWhoseFieldsAreMissing) {
  const std::string scene = std::string(INPUTS) + "/paper/hertz_elastic.xml";
  const fs::path straight = scratch("all_fields"), results = scratch("missing_fields");
  Words settings = with_checkpoints(short_hertz, 1, 10);
  settings.insert(settings.end(), {"variables/steps=8", "output/every step=1"});
  ASSERT_EQ(run(scene, settings, 1, straight).code, 0);
  for (const int ranks : {1, 2}) {
    SCOPED_TRACE(ranks);
    fs::remove_all(results);
    fs::copy(straight, results, fs::copy_options::recursive);
    for (const char* file : {"step-000001.h5", "step-000003.h5", "step-000004.h5", "step-000005.h5", "step-000007.h5"})
      fs::remove(results / "fields" / file);
    Ending ending = run(scene, settings, ranks, results, {"--restart", "6"});
    EXPECT_EQ(ending.code, 0) << ending.output;
    const std::string warning = "fields holds no fields any more of steps 1, 3 to 5, which this run had written";
    const auto first = ending.output.find(warning);
    EXPECT_NE(first, std::string::npos) << ending.output;
    EXPECT_EQ(ending.output.find("fields any more", first + warning.size()), std::string::npos) << ending.output;
    EXPECT_NE(read_file(results / "log.txt").find(warning), std::string::npos);
    EXPECT_EQ(names_in(results / "fields"), (Words{"mesh.h5", "step-000002.h5", "step-000006.h5", "step-000007.h5", "step-000008.h5"}));
    ending = run(scene, settings, ranks, results, {"--restart"});
    EXPECT_EQ(ending.code, 0) << ending.output;
    EXPECT_EQ(ending.output.find("fields any more"), std::string::npos) << ending.output;
  }
}

// All files are looked at before one is cut.
TEST(Restart, ThatIsRefusedLeavesAllFiles) {
  const std::string scene = std::string(INPUTS) + "/paper/hertz_elastic.xml";
  const fs::path straight = scratch("refused_straight"), results = scratch("refused");
  Words settings = with_checkpoints(short_hertz, 1, 10);
  settings.push_back("output/every step=1");
  ASSERT_EQ(run(scene, settings, 1, straight).code, 0);
  const auto refused = [&](const std::string& what, const std::function<void()>& harm) {
    SCOPED_TRACE(what);
    fs::remove_all(results);
    fs::copy(straight, results, fs::copy_options::recursive);
    harm();
    const Words fields = names_in(results / "fields"), checkpoints = names_in(results / "checkpoints");
    const std::string history = read_file(results / "history.csv"), newton = read_file(results / "newton.csv");
    const Ending ending = run(scene, settings, 1, results, {"--restart", "2"});
    EXPECT_EQ(ending.code, 5) << ending.output;
    EXPECT_EQ(names_in(results / "fields"), fields);
    EXPECT_EQ(names_in(results / "checkpoints"), checkpoints);
    EXPECT_EQ(read_file(results / "history.csv"), history);
    EXPECT_EQ(read_file(results / "newton.csv"), newton);
  };
  refused("steps.jsonl is missing", [&] { fs::remove(results / "steps.jsonl"); });
  refused("steps.jsonl is short", [&] { fs::resize_file(results / "steps.jsonl", 10); });
  refused("fields of an earlier step cannot be read", [&] { fs::resize_file(results / "fields" / "step-000001.h5", 100); });
  refused("the mesh cannot be read", [&] { fs::resize_file(results / "fields" / "mesh.h5", 100); });
  refused("a checkpoint has another's name", [&] {
    fs::copy_file(results / "checkpoints" / "step-000003.h5", results / "checkpoints" / "step-000002.h5", fs::copy_options::overwrite_existing);
  });
  refused("a table is a link", [&] {
    fs::rename(results / "history.csv", fs::path(SCRATCH) / "theirs.csv");
    fs::create_symlink(fs::path(SCRATCH) / "theirs.csv", results / "history.csv");
  });
}

TEST(Restart, WithoutACheckpointSaysSo) {
  const std::string scene = std::string(INPUTS) + "/paper/patch_test.xml";
  const Ending ending = run(scene, {}, 1, scratch("nothing"), {"--restart"});
  EXPECT_EQ(ending.code, 5);
  EXPECT_THAT(ending.output, HasSubstr("holds no checkpoint: there is nothing to restart from"));
  EXPECT_FALSE(fs::exists(fs::path(SCRATCH) / "nothing"));
}

}  // namespace
