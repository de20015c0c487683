#include <CLI/CLI.hpp>
#include <memory>

#include "declarations.hpp"
#include "mortise/studies/study.hpp"
#include "program.hpp"

namespace mortise {

void add_study_command(CLI::App& app, Program& program) {
  auto* command = app.add_subcommand("study", "what accuracy costs: run a scene under many settings, draw errors against mesh size and time");
  const auto options = std::make_shared<StudyOptions>();
  options->version = version();
  command->add_option("STUDY", options->study, "study file")->required()->type_name(xml_value);
  add_directory(*command, options->directory, "directory for the report and the results of all runs; default: results/<name of the file STUDY>");
  add_settings(*command, options->settings,
               "replace a value of the study: path=value, e.g. axes/n/values='4, 8', settings/variables/mu=0.2; may be repeated");
  add_launcher(*command, options->launcher);
  command->add_flag("--fresh", options->fresh, "forget what DIR holds; otherwise runs that an earlier call finished are not repeated");
  command->add_flag_callback(
      "--quiet", [options] { options->verbosity = Verbosity::quiet; }, "say nothing but warnings and errors");
  command->footer(
      "Leaves study.csv, study.json, report.html, which needs no other file, and DIR/points with the results of each run. A run that fails does not\n"
      "stop the others. May be killed at any time: called again, it runs what is missing. `mortise describe study` says what a study file may say.\n"
      "Exit codes: 2 if the study is invalid, with all that is wrong with it; 3 if a run failed.\n"
      "Example: mortise study inputs/studies/hertz_elastic.xml -o study");
  command->callback([&program, options] {
    program.launches = true;
    program.action = [&program, options] { return run_study(program.comm, *options); };
  });
}

}  // namespace mortise
