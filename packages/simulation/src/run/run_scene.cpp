#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "model/contact_at_start.hpp"
#include "model/memory.hpp"
#include "model/precision.hpp"
#include "model/report_model.hpp"
#include "mortise/input/parameter_tree.hpp"
#include "mortise/io/csv_writer.hpp"
#include "mortise/io/field_writer.hpp"
#include "mortise/io/files.hpp"
#include "mortise/io/output_directory.hpp"
#include "mortise/simulation/model/model.hpp"
#include "mortise/simulation/model/run_log.hpp"
#include "mortise/simulation/run/jump_check.hpp"
#include "mortise/simulation/run/newton_table.hpp"
#include "mortise/simulation/run/run.hpp"
#include "mortise/simulation/run/state_check.hpp"
#include "mortise/simulation/run/step_evaluation.hpp"
#include "run/coarse_slave.hpp"
#include "run/explain_failure.hpp"
#include "run/explain_statics.hpp"
#include "run/limit_load.hpp"
#include "run/run_record.hpp"
#include "run/slip_settlement.hpp"
#include "run/surface_watch.hpp"
#include "run/timer_sums.hpp"
#include "run/turning_point.hpp"
#include "scene/history_columns.hpp"

namespace mortise {
namespace {

std::string effective_xml(const Scene& scene) {
  return to_scene_xml(collect_parameters(scene.name, scene, CollectParameters::What::values), symbol_lists(scene.symbols));
}

/// Everything that follows the steps: table, newton.csv, history.csv, profiles.csv, fields.
class Observers {
 public:
  Observers(const RCP<const Communicator>& comm, const Scene& scene, OutputDirectory& directory, const RCP<const Mesh>& mesh,
            StepEvaluation& evaluation, RunLog& log, RunRecord& record, const Timers& timers)
      : scene_(scene),
        evaluation_(evaluation),
        log_(log),
        record_(record),
        timers_(timers),
        newton_(comm, directory.claim("newton.csv"),
                {"step", "try", "time", "dt", "iteration", "momentum", "momentum_absolute", "gap", "complementarity", "increment", "step_length",
                 "active", "stick", "slip", "changed", "linear_iterations", "seconds", "undone"}),
        history_(comm, directory.claim("history.csv"), columns_with(evaluation)) {
    if (scene.output.contact_profiles)
      profiles_ =
          std::make_unique<CsvWriter>(comm, directory.claim("profiles.csv"),
                                      std::vector<std::string>{"time", "pair", "part", "arc_length", "x", "y", "pressure", "shear", "gap", "state"});
    if (!scene.output.fields.empty()) {
      for (const char* name : {"fields.h5", "fields.xdmf"}) directory.claim(name);
      fields_ = std::make_unique<FieldWriter>(mesh, directory.path());
    }
  }

  StepperObserver functions() {
    StepperObserver observer;
    observer.begin = [this](int step, double time, double dt) { begin(step, time, dt); };
    observer.iteration = [this](const NewtonIteration& iteration) { add(iteration); };
    observer.accepted = [this](const StepReport& report, const SystemEvaluation& at) { accept(report, at); };
    observer.undone = [this](const StepReport&, const StepFailure& failure) {
      const auto count = [](int value) { return static_cast<long long>(value); };
      if (last_iteration_.empty())  // it ended before the first residual
        last_iteration_ = {count(step_), count(try_), time_, dt_, count(0), "", "", "", "", "", "", "", "", "", "", "", "", ""};
      write_last_iteration(to_string(failure.kind()));
      log_.info(fmt::format("  step {} undone: {}", step_, failure.what()));
      ++try_;
    };
    return observer;
  }

  /// Writes fields and profiles of the last accepted state, if that has not been done.
  void finish(const std::function<SystemEvaluation()>& last_state) {
    if (record_.steps.empty()) return;
    const StepReport& last = record_.steps.back();
    const bool fields = fields_ && written_ != last.step, profiles = profiles_ && !is_output_time(last);
    if (!fields && !profiles) return;
    const SystemEvaluation at = last_state();
    if (fields) write_fields(last, at);
    if (profiles) write_profiles(last, at);
  }

 private:
  static std::vector<std::string> columns_with(const StepEvaluation& evaluation) {
    std::vector<std::string> columns = history_columns();
    for (const auto& name : evaluation.names()) columns.push_back(name);
    return columns;
  }

  void begin(int step, double time, double dt) {
    if (step != step_) try_ = 0;
    last_iteration_.clear();
    step_ = step, time_ = time, dt_ = dt;
    log_.info(step_header(step, time, scene_.stepping.end_time, dt));
    log_.info(newton_header());
  }

  void add(const NewtonIteration& iteration) {
    const auto timer = timers_.scope("output");
    const auto& norms = iteration.norms;
    log_.info(newton_line(iteration));
    const auto count = [](int value) { return static_cast<long long>(value); };
    write_last_iteration("");
    last_iteration_ = {count(step_),
                       count(try_),
                       time_,
                       dt_,
                       count(iteration.iteration),
                       norms.momentum,
                       norms.momentum_absolute,
                       norms.gap,
                       norms.complementarity,
                       iteration.increment,
                       iteration.step_length,
                       count(norms.active),
                       count(norms.sticking),
                       count(norms.active - norms.sticking),
                       count(norms.changed),
                       count(iteration.linear_iterations),
                       iteration.seconds,
                       ""};
  }

  /// An iteration's row waits for what follows, as the last one of a try that is undone says why.
  void write_last_iteration(const std::string& undone) {
    if (last_iteration_.empty()) return;
    last_iteration_.back() = undone;
    newton_.row(last_iteration_);
    last_iteration_.clear();
  }

  void accept(const StepReport& report, const SystemEvaluation& at) {
    const auto timer = timers_.scope("output");
    write_last_iteration("");
    record_.steps.push_back(report);
    const auto names = evaluation_.names();
    const auto values = evaluation_.quantities(at);
    std::vector<CsvValue> row{static_cast<long long>(report.step), report.time, static_cast<long long>(report.newton.newton_steps())};
    for (std::size_t i = 0; i < values.size(); ++i) {
      row.emplace_back(values[i]);
      record_.quantities[names[i]] = values[i];
    }
    history_.row(row);
    log_.info(step_footer(report, seconds_left(report.time)));
    if (is_output_time(report) || (scene_.output.every_step > 0 && report.step % scene_.output.every_step == 0)) write_fields(report, at);
    if (is_output_time(report)) write_profiles(report, at);
  }

  /// As if the rest of the scene's time went on as fast as what is done of it.
  double seconds_left(double time) const {
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin_;
    return taken.count() * (scene_.stepping.end_time - time) / time;
  }

  bool is_output_time(const StepReport& report) const {
    for (const double time : scene_.stepping.output_times)
      if (std::abs(report.time - time) <= 1e-12 * scene_.stepping.end_time) return true;
    return false;
  }

  void write_fields(const StepReport& report, const SystemEvaluation& at) {
    written_ = report.step;
    if (fields_) fields_->write(report.time, evaluation_.fields(at, scene_.output.fields));
  }

  void write_profiles(const StepReport& report, const SystemEvaluation& at) {
    if (!profiles_) return;
    const auto profiles = evaluation_.profiles(at);
    std::vector<std::vector<CsvValue>> rows;
    for (std::size_t pair = 0; pair < profiles.size(); ++pair)
      for (const ProfilePoint& point : profiles[pair])
        rows.push_back({report.time, scene_.contact[pair].name, static_cast<long long>(point.part), point.arc_length, point.x, point.y,
                        point.pressure, point.shear, point.gap, static_cast<long long>(point.state)});
    profiles_->rows(rows);
  }

  const Scene& scene_;
  StepEvaluation& evaluation_;
  RunLog& log_;
  RunRecord& record_;
  Timers timers_;
  CsvWriter newton_, history_;
  std::vector<CsvValue> last_iteration_;
  std::unique_ptr<FieldWriter> fields_;
  std::unique_ptr<CsvWriter> profiles_;
  int step_ = 0, try_ = 0, written_ = 0;
  double time_ = 0.0, dt_ = 0.0;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

bool is_input(const std::optional<StepFailure>& failure) { return failure && failure->kind() == FailureKind::input; }

ExitCode exit_code(const RunRecord& record, const std::optional<StepFailure>& failure) {
  if (!record.converged) return is_input(failure) ? ExitCode::invalid_input : ExitCode::not_converged;
  for (const auto& check : record.checks)
    if (!check.ok) return ExitCode::check_missed;
  return ExitCode::done;
}

void report_end(const RunRecord& record, const std::optional<StepFailure>& failure, const std::string& directory, RunLog& log) {
  for (const auto& name : record.quantity_order)
    if (const auto found = record.quantities.find(name); found != record.quantities.end()) log.info(fmt::format("{} = {:.10g}", name, found->second));
  for (const auto& check : record.checks) {
    check.ok ? log.info(check_line(check)) : log.warning(check_line(check));
  }
  for (const auto& [pair, load] : record.integration)
    if (load.segments > 0)
      log.info(fmt::format("contact {}: {} slave facets, {} overlaps; largest over mean work of the ranks {:.2f}{}", pair, load.facets, load.segments,
                           load.imbalance, load.redistributions > 0 ? fmt::format(", as owned {:.2f}", load.imbalance_as_owned) : ""));
  if (!record.converged)
    log.warning(fmt::format(
        "{}; the last converged state is that of time {:g}{}", is_input(failure) ? "stopped by an error of the input" : "not converged",
        record.steps.empty() ? 0.0 : record.steps.back().time, failure && !is_input(failure) ? fmt::format(": {}", failure->what()) : ""));
  int iterations = 0;
  for (const auto& step : record.steps) iterations += step.newton.newton_steps();
  const auto total = record.seconds.find("total");
  log.info(fmt::format("{} steps, {} Newton iterations, {:.2f} s, {:.0f} MiB; results in {}", record.steps.size(), iterations,
                       total == record.seconds.end() ? 0.0 : total->second, record.memory_peak_mib, directory));
}

}  // namespace

std::string default_directory(const std::string& file) { return "results/" + std::filesystem::path(file).stem().string(); }

ExitCode run_scene(const RCP<const Communicator>& comm, const Scene& scene, const RunOptions& options) {
  RunLog log(comm, options.verbosity);
  const Timers timers;
  OutputDirectory directory(comm, options.directory.empty() ? default_directory(options.scene) : options.directory,
                            {"run", options.scene, options.directory.empty()}, options.keep);
  const Model model(comm, scene, timers);
  SystemParts parts = model.parts();
  std::optional<SlipSettlement> settlement;
  if (SlipSettlement::is_needed(model)) {
    settlement.emplace(model);
    parts.better_start = [&](const SystemEvaluation& at) { return settlement->better_start(at); };
  }
  const SemiSmoothSystem system(std::move(parts), timers);
  StepEvaluation evaluation(scene, model, system);

  // From here on the scene is one that can be run: only now is anything made, and what an earlier run left makes room.
  directory.begin_run();
  log.open(directory.claim("log.txt"));
  report_model(options.scene, scene, model, log);
  report_precision(model, scene, log);
  report_contact_at_start(model, scene, log);
  report_memory(model, log);
  write_file(*comm, directory.claim("effective.xml"), [&] { return effective_xml(scene); });

  RunRecord record;
  record.scene = options.scene;
  record.version = options.version;
  record.settings = options.settings;
  record.quantity_order = evaluation.names();
  Observers observers(comm, scene, directory, model.mesh(), evaluation, log, record, timers);
  AcceptedState state = system.initial_state(Vector(system.map()));
  std::optional<SystemEvaluation> last;  // of `state`, in the step that led there; none while another step is tried
  std::optional<StepFailure> failure;
  // An overlap is taken up by the end of the first step. A try that is cut short takes up its share, as if the bodies were moved into one another.
  const double taken_up = std::min(scene.stepping.step, scene.stepping.end_time);
  const auto start_step = [&](const AcceptedState& from, double time, const Vector& d, Vector& z) {
    AcceptedState allowed = from;
    for (std::size_t pair = 0; pair < scene.contact.size(); ++pair)
      if (const double depth = model.surfaces_at_start().pairs[pair].overlap.depth; depth > 0.0)
        allowed.context.contact = model.contact()->allow_overlap(*allowed.context.contact, pair, depth * std::max(0.0, 1.0 - time / taken_up));
    return system.start_step(allowed, time, model.held_by_contact_only(), d, z);
  };
  {
    const auto timer = timers.scope("steps");
    StepperObserver functions = observers.functions();
    const auto warn = [&](const std::string& line) { log.warning(line); };
    std::optional<SurfaceWatch> surfaces;
    if (model.contact()) surfaces.emplace(model, scene, warn);
    std::optional<StateCheck> check;
    if (StateCheck::is_needed(model)) check.emplace(model, scene.newton.increment_tolerance * model.parts().length, warn);
    JumpCheck jump(model.parts().length);
    functions.verify = [&](const AcceptedState& from, const SystemEvaluation& found, int round) -> RCP<Vector> {
      if (surfaces) surfaces->examine(*system.displacement(found.x()), found.contact_laws());
      if (check) {
        const auto timer = timers.scope("state check");
        try {
          if (const RCP<Vector> other = check->verify(system, *from.x, found, round); !other.is_null()) return other;
        } catch (const StepFailure& far) {  // on every rank
          const StaticsReason statics = explain_statics(model, system, *from.x, found.context());
          if (statics.words.empty()) throw;
          throw StepFailure(far.kind(), fmt::format("{}; the state that was found is too far away: {}", statics.words, far.what()));
        }
      }
      jump.verify(*system.displacement(*from.x), *system.displacement(found.x()), found.context().time - from.context.time,
                  check && check->went_far());
      return Teuchos::null;
    };
    // Smaller tries of a step often end where less can be told: then what an earlier one showed is said again.
    std::string known;
    const double smallest = scene.stepping.minimum_step.value_or(scene.stepping.step / 1024.0);
    functions.explain = [&](const FailedTry& failed) -> std::string {
      if (failed.failure.kind() == FailureKind::input) return {};
      const StaticsReason statics = check ? explain_statics(model, system, *failed.from.x, failed.context) : StaticsReason{};
      if (statics.verdict == StaticsVerdict::falls) return known = statics.words;
      const bool may_hold = statics.verdict != StaticsVerdict::unknown;
      if (failed.time - failed.from.context.time < 2.0 * smallest)
        if (const std::string turns = explain_turning_point(failed, model, system); !turns.empty()) return known = turns;
      if (check && !check->refused().empty()) return known = check->refused() + "; put back, it found no equilibrium";
      // What Newton's last iterate says of motions is no reason where statics says that contact can hold the bodies.
      std::string explanation = settlement && !may_hold ? settlement->overload() : std::string();
      if (explanation.empty() && check && !may_hold) explanation = explain_failure(failed, model, system, check->record());
      if (explanation.empty()) explanation = explain_limit_load(failed, model, system);
      if (!explanation.empty()) return known = explanation;
      if (known.empty() && may_hold)
        return fmt::format("{}; Newton's method found no equilibrium; {}", statics.words,
                           describe_held_bodies(failed, model, system, check->record()));
      if (known.empty()) return check ? describe_held_bodies(failed, model, system, check->record()) : known;
      return known + "; so an earlier try of this step";
    };
    functions.begin = [&, begin = functions.begin](int step, double time, double dt) {
      last.reset();
      begin(step, time, dt);
    };
    functions.accepted = [&, accepted = functions.accepted](const StepReport& report, const SystemEvaluation& at) {
      last = at;
      known.clear();
      if (surfaces) surfaces->accept();
      jump.accept();
      accepted(report, at);
    };
    // What is pushed apart does not go on: predicted, it would let all nodes of a press fit slip.
    const auto& at_start = model.surfaces_at_start().pairs;
    const bool begins_pressed = std::any_of(at_start.begin(), at_start.end(), [](const PairAtStart& pair) { return pair.overlap.depth > 0.0; });
    functions.predict = [&](const Vector& at, double dt, Vector& rate) {
      if (begins_pressed && (record.steps.empty() || record.steps.back().time < taken_up)) {
        rate.putScalar(0.0);
        return;
      }
      if (check) check->without_free_motions(system, at, dt, rate);
    };
    if (check) {
      functions.begin = [&, begin = functions.begin](int step, double time, double dt) {
        check->begin();
        if (settlement) settlement->begin();
        begin(step, time, dt);
      };
      functions.accepted = [&, accepted = functions.accepted](const StepReport& report, const SystemEvaluation& at) {
        check->accept();
        accepted(report, at);
      };
    }
    try {
      record.converged = run_steps(system, scene.stepping, scene.newton, state, start_step, functions, failure);
      // On its way in a corner passes through a part of a facet before contact begins; a run that ends there has not found its force.
      if (record.converged && surfaces && !surfaces->without_force().empty()) {
        failure.emplace(FailureKind::lost_contact, surfaces->without_force() + "; please make the slave finer there, or exchange slave and master");
        record.converged = false;
      }
      if (record.converged && model.contact())
        for (const std::string& line : slaves_too_coarse(model, scene, *system.displacement(*state.x), last->contact_laws())) log.warning(line);
    } catch (const InputError& error) {  // on every rank: a quantity's expression without a value
      failure.emplace(FailureKind::input, error.what());
    }
    observers.finish([&] { return last ? *last : system.evaluate_at(state, *system.multipliers(*state.x), state.context); });
  }
  if (!record.steps.empty()) record.checks = evaluate_checks(scene.checks, record.quantities);
  record.exit = exit_code(record, failure);

  for (std::size_t pair = 0; pair < scene.contact.size(); ++pair)
    record.integration.emplace_back(scene.contact[pair].name, model.contact()->integration_load(pair));

  timers.stacked().stopBaseTimer();
  record.seconds = seconds_by_name(timers, comm);
  const double mine = peak_memory_mib();
  Teuchos::reduceAll(*comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(record.memory_peak_mib));
  Teuchos::reduceAll(*comm, Teuchos::REDUCE_SUM, mine, Teuchos::outArg(record.memory_total_mib));
  log.detail(timer_report(timers, comm));
  report_end(record, failure, directory.path(), log);
  write_file(*comm, directory.claim("summary.json"), [&, json = summary(record, model, state.context.contact)] {
    return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  });
  if (is_input(failure)) throw *failure;
  return record.exit;
}

}  // namespace mortise
