#include "study/study_report.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "mortise/core/names.hpp"
#include "mortise/io/csv_writer.hpp"
#include "shared/run_process.hpp"

namespace mortise {
namespace {

using Json = nlohmann::ordered_json;

CsvValue cell(double value) { return std::isfinite(value) ? CsvValue(value) : CsvValue(std::string()); }
CsvValue count(double value) { return std::isfinite(value) ? CsvValue(std::llround(value)) : CsvValue(std::string()); }

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
Json numbers(const std::vector<double>& values) {
  Json json = Json::array();
  for (const double value : values) json.push_back(number(value));
  return json;
}
Json number(const std::optional<double>& value) { return value ? number(*value) : Json(nullptr); }

Json point_json(const StudyPoint& point, const StudyRecord& record) {
  return {{"label", point.label()},
          {"name", point.name},
          {"labels", point.labels},
          {"settings", point.words()},
          {"ranks", point.ranks},
          {"peer", peer_name(point.peer)},
          {"peer_penalty", point.peer == Peer::none ? "" : point.penalty.value},
          {"formulation", point.formulation},
          {"element", point.element},
          {"dofs", number(record.dofs)},
          {"steps", number(record.steps)},
          {"newton_iterations", number(record.newton_iterations)},
          {"cutbacks", number(record.cutbacks)},
          {"wall_s", number(record.wall)},
          {"cpu_s", number(record.cpu)},
          {"memory_mib", number(record.memory)},
          {"time", record.time},
          {"status", record.status()},
          {"finished", record.finished()},
          {"said", record.said},
          {"missed", record.missed_checks},
          {"date", record.date}};
}

Json errors_json(const StudyErrors& errors, const StudyConclusions& conclusions) {
  Json json{{"name", errors.name},
            {"file", name_for_files(errors.name)},
            {"error", numbers(errors.error)},
            {"value", numbers(errors.value)},
            {"reference", numbers(errors.reference)},
            {"notes", errors.notes},
            {"orders", Json::array()},
            {"no_order", Json::array()},
            {"front", conclusions.front},
            {"targets", Json::array()}};
  json["exact"] = conclusions.exact ? Json(*conclusions.exact) : Json(nullptr);
  for (const auto& fitted : conclusions.orders) json["orders"].push_back(number(fitted.order)), json["no_order"].push_back(fitted.reason);
  for (const auto& target : conclusions.targets) {
    Json one{{"error", target.error}, {"cheapest", nullptr}, {"curves", Json::array()}};
    if (target.cheapest) one["cheapest"] = {{"point", target.cheapest->run}, {"confirmed", target.cheapest->confirmed}};
    for (std::size_t c = 0; c < target.times.size(); ++c) {
      const auto& time = target.times[c];
      one["curves"].push_back({{"seconds", time ? Json(time->seconds) : Json(nullptr)},
                               {"at_most", time && time->at_most},
                               {"confirmed", time && time->confirmed},
                               {"ratio", number(target.ratios[c])}});
    }
    json["targets"].push_back(std::move(one));
  }
  return json;
}

/// Environment of times and results besides the study.
Json environment(const std::string& version, const StudyResults& results) {
  std::set<std::string> processors, dates;
  const auto add = [&](const StudyRecord& record) { processors.insert(record.processor), dates.insert(record.date); };
  std::for_each(results.points.begin(), results.points.end(), add);
  if (results.finest) add(*results.finest);
  return {{"version", version}, {"processors", processors}, {"first_run", *dates.begin()}, {"last_run", *dates.rbegin()}};
}

}  // namespace

void write_study_table(const RCP<const Communicator>& comm, const std::string& path, const StudyPlan& plan, const StudyResults& results,
                       const std::vector<StudyErrors>& errors) {
  std::vector<std::string> columns{"formulation", "element", "h", "dofs", "steps", "newton_iterations", "wall_s", "cpu_s", "memory_mib"};
  const auto has_values = [&](std::size_t q) {
    const StudyQuantity& quantity = plan.file.quantities[q].value;
    return quantity.of_scalar() && quantity.measure == StudyMeasure::relative_difference;
  };
  for (std::size_t q = 0; q < errors.size(); ++q)
    if (has_values(q)) columns.push_back("value_" + errors[q].name);
  for (const auto& one : errors) columns.push_back("error_" + one.name);
  columns.push_back("status");
  for (const auto& axis : plan.file.axes) columns.push_back("axis_" + axis.name);
  std::vector<std::vector<CsvValue>> rows;
  for (std::size_t i = 0; i < plan.points.size(); ++i) {
    const StudyPoint& point = plan.points[i];
    const StudyRecord& record = results.points[i];
    std::vector<CsvValue> row{point.formulation,  point.element,       cell(results.h[i]),
                              count(record.dofs), count(record.steps), count(record.newton_iterations),
                              cell(record.wall),  cell(record.cpu),    cell(record.memory)};
    for (std::size_t q = 0; q < errors.size(); ++q)
      if (has_values(q)) row.push_back(cell(errors[q].value[i]));
    for (const auto& one : errors) row.push_back(cell(one.error[i]));
    row.emplace_back(record.status());
    for (const auto& label : point.labels) row.emplace_back(label);
    rows.push_back(std::move(row));
  }
  CsvWriter(comm, path, columns).rows(rows);
}

Json study_json(const StudyOptions& options, const StudyPlan& plan, const StudyResults& results, const std::vector<StudyCurve>& curves,
                const std::vector<StudyErrors>& errors, const std::vector<StudyConclusions>& conclusions) {
  Json json{{"study", plan.file.name},
            {"program", this_program()},
            {"launcher", options.launcher.words},
            {"scene", plan.file.scene.value},
            {"environment", environment(options.version, results)},
            {"axes", Json::array()}};
  for (std::size_t a = 0; a < plan.file.axes.size(); ++a) json["axes"].push_back({{"name", plan.file.axes[a].name}, {"values", plan.labels[a]}});
  json["series"] = plan.series;
  json["along"] = plan.along;
  json["h"] = plan.file.h.value;
  json["repeats"] = plan.file.repeats;
  json["points"] = Json::array();
  for (std::size_t i = 0; i < plan.points.size(); ++i) {
    json["points"].push_back(point_json(plan.points[i], results.points[i]));
    json["points"].back()["h"] = number(results.h[i]);
  }
  json["finest"] = plan.finest ? point_json(*plan.finest, *results.finest) : Json(nullptr);
  json["curves"] = Json::array();
  for (const auto& curve : curves) json["curves"].push_back({{"name", curve.name}, {"base", curve.base}, {"points", curve.points}});
  json["errors"] = Json::array();
  json["conclusions"] = Json::array();
  for (std::size_t q = 0; q < errors.size(); ++q) {
    json["errors"].push_back(errors_json(errors[q], conclusions[q]));
    json["conclusions"].push_back(sentence(plan, results, errors[q], conclusions[q]));
  }
  return json;
}

}  // namespace mortise
