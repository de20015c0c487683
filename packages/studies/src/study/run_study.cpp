#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "mortise/core/names.hpp"
#include "mortise/io/files.hpp"
#include "mortise/io/output_directory.hpp"
#include "mortise/simulation/model/run_log.hpp"
#include "mortise/simulation/run/run.hpp"
#include "mortise/studies/study.hpp"
#include "shared/draw_plot.hpp"
#include "shared/plot_scripts.hpp"
#include "study/study_progress.hpp"
#include "study/study_report.hpp"

namespace mortise {
namespace {

const std::vector<std::string> reports{"study.csv", "study.json", "report.html", "field-errors.json", "plots"};

/// Registers what study_page draws.
void claim_plots(OutputDirectory& plots, const StudyFile& study) {
  for (const char* name : {"cost.svg", "newton.svg"}) plots.claim(name);
  for (const auto& quantity : study.quantities)
    for (const char* what : {"error_", "time_"}) plots.claim(what + name_for_files(quantity.name) + ".svg");
}

}  // namespace

ExitCode run_study(const RCP<const Communicator>& comm, const StudyOptions& options) {
  RunLog log(comm, options.verbosity);
  const StudyPlan plan = read_study(*comm, options.study, options.settings);
  require_launcher(options.launcher);
  OutputDirectory directory(comm, options.directory.empty() ? default_directory(options.study) : options.directory,
                            {"study", options.study, options.directory.empty()});
  const std::string page = directory.file("report.html"), scene = directory.file("scene.xml");
  require_page_python(*comm, page);
  std::vector<std::string> names = reports;
  names.insert(names.end(), {"scene.xml", "points", "finest"});
  directory.open(names);
  for (const auto& old : options.fresh ? names : reports) directory.remove(old);
  OutputDirectory points = directory.subdirectory("points");
  write_file(*comm, directory.claim("scene.xml"), [&] { return plan.scene_text; });

  StudyResults results;
  const std::vector<StudyCurve> curves = study_curves(plan);
  const StudyMeasuring measuring{*comm, plan, results, curves, directory.path()};
  std::vector<StudyPoint> runs = plan.points;
  if (plan.finest) runs.insert(runs.begin(), *plan.finest);
  const auto how = [&](const StudyPoint& point) {
    return StudyPointOptions{scene, plan.scene_text, measuring.directory_of(point), options.version, plan.file.repeats, options.launcher};
  };
  std::vector<std::optional<StudyRecord>> records;
  for (const StudyPoint& point : runs) records.push_back(earlier_record(*comm, point, how(point)));
  for (std::size_t i = 0; i < runs.size(); ++i) {
    (runs[i].labels.empty() ? directory : points).subdirectory(runs[i].name);
    if (!records[i]) records[i] = run_point(*comm, runs[i], how(runs[i]));
    log_progress(plan, runs, records, i, log);
  }
  if (plan.finest) results.finest = *records.front();
  for (std::size_t i = plan.finest ? 1 : 0; i < runs.size(); ++i) results.points.push_back(*records[i]);
  results.h = mesh_sizes(plan, results.points);

  OutputDirectory plots = directory.subdirectory("plots");
  claim_plots(plots, plan.file);
  for (const char* name : {"field-errors.json", "report.html"}) directory.claim(name);
  const std::vector<StudyErrors> errors = study_errors(measuring);
  directory.remove("field-errors.json");
  std::vector<StudyConclusions> conclusions;
  for (const auto& one : errors) conclusions.push_back(conclude(plan, results, curves, one));
  write_study_table(comm, directory.claim("study.csv"), plan, results, errors);
  write_json(*comm, directory.claim("study.json"), study_json(options, plan, results, curves, errors, conclusions));
  draw_plot(*comm, std::string(page_needs) + study_page, {directory.path()}, page);
  plots.strike_missing();
  for (std::size_t q = 0; q < errors.size(); ++q) log.info(sentence(plan, results, errors[q], conclusions[q]));
  log.info("the page: " + page);
  const auto well = [](const StudyRecord& one) { return one.finished() || one.excused(); };
  const bool finished = std::all_of(results.points.begin(), results.points.end(), well);
  return finished && (!results.finest || results.finest->finished()) ? ExitCode::done : ExitCode::not_converged;
}

}  // namespace mortise
