#include "stepping/repeated_course.hpp"

#include <algorithm>
#include <cctype>

namespace mortise::detail {
namespace {

bool is_of_evaluation(FailureKind kind) {
  return kind != FailureKind::too_many_iterations && kind != FailureKind::cycling_active_set && kind != FailureKind::line_search;
}

/// True if a number with decimals is among the words: it would change with the step if anything did.
bool has_decimals(const std::string& words) {
  for (std::size_t at = 1; at + 1 < words.size(); ++at)
    if (words[at] == '.' && std::isdigit(static_cast<unsigned char>(words[at - 1])) && std::isdigit(static_cast<unsigned char>(words[at + 1])))
      return true;
  return false;
}

}  // namespace

bool RepeatedCourse::add(const StepFailure& failure, const NewtonReport& report) {
  std::vector<std::array<long long, 2>> course;
  for (const NewtonIteration& iteration : report.iterations) course.push_back(iteration.norms.active_set);
  const bool changes = std::any_of(course.begin(), course.end(), [&](const auto& set) { return set != course.front(); });
  const bool counts = changes && !is_of_evaluation(failure.kind());
  tries_ = counts && kind_ == failure.kind() && course == course_ ? tries_ + 1 : counts;
  const std::string words = failure.what();
  alike_ = has_decimals(words) && kind_ == failure.kind() && words == words_ ? alike_ + 1 : 1;
  words_ = words;
  kind_ = failure.kind();
  course_ = std::move(course);
  return tries_ >= enough || alike_ >= enough;
}

}  // namespace mortise::detail
