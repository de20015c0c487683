#include "repeated_course.hpp"

#include <algorithm>

namespace mortise::detail {

bool RepeatedCourse::add(const StepFailure& failure, const NewtonReport& report) {
  std::vector<std::array<long long, 2>> course;
  for (const NewtonIteration& iteration : report.iterations) course.push_back(iteration.norms.active_set);
  const bool changes = std::any_of(course.begin(), course.end(), [&](const auto& set) { return set != course.front(); });
  const bool counts = changes && (failure.kind() == FailureKind::too_many_iterations || failure.kind() == FailureKind::cycling_active_set ||
                                  failure.kind() == FailureKind::line_search);
  tries_ = counts && kind_ == failure.kind() && course == course_ ? tries_ + 1 : counts;
  kind_ = failure.kind();
  course_ = std::move(course);
  return tries_ >= enough;
}

}  // namespace mortise::detail
