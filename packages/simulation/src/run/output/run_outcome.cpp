#include "run/output/run_outcome.hpp"

#include <fmt/format.h>

namespace mortise {

bool is_input(const std::optional<StepFailure>& failure) { return failure && failure->kind() == FailureKind::input; }

// Why a step failed tells more than what could not be written after it.
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

}  // namespace mortise
