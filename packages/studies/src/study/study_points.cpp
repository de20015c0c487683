#include "mortise/studies/study_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string.hpp>
#include <charconv>
#include <limits>

#include "mortise/core/names.hpp"

namespace mortise {
namespace {

using Labels = std::vector<std::string>;

/// More runs than these are a slip of the pen; to count them up takes long and much memory.
constexpr std::size_t most_combinations = 10000;

/// Labels of each axis that an entry of "exclude" is about; none: all of them.
std::vector<Labels> excluded(const Named<AssignmentList>& entry, const StudyFile& study, const std::vector<Labels>& labels,
                             std::vector<Diagnostic>& diagnostics) {
  std::vector<Labels> about(labels.size());
  const Labels axes = names_of(study.axes);
  for (const Assignment& one : entry.value.all) {
    const auto axis = std::find(axes.begin(), axes.end(), one.path) - axes.begin();
    if (axis == static_cast<long>(axes.size())) {
      diagnostics.push_back({one.place, unknown_name("axis", one.path, axes)});
      continue;
    }
    boost::algorithm::split(about[axis], one.value, boost::is_any_of(","));
    for (std::string& label : about[axis]) {
      boost::algorithm::trim(label);
      if (std::find(labels[axis].begin(), labels[axis].end(), label) == labels[axis].end())
        diagnostics.push_back({one.place, unknown_name("value of \"" + one.path + "\"", label, labels[axis])});
    }
  }
  return about;
}

void read_ranks(StudyPoint& point, const Assignment& said, std::vector<Diagnostic>& diagnostics) {
  const auto [end, error] = std::from_chars(said.value.data(), said.value.data() + said.value.size(), point.ranks);
  if (error != std::errc() || end != said.value.data() + said.value.size() || point.ranks < 1)
    diagnostics.push_back({said.place, fmt::format("\"ranks\" is \"{}\"; it has to be a whole number, 1 or more", said.value)});
}

void read_time_limit(StudyPoint& point, const Assignment& said, std::vector<Diagnostic>& diagnostics) {
  const auto [end, error] = std::from_chars(said.value.data(), said.value.data() + said.value.size(), point.time_limit);
  if (error != std::errc() || end != said.value.data() + said.value.size() || !(point.time_limit > 0.0))
    diagnostics.push_back({said.place, fmt::format("\"time limit\" is \"{}\"; it has to be a number of seconds above 0", said.value)});
}

void read_peer(StudyPoint& point, const Assignment& said, std::vector<Diagnostic>& diagnostics) {
  Labels known;
  for (const auto& [name, peer] : peer_names()) {
    known.push_back(name);
    if (name == said.value) point.peer = peer;
  }
  if (std::find(known.begin(), known.end(), said.value) == known.end()) diagnostics.push_back({said.place, unknown_name("peer", said.value, known)});
}

/// Takes "ranks", "peer", "peer penalty" and "time limit" out of the settings: they say how the scene is run and are no part of it.
void take_reserved(StudyPoint& point, std::vector<Diagnostic>& diagnostics) {
  std::vector<Assignment> others;
  const Assignment* ranks = nullptr;
  for (const Assignment& one : point.settings) {
    if (one.path == "ranks")
      read_ranks(point, *(ranks = &one), diagnostics);
    else if (one.path == "peer")
      read_peer(point, one, diagnostics);
    else if (one.path == "peer penalty")
      point.penalty = {one.value, one.place};
    else if (one.path == "time limit")
      read_time_limit(point, one, diagnostics);
    else
      others.push_back(one);
  }
  if (point.peer != Peer::none && point.ranks > 1) diagnostics.push_back({ranks->place, "a peer runs on one rank"});
  point.settings = std::move(others);
}

}  // namespace

std::vector<std::string> StudyPoint::words() const {
  std::vector<std::string> words;
  for (const Assignment& one : settings) words.push_back(one.path + "=" + one.value);
  return words;
}

std::string StudyPoint::label() const { return labels.empty() ? name : boost::algorithm::join(titles, ", "); }

std::vector<StudyPoint> study_points(const StudyFile& study, std::vector<Diagnostic>& diagnostics) {
  std::vector<std::vector<Named<AssignmentList>>> values;
  std::vector<Labels> labels;
  std::size_t combinations = 1;
  for (const auto& axis : study.axes) {
    values.push_back(axis.value.labelled());
    if (values.back().empty()) values.back().push_back({});  // said when it was read
    labels.push_back(names_of(values.back()));
    for (std::size_t i = 0; i < labels.back().size(); ++i)
      if (std::find(labels.back().begin(), labels.back().begin() + i, labels.back()[i]) != labels.back().begin() + i)
        diagnostics.push_back({values.back()[i].place, fmt::format("the value \"{}\" is given twice", labels.back()[i])});
    combinations = std::min(most_combinations + 1, combinations * std::min(most_combinations + 1, values.back().size()));
  }
  if (combinations > most_combinations) {
    diagnostics.push_back({study.axes.back().place, fmt::format("the axes make more than {} combinations, which is the most that a study may have; "
                                                                "please give fewer values, or make several studies of it",
                                                                most_combinations)});
    return {};
  }
  std::vector<std::vector<Labels>> excludes;
  for (const auto& entry : study.exclude) excludes.push_back(excluded(entry, study, labels, diagnostics));

  std::vector<StudyPoint> points;
  for (std::size_t combination = 0; combination < combinations; ++combination) {
    StudyPoint point;
    std::vector<std::size_t> of_axis(values.size());
    for (std::size_t axis = values.size(), rest = combination; axis-- > 0; rest /= values[axis].size()) of_axis[axis] = rest % values[axis].size();
    point.settings = study.settings.all;
    if (study.time_limit) point.time_limit = *study.time_limit;
    for (std::size_t axis = 0; axis < values.size(); ++axis) {
      const auto& value = values[axis][of_axis[axis]];
      point.labels.push_back(value.name);
      point.titles.push_back(study.axes[axis].value.choices.empty() ? study.axes[axis].name + " = " + value.name : value.name);
      point.name += (axis == 0 ? "" : ",") + name_for_files(study.axes[axis].name + "=" + value.name);
      point.settings.insert(point.settings.end(), value.value.all.begin(), value.value.all.end());
    }
    const bool left_out = std::any_of(excludes.begin(), excludes.end(), [&](const std::vector<Labels>& about) {
      for (std::size_t axis = 0; axis < about.size(); ++axis)
        if (!about[axis].empty() && std::find(about[axis].begin(), about[axis].end(), point.labels[axis]) == about[axis].end()) return false;
      return true;
    });
    if (left_out) continue;
    point.name = name_for_files(point.name);
    while (std::any_of(points.begin(), points.end(), [&](const StudyPoint& other) { return other.name == point.name; })) point.name += "+";
    take_reserved(point, diagnostics);
    points.push_back(std::move(point));
  }
  return points;
}

double evaluate(const Located<std::string>& source, const StudyPoint& point, const std::vector<double>& values, double dofs) {
  std::vector<std::string> names{"dofs"};
  std::vector<double> arguments{dofs};
  for (std::size_t i = 0; i < point.quantities.size(); ++i) {
    if (point.symbols.variables.count(point.quantities[i])) continue;  // the variable stands for itself
    names.push_back(point.quantities[i]);
    arguments.push_back(values[i]);
  }
  return parse_expression(names, source.value, point.symbols, source.place).at(arguments);
}

}  // namespace mortise
