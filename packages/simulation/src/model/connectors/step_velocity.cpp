#include "model/connectors/step_velocity.hpp"

#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>

namespace mortise {

StepVelocity::StepVelocity(std::shared_ptr<const Bodies> bodies)
    : bodies_(std::move(bodies)),
      displacement_(rcp(new Vector(bodies_->space().local_dofs()))),
      last_(rcp(new Vector(bodies_->space().local_dofs()))) {}

double StepVelocity::per_time(const Configuration& at) const { return at.time > time_ ? 1.0 / (at.time - time_) : 0.0; }

RCP<Vector> StepVelocity::change(const Configuration& at) const {
  const auto result = rcp(new Vector(at.local_unknowns, Teuchos::Copy));
  result->update(-1.0, *displacement_, 1.0);
  return result;
}

RCP<const Vector> StepVelocity::at(const Configuration& at) const {
  const double per_time = this->per_time(at);
  if (per_time == 0.0) return last_;
  const RCP<Vector> result = change(at);
  result->scale(per_time);
  return result;
}

void StepVelocity::accept(const Configuration& at, const Vector& velocity) {
  const auto copy = rcp(new Vector(velocity, Teuchos::Copy));  // it may be last_
  last_ = copy;
  displacement_->assign(at.local_unknowns);
  time_ = at.time;
}

void StepVelocity::serialize(StateArchive& archive, const std::string& name) {
  mortise::serialize(archive, name + ".time", time_);
  const auto vector = [&](const std::string& what, Vector& local) {
    Vector owned(*local.offsetView(bodies_->space().dofs(), 0), Teuchos::Copy);
    mortise::serialize(archive, name + what, "dofs", owned);
    if (archive.restores()) local.doImport(owned, *bodies_->space().ghost_import(), Tpetra::INSERT);
  };
  vector(".displacement", *displacement_);
  vector(".velocity", *last_);
}

}  // namespace mortise
