#include "mortise/nonlinear/drive.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>

#include "system/system_model.hpp"

namespace mortise {
namespace {

constexpr double least_change = 1e-12;  ///< of a load or a motion: a change that small is none

/// -f_ext
RCP<Vector> loads_at(const detail::SystemModel& model, const Vector& displacement, double time) {
  auto loads = rcp(new Vector(model.parts().dofs));
  const Configuration configuration = model.configuration(time, displacement);
  std::optional<StepFailure> failure;
  for (const auto& contribution : model.parts().contributions)
    if (contribution->kind() == Contribution::Kind::external && contribution->uses().time_derivatives == 0)
      contribution->add_residual(configuration, *loads, failure);
  throw_if_any(model.comm(), failure);
  return loads;
}

/// s p; 0 on dofs that are free
RCP<Vector> motions_at(const detail::SystemModel& model, double time) {
  const SystemParts& parts = model.parts();
  auto motions = rcp(new Vector(parts.dofs));
  std::optional<StepFailure> failure;
  if (parts.constraints) {
    if (const RCP<Vector> offset = parts.constraints->offset(time, failure); !offset.is_null()) Tpetra::deep_copy(*motions, *offset);
    const std::vector<double> values = parts.constraints->prescribed_values(time, failure);
    const auto rows = motions->getLocalViewHost(Tpetra::Access::ReadWrite);
    for (std::size_t i = 0; i < model.prescribed().size(); ++i) rows(model.prescribed()[i], 0) = values[i];
  }
  throw_if_any(model.comm(), failure);
  const auto rows = motions->getLocalViewHost(Tpetra::Access::ReadWrite);
  for (std::size_t row = 0; row < rows.extent(0); ++row) rows(row, 0) *= model.stiffness_scale_of(static_cast<LocalOrdinal>(row));
  return motions;
}

}  // namespace

Drive::Drive(std::shared_ptr<const detail::SystemModel> model, const Vector& displacement, double from, double to) : model_(std::move(model)) {
  const RCP<const Vector> d = model_->d(displacement);
  const auto add = [&](const RCP<Vector>& before, const RCP<Vector>& after) {
    const std::vector<double> sizes = model_->sizes().norms(*after);
    after->update(-1.0, *before, 1.0);
    std::vector<double> norms = model_->sizes().norms(*after);
    for (std::size_t field = 0; field < norms.size(); ++field)
      norms[field] = norms[field] <= least_change * sizes[field] ? 0.0 : norms[field] * model_->weight(field);
    changes_.push_back(after);
    norms_.push_back(std::move(norms));
  };
  add(loads_at(*model_, *d, from), loads_at(*model_, *d, to));
  add(motions_at(*model_, from), motions_at(*model_, to));
}

double Drive::strength() const {
  double squares = 0.0;
  for (const auto& norms : norms_)
    for (const double norm : norms) squares += norm * norm;
  return std::sqrt(squares);
}

std::optional<double> Drive::continuation(const Drive& before) const {
  const std::size_t fields = model_->sizes().fields();
  std::vector<double> mine(2 * changes_.size() * fields, 0.0), all(mine.size());
  for (std::size_t kind = 0; kind < changes_.size(); ++kind) {
    const auto now = changes_[kind]->getLocalViewHost(Tpetra::Access::ReadOnly),
               then = before.changes_[kind]->getLocalViewHost(Tpetra::Access::ReadOnly);
    for (std::size_t row = 0; row < now.extent(0); ++row) {
      double* products = &mine[2 * (kind * fields + model_->sizes().field(static_cast<LocalOrdinal>(row)))];
      products[0] += now(row, 0) * then(row, 0);
      products[1] += then(row, 0) * then(row, 0);
    }
  }
  Teuchos::reduceAll(model_->comm(), Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), all.data());
  std::optional<double> least;
  for (std::size_t kind = 0; kind < changes_.size(); ++kind)
    for (std::size_t field = 0; field < fields; ++field) {
      if (before.norms_[kind][field] == 0.0) continue;
      const double* products = &all[2 * (kind * fields + field)];
      const double share = norms_[kind][field] == 0.0 ? 0.0 : std::max(0.0, products[0] / products[1]);
      least = std::min(least.value_or(share), share);
    }
  return least;
}

}  // namespace mortise
