#include "study/study_progress.hpp"

#include <fmt/format.h>

#include <boost/algorithm/string/predicate.hpp>
#include <cmath>
#include <map>

namespace mortise {
namespace {

/// "; about 12 s left"; nothing if nothing is left, or nothing is known of it.
std::string left(const StudyPlan& plan, const std::vector<StudyPoint>& points, const std::vector<std::optional<StudyRecord>>& records) {
  struct Mean {
    double sum = 0.0;
    int count = 0;
  };
  std::map<std::string, Mean> seconds;  // by the label on the axis "along"; "" is the finest run
  const auto level = [&](const StudyPoint& point) { return point.labels.empty() ? "" : point.labels[plan.along]; };
  for (std::size_t i = 0; i < points.size(); ++i)
    if (records[i] && std::isfinite(records[i]->wall)) seconds[level(points[i])].sum += records[i]->wall, ++seconds[level(points[i])].count;
  double sum = 0.0;
  bool all = true;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (records[i]) continue;
    const auto known = seconds.find(level(points[i]));
    all &= known != seconds.end();
    if (known != seconds.end()) sum += plan.file.repeats * known->second.sum / known->second.count;
  }
  return sum > 0.0 ? fmt::format("; {} {:.0f} s left", all ? "about" : "more than", std::ceil(sum)) : "";
}

}  // namespace

void log_progress(const StudyPlan& plan, const std::vector<StudyPoint>& points, const std::vector<std::optional<StudyRecord>>& records,
                  std::size_t number, RunLog& log) {
  const StudyRecord& record = *records[number];
  std::string line = fmt::format("{}/{} {}: {}", number + 1, points.size(), points[number].label(), record.status());
  if (record.reused) line += ", results of an earlier call";
  if (!record.reused && std::isfinite(record.wall)) line += fmt::format(", {:.2f} s", record.wall);
  log.info(line + left(plan, points, records));
  std::string reason = record.said.substr(record.said.find_last_of('\n') + 1);
  if (boost::starts_with(reason, "warning: ")) reason.erase(0, std::string("warning: ").size());
  if (!record.finished()) log.warning(fmt::format("{}: {}", points[number].label(), reason));
}

}  // namespace mortise
