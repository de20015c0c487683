#include "run/output/run_record.hpp"

#include <fmt/chrono.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>

namespace mortise {
namespace {

using Json = nlohmann::ordered_json;

/// JSON knows no NaN and no infinity: null.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json step_json(const StepReport& step) {
  Json iterations = Json::array();
  for (const auto& iteration : step.newton.iterations) {
    const auto& norms = iteration.norms;
    iterations.push_back({{"momentum", number(norms.momentum)},
                          {"constraint", number(std::max(norms.gap, norms.complementarity))},
                          {"increment", number(iteration.increment)},
                          {"active", norms.active},
                          {"stick", norms.sticking},
                          {"slip", norms.active - norms.sticking},
                          {"changed", norms.changed},
                          {"linear_iterations", iteration.linear_iterations}});
  }
  return {{"time", step.time},   {"dt", step.dt}, {"cutbacks", step.cutbacks}, {"undone", step.undone}, {"solves", step.newton.solves},
          {"newton", iterations}};
}

Json check_json(const CheckResult& check) {
  Json json{{"name", check.name}, {"quantity", check.quantity}, {"value", number(check.value)}};
  json["low"] = check.low ? number(*check.low) : Json(nullptr);
  json["high"] = check.high ? number(*check.high) : Json(nullptr);
  json["ok"] = check.ok;
  return json;
}

Json effects_json(const Effects& effects) {
  Json json = Json::object();
  for (const auto& [effect, members] : effects) json[effect] = members;
  return json;
}

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

/// ISO 8601.
std::string utc_now() { return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))); }

}  // namespace

void RunRecord::serialize(StateArchive& archive) {
  mortise::serialize(archive, "record.steps", steps);
  mortise::serialize(archive, "record.time", time);
  mortise::serialize(archive, "record.newton_steps", newton_steps);
  std::string json = Json(parts).dump();
  archive.text("record.parts", json);
  std::vector<double> values;
  for (const auto& name : quantity_order) {
    const auto found = quantities.find(name);
    values.push_back(found == quantities.end() ? std::nan("") : found->second);
  }
  archive.values("record.quantities", values);
  if (!archive.restores()) return;
  parts = Json::parse(json, nullptr, false).get<std::vector<std::string>>();
  for (std::size_t n = 0; n < std::min(values.size(), quantity_order.size()); ++n) quantities[quantity_order[n]] = values[n];
}

std::string step_line(const StepReport& step) { return step_json(step).dump(-1, ' ', false, Json::error_handler_t::replace); }

std::string part_text(int from_step, int ranks) {
  return Json{{"from_step", from_step}, {"ranks", ranks}, {"host", host_name()}, {"date", utc_now()}}.dump();
}

Json summary(const RunRecord& record, const Model& model, const std::optional<ContactHistory>& contact, const std::string& steps) {
  Json json;
  json["scene"] = record.scene;
  json["settings"] = record.settings;
  json["version"] = record.version;
  json["host"] = host_name();
  json["date"] = utc_now();
  json["ranks"] = model.mesh()->comm->getSize();
  json["dofs"] = model.dofs();
  json["elements"] = model.size().elements;
  json["slave_nodes"] = model.slave_nodes();
  json["converged"] = record.converged;
  json["reason"] = record.reason ? Json(*record.reason) : Json(nullptr);
  json["stopped"] = record.stopped ? Json(*record.stopped) : Json(nullptr);
  json["exit"] = static_cast<int>(record.exit);
  json["linear_solver"] = model.parts().linear_solver->name();
  json["effects"] = effects_json(model.effects());
  json["parts"] = Json::array();
  for (const std::string& part : record.parts) json["parts"].push_back(Json::parse(part, nullptr, false));
  json["steps"] = Json::array();
  if (model.mesh()->comm->getRank() == 0) {
    std::ifstream lines(steps);
    for (std::string line; std::getline(lines, line);) json["steps"].push_back(Json::parse(line, nullptr, false));
  }
  json["quantities"] = Json::object();
  for (const auto& name : record.quantity_order)
    if (const auto found = record.quantities.find(name); found != record.quantities.end()) json["quantities"][name] = number(found->second);
  json["checks"] = Json::array();
  for (const auto& check : record.checks) json["checks"].push_back(check_json(check));
  json["contact"] = Json::object();
  for (const auto& [pair, load] : record.integration)
    json["contact"][pair] = {{"facets", load.facets},
                             {"segments", load.segments},
                             {"imbalance", load.imbalance},
                             {"imbalance_as_owned", load.imbalance_as_owned},
                             {"redistributions", load.redistributions}};
  json["time"] = record.seconds;
  json["memory_peak_mib"] = record.memory_peak_mib;
  json["memory_total_mib"] = record.memory_total_mib;
  // By contribution, and what plasticity adds to that of the bodies. Contributions without a history are said to have none.
  json["calls"] = model.calls();
  json["bytes"] = Json::object();
  for (const auto& [name, calls] : model.calls()) json["bytes"][name] = 0;
  json["bodies"] = Json::object();
  long bytes = 0, evaluations = 0;
  for (const BodyHistory& history : model.histories()) {
    json["bodies"][history.body] = {{"history_bytes", history.bytes}, {"history_evaluations", history.evaluations}};
    bytes += history.bytes;
    evaluations += history.evaluations;
  }
  json["calls"]["plasticity"] = evaluations;
  json["bytes"]["plasticity"] = bytes;
  json["calls"]["friction"] = model.contact() ? model.contact()->friction_evaluations() : 0;
  json["bytes"]["friction"] = contact ? friction_bytes(*contact) : 0;
  return json;
}

}  // namespace mortise
