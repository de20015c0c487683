#include "scale/scale_prediction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>

#include "scale/scale_phases.hpp"

namespace mortise {
namespace {

double received(const std::map<int, double>& bytes) {
  double all = 0.0;
  for (const auto& [rank, of_rank] : bytes) all += of_rank;
  return all;
}

/// Owned work of a rank in a phase; `others` is what it does for elements of other ranks as well.
struct Units {
  std::function<double(const RankPlan&)> owned, others;
};

std::vector<Units> units() {
  const auto none = [](const RankPlan&) { return 0.0; };
  const Units elements{[](const RankPlan&rank) { return static_cast<double>(rank.mesh.elements); },
                       [](const RankPlan&rank) { return static_cast<double>(rank.mesh.ghost_elements); }},
      facets{[](const RankPlan&rank) { return static_cast<double>(rank.facets); }, none},
      overlaps{[](const RankPlan&rank) { return static_cast<double>(rank.segments); }, none},
      pairs{[](const RankPlan&rank) { return static_cast<double>(rank.mesh.node_pairs); }, none},
      nodes{[](const RankPlan&rank) { return static_cast<double>(rank.mesh.nodes); }, none};
  return {elements, facets, overlaps, facets, elements, pairs, pairs, nodes, nodes};
}

double count_of(const MachineFile& machine, ScalePhase::Times times) {
  if (times == ScalePhase::Times::once) return 1.0;
  return times == ScalePhase::Times::newton_iterations ? machine.newton_iterations : machine.linear_iterations;
}

// Between nodes each iteration of GMRES with a V-cycle exchanges ghosts some six times on each level: two sweeps of the smoother and two residuals
// on the way, restriction, prolongation. Coarse levels take the latency alone, as each has about a 27th of the nodes. Two reductions orthogonalise.
double solution_messages(const MachineFile& machine, const ScalePlan& plan) {
  double nodes = 0.0, neighbours = 0.0, bytes = 0.0;
  for (const RankPlan& rank : plan.ranks) {
    nodes += static_cast<double>(rank.mesh.nodes);
    neighbours = std::max(neighbours, static_cast<double>(rank.neighbours()));
    bytes = std::max(bytes, received(rank.vector_bytes));
  }
  constexpr double exchanges = 6.0, coarsest = 1000.0, coarsening = 27.0;
  const double levels = 1.0 + std::max(0.0, std::ceil(std::log(nodes / coarsest) / std::log(coarsening)));
  const double reductions = 2.0 * std::ceil(std::log2(static_cast<double>(plan.ranks.size())));
  return exchanges * (levels * neighbours * machine.latency + bytes / (1e9 * machine.network_bandwidth)) + reductions * machine.latency;
}

double coupling_messages(const MachineFile& machine, const ScalePlan& plan) {
  double seconds = 0.0;
  for (const RankPlan& rank : plan.ranks)
    seconds = std::max(seconds, static_cast<double>(rank.coupling_bytes.size()) * machine.latency +
                                    received(rank.coupling_bytes) / (1e9 * machine.network_bandwidth));
  return seconds;
}

}  // namespace

std::vector<PhaseWork> work_of(const ScalePlan& plan) {
  std::vector<PhaseWork> work;
  for (const Units& unit : units()) {
    PhaseWork& one = work.emplace_back();
    for (const RankPlan& rank : plan.ranks) {
      one.whole += unit.owned(rank);
      one.most = std::max(one.most, unit.owned(rank) + unit.others(rank));
    }
  }
  return work;
}

double slowdown(const MachineFile& machine, int ranks) {
  if (!machine.core_bandwidth || !machine.node_bandwidth) return 1.0;
  return std::max(1.0, std::min(ranks, machine.cores_per_node) * *machine.core_bandwidth / *machine.node_bandwidth);
}

ScalePrediction predict(const MachineFile& machine, const ScalePlan& plan) {
  ScalePrediction prediction;
  prediction.ranks = static_cast<int>(plan.ranks.size());
  prediction.nodes = (prediction.ranks + machine.cores_per_node - 1) / machine.cores_per_node;
  for (int node = 0; node < prediction.nodes; ++node) {
    double memory = 0.0;
    for (int rank = node * machine.cores_per_node; rank < std::min(prediction.ranks, (node + 1) * machine.cores_per_node); ++rank)
      memory += plan.ranks[rank].memory_mib + machine.memory_of_process;
    prediction.memory_per_node = std::max(prediction.memory_per_node, memory);
  }
  prediction.fits = prediction.memory_per_node <= machine.memory_per_node;
  if (!machine.has_rates()) return prediction;
  const std::vector<PhaseWork> work = work_of(plan);
  for (std::size_t p = 0; p < work.size(); ++p) {
    const ScalePhase& phase = scale_phases()[p];
    const double slow = phase.streams ? slowdown(machine, prediction.ranks) : 1.0;
    double seconds = machine.rates[p].rank * work[p].most * slow + machine.rates[p].whole * work[p].whole;
    if (prediction.nodes > 1 && phase.name == "solution") seconds += solution_messages(machine, plan);
    if (prediction.nodes > 1 && phase.name == "integrals") seconds += coupling_messages(machine, plan);
    prediction.phases.push_back(count_of(machine, phase.times) * seconds);
    prediction.seconds += prediction.phases.back();
  }
  prediction.core_seconds = prediction.seconds * prediction.nodes * machine.cores_per_node;
  return prediction;
}

std::vector<int> candidate_ranks(const MachineFile& machine, int most) {
  std::set<int> ranks{most};
  for (int some = 1; some < most; some *= 2) ranks.insert(some);
  for (int nodes = 1; nodes <= most / machine.cores_per_node; nodes *= 2) ranks.insert(nodes * machine.cores_per_node);
  return {ranks.begin(), ranks.end()};
}

const ScalePrediction* cheapest(const std::vector<ScalePrediction>& predictions) {
  const ScalePrediction* best = nullptr;
  for (const ScalePrediction& one : predictions)
    if (one.fits && one.seconds > 0.0 &&
        (best == nullptr || one.core_seconds < best->core_seconds || (one.core_seconds == best->core_seconds && one.seconds < best->seconds)))
      best = &one;
  return best;
}

nlohmann::ordered_json prediction_json(const MachineFile& machine, const std::vector<ScalePrediction>& predictions) {
  using Json = nlohmann::ordered_json;
  Json json{{"machine", machine.name},
            {"cores_per_node", machine.cores_per_node},
            {"memory_per_node_mib", machine.memory_per_node},
            {"newton_iterations", machine.newton_iterations},
            {"linear_iterations", machine.linear_iterations}};
  const ScalePrediction* best = cheapest(predictions);
  json["cheapest"] = best ? Json(best->ranks) : Json(nullptr);
  json["points"] = Json::array();
  for (const ScalePrediction& one : predictions) {
    Json point{{"ranks", one.ranks}, {"nodes", one.nodes}, {"memory_per_node_mib", one.memory_per_node}, {"fits", one.fits}};
    if (!one.phases.empty()) {
      point["seconds"] = one.seconds;
      point["core_seconds"] = one.core_seconds;
      for (std::size_t p = 0; p < one.phases.size(); ++p) point["phases"][scale_phases()[p].name] = one.phases[p];
    }
    json["points"].push_back(std::move(point));
  }
  return json;
}

std::vector<std::string> prediction_lines(const MachineFile& machine, const std::vector<ScalePrediction>& predictions) {
  std::vector<std::string> lines;
  if (machine.has_rates())
    lines.push_back(fmt::format("times on {}, for {} Newton iterations and {} of the linear solver", machine.name, machine.newton_iterations,
                                machine.linear_iterations));
  lines.push_back(fmt::format("{:>8}{:>8}{:>14}{:>16}{:>16}", "ranks", "nodes", "seconds", "MiB per node", "core seconds"));
  for (const ScalePrediction& one : predictions) {
    const bool timed = !one.phases.empty();
    lines.push_back(fmt::format("{:>8}{:>8}{:>14}{:>16.5g}{:>16}{}", one.ranks, one.nodes, timed ? fmt::format("{:.3g}", one.seconds) : "-",
                                one.memory_per_node, timed ? fmt::format("{:.4g}", one.core_seconds) : "-", one.fits ? "" : "  does not fit"));
  }
  const ScalePrediction* best = cheapest(predictions);
  const bool any_fits = std::any_of(predictions.begin(), predictions.end(), [](const ScalePrediction& one) { return one.fits; });
  if (!any_fits)
    lines.push_back(fmt::format("no number of ranks up to {} fits into nodes of {:g} MiB", predictions.back().ranks, machine.memory_per_node));
  else if (best == nullptr)
    lines.push_back("no times: the machine has no rates; `mortise scale` measures them and leaves machine.xml");
  else
    lines.push_back(fmt::format("cheapest: {} rank(s) on {} node(s), {:.3g} s, {:.4g} core seconds of whole nodes, {:.4g} MiB of {:g} MiB per node",
                                best->ranks, best->nodes, best->seconds, best->core_seconds, best->memory_per_node, machine.memory_per_node));
  return lines;
}

}  // namespace mortise
