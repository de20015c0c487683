#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Teuchos_CommHelpers.hpp>
#include <nlohmann/json.hpp>

#include "mortise/core/memory.hpp"
#include "mortise/io/files.hpp"
#include "run/continue_command.hpp"
#include "run/output/run_outcome.hpp"
#include "run/output/timer_sums.hpp"
#include "run/scene_run.hpp"

namespace mortise {

ExitCode Run::execute() {
  restore();
  open_results();
  begin_steps();
  {
    const auto timer = timers_.scope("steps");
    take_steps();
    write_last_state();
  }
  close_record();
  report();
  write_summary();
  if (is_input(failure_)) throw *failure_;
  if (record_.exit == ExitCode::files) throw FileError(*record_.reason);
  return record_.exit;
}

void Run::write_last_state() {
  const auto attempt = [&](const auto& write) {
    try {
      write();
    } catch (const FileError& error) {  // on every rank
      unwritten_.emplace_back(error.what());
    }
  };
  const int steps = state_->steps;
  const bool wants_last = !record_.converged || is_asked_to_stop_ || scene_.output.checkpoints.every_step > 0 || checkpoints_->last() > 0 || restart_;
  if (wants_last && steps > 0 && checkpoints_->last() != steps && (!restart_ || restart_->step != steps)) attempt([&] { write_checkpoint(); });
  const auto last_state = [&] {
    const AcceptedState& state = state_->accepted;
    return last_ ? *last_ : system_.evaluate_at(state, *system_.multipliers(*state.x), state.context);
  };
  attempt([&] { output_->finish(last_state); });
}

void Run::close_record() {
  if (record_.steps > 0) record_.checks = evaluate_checks(scene_.checks, record_.quantities);
  record_.exit = exit_code(record_, failure_, unwritten_.empty());
  if (failure_)
    record_.reason = failure_->what();
  else if (!unwritten_.empty())
    record_.reason = fmt::format("{}", fmt::join(unwritten_, "; "));
  for (std::size_t pair = 0; pair < scene_.contact.size(); ++pair)
    record_.integration.emplace_back(scene_.contact[pair].name, model_.contact()->integration_load(pair));
  timers_.stacked().stopBaseTimer();
  record_.seconds = seconds_by_name(timers_, comm_);
  const double mine = peak_memory_mib();
  Teuchos::reduceAll(*comm_, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(record_.memory_peak_mib));
  Teuchos::reduceAll(*comm_, Teuchos::REDUCE_SUM, mine, Teuchos::outArg(record_.memory_total_mib));
}

void Run::report() {
  log_.detail(timer_report(timers_, comm_));
  report_end(record_, failure_, directory_.path(), log_);
  for (const std::string& line : unwritten_) log_.warning(line);
  if (record_.stopped && (checkpoints_->last() > 0 || restart_))
    log_.info(fmt::format("to go on: {}", command_to_continue(options_, directory_.path(), comm_->getSize())));
}

void Run::write_summary() {
  write_file(*comm_, directory_.claim("summary.json"),
             [json = summary(record_, model_, state_->accepted.context.contact, directory_.file("steps.jsonl"))] {
               return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
             });
}

}  // namespace mortise
