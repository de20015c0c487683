#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "model/contact_at_start.hpp"
#include "model/edge_contact.hpp"
#include "model/precision.hpp"
#include "model/report_model.hpp"
#include "mortise/core/memory.hpp"
#include "mortise/input/parameter_tree.hpp"
#include "mortise/io/files.hpp"
#include "mortise/io/output_directory.hpp"
#include "mortise/mesh/file_mesh.hpp"
#include "mortise/simulation/model/model.hpp"
#include "mortise/simulation/model/run_log.hpp"
#include "mortise/simulation/run/jump_check.hpp"
#include "mortise/simulation/run/run.hpp"
#include "mortise/simulation/run/stability_check.hpp"
#include "mortise/simulation/run/state_check.hpp"
#include "mortise/simulation/run/step_evaluation.hpp"
#include "run/checkpoints.hpp"
#include "run/coarse_crossing.hpp"
#include "run/coarse_slave.hpp"
#include "run/explain_failure.hpp"
#include "run/explain_statics.hpp"
#include "run/limit_load.hpp"
#include "run/motion_hold.hpp"
#include "run/parts_apart.hpp"
#include "run/restart.hpp"
#include "run/run_output.hpp"
#include "run/run_record.hpp"
#include "run/scene_changes.hpp"
#include "run/slip_settlement.hpp"
#include "run/start_rule.hpp"
#include "run/stop_request.hpp"
#include "run/surface_watch.hpp"
#include "run/timer_sums.hpp"
#include "run/turning_point.hpp"
#include "run/watchdog.hpp"

namespace mortise {
namespace {

std::string effective_xml(const Scene& scene) {
  return to_scene_xml(collect_parameters(scene.name, scene, CollectParameters::What::values), symbol_lists(scene.symbols));
}

bool is_input(const std::optional<StepFailure>& failure) { return failure && failure->kind() == FailureKind::input; }

/// Why a step failed tells more than what could not be written after it.
ExitCode exit_code(const RunRecord& record, const std::optional<StepFailure>& failure, bool is_written) {
  if (failure && failure->kind() == FailureKind::out_of_memory) return ExitCode::memory;
  if (failure) return is_input(failure) ? ExitCode::invalid_input : ExitCode::not_converged;
  if (!is_written) return ExitCode::files;
  if (!record.converged) return ExitCode::not_converged;
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
    log.warning(fmt::format("{}; the last converged state is that of time {:g}{}",
                            record.stopped      ? "stopped by " + *record.stopped
                            : is_input(failure) ? "stopped by an error of the input"
                                                : "not converged",
                            record.time, failure && !is_input(failure) ? fmt::format(": {}", failure->what()) : ""));
  const auto total = record.seconds.find("total");
  log.info(fmt::format("{} steps, {} Newton iterations, {:.2f} s, {:.0f} MiB; results in {}", record.steps, record.newton_steps,
                       total == record.seconds.end() ? 0.0 : total->second, record.memory_peak_mib, directory));
}

/// Results of an earlier run in the directory make room for the next: a mesh file among them would be gone.
void refuse_meshes_in(const Scene& scene, const std::string& directory) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path results = fs::weakly_canonical(directory, error);
  for (const auto& body : scene.bodies) {
    const auto* mesh = dynamic_cast<const FileMesh*>(body.value.mesh.options.get());
    if (mesh == nullptr) continue;
    const fs::path file = fs::weakly_canonical(mesh->file.value, error);
    if (std::mismatch(results.begin(), results.end(), file.begin(), file.end()).first == results.end())
      throw InputError(
          mesh->file.place,
          fmt::format("the mesh file {} lies in the directory of the results, {}, where a run replaces what it made; please move it, or give another "
                      "directory (-o)",
                      file.string(), directory));
  }
}

}  // namespace

std::string default_directory(const std::string& file) { return "results/" + std::filesystem::path(file).stem().string(); }

ExitCode run_scene(const RCP<const Communicator>& comm, const Scene& scene, const RunOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  RunLog log(comm, options.verbosity);
  const Timers timers;
  std::optional<Watchdog> watchdog;
  if (options.supervised) watchdog.emplace(*comm);
  OutputDirectory directory(comm, options.directory.empty() ? default_directory(options.scene) : options.directory,
                            {"run", options.scene, options.directory.empty()}, options.keep && !options.restart);
  const Model model(comm, scene, timers);
  SystemParts parts = model.parts();
  std::optional<SlipSettlement> settlement;
  if (SlipSettlement::is_needed(model)) {
    settlement.emplace(model);
    parts.better_start = [&](const SystemEvaluation& at) { return settlement->better_start(at); };
  }
  // Parts of the system that look at its iterates, while it is solved.
  const SemiSmoothSystem* whole = nullptr;
  std::vector<int> loose;  // bodies that contact alone holds
  if (StateCheck::is_needed(model)) {
    loose = bodies_held_by_contact_only(model);
    parts.held_motions = [&](const SystemEvaluation& at) {
      const auto timer = timers.scope("free motions");
      return motions_without_load(model, *whole, at, loose, scene.newton.momentum_tolerance);
    };
  }
  const SemiSmoothSystem system(std::move(parts), timers);
  whole = &system;
  StepEvaluation evaluation(scene, model, system);

  const auto warn = [&](const std::string& line) { log.warning(line); };
  std::optional<SurfaceWatch> surfaces;
  if (model.contact()) surfaces.emplace(model, scene, warn);
  std::optional<StateCheck> check;
  if (StateCheck::is_needed(model)) check.emplace(model, scene.newton.increment_tolerance * model.parts().length, warn);
  JumpCheck jump(model.parts().length);
  std::optional<CoarseSlaveWatch> coarse;
  if (model.contact()) coarse.emplace(model, scene);
  StabilityCheck stability(scene.newton.increment_tolerance * model.parts().length, warn);

  RunRecord record;
  record.scene = options.scene;
  record.version = options.version;
  record.settings = options.settings;
  record.quantity_order = evaluation.names();
  // Memory of a run beside the state of the system and how far its files go.
  const auto serialize_memory = [&](StateArchive& archive) {
    evaluation.serialize(archive);
    if (surfaces) surfaces->serialize(archive);
    if (check) check->serialize(archive);
    if (coarse) coarse->serialize(archive);
    jump.serialize(archive);
    stability.serialize(archive);
    record.serialize(archive);
  };
  const std::optional<Restart> restart = options.restart ? std::optional(restart_from(comm, directory.path(), *options.restart)) : std::nullopt;
  std::optional<SteppingState> restored;
  if (restart) {
    restored = restore_run(*restart, scene, options.scene, model, system, evaluation);
    serialize_memory(*restart->file);
  }

  refuse_meshes_in(scene, directory.path());
  // From here on the scene is one that can be run: only now is anything made, and what an earlier run left makes room.
  if (restart)
    directory.continue_run();
  else
    directory.begin_run();
  log.open(directory.claim("log.txt"), restart.has_value());
  if (restart) report_restart(*restart, log);
  report_model(options.scene, scene, model, log);
  report_precision(model, scene, log);
  if (!restart) report_contact_at_start(model, scene, log);
  report_memory(model, log);
  write_file(*comm, directory.claim("effective.xml"), [&] { return effective_xml(scene); });
  record.parts.push_back(part_text(record.steps, comm->getSize()));
  RunOutput output(comm, scene, directory, model.mesh(), evaluation, log, record, timers, restart ? restart->file.get() : nullptr);
  if (restart) remove_checkpoints_after(*comm, directory.path(), restart->step);

  SteppingState state = restored ? *std::move(restored) : SteppingState(system.initial_state(Vector(system.map())));
  if (model.edges()) model.edges()->start_step(*system.displacement(*state.accepted.x));
  if (auto& context = state.accepted.context; context.contact) context.contact = model.contact()->with_clearances(*context.contact, context.time);
  std::optional<SystemEvaluation> last;  // of `state`, in the step that led there; none while another step is tried
  std::optional<StepFailure> failure;
  std::vector<std::string> unwritten;  // why files of the end could not be written
  StopRequest requests(options.supervised, options.time_limit, begin);
  Checkpoints checkpoints(comm, scene.output.checkpoints, directory);
  const std::string fingerprint = scene_fingerprint(scene);
  const auto write_checkpoint = [&] {
    const auto timer = timers.scope("checkpoint");
    const std::uintmax_t bytes = checkpoints.write(state.steps, [&](StateArchive& archive) {
      store_run(archive, fingerprint, model, system, evaluation, state);
      serialize_memory(archive);
      output.store(archive);
    });
    // A run that goes on from here takes the way of the one that is restarted. The clock and signals have no influence on the way.
    if (checkpoints.is_due_by_step(state.steps)) system.parts().linear_solver->forget();
    requests.reserve(checkpoints.seconds());
    log.info(
        fmt::format("  checkpoint of step {}: {:.3g} MiB, {:.2g} s", state.steps, static_cast<double>(bytes) / 1048576.0, checkpoints.seconds()));
  };
  // An overlap is taken up by the end of the first step unless a pair says when. A try that is cut short takes up its share, as if the bodies were
  // moved into one another.
  const double taken_up = std::min(scene.stepping.step, scene.stepping.end_time);
  const auto start_step = [&](const AcceptedState& from, double time, const Vector& d, Vector& z) {
    AcceptedState allowed = from;
    if (model.edges()) model.edges()->start_step(*system.displacement(*from.x));
    if (model.contact()) allowed.context.contact = model.contact()->with_clearances(*allowed.context.contact, time);
    for (std::size_t pair = 0; pair < scene.contact.size(); ++pair)
      if (const double depth = model.surfaces_at_start().pairs[pair].overlap.depth; depth > 0.0) {
        const double left = 1.0 - time / scene.contact[pair].value.start.taken_up_at.value_or(taken_up);
        allowed.context.contact = model.contact()->allow_overlap(*allowed.context.contact, pair, depth * std::max(0.0, left));
      }
    return system.start_step(allowed, time, d, z);
  };
  {
    const auto timer = timers.scope("steps");
    StepperObserver functions = output.functions();
    bool is_asked_to_stop = false;
    functions.rest = [&](const SteppingState&) {
      const Request request = requests.after_step(*comm);
      record.stopped = request.stop;
      is_asked_to_stop = request.stop.has_value();  // the checkpoint is written at the end, below
      if (!is_asked_to_stop && (request.checkpoint || checkpoints.is_due(state.steps))) write_checkpoint();
      return is_asked_to_stop;
    };
    functions.interrupted = [&] {
      record.stopped = requests.within_step(*comm);
      is_asked_to_stop = record.stopped.has_value();
      return is_asked_to_stop;
    };
    functions.verify = [&](const AcceptedState& from, const SystemEvaluation& found, int round) -> RCP<Vector> {
      if (model.edges()) model.edges()->examine(*system.displacement(found.x()));
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
      stability.verify(system, from, found);
      return Teuchos::null;
    };
    // Smaller tries of a step often end where less can be told: then the finding of an earlier one is reported again.
    std::string known;
    const double smallest = scene.stepping.minimum_step.value_or(scene.stepping.step / 1024.0);
    const auto explain_statically = [&](const FailedTry& failed) -> std::string {
      if (failed.failure.kind() == FailureKind::input || failed.failure.kind() == FailureKind::out_of_memory) return {};
      const StaticsReason statics = check ? explain_statics(model, system, *failed.from.x, failed.context) : StaticsReason{};
      if (statics.verdict == StaticsVerdict::falls) return known = statics.words;
      const bool may_hold = statics.verdict != StaticsVerdict::unknown;
      if (failed.time - failed.from.context.time < 2.0 * smallest)
        if (const std::string turns = explain_turning_point(failed, model, system); !turns.empty()) return known = turns;
      if (check && !check->refused().empty()) return known = check->refused() + "; put back, it found no equilibrium";
      // Newton's last iterate gives no reason about motions where statics says that contact can hold the bodies.
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
    functions.explain = [&](const FailedTry& failed) -> FailureExplanation {
      const std::string apart = advise_parts_apart(failed, model, scene, system);
      std::vector<std::string> words{explain_by_coarse_slave(failed, model, scene, system), apart, explain_statically(failed)};
      words.erase(std::remove(words.begin(), words.end(), std::string()), words.end());
      return {fmt::format("{}", fmt::join(words, "; ")), !apart.empty()};
    };
    functions.begin = [&, begin = functions.begin](int step, double time, double dt) {
      last.reset();
      begin(step, time, dt);
    };
    functions.accepted = [&, accepted = functions.accepted](const StepReport& report, const SystemEvaluation& at) {
      last = at;
      known.clear();
      if (coarse) coarse->accept(*system.displacement(at.x()), at.contact_laws(), at.context().time);
      if (surfaces) surfaces->accept();
      jump.accept();
      stability.accept();
      accepted(report, at);
    };
    // The motion that pushes surfaces apart does not go on: predicted, it would let all nodes of a press fit slip.
    const auto& at_start = model.surfaces_at_start().pairs;
    const bool begins_pressed = std::any_of(at_start.begin(), at_start.end(), [](const PairAtStart& pair) { return pair.overlap.depth > 0.0; });
    functions.predict = [&](const Vector& at, double dt, Vector& rate) {
      if (begins_pressed && record.time < taken_up) {
        rate.putScalar(0.0);
        return;
      }
      if (check) check->without_free_motions(system, at, dt, rate);
    };
    if (check) {
      functions.close = [&, rule = StartRule(model, loose, scene.newton.momentum_tolerance, [&](const std::string& line) { log.info(line); })](
                            const SystemEvaluation& start) { return rule.close(system, start); };
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
      if (record.converged) record.stopped.reset();
      output.end_steps();
      // On its way in a corner passes through a part of a facet before contact begins; a run that ends there has not found its force.
      if (record.converged && surfaces && !surfaces->without_force().empty()) {
        failure.emplace(FailureKind::lost_contact, surfaces->without_force() + "; please make the slave finer there, or exchange slave and master");
        record.converged = false;
      }
      if (coarse && last)
        for (const std::string& line : coarse->warnings(*system.displacement(*state.accepted.x), last->contact_laws(), record.time))
          log.warning(line);
      if (record.converged && model.edges() && last)
        for (const std::string& line : crossings_too_coarse(model, scene, *system.displacement(*state.accepted.x), last->contact_laws()))
          log.warning(line);
    } catch (const InputError& error) {  // on every rank: a quantity's expression without a value
      failure.emplace(FailureKind::input, error.what());
    }
    const auto attempt = [&](const auto& write) {
      try {
        write();
      } catch (const FileError& error) {  // on every rank
        unwritten.emplace_back(error.what());
      }
    };
    const bool wants_last = !record.converged || is_asked_to_stop || scene.output.checkpoints.every_step > 0 || checkpoints.last() > 0 || restart;
    if (wants_last && state.steps > 0 && checkpoints.last() != state.steps && (!restart || restart->step != state.steps)) attempt(write_checkpoint);
    attempt([&] {
      output.finish(
          [&] { return last ? *last : system.evaluate_at(state.accepted, *system.multipliers(*state.accepted.x), state.accepted.context); });
    });
  }
  if (record.steps > 0) record.checks = evaluate_checks(scene.checks, record.quantities);
  record.exit = exit_code(record, failure, unwritten.empty());
  if (failure)
    record.reason = failure->what();
  else if (!unwritten.empty())
    record.reason = fmt::format("{}", fmt::join(unwritten, "; "));

  for (std::size_t pair = 0; pair < scene.contact.size(); ++pair)
    record.integration.emplace_back(scene.contact[pair].name, model.contact()->integration_load(pair));

  timers.stacked().stopBaseTimer();
  record.seconds = seconds_by_name(timers, comm);
  const double mine = peak_memory_mib();
  Teuchos::reduceAll(*comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(record.memory_peak_mib));
  Teuchos::reduceAll(*comm, Teuchos::REDUCE_SUM, mine, Teuchos::outArg(record.memory_total_mib));
  log.detail(timer_report(timers, comm));
  report_end(record, failure, directory.path(), log);
  for (const std::string& line : unwritten) log.warning(line);
  if (record.stopped && (checkpoints.last() > 0 || restart))
    log.info(fmt::format("to go on: {}", command_to_continue(options, directory.path(), comm->getSize())));
  write_file(*comm, directory.claim("summary.json"),
             [&, json = summary(record, model, state.accepted.context.contact, directory.file("steps.jsonl"))] {
               return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
             });
  if (is_input(failure)) throw *failure;
  if (record.exit == ExitCode::files) throw FileError(*record.reason);
  return record.exit;
}

}  // namespace mortise
