#include "study_progress.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

namespace mortise {

StudyProgress::StudyProgress(const StudyPlan& plan, RunLog& log) : plan_(plan), log_(log), total_(plan.points.size() + (plan.finest ? 1 : 0)) {}

void StudyProgress::begin(const StudyPoint& point) { log_.detail(fmt::format("{}/{} {} ...", number_ + 1, total_, point.label())); }

void StudyProgress::end(const StudyPoint& point, const StudyRecord& record) {
  ++number_;
  if (!point.labels.empty() && std::isfinite(record.wall)) seconds_[level_of(point)].push_back(record.wall * plan_.file.repeats);
  std::string line = fmt::format("{}/{} {}: {}", number_, total_, point.label(), record.status());
  line += record.reused ? ", results of an earlier call" : std::isfinite(record.wall) ? fmt::format(", {:.2f} s", record.wall) : "";
  if (number_ < total_) line += left();
  log_.info(line);
  if (!record.finished()) log_.warning(fmt::format("{}: {}", point.label(), record.said.substr(record.said.find_last_of('\n') + 1)));
}

std::string StudyProgress::level_of(const StudyPoint& point) const { return point.labels[plan_.along]; }

std::string StudyProgress::left() const {
  double sum = 0.0;
  bool all = true;
  for (std::size_t i = number_ - (plan_.finest ? 1 : 0); i < plan_.points.size(); ++i) {
    const auto known = seconds_.find(level_of(plan_.points[i]));
    all &= known != seconds_.end();
    if (known != seconds_.end()) sum += std::accumulate(known->second.begin(), known->second.end(), 0.0) / static_cast<double>(known->second.size());
  }
  if (sum == 0.0) return "";
  return fmt::format("; {} {:.0f} s left", all ? "about" : "more than", std::ceil(sum));
}

}  // namespace mortise
