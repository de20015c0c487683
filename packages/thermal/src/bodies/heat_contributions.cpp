#include "mortise/thermal/heat_contributions.hpp"

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>
#include <stdexcept>

#include "elements/thermal_block.hpp"
#include "mortise/core/trilinos_versions.hpp"

namespace mortise {
namespace {

/// Views of a configuration, held as long as the object lives.
class StateViews {
 public:
  explicit StateViews(const Configuration& at) : unknowns_(view_of(at.local_unknowns)) {
    state.time = at.time;
    state.unknowns = unknowns_.data();
  }
  StateViews(const Configuration& at, const Vector* velocity_shares, const std::vector<double>& ones) : StateViews(at) {
    if (at.local_velocity == nullptr) throw std::logic_error("the capacity of heat needs rates of the temperature");
    velocity_ = view_of(*at.local_velocity);
    state.velocity = velocity_.data();
    state.velocity_shares = ones.data();
    if (velocity_shares == nullptr) return;
    shares_ = view_of(*velocity_shares);
    state.velocity_shares = shares_.data();
  }

  ThermalState state;

 private:
  using View = Vector::dual_view_type::t_host::const_type;
  static View view_of(const Vector& vector) { return vector.getLocalViewHost(Tpetra::Access::ReadOnly); }
  View unknowns_, velocity_, shares_;
};

/// add(block, target) for each block with a temperature.
/// @param residual  null: not wanted
/// @param jacobian  null: not wanted
template <class Add>
void add_blocks(const ThermalBodies& bodies, Vector* residual, Matrix* jacobian, double factor, const Add& add) {
  AssemblyTarget target;
  target.factor = factor;
  std::optional<Vector::dual_view_type::t_host> rows;
  if (residual != nullptr) {
    rows = residual->getLocalViewHost(Tpetra::Access::ReadWrite);
    target.residual = {rows->data(), bodies.space().rows(bodies.temperature())};
  }
  std::optional<NodalSparsity::Values> values;
  if (jacobian != nullptr) {
    values.emplace(bodies.space().sparsity().open(*jacobian));
    target.matrix = &*values;
  }
  for (const auto& block : bodies.blocks())
    if (block) add(*block, target);
  if (values) values->close();
}

void add_conduction(const ThermalBodies& bodies, const Configuration& at, Vector* residual, Matrix* jacobian, double factor,
                    std::optional<StepFailure>& failure) {
  const StateViews views(at);
  add_blocks(bodies, residual, jacobian, factor,
             [&](const ThermalBlock& block, const AssemblyTarget& target) { block.add_conduction(views.state, target, failure); });
}

}  // namespace

FieldUse HeatConduction::uses() const {
  if (bodies_->conducts_by_displacement()) return {{"temperature", "displacement"}, {"temperature"}, 0};
  return {{"temperature"}, {"temperature"}, 0};
}

void HeatConduction::add_residual(const Configuration& at, Vector& residual, std::optional<StepFailure>& failure) {
  add_conduction(*bodies_, at, &residual, nullptr, 1.0, failure);
}

void HeatConduction::add_jacobian(const Configuration& at, const JacobianWeights& weights, Matrix& jacobian, std::optional<StepFailure>& failure) {
  add_conduction(*bodies_, at, nullptr, &jacobian, weights.unknowns, failure);
}

void HeatConduction::add_residual_and_jacobian(const Configuration& at, const JacobianWeights& weights, Vector& residual, Matrix& jacobian,
                                               std::optional<StepFailure>& failure) {
  add_conduction(*bodies_, at, &residual, &jacobian, weights.unknowns, failure);
}

HeatCapacity::HeatCapacity(std::shared_ptr<const ThermalBodies> bodies)
    : bodies_(std::move(bodies)), ones_(local_id_count(*bodies_->space().local_dofs()), 1.0) {}

void HeatCapacity::add_residual(const Configuration& at, Vector& residual, std::optional<StepFailure>& failure) {
  StateViews views(at, nullptr, ones_);
  views.state.time_step = time_step_;
  add_blocks(*bodies_, &residual, nullptr, 1.0,
             [&](const ThermalBlock& block, const AssemblyTarget& target) { block.add_capacity(views.state, 0.0, 0.0, target, failure); });
}

void HeatCapacity::add_jacobian(const Configuration& at, const JacobianWeights& weights, Matrix& jacobian, std::optional<StepFailure>& failure) {
  StateViews views(at, weights.local_velocity_shares, ones_);
  views.state.time_step = time_step_;
  add_blocks(*bodies_, nullptr, &jacobian, 1.0, [&](const ThermalBlock& block, const AssemblyTarget& target) {
    block.add_capacity(views.state, weights.velocity, weights.unknowns, target, failure);
  });
}

void HeatSource::add_residual(const Configuration& at, Vector& residual, std::optional<StepFailure>& failure) {
  const StateViews views(at);
  add_blocks(*bodies_, &residual, nullptr, 1.0,
             [&](const ThermalBlock& block, const AssemblyTarget& target) { block.add_source(views.state, target, failure); });
}

void HeatSource::add_jacobian(const Configuration& at, const JacobianWeights& weights, Matrix& jacobian, std::optional<StepFailure>& failure) {
  const StateViews views(at);
  add_blocks(*bodies_, nullptr, &jacobian, weights.unknowns,
             [&](const ThermalBlock& block, const AssemblyTarget& target) { block.add_source(views.state, target, failure); });
}

std::vector<double> sums_of_heat(Contribution& contribution, const ThermalBodies& bodies, const Configuration& at,
                                 std::optional<StepFailure>& failure) {
  const Mesh& mesh = *bodies.mesh();
  Vector residual(bodies.space().dofs());
  contribution.add_residual(at, residual, failure);
  std::vector<double> sums(mesh.bodies.size(), 0.0);
  const FieldRows& rows = bodies.space().rows(bodies.temperature());
  const auto values = residual.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node)
    if (rows.lives(node)) sums[static_cast<std::size_t>(mesh.body_of_node[node])] += values(rows(node, 0), 0);
  return sums;
}

}  // namespace mortise
