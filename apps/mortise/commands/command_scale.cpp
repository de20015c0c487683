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
  options->cores = cores();
  const auto harvest = std::make_shared<std::string>();
  auto* scene = command->add_option("SCENE", options->scene, "scene file; not with --harvest")->type_name(xml_value);
  add_settings(*command, options->settings);
  add_directory(*command, options->directory, "directory for the report and all runs; default: results/<name of the file SCENE>-scale");
  add_launcher(*command, options->launcher);
  auto* ranks = command
                    ->add_option("--ranks", options->ranks,
                                 "most ranks; the series is 1, 2, 4 ... up to it; default: the cores of this machine, or of a node with --batch")
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
  auto* machine = command
                      ->add_option("--machine", options->machine,
                                   "machine file, for --plan and --batch: cores, memory and measured rates; `mortise describe machine`")
                      ->type_name(xml_value);
  auto* batch = command->add_option("--batch", "write job scripts for this scheduler and run nothing; takes --machine")
                    ->check(one_of("scheduler", {"slurm"}))
                    ->option_text("SCHEDULER")
                    ->needs(machine);
  command->add_option("--harvest", *harvest, "report the runs of jobs that --batch wrote in this directory, as far as they are")
      ->type_name(directory_value)
      ->excludes(scene);
  for (auto* other : {ranks, repeats, weak, batch}) plan->excludes(other);
  command->add_flag_callback(
      "--quiet", [options] { options->verbosity = Verbosity::quiet; }, "say nothing but warnings and errors");
  command->footer(
      "Leaves scale.csv, scale.json, scale.svg, report.html, which needs no other file, and DIR/runs with the results of each run; with --plan: "
      "plan.csv,\nplan.json and plan.svg. A run that fails does not stop the others. --batch leaves jobs/, submit.sh and scale-jobs.json.\n"
      "Exit codes: 2 if the scene is invalid; 3 if a run failed.\n"
      "Examples: mortise scale inputs/scaling/pressed_blocks.xml --set variables/n=16 --weak n:4 -o scale\n"
      "          mortise scale inputs/scaling/pressed_blocks.xml --set variables/n=128 --plan 1024 --machine scale/machine.xml\n"
      "          mortise scale inputs/scaling/pressed_blocks.xml --set variables/n=32 --ranks 256 --batch slurm --machine cluster.xml -o jobs\n"
      "          mortise scale --harvest jobs");
  command->callback([&program, options, harvest, scene, batch, machine] {
    if (!harvest->empty()) {
      program.launches = true;
      program.action = [&program, options, harvest] { return harvest_scale(program.comm, *harvest, options->verbosity); };
      return;
    }
    if (scene->count() == 0) throw CLI::RequiredError("SCENE");
    const bool writes_jobs = batch->count() > 0;
    if (machine->count() > 0 && !writes_jobs && options->plan == 0) throw CLI::ValidationError("--machine", "goes with --plan or --batch");
    program.launches = options->plan == 0 && !writes_jobs;
    program.action = [&program, options, writes_jobs] {
      if (writes_jobs) return write_scale_jobs(program.comm, *options);
      if (options->plan > 0) return plan_scale(program.comm, *options);
      if (options->ranks == 0) options->ranks = options->cores;
      return run_scale(program.comm, *options);
    };
  });
}

}  // namespace mortise
