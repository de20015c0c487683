#include "hard/hard_verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <sstream>

namespace mortise {
namespace {

/// The last line that is a warning or an error of the program: mpirun adds lines of its own when ranks end with a code.
std::string reason_of(const StudyRecord& record) {
  std::string reason;
  std::istringstream said(record.said);
  for (std::string line; std::getline(said, line);) {
    if (line.rfind("warning: ", 0) == 0) reason = line.substr(std::string("warning: ").size());
    if (line.find("error: ") != std::string::npos) reason = line;
  }
  if (!reason.empty()) return reason;
  return record.said.empty() ? "it says nothing" : record.said.substr(record.said.find_last_of('\n') + 1);
}

/// Condition that does not hold after one of the steps; empty if all hold.
std::string broken_on_the_way(const HardCase& one, const HardLine& line, const HardOutcome& outcome) {
  if (one.always.value.empty()) return {};
  for (int row = 0; row < outcome.steps; ++row) {
    HardNames names;
    const auto cell = [&](const std::string& column) { return number_of(outcome.history.at(column)[static_cast<std::size_t>(row)]); };
    names.add("t", cell("time"));
    for (const auto& quantity : line.run.point.quantities) names.add(quantity, cell(quantity));
    const double holds = evaluate(one.always, line.run.point.symbols, names);
    if (!(holds != 0.0)) return fmt::format("after the step to t = {:g}, accepted, this does not hold: {}", cell("time"), one.always.value);
  }
  return {};
}

HardFigure measure(const Named<HardExpectation>& expectation, const Symbols& symbols, const HardNames& names) {
  const auto value = [&](const Located<std::string>& source) { return evaluate(source, symbols, names); };
  const HardExpectation& what = expectation.value;
  HardFigure figure;
  figure.name = expectation.name;
  figure.value = value(what.figure.value.empty() ? Located<std::string>{expectation.name, expectation.place} : what.figure);
  if (!what.value.value.empty()) {
    const double expected = value(what.value), bound = std::abs(value(what.bound));
    figure.near = true;
    figure.low = expected - bound, figure.high = expected + bound;
  }
  if (!what.low.value.empty()) figure.low = value(what.low);
  if (!what.high.value.empty()) figure.high = value(what.high);
  return figure;
}

std::string missed(const HardFigure& figure) { return fmt::format("{} is {:.6g}; expected: {}", figure.name, figure.value, figure.allowed()); }

}  // namespace

std::string to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::right:
      return "right";
    case Verdict::stopped:
      return "stopped with a true reason";
    default:
      return "wrong";
  }
}

double HardFigure::excess() const {
  if (!std::isfinite(value)) return std::numeric_limits<double>::infinity();
  if (std::isinf(low) || std::isinf(high)) return ok() ? 0.0 : std::numeric_limits<double>::infinity();
  const double half = 0.5 * (high - low);
  const double distance = std::abs(value - 0.5 * (low + high));
  return half > 0.0 ? distance / half : (distance > 0.0 ? std::numeric_limits<double>::infinity() : 0.0);
}

double HardFigure::room() const {
  if (std::isinf(low)) return std::abs(high);
  return std::isinf(high) ? std::abs(low) : 0.5 * (high - low);
}

std::string HardFigure::allowed() const {
  if (near) return fmt::format("{:.6g} within {:.2g}", 0.5 * (low + high), 0.5 * (high - low));
  if (std::isinf(low)) return fmt::format("at most {:.6g}", high);
  if (std::isinf(high)) return fmt::format("at least {:.6g}", low);
  return fmt::format("{:.6g} to {:.6g}", low, high);
}

const HardFigure* HardVerdict::worst() const {
  const auto found = std::max_element(figures.begin(), figures.end(), [](const auto& a, const auto& b) { return a.excess() < b.excess(); });
  return found == figures.end() ? nullptr : &*found;
}

HardVerdict judge(const Named<HardCase>& one, const HardLine& line, const HardOutcome& outcome, const std::vector<HardOutcome>& companions) {
  HardVerdict verdict;
  const HardCase& what = one.value;
  const StudyRecord& record = outcome.record;
  const bool ended = record.finished();
  if (ended || outcome.steps > 0) {
    HardNames names;
    outcome.name_figures(line.run, "", names);
    for (std::size_t c = 0; c < companions.size(); ++c) companions[c].name_figures(line.companions[c], what.companions[c].name + "_", names);
    if (ended || what.stop.required)
      for (const auto& expectation : what.expected) verdict.figures.push_back(measure(expectation, line.run.point.symbols, names));
  }
  const auto wrong = [&](const std::string& why) {
    verdict.verdict = Verdict::wrong;
    verdict.why = why;
    return verdict;
  };
  if (record.stopped_after) return wrong(record.status());
  const std::string broken = broken_on_the_way(what, line, outcome);
  if (!broken.empty()) return wrong(broken);
  if (!ended) {
    const bool true_code = std::find(what.stop.codes.begin(), what.stop.codes.end(), record.exit) != what.stop.codes.end();
    const bool is_true = true_code && !what.stop.reason.value.empty() && std::regex_search(record.said, std::regex(what.stop.reason.value));
    if (!is_true) return wrong(fmt::format("{}: {}", record.status(), reason_of(record)));
    if (!what.stop.required) {
      verdict.verdict = Verdict::stopped;
      verdict.why = reason_of(record);
      return verdict;
    }
  } else if (what.stop.required) {
    return wrong("it came to its end, but there is no answer");
  }
  for (std::size_t c = 0; c < companions.size(); ++c)
    if (!companions[c].record.finished())
      return wrong(fmt::format("nothing to compare with: \"{}\": {}: {}", what.companions[c].name, companions[c].record.status(),
                               reason_of(companions[c].record)));
  for (const HardFigure& figure : verdict.figures)
    if (!figure.ok()) return wrong(missed(figure));
  if (!record.missed_checks.empty()) return wrong(record.missed_checks.front());
  verdict.verdict = Verdict::right;
  if (!ended) verdict.why = reason_of(record);
  return verdict;
}

void compare_ranks(const HardVerdict& first, int first_ranks, HardVerdict& other) {
  if (other.verdict == Verdict::wrong) return;
  if (first.verdict != other.verdict && first.verdict != Verdict::wrong) {
    other.verdict = Verdict::wrong;
    other.why = fmt::format("on {} rank(s) it is {}", first_ranks, to_string(first.verdict));
    return;
  }
  for (std::size_t i = 0; i < std::min(first.figures.size(), other.figures.size()); ++i) {
    const HardFigure &a = first.figures[i], &b = other.figures[i];
    const double allowed = std::max(1e-6 * std::max(std::abs(a.value), std::abs(b.value)), 1e-3 * b.room());
    if (std::abs(a.value - b.value) <= allowed) continue;
    other.verdict = Verdict::wrong;
    other.why = fmt::format("{} is {:.9g}, on {} rank(s) {:.9g}", b.name, b.value, first_ranks, a.value);
    return;
  }
}

}  // namespace mortise
