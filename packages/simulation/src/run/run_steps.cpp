#include <fmt/format.h>

#include <Tpetra_Vector.hpp>

#include "run/scene_run.hpp"

namespace mortise {

void Run::take_steps() {
  const auto start = [this](const AcceptedState& from, double time, const Vector& d, Vector& z) { return preparation_.start(from, time, d, z); };
  try {
    record_.converged = run_steps(system_, scene_.stepping, scene_.newton, *state_, start, observer(), failure_);
    if (record_.converged) record_.stopped.reset();
    output_->end_steps();
    if (std::optional<StepFailure> lost = end_steps(guards_, system_, {record_.converged, last_ ? &*last_ : nullptr})) {
      failure_.emplace(*std::move(lost));
      record_.converged = false;
    }
  } catch (const InputError& error) {  // on every rank: a quantity's expression without a value
    failure_.emplace(FailureKind::input, error.what());
  }
}

StepperObserver Run::observer() {
  StepperObserver observer = output_->functions();
  guard_steps(observer, guards_, system_);
  observer.begin = [this, begin = observer.begin](int step, double time, double dt) {
    last_.reset();
    begin(step, time, dt);
  };
  observer.predict = [this, predict = observer.predict](const Vector& x, double dt, Vector& rate) {
    if (preparation_.is_pushed_apart(record_.time))
      rate.putScalar(0.0);
    else
      predict(x, dt, rate);
  };
  observer.accepted = [this, accepted = observer.accepted](const StepReport& report, const SystemEvaluation& at) {
    last_ = at;
    accepted(report, at);
  };
  observer.rest = [this](const SteppingState&) { return rest(); };
  observer.interrupted = [this] { return is_interrupted(); };
  return observer;
}

bool Run::rest() {
  const Request request = requests_->after_step(*comm_);
  record_.stopped = request.stop;
  is_asked_to_stop_ = request.stop.has_value();  // the checkpoint is written at the end
  if (!is_asked_to_stop_ && (request.checkpoint || checkpoints_->is_due(state_->steps))) write_checkpoint();
  return is_asked_to_stop_;
}

bool Run::is_interrupted() {
  record_.stopped = requests_->within_step(*comm_);
  is_asked_to_stop_ = record_.stopped.has_value();
  return is_asked_to_stop_;
}

void Run::serialize_memory(StateArchive& archive) {
  evaluation_.serialize(archive);
  for (const auto& guard : guards_) guard->serialize(archive);
  record_.serialize(archive);
}

void Run::write_checkpoint() {
  const auto timer = timers_.scope("checkpoint");
  const std::uintmax_t bytes = checkpoints_->write(state_->steps, [&](StateArchive& archive) {
    store_run(archive, fingerprint_, model_, system_, evaluation_, *state_);
    serialize_memory(archive);
    output_->store(archive);
  });
  // A run that goes on from here takes the way of the one that is restarted. What the clock or a signal asks for has no influence on the way.
  if (checkpoints_->is_due_by_step(state_->steps)) system_.parts().linear_solver->forget();
  const double seconds = checkpoints_->seconds();
  requests_->reserve(seconds);
  log_.info(fmt::format("  checkpoint of step {}: {:.3g} MiB, {:.2g} s", state_->steps, static_cast<double>(bytes) / 1048576.0, seconds));
}

}  // namespace mortise
