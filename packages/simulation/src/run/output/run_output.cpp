#include "run/output/run_output.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "mortise/simulation/run/output/newton_table.hpp"
#include "scene/history_columns.hpp"

namespace mortise {
namespace {

const std::vector<std::string> newton_columns{
    "step",      "try",         "time",   "dt",    "iteration", "momentum", "momentum_absolute", "gap",     "complementarity",
    "increment", "step_length", "active", "stick", "slip",      "changed",  "linear_iterations", "seconds", "undone"};
const std::vector<std::string> profile_columns{"time", "pair", "part", "arc_length", "x", "y", "pressure", "shear", "gap", "state"};

std::vector<std::string> columns_with(const StepEvaluation& evaluation) {
  std::vector<std::string> columns = history_columns();
  for (const auto& name : evaluation.names()) columns.push_back(name);
  return columns;
}

long long whole(int value) { return value; }

/// "step 3", "steps 3, 5 to 8"
std::string steps_in_words(const std::vector<int>& steps) {
  std::vector<std::string> ranges;
  for (std::size_t first = 0, next = 0; first < steps.size(); first = next) {
    for (next = first + 1; next < steps.size() && steps[next] == steps[next - 1] + 1;) ++next;
    ranges.push_back(next - first < 3 ? fmt::format("{}", fmt::join(steps.begin() + first, steps.begin() + next, ", "))
                                      : fmt::format("{} to {}", steps[first], steps[next - 1]));
  }
  return fmt::format("step{} {}", steps.size() > 1 ? "s" : "", fmt::join(ranges, ", "));
}

}  // namespace

RunOutput::RunOutput(const RCP<const Communicator>& comm, const Scene& scene, OutputDirectory& directory, const RCP<const Mesh>& mesh,
                     StepEvaluation& evaluation, RunLog& log, RunRecord& record, const Timers& timers, StateArchive* checkpoint)
    : scene_(scene), directory_(directory), evaluation_(evaluation), log_(log), record_(record), timers_(timers) {
  if (checkpoint != nullptr) {
    restore(comm, *checkpoint);
  } else {
    newton_ = std::make_unique<CsvWriter>(comm, directory.claim("newton.csv"), newton_columns);
    history_ = std::make_unique<CsvWriter>(comm, directory.claim("history.csv"), columns_with(evaluation));
    steps_ = std::make_unique<LineFile>(comm, directory.claim("steps.jsonl"));
  }
  writes_profiles_ = scene.output.contact_profiles;
  writes_fields_ = !scene.output.fields.empty();
  if (writes_profiles_ && !profiles_) profiles_ = std::make_unique<CsvWriter>(comm, directory.claim("profiles.csv"), profile_columns);
  // Fields of a run that goes on without them are cut as well.
  if (writes_fields_ || has_fields_) {
    has_fields_ = true;
    directory.claim("fields.xdmf");
    OutputDirectory files = directory.subdirectory("fields");
    for (const char* name : {"mesh.h5", "step-*.h5"}) files.claim(name);
    fields_ = std::make_unique<FieldWriter>(mesh, directory.path(), checkpoint != nullptr ? std::optional(last_fields()) : std::nullopt);
    report_missing_fields();
  }
  if (checkpoint == nullptr) return;
  for (CsvWriter* table : {newton_.get(), history_.get(), profiles_.get()})
    if (table != nullptr) table->cut();
  steps_->cut();
}

void RunOutput::restore(const RCP<const Communicator>& comm, StateArchive& archive) {
  FileSizes sizes;
  serialize_sizes(archive, sizes);
  newton_ = std::make_unique<CsvWriter>(comm, directory_.claim("newton.csv"), newton_columns, sizes.newton);
  history_ = std::make_unique<CsvWriter>(comm, directory_.claim("history.csv"), columns_with(evaluation_), sizes.history);
  steps_ = std::make_unique<LineFile>(comm, directory_.claim("steps.jsonl"), "", sizes.steps);
  if (sizes.profiles > 0) profiles_ = std::make_unique<CsvWriter>(comm, directory_.claim("profiles.csv"), profile_columns, sizes.profiles);
  begin_time_ = record_.time;
}

// Files of fields are large: one may well have been removed since, and the run does not need them.
void RunOutput::report_missing_fields() {
  std::vector<int> missing;
  const std::vector<int>& there = fields_->steps();
  std::set_difference(field_steps_.begin(), field_steps_.end(), there.begin(), there.end(), std::back_inserter(missing));
  if (!missing.empty())
    log_.warning(fmt::format("{} holds no fields any more of {}, which this run had written; fields.xdmf is without {}", directory_.file("fields"),
                             steps_in_words(missing), missing.size() > 1 ? "them" : "it"));
  field_steps_ = there;
}

void RunOutput::store(StateArchive& archive) {
  const auto size_on_disk = [](const auto& file) -> std::uintmax_t {
    if (!file) return 0;
    file->sync();
    return file->size();
  };
  if (fields_) fields_->sync();
  FileSizes sizes{size_on_disk(newton_), size_on_disk(history_), size_on_disk(steps_), size_on_disk(profiles_)};
  serialize_sizes(archive, sizes);
}

void RunOutput::serialize_sizes(StateArchive& archive, FileSizes& sizes) {
  serialize(archive, "files.newton", sizes.newton);
  serialize(archive, "files.history", sizes.history);
  serialize(archive, "files.steps", sizes.steps);
  serialize(archive, "files.profiles", sizes.profiles);
  serialize(archive, "files.fields", field_steps_);
  serialize(archive, "files.has_fields", has_fields_);
}

StepperObserver RunOutput::functions() {
  StepperObserver observer;
  observer.begin = [this](int step, double time, double dt) { begin(step, time, dt); };
  observer.iteration = [this](const NewtonIteration& iteration) { add(iteration); };
  observer.accepted = [this](const StepReport& report, const SystemEvaluation& at) { accept(report, at); };
  observer.undone = [this](const StepReport&, const StepFailure& failure) { undo(failure); };
  return observer;
}

void RunOutput::undo(const StepFailure& failure) {
  if (last_iteration_.empty())  // it ended before the first residual
    last_iteration_ = {whole(step_), whole(try_), time_, dt_, whole(0), "", "", "", "", "", "", "", "", "", "", "", "", ""};
  write_last_iteration(to_string(failure.kind()));
  log_.info(fmt::format("  step {} undone: {}", step_, failure.what()));
  ++try_;
}

void RunOutput::finish(const std::function<SystemEvaluation()>& last_state) {
  if (record_.steps == 0) return;
  const bool fields = writes_fields_ && last_fields() != record_.steps, profiles = writes_profiles_ && !is_output_time(record_.time);
  if (!fields && !profiles) return;
  const SystemEvaluation at = last_state();
  if (fields) write_fields(at);
  if (profiles) write_profiles(at);
}

void RunOutput::begin(int step, double time, double dt) {
  if (step != step_) try_ = 0;
  last_iteration_.clear();
  step_ = step, time_ = time, dt_ = dt;
  log_.info(step_header(step, time, scene_.stepping.end_time, dt));
  log_.info(newton_header());
}

void RunOutput::add(const NewtonIteration& iteration) {
  const auto timer = timers_.scope("output");
  const auto& norms = iteration.norms;
  log_.info(newton_line(iteration));
  write_last_iteration("");
  last_iteration_ = {whole(step_),
                     whole(try_),
                     time_,
                     dt_,
                     whole(iteration.iteration),
                     norms.momentum,
                     norms.momentum_absolute,
                     norms.gap,
                     norms.complementarity,
                     iteration.increment,
                     iteration.step_length,
                     whole(norms.active),
                     whole(norms.sticking),
                     whole(norms.active - norms.sticking),
                     whole(norms.changed),
                     whole(iteration.linear_iterations),
                     iteration.seconds,
                     ""};
}

// An iteration's row waits for what follows, as the last one of a try that is undone says why.
void RunOutput::write_last_iteration(const std::string& undone) {
  if (last_iteration_.empty()) return;
  last_iteration_.back() = undone;
  newton_->row(last_iteration_);
  last_iteration_.clear();
}

void RunOutput::accept(const StepReport& report, const SystemEvaluation& at) {
  const auto timer = timers_.scope("output");
  write_last_iteration("");
  record_.steps = report.step;
  record_.time = report.time;
  record_.newton_steps += report.newton.newton_steps();
  const auto names = evaluation_.names();
  const auto values = evaluation_.quantities(at);
  std::vector<CsvValue> row{whole(report.step), report.time, whole(report.newton.newton_steps())};
  for (std::size_t i = 0; i < values.size(); ++i) {
    row.emplace_back(values[i]);
    record_.quantities[names[i]] = values[i];
  }
  history_->row(row);
  steps_->append(step_line(report) + "\n");
  log_.info(step_footer(report, seconds_left(report.time)));
  if (is_output_time(report.time) || (scene_.output.every_step > 0 && report.step % scene_.output.every_step == 0)) write_fields(at);
  if (is_output_time(report.time)) write_profiles(at);
}

// As if the rest of the scene's time went on as fast as what is done of it.
double RunOutput::seconds_left(double time) const {
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin_;
  return taken.count() * (scene_.stepping.end_time - time) / (time - begin_time_);
}

bool RunOutput::is_output_time(double time) const {
  for (const double one : scene_.stepping.output_times)
    if (std::abs(time - one) <= 1e-12 * scene_.stepping.end_time) return true;
  return false;
}

void RunOutput::write_fields(const SystemEvaluation& at) {
  if (!writes_fields_) return;
  field_steps_.push_back(record_.steps);
  fields_->write(record_.steps, record_.time, evaluation_.fields(at, scene_.output.fields));
}

void RunOutput::write_profiles(const SystemEvaluation& at) {
  if (!writes_profiles_) return;
  const auto profiles = evaluation_.profiles(at);
  std::vector<std::vector<CsvValue>> rows;
  for (std::size_t pair = 0; pair < profiles.size(); ++pair)
    for (const ProfilePoint& point : profiles[pair])
      rows.push_back({record_.time, scene_.contact[pair].name, whole(point.part), point.arc_length, point.x, point.y, point.pressure, point.shear,
                      point.gap, whole(static_cast<int>(point.state))});
  profiles_->rows(rows);
}

}  // namespace mortise
