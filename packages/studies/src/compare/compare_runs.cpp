#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "mortise/core/error.hpp"
#include "mortise/input/xml.hpp"
#include "mortise/studies/compare.hpp"

namespace mortise {
namespace {

using ComparedJson = nlohmann::ordered_json;

/// Columns of a history by their names.
struct ComparedHistory {
  std::vector<std::string> names;
  std::map<std::string, std::vector<double>> columns;
};

struct ComparedRun {
  std::string directory;
  ComparedJson summary;
  ComparedHistory history;
};

/// Cells of a line of CSV; a cell with a comma stands in quotes, in which "" is a quote.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t c = 0; c < line.size(); ++c) {
    if (line[c] == '"' && quoted && c + 1 < line.size() && line[c + 1] == '"')
      cells.back() += line[++c];
    else if (line[c] == '"')
      quoted = !quoted;
    else if (line[c] == ',' && !quoted)
      cells.emplace_back();
    else if (line[c] != '\r')
      cells.back() += line[c];
  }
  return cells;
}

double number_in(const std::string& cell) {
  if (cell.empty()) return std::numeric_limits<double>::quiet_NaN();
  char* end = nullptr;
  const double value = std::strtod(cell.c_str(), &end);
  return *end == '\0' ? value : std::numeric_limits<double>::quiet_NaN();
}

ComparedHistory read_history(const Communicator& comm, const std::string& path) {
  ComparedHistory history;
  std::istringstream lines(read_text(comm, path));
  std::string line;
  std::getline(lines, line);
  history.names = cells_of(line);
  for (int row = 2; std::getline(lines, line); ++row) {
    if (line.empty()) continue;
    const std::vector<std::string> cells = cells_of(line);
    if (cells.size() != history.names.size())
      throw FileError(fmt::format("{}: line {} has {} values, and the first line has {} names; please run the scene again", path, row, cells.size(),
                                  history.names.size()));
    for (std::size_t c = 0; c < cells.size(); ++c) history.columns[history.names[c]].push_back(number_in(cells[c]));
  }
  return history;
}

ComparedRun read_run(const Communicator& comm, const std::string& directory) {
  ComparedRun run{directory, {}, {}};
  const std::string summary = directory + "/summary.json";
  if (!std::filesystem::exists(summary)) throw FileError(fmt::format("{} is missing: {} holds no results of a run", summary, directory));
  run.summary = ComparedJson::parse(read_text(comm, summary), nullptr, false);
  if (run.summary.is_discarded() || !run.summary.contains("quantities"))
    throw FileError(fmt::format("{} is damaged; please run the scene again", summary));
  run.history = read_history(comm, directory + "/history.csv");
  return run;
}

/// The value at a time on straight lines between the times of a history. Nothing beyond them, and between two times of which one has no value.
std::optional<double> value_at_time(const std::vector<double>& times, const std::vector<double>& values, double time) {
  const double slack = 1e-9 * std::abs(time);
  const auto after = std::lower_bound(times.begin(), times.end(), time - slack);
  if (after == times.end()) return std::nullopt;
  const auto n = static_cast<std::size_t>(after - times.begin());
  if (std::abs(times[n] - time) <= slack) return values[n];
  if (n == 0) return std::nullopt;
  const double share = (time - times[n - 1]) / (times[n] - times[n - 1]);
  const double value = (1.0 - share) * values[n - 1] + share * values[n];
  return std::isnan(value) ? std::nullopt : std::optional(value);
}

void compare_histories(const ComparedHistory& a, const ComparedHistory& b, QuantityDifference& quantity) {
  const auto of_a = a.columns.find(quantity.name), of_b = b.columns.find(quantity.name);
  const auto times_of_a = a.columns.find("time"), times_of_b = b.columns.find("time");
  if (of_a == a.columns.end() || of_b == b.columns.end() || times_of_a == a.columns.end() || times_of_b == b.columns.end()) return;
  for (const auto* values : {&of_a->second, &of_b->second})
    for (const double value : *values)
      if (std::isfinite(value)) quantity.scale = std::max(quantity.scale, std::abs(value));
  // At the times of the one with fewer: straight lines between close times are nearer to the truth.
  const bool a_is_shorter = of_a->second.size() <= of_b->second.size();
  const auto &short_times = (a_is_shorter ? times_of_a : times_of_b)->second, &short_values = (a_is_shorter ? of_a : of_b)->second;
  const auto &long_times = (a_is_shorter ? times_of_b : times_of_a)->second, &long_values = (a_is_shorter ? of_b : of_a)->second;
  for (std::size_t n = 0; n < short_times.size(); ++n) {
    const std::optional<double> other = value_at_time(long_times, long_values, short_times[n]);
    if (!other || (std::isnan(*other) && std::isnan(short_values[n]))) continue;
    // One run has a value where the other has none.
    const bool has_both = !std::isnan(*other) && !std::isnan(short_values[n]);
    const double difference = has_both ? std::abs(short_values[n] - *other) : std::numeric_limits<double>::infinity();
    if (difference <= quantity.largest_difference) continue;
    quantity.largest_difference = difference;
    quantity.time = short_times[n];
  }
}

double number_of(const ComparedJson& value) { return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN(); }

void remark_on(const ComparedRun& a, const ComparedRun& b, std::vector<std::string>& remarks) {
  for (const char* name : {"exit", "version", "scene", "ranks"}) {
    const ComparedJson of_a = a.summary.value(name, ComparedJson()), of_b = b.summary.value(name, ComparedJson());
    if (of_a != of_b) remarks.push_back(fmt::format("{}: {}, {}", name, of_a.dump(), of_b.dump()));
  }
  const auto steps = [](const ComparedRun& run) {
    const auto found = run.history.columns.find("time");
    return found == run.history.columns.end() ? std::size_t{0} : found->second.size();
  };
  if (steps(a) != steps(b)) remarks.push_back(fmt::format("steps: {}, {}", steps(a), steps(b)));
}

std::string relative(double difference, double scale) {
  if (difference == 0.0) return "0";
  return scale > 0.0 ? fmt::format("{:.1e}", std::abs(difference) / scale) : "-";
}

}  // namespace

RunComparison compare_runs(const Communicator& comm, const std::string& directory_a, const std::string& directory_b) {
  const ComparedRun a = read_run(comm, directory_a), b = read_run(comm, directory_b);
  RunComparison result;
  remark_on(a, b, result.remarks);
  for (const auto& [name, value] : a.summary["quantities"].items()) {
    if (!b.summary["quantities"].contains(name)) {
      result.in_one_alone.push_back(name);
      continue;
    }
    QuantityDifference quantity;
    quantity.name = name;
    quantity.a = number_of(value);
    quantity.b = number_of(b.summary["quantities"][name]);
    // Both have no value, as a half width without contact.
    quantity.difference = std::isnan(quantity.a) && std::isnan(quantity.b) ? 0.0 : quantity.a - quantity.b;
    for (const double end : {quantity.a, quantity.b})
      if (std::isfinite(end)) quantity.scale = std::max(quantity.scale, std::abs(end));
    compare_histories(a.history, b.history, quantity);
    result.quantities.push_back(quantity);
  }
  for (const auto& entry : b.summary["quantities"].items())
    if (!a.summary["quantities"].contains(entry.key())) result.in_one_alone.push_back(entry.key());
  const auto has_fields = [](const std::string& directory) { return std::filesystem::exists(directory + "/fields/mesh.h5"); };
  if (has_fields(directory_a) && has_fields(directory_b)) result.fields = compare_fields(directory_a, directory_b);
  return result;
}

double largest_relative_difference(const RunComparison& comparison) {
  double largest = 0.0;
  const auto add = [&](double difference, double scale) {
    if (difference == 0.0) return;
    const double over = std::abs(difference) / scale;
    largest = std::isfinite(over) ? std::max(largest, over) : std::numeric_limits<double>::infinity();
  };
  for (const QuantityDifference& quantity : comparison.quantities) {
    add(quantity.difference, quantity.scale);
    add(quantity.largest_difference, quantity.scale);
  }
  if (comparison.fields)
    for (const FieldDifference& field : comparison.fields->fields) add(field.difference, field.scale);
  return largest;
}

std::string to_text(const RunComparison& comparison) {
  std::string text;
  for (const std::string& remark : comparison.remarks) text += remark + "\n";
  std::size_t width = 8;
  for (const QuantityDifference& quantity : comparison.quantities) width = std::max(width, quantity.name.size());
  if (comparison.fields)
    for (const FieldDifference& field : comparison.fields->fields) width = std::max(width, field.name.size());
  if (!comparison.quantities.empty())
    text += fmt::format("{:<{}}  {:>14} {:>14} {:>11} {:>9} {:>9}  {}\n", "quantity", width, "A", "B", "A - B", "of scale", "at most", "at time");
  for (const QuantityDifference& quantity : comparison.quantities)
    text += fmt::format("{:<{}}  {:>14.8g} {:>14.8g} {:>11.3g} {:>9} {:>9}  {}\n", quantity.name, width, quantity.a, quantity.b, quantity.difference,
                        relative(quantity.difference, quantity.scale), relative(quantity.largest_difference, quantity.scale),
                        quantity.largest_difference > 0.0 ? fmt::format("{:.6g}", quantity.time) : "-");
  if (comparison.fields && !comparison.fields->not_compared.empty()) text += "fields are not compared: " + comparison.fields->not_compared + "\n";
  if (comparison.fields && !comparison.fields->fields.empty()) {
    text += fmt::format("{:<{}}  {:>14} {:>9}  {:>9}  {}\n", "field", width, "|A - B|", "of scale", "at time", "where");
    for (const FieldDifference& field : comparison.fields->fields)
      text += fmt::format("{:<{}}  {:>14.6g} {:>9}  {:>9.6g}  {}\n", field.name, width, field.difference, relative(field.difference, field.scale),
                          field.time,
                          field.difference == 0.0 ? "-"
                                                  : fmt::format("{} {} at ({:.6g}, {:.6g}, {:.6g})", field.of_nodes ? "node" : "element", field.id,
                                                                field.place[0], field.place[1], field.place[2]));
  }
  const auto tell_alone = [&](const char* kind, const std::vector<std::string>& names) {
    for (const std::string& name : names) text += fmt::format("{} of one run alone: {}\n", kind, name);
  };
  tell_alone("quantity", comparison.in_one_alone);
  if (comparison.fields) tell_alone("field", comparison.fields->in_one_alone);
  return text;
}

}  // namespace mortise
