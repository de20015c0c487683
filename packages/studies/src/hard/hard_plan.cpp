#include "hard/hard_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>

#include "mortise/core/names.hpp"
#include "mortise/input/read_parameters.hpp"
#include "mortise/input/xml.hpp"
#include "mortise/simulation/scene/file_kind.hpp"
#include "mortise/simulation/scene/read_scene.hpp"
#include "mortise/simulation/scene/scene.hpp"
#include "shared/distinct_files.hpp"
#include "shared/throw_all.hpp"

namespace mortise {
namespace {

/// Scenes by path, each read once.
class Scenes {
 public:
  Scenes(const Communicator& comm, const std::string& ledger) : comm_(comm), folder_(std::filesystem::path(ledger).parent_path()) {}

  /// The file, its text, and what make_scene says of it under the point's settings. The point gets names of its quantities and its symbols; of a
  /// scene that may be refused under its settings those that it has without.
  HardRun complete(const Located<std::string>& scene, StudyPoint point, bool may_be_refused, std::vector<Diagnostic>& diagnostics) {
    HardRun run{(folder_ / scene.value).string(), {}, std::move(point)};
    run.point.settings.insert(run.point.settings.begin(), {"output/fields", "", scene.place});
    try {
      const Read& read = find(run.scene);
      run.text = read.text;
      const Scene made = [&] {
        XmlList changed = read.root;
        for (const Assignment& one : run.point.settings) apply_override(changed, one.path, one.value, one.place);
        if (!may_be_refused) return make_scene(changed);
        try {
          return make_scene(changed);
        } catch (const InputError&) {
          return make_scene(read.root);
        }
      }();
      run.point.quantities = names_of(made.quantities);
      run.point.symbols = made.symbols;
    } catch (const InputError& error) {
      diagnostics.insert(diagnostics.end(), error.diagnostics().begin(), error.diagnostics().end());
    } catch (const FileError& error) {
      diagnostics.push_back({scene.place, error.what()});
    }
    return run;
  }

 private:
  struct Read {
    std::string text;
    XmlList root;
  };
  const Read& find(const std::string& path) {
    const auto known = read_.find(path);
    if (known != read_.end()) return known->second;
    const std::string text = read_text(comm_, path);
    return read_[path] = Read{text, parse_xml(text, path)};
  }

  const Communicator& comm_;
  std::filesystem::path folder_;
  std::map<std::string, Read> read_;
};

StudyFile as_study(const HardFile& ledger, const HardCase& one) {
  StudyFile study;
  study.settings = one.settings;
  study.axes = one.axes;
  study.time_limit = ledger.time_limit;
  return study;
}

/// The companion's run beside a run of the case: its settings on top, as a choice of one value, so that "time limit" is taken out of them.
StudyPoint companion_point(const HardCase& one, const Named<HardCompanion>& companion, const StudyPoint& beside,
                           std::vector<Diagnostic>& diagnostics) {
  StudyFile study;
  study.time_limit = beside.time_limit;
  if (companion.value.scene.value.empty()) study.settings.all = companion.value.follows_axes ? beside.settings : one.settings.all;
  study.axes.push_back({companion.name, companion.place, {}});
  study.axes.back().value.choices.push_back({companion.name, companion.place, companion.value.settings});
  return study_points(study, diagnostics).front();
}

/// Expressions that mean nothing. Values of names do not matter.
void check_expressions(const Named<HardCase>& one, const HardLine& line, std::vector<Diagnostic>& diagnostics) {
  HardNames names, during;
  for (const char* name : {"t", "steps", "iterations", "cutbacks", "output_seconds"}) names.add(name, 1.0);
  during.add("t", 1.0);
  for (const auto& quantity : line.run.point.quantities) names.add(quantity, 1.0), during.add(quantity, 1.0);
  for (std::size_t c = 0; c < line.companions.size(); ++c) {
    const std::string prefix = one.value.companions[c].name + "_";
    for (const char* name : {"t", "steps", "iterations", "cutbacks", "output_seconds"}) names.add(prefix + name, 1.0);
    for (const auto& quantity : line.companions[c].point.quantities) names.add(prefix + quantity, 1.0);
  }
  const auto attempt = [&](const Located<std::string>& source, const HardNames& known) {
    if (source.value.empty()) return;
    try {
      evaluate(source, line.run.point.symbols, known);
    } catch (const InputError& error) {
      diagnostics.insert(diagnostics.end(), error.diagnostics().begin(), error.diagnostics().end());
    }
  };
  attempt(one.value.always, during);
  for (const auto& [name, place, expectation] : one.value.expected) {
    const auto& quantities = line.run.point.quantities;
    if (expectation.figure.value.empty() && std::find(quantities.begin(), quantities.end(), name) == quantities.end())
      diagnostics.push_back({place, unknown_name("quantity", name, quantities)});
    for (const auto* source : {&expectation.figure, &expectation.value, &expectation.bound, &expectation.low, &expectation.high})
      attempt(*source, names);
  }
  try {
    const std::regex reason(one.value.stop.reason.value);
  } catch (const std::regex_error& error) {
    diagnostics.push_back(
        {one.value.stop.reason.place, fmt::format("\"{}\" is no regular expression: {}", one.value.stop.reason.value, error.what())});
  }
}

/// Cases and companions whose runs would share a directory, also of cases that are not chosen: their runs may be there already.
void check_directories(const HardFile& ledger, const std::vector<int>& ranks, std::vector<Diagnostic>& diagnostics) {
  DistinctFiles directories;
  for (const std::string& page : hard_pages()) directories.reserve(page, "a page of the ledger");
  for (const auto& one : ledger.cases) {
    directories.add(one.name, one.place, diagnostics);
    DistinctFiles below;
    for (const int count : ranks) below.reserve(run_name(count), fmt::format("the run on {} rank(s)", count));
    for (const auto& companion : one.value.companions) below.add(companion.name, companion.place, diagnostics);
  }
}

bool is_chosen(const Named<HardCase>& one, const HardOptions& options) {
  if (options.only.empty()) return options.sweeps || one.value.axes.empty();
  return std::regex_search(one.name, std::regex(options.only));
}

}  // namespace

double evaluate(const Located<std::string>& source, const Symbols& symbols, const HardNames& names) {
  std::vector<std::string> arguments;
  std::vector<double> values;
  for (std::size_t i = 0; i < names.names.size(); ++i) {
    if (symbols.variables.count(names.names[i])) continue;  // the variable stands for itself
    arguments.push_back(names.names[i]);
    values.push_back(names.values[i]);
  }
  return parse_expression(arguments, source.value, symbols, source.place).at(values);
}

const std::vector<std::string>& hard_pages() {
  static const std::vector<std::string> pages{"ledger.csv", "hard-cases.md", "hard-cases.html"};
  return pages;
}

std::string run_name(int ranks) { return fmt::format("np{}", ranks); }

HardPlan read_hard(const Communicator& comm, const HardOptions& options) {
  const XmlList root = parse_xml(read_text(comm, options.ledger), options.ledger);
  refuse_other_kinds(root, FileKind::ledger);
  std::vector<Diagnostic> diagnostics;
  HardFile ledger;
  read_parameters(ledger, root, {}, {}, diagnostics);
  throw_all(diagnostics);

  check_directories(ledger, options.ranks, diagnostics);
  HardPlan plan;
  Scenes scenes(comm, options.ledger);
  for (const auto& one : ledger.cases) {
    if (!is_chosen(one, options)) continue;
    plan.cases.push_back(one);
    const std::vector<double>& codes = one.value.stop.codes;
    const bool may_be_refused =
        !one.value.stop.reason.value.empty() && std::find(codes.begin(), codes.end(), static_cast<double>(ExitCode::invalid_input)) != codes.end();
    DistinctFiles lines;
    for (const StudyPoint& point : study_points(as_study(ledger, one.value), diagnostics)) {
      HardLine line{
          plan.cases.size() - 1, point.labels.empty() ? "" : point.label(), scenes.complete(one.value.scene, point, may_be_refused, diagnostics), {}};
      for (const auto& companion : one.value.companions) {
        const StudyPoint beside = companion_point(one.value, companion, point, diagnostics);
        const Located<std::string>& scene = companion.value.scene;
        line.companions.push_back(scenes.complete(scene.value.empty() ? one.value.scene : scene, beside, false, diagnostics));
      }
      lines.add(line.label, one.place, diagnostics);
      check_expressions(one, line, diagnostics);
      plan.lines.push_back(std::move(line));
    }
  }
  throw_all(diagnostics);
  if (plan.lines.empty()) throw InputError(root.place, fmt::format("no case has a name that matches \"{}\"", options.only));
  return plan;
}

}  // namespace mortise
