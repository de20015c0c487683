#include <CLI/CLI.hpp>
#include <charconv>
#include <memory>

#include "declarations.hpp"
#include "mortise/studies/scale.hpp"
#include "program.hpp"

namespace mortise {
namespace {

/// "n" or "n:4".
WeakVariable weak_variable(const std::string& text) {
  WeakVariable variable{text.substr(0, text.find(':')), 1};
  if (variable.name == text) return variable;
  const char *begin = text.data() + variable.name.size() + 1, *end = text.data() + text.size();
  const auto [last, error] = std::from_chars(begin, end, variable.multiple);
  if (error != std::errc() || last != end || variable.multiple < 1) throw CLI::ValidationError("--weak", "a multiple is a whole number above 0");
  return variable;
}

}  // namespace

void add_scale_command(CLI::App& app, Program& program) {
  auto* command = app.add_subcommand("scale", "how a scene scales: run it on growing numbers of ranks, or plan it for more than there are");
  const auto options = std::make_shared<ScaleOptions>();
  options->version = version();
  options->ranks = cores();
  command->add_option("SCENE", options->scene, "scene file")->required()->type_name(xml_value);
  add_settings(*command, options->settings);
  add_directory(*command, options->directory, "directory for the report and all runs; default: results/<name of the file SCENE>-scale");
  auto* ranks = command->add_option("--ranks", options->ranks, "most ranks; the series is 1, 2, 4 ... up to it; default: the cores of this machine")
                    ->check(CLI::Range(1, 4096));
  auto* repeats =
      command->add_option("--repeats", options->repeats, "runs of each point, of which the fastest counts; default: 1")->check(CLI::Range(1, 100));
  auto* weak =
      command
          ->add_option_function<std::string>(
              "--weak", [options](const std::string& text) { options->weak = weak_variable(text); },
              "a weak series as well: this variable grows with the ranks to the power 1/dimension, rounded to a whole number, or to a multiple "
              "(n:4)")
          ->type_name("NAME[:MULTIPLE]");
  auto* plan = command->add_option("--plan", options->plan, "share the scene out to so many ranks and run nothing")
                   ->type_name("RANKS")
                   ->check(CLI::Range(1, 4096));
  for (auto* other : {ranks, repeats, weak}) plan->excludes(other);
  command->add_flag_callback(
      "--quiet", [options] { options->verbosity = Verbosity::quiet; }, "say nothing but warnings and errors");
  command->footer(
      "Leaves scale.csv, scale.json, scale.svg, report.html, which needs no other file, and DIR/runs with the results of each run; with --plan: "
      "plan.csv,\nplan.json and plan.svg. A run that fails does not stop the others.\n"
      "Exit codes: 2 if the scene is invalid; 3 if a run failed.\n"
      "Examples: mortise scale inputs/scaling/pressed_blocks.xml --set variables/n=16 --weak n:4 -o scale\n"
      "          mortise scale inputs/scaling/pressed_blocks.xml --set variables/n=128 --plan 1024");
  command->callback([&program, options] {
    program.launches = options->plan == 0;
    program.action = [&program, options] { return options->plan > 0 ? plan_scale(program.comm, *options) : run_scale(program.comm, *options); };
  });
}

}  // namespace mortise
