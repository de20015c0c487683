#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>

#include "mortise/io/csv_writer.hpp"
#include "mortise/io/files.hpp"
#include "mortise/io/output_directory.hpp"
#include "mortise/simulation/model/run_log.hpp"
#include "mortise/simulation/run/run.hpp"
#include "mortise/simulation/scene/read_scene.hpp"
#include "mortise/studies/scale.hpp"
#include "scale/scale_phases.hpp"
#include "scale/scale_plan.hpp"
#include "scale/scale_prediction.hpp"
#include "shared/draw_plot.hpp"
#include "shared/plot_scripts.hpp"

namespace mortise {
namespace {

/// Figure of each rank: a column of plan.csv and a line of the table.
struct Column {
  std::string name;
  std::function<double(const RankPlan&)> value;
};

double sum(const std::map<int, double>& bytes) {
  double all = 0.0;
  for (const auto& [rank, of_rank] : bytes) all += of_rank;
  return all;
}

std::vector<Column> columns() {
  return {{"elements", [](const RankPlan& rank) { return static_cast<double>(rank.mesh.elements); }},
          {"ghost_elements", [](const RankPlan& rank) { return static_cast<double>(rank.mesh.ghost_elements); }},
          {"nodes", [](const RankPlan& rank) { return static_cast<double>(rank.mesh.nodes); }},
          {"ghost_nodes", [](const RankPlan& rank) { return static_cast<double>(rank.mesh.ghost_nodes); }},
          {"slave_facets", [](const RankPlan& rank) { return static_cast<double>(rank.facets); }},
          {"slave_work", [](const RankPlan& rank) { return static_cast<double>(rank.segments); }},
          {"neighbours", [](const RankPlan& rank) { return static_cast<double>(rank.neighbours()); }},
          {"vector_bytes", [](const RankPlan& rank) { return sum(rank.vector_bytes); }},
          {"coupling_bytes", [](const RankPlan& rank) { return sum(rank.coupling_bytes); }},
          {"memory_mib", [](const RankPlan& rank) { return rank.memory_mib; }}};
}

struct Spread {
  double least = 0.0, mean = 0.0, most = 0.0, total = 0.0;
};

Spread spread_of(const ScalePlan& plan, const Column& column) {
  Spread spread;
  spread.least = spread.most = column.value(plan.ranks.front());
  for (const RankPlan& rank : plan.ranks) {
    const double value = column.value(rank);
    spread.least = std::min(spread.least, value);
    spread.most = std::max(spread.most, value);
    spread.total += value;
  }
  spread.mean = spread.total / static_cast<double>(plan.ranks.size());
  return spread;
}

double over_mean(const Spread& spread) { return spread.mean > 0.0 ? spread.most / spread.mean : 1.0; }

nlohmann::ordered_json plan_json(const ScaleOptions& options, const ScalePlan& plan) {
  using Json = nlohmann::ordered_json;
  Json json{{"scene", options.scene}, {"settings", options.settings}, {"version", options.version}, {"ranks", plan.ranks.size()}};
  json["contact"] = Json::object();
  for (const PairPlan& pair : plan.pairs)
    json["contact"][pair.name] = {{"slave_facets", pair.facets},
                                  {"slave_work", pair.segments},
                                  {"most_work_of_a_facet", pair.most_segments},
                                  {"imbalance_as_owned", pair.imbalance_as_owned},
                                  {"imbalance", pair.imbalance},
                                  {"least_imbalance", pair.least_imbalance(options.plan)},
                                  {"redistributed", pair.is_moved}};
  json["per_rank"] = Json::object();
  for (const Column& column : columns()) {
    const Spread spread = spread_of(plan, column);
    json["per_rank"][column.name] = {
        {"min", spread.least}, {"mean", spread.mean}, {"max", spread.most}, {"total", spread.total}, {"max_over_mean", over_mean(spread)}};
  }
  const std::vector<PhaseWork> work = work_of(plan);
  json["work"] = Json::object();
  for (std::size_t p = 0; p < work.size(); ++p) json["work"][scale_phases()[p].name] = {{"most", work[p].most}, {"whole", work[p].whole}};
  return json;
}

void say(const ScaleOptions& options, const ScalePlan& plan, RunLog& log) {
  log.info(fmt::format("{} on {} rank(s); nothing is run", options.scene, options.plan));
  log.info(fmt::format("{:<16}{:>12}{:>12}{:>12}{:>12}", "of a rank", "min", "mean", "max", "max/mean"));
  for (const Column& column : columns()) {
    const Spread spread = spread_of(plan, column);
    log.info(fmt::format("{:<16}{:>12.5g}{:>12.5g}{:>12.5g}{:>12.3f}", column.name, spread.least, spread.mean, spread.most, over_mean(spread)));
  }
  for (const PairPlan& pair : plan.pairs) {
    if (pair.facets == 0) {
      log.info(fmt::format("contact {}: nothing to integrate, with node to segment or while no facets overlap within reach", pair.name));
      continue;
    }
    log.info(fmt::format("contact {}: {} slave facets, {} overlaps; largest over mean work of the ranks {:.3f}{}", pair.name, pair.facets,
                         pair.segments, pair.imbalance, pair.is_moved ? fmt::format(", as owned {:.3f}", pair.imbalance_as_owned) : ""));
    if (pair.facets < options.plan)
      log.warning(fmt::format("contact {}: {} slave facets cannot keep {} ranks busy; a facet is integrated as a whole", pair.name, pair.facets,
                              options.plan));
    else if (const double least = pair.least_imbalance(options.plan); least > 1.2)
      log.warning(
          fmt::format("contact {}: one facet has {:.2f} times the mean work of a rank, so no balance can be better than that", pair.name, least));
  }
  if (static_cast<double>(options.plan) > spread_of(plan, columns().front()).total) log.warning("there are fewer elements than ranks");
}

}  // namespace

ExitCode plan_scale(const RCP<const Communicator>& comm, const ScaleOptions& options) {
  if (comm->getSize() > 1) throw InputError(Place{}, "a plan is made on one rank; please call it without mpirun");
  RunLog log(comm, options.verbosity);
  const Scene scene = read_scene(*comm, options.scene, options.settings);
  std::optional<MachineFile> machine;
  if (!options.machine.empty()) machine = read_machine(*comm, options.machine);
  const ScalePlanner planner(comm, scene, options.plan);
  const ScalePlan plan = planner.plan(options.plan);
  std::vector<ScalePrediction> predictions;
  if (machine)
    for (const int ranks : candidate_ranks(*machine, options.plan))
      predictions.push_back(predict(*machine, ranks == options.plan ? plan : planner.plan(ranks)));
  OutputDirectory directory(comm, options.directory.empty() ? default_directory(options.scene) + "-scale" : options.directory,
                            {"scale", options.scene, options.directory.empty()});
  const std::vector<std::string> names_of_plan{"plan.csv", "plan.json", "plan.svg", "plan.png"};
  directory.open(names_of_plan);
  for (const auto& name : names_of_plan) directory.remove(name), directory.claim(name);
  {
    std::vector<std::string> names{"rank"};
    for (const Column& column : columns()) names.push_back(column.name);
    CsvWriter table(comm, directory.file("plan.csv"), names);
    std::vector<std::vector<CsvValue>> rows;
    for (std::size_t rank = 0; rank < plan.ranks.size(); ++rank) {
      rows.push_back({static_cast<long long>(rank)});
      for (const Column& column : columns()) rows.back().emplace_back(column.value(plan.ranks[rank]));
    }
    table.rows(rows);
  }
  nlohmann::ordered_json json = plan_json(options, plan);
  if (machine) json["prediction"] = prediction_json(*machine, predictions);
  write_json(*comm, directory.file("plan.json"), json);
  say(options, plan, log);
  if (machine)
    for (const std::string& line : prediction_lines(*machine, predictions)) log.info(line);
  const std::string title = fmt::format("{} on {} ranks", scene.name, options.plan);
  if (!draw_plot(*comm, scale_plan_plot, {directory.file("plan.csv"), directory.file("plan"), title}, directory.file("plan.svg")))
    log.warning("nothing is drawn without matplotlib; please install python3-matplotlib (Debian)");
  directory.strike_missing();
  log.info("results in " + directory.path());
  return ExitCode::done;
}

}  // namespace mortise
