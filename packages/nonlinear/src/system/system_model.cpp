#include "system/system_model.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <TpetraExt_MatrixMatrix.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "mortise/core/trilinos_versions.hpp"

namespace mortise::detail {
namespace {

/// Ids of the first map, then those of the second.
RCP<const Map> map_of_both(const Map& first, const Map& second) {
  std::vector<GlobalOrdinal> ids;
  for (const Map* map : {&first, &second})
    for (const GlobalOrdinal id : local_ids(*map)) ids.push_back(id);
  const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  return rcp(new Map(invalid, ids.data(), static_cast<LocalOrdinal>(ids.size()), 0, first.getComm()));
}

}  // namespace

SystemModel::SystemModel(SystemParts parts, Timers timers)
    : parts_(std::move(parts)),
      sizes_(parts_),
      timers_(std::move(timers)),
      to_local_(parts_.dofs, parts_.local_dofs),
      local_unknowns_(parts_.local_dofs),
      stiffness_scales_(sizes_.fields(), 0.0) {
  check_contributions();
  multipliers_ = rcp(new Map(0, 0, parts_.dofs->getComm()));
  map_ = parts_.dofs;
  if (parts_.contact) {
    multipliers_ = parts_.contact->multiplier_map();
    map_ = map_of_both(*parts_.dofs, *multipliers_);
  }
  if (parts_.constraints) prescribed_ = parts_.constraints->prescribed();
  const bool depends = parts_.constraints && !parts_.constraints->T().is_null();
  if (parts_.rigid || depends)
    reduction_ = std::make_shared<const Reduction>(parts_.rigid, depends ? parts_.constraints : nullptr, parts_.put_support_forces, parts_.dofs,
                                                   parts_.local_dofs);
  if (parts_.contact && parts_.contact->keeps_multipliers())
    saddle_point_ = std::make_unique<SaddlePointMatrix>(reduction_ ? reduction_->unknowns() : parts_.dofs, multipliers_);
}

void SystemModel::check_contributions() const {
  std::vector<std::string> known;
  for (const SystemField& field : parts_.fields) known.push_back(field.unknowns.name());
  if (known.empty()) known.push_back("displacement");
  const auto check = [&](const std::string& contribution, const FieldUse& uses) {
    for (const auto* names : {&uses.reads, &uses.writes})
      for (const std::string& name : *names)
        if (std::find(known.begin(), known.end(), name) == known.end())
          throw std::invalid_argument(
              fmt::format("contribution \"{}\" knows a field '{}'; the system's fields are: {}", contribution, name, fmt::join(known, ", ")));
    if (uses.time_derivatives > 0 && !parts_.time)
      throw std::invalid_argument(
          fmt::format("contribution \"{}\" reads time derivatives of order {}; this system has none", contribution, uses.time_derivatives));
  };
  for (const auto& contribution : parts_.contributions) check(contribution->name(), contribution->uses());
  for (const auto& contribution : parts_.contact_contributions) check(contribution->name(), contribution->uses());
  if (!parts_.contact && !parts_.contact_contributions.empty())
    throw std::invalid_argument(
        fmt::format("contribution \"{}\" depends on contact, which the system has not", parts_.contact_contributions[0]->name()));
}

Configuration SystemModel::configuration(double time, const Vector& unknowns) const {
  local_unknowns_.doImport(unknowns, to_local_, Tpetra::REPLACE);
  return {time, unknowns, local_unknowns_};
}

Configuration SystemModel::configuration(double time, const Vector& unknowns, const TimeStep* step) const {
  return step == nullptr ? configuration(time, unknowns) : configuration(time, unknowns, blended_rates(*step, unknowns));
}

Configuration SystemModel::configuration(double time, const Vector& unknowns, BlendedRates rates) const {
  Configuration result = configuration(time, unknowns);
  if (rates_.local_velocity.is_null()) {
    rates_.local_velocity = rcp(new Vector(parts_.local_dofs));
    rates_.local_acceleration = rcp(new Vector(parts_.local_dofs));
  }
  rates_.of_dofs = std::move(rates);
  rates_.local_velocity->doImport(*rates_.of_dofs.velocity, to_local_, Tpetra::REPLACE);
  rates_.local_acceleration->doImport(*rates_.of_dofs.acceleration, to_local_, Tpetra::REPLACE);
  result.velocity = rates_.of_dofs.velocity.get();
  result.local_velocity = rates_.local_velocity.get();
  result.acceleration = rates_.of_dofs.acceleration.get();
  result.local_acceleration = rates_.local_acceleration.get();
  return result;
}

bool SystemModel::depends_on_time() const {
  return std::any_of(parts_.contributions.begin(), parts_.contributions.end(), [](const auto& one) { return one->depends_on_time(); });
}

void SystemModel::serialize(StateArchive& archive) const {
  const std::size_t fields = stiffness_scales_.size();
  mortise::serialize(archive, "stiffness_scales", stiffness_scales_);
  if (parts_.time) {
    mortise::serialize(archive, "static_scales", static_scales_);
    mortise::serialize(archive, "mass_scales", mass_scales_);
  }
  if (stiffness_scales_.size() != fields)
    throw FileError(fmt::format("a stored state has {} fields; expected are {}", stiffness_scales_.size(), fields));
  for (const auto& contribution : parts_.contributions) contribution->serialize(archive);
  for (const auto& contribution : parts_.contact_contributions) contribution->serialize(archive);
  forget_stiffness();
}

std::shared_ptr<EvaluatedSystem> SystemModel::begin_evaluation(const Vector& x, const StepContext& context) const {
  const Vector values(x, Teuchos::Copy);
  return std::make_shared<EvaluatedSystem>(EvaluatedSystem{values,
                                                           d(values),
                                                           z(values),
                                                           context,
                                                           Teuchos::null,
                                                           Vector(parts_.dofs),
                                                           Teuchos::null,
                                                           Teuchos::null,
                                                           std::nullopt,
                                                           std::nullopt,
                                                           nullptr,
                                                           Vector(parts_.dofs),
                                                           Vector(map_),
                                                           {}});
}

std::shared_ptr<const EvaluatedSystem> SystemModel::evaluate(const Vector& x, const StepContext& context, AtHand at_hand,
                                                             StiffnessIs stiffness) const {
  if (parts_.contact && !context.contact)
    throw std::invalid_argument("SemiSmoothSystem: a context without a history of contact; take step_from() or start_step() of an initial_state()");
  const std::shared_ptr<EvaluatedSystem> result = begin_evaluation(x, context);
  result->internal = std::move(at_hand.internal);
  result->contact = std::move(at_hand.contact);
  EvaluatedSystem& at = *result;
  // Internal forces come first, as they fail more often than contact, which says later which entries the matrix has.
  const bool at_once = stiffness == StiffnessIs::needed_next && at.internal.is_null() && !matrix_.is_null();
  if (at_once) open_matrix(matrix_->getCrsGraph());
  add_forces(at, at_once ? matrix_.get() : nullptr);
  if (parts_.contact) {
    if (!at.contact) at.contact = parts_.contact->differentiate(*at.d, *context.contact, &context.states);
    at.laws = at.contact->laws(*at.z);
    Vector contact_force(parts_.dofs);
    at.laws->add_force(contact_force);
    at.forces.update(1.0, contact_force, 1.0);
    add_contact_contributions(at);
  }
  if (at_once) {
    if (const RCP<const Graph> graph = graph_of(at); graph != matrix_->getCrsGraph()) widen_matrix(graph);
    internal_forces_of_matrix_ = at.internal;
  }
  if (reduction_) {
    configuration(context.time, *at.d);
    at.follow = std::make_shared<const FollowedUnknowns>(reduction_, context.time, local_unknowns_);
  }
  if (stiffness_scale() == 0.0) this->stiffness(result);
  add_norms(at);
  return result;
}

// What acts between bodies has the weight 1 of contact in any scheme.
void SystemModel::add_forces(EvaluatedSystem& at, Matrix* stiffness) const {
  const TimeStep* step = at.context.step.get();
  const Configuration configuration = this->configuration(at.context.time, *at.d, step);
  RCP<Vector> internal, of_rates, between;
  if (at.internal.is_null()) at.internal = internal = rcp(new Vector(parts_.dofs));
  if (step != nullptr) at.of_rates = of_rates = rcp(new Vector(parts_.dofs));
  if (step != nullptr && step->integration->scheme.blends_forces()) between = rcp(new Vector(parts_.dofs));
  std::optional<StepFailure> failure;
  for (const auto& contribution : parts_.contributions) {
    if (contribution->uses().time_derivatives > 0) {
      if (step != nullptr) contribution->add_residual(configuration, *of_rates, failure);
    } else if (contribution->kind() == Contribution::Kind::internal) {
      if (stiffness != nullptr)
        contribution->add_residual_and_jacobian(configuration, weights_of_forces(step), *internal, *stiffness, failure);
      else if (!internal.is_null())
        contribution->add_residual(configuration, *internal, failure);
    } else {
      const bool is_between = contribution->kind() == Contribution::Kind::interaction && !between.is_null();
      contribution->add_residual(configuration, is_between ? *between : at.external, failure);
    }
  }
  if (parts_.rigid) parts_.rigid->check(local_unknowns_, failure);
  throw_if_any(comm(), failure);
  at.forces.update(1.0, *at.internal, 1.0, at.external, 0.0);
  if (step == nullptr) return;
  if (step->integration->scheme.blends_forces()) {
    const double before = step->integration->scheme.alpha_f;
    at.forces.update(before, *step->internal_forces, before, *step->start.external_forces, 1.0 - before);
    at.forces.update(1.0, *between, 1.0);
  }
  at.forces.update(1.0, *of_rates, 1.0);
}

void SystemModel::add_contact_contributions(EvaluatedSystem& at) const {
  if (parts_.contact_contributions.empty()) return;
  const Configuration configuration = this->configuration(at.context.time, *at.d, at.context.step.get());
  const auto sum = rcp(new Vector(parts_.dofs));
  std::optional<StepFailure> failure;
  for (const auto& contribution : parts_.contact_contributions) contribution->add_residual(*at.laws, configuration, *sum, failure);
  throw_if_any(comm(), failure);
  at.forces.update(1.0, *sum, 1.0);
  at.of_contact = sum;
}

ContactContribution::Derivatives SystemModel::derivatives_of_contact_contributions(const EvaluatedSystem& at,
                                                                                   const ContactLinearisation& linearised) const {
  ContactContribution::Derivatives sum;
  if (parts_.contact_contributions.empty()) return sum;
  const Configuration configuration = this->configuration(at.context.time, *at.d, at.context.step.get());
  std::optional<StepFailure> failure;
  const auto add = [&](RCP<const Matrix>& to, const RCP<const Matrix>& matrix) {
    if (matrix.is_null()) return;
    to = to.is_null()
             ? matrix
             : RCP<const Matrix>(Tpetra::MatrixMatrix::add(1.0, false, *to, 1.0, false, *matrix, matrix->getDomainMap(), matrix->getRangeMap()));
  };
  for (const auto& contribution : parts_.contact_contributions) {
    const ContactContribution::Derivatives derivatives = contribution->differentiate(linearised, configuration, failure);
    throw_if_any(comm(), failure);
    add(sum.of_unknowns, derivatives.of_unknowns);
    add(sum.of_multipliers, derivatives.of_multipliers);
  }
  return sum;
}

double SystemModel::weight(std::size_t field) const {
  return field == 0 ? 1.0 : stiffness_scale() * parts_.length / (stiffness_scale(field) * sizes_.size(field));
}

FieldsOfRows SystemModel::field_rows() const {
  FieldsOfRows result;
  for (LocalOrdinal row = 0; row < static_cast<LocalOrdinal>(local_id_count(*parts_.dofs)); ++row) {
    result.field_of_row.push_back(sizes_.field(row));
    result.node_of_row.push_back(sizes_.node(row));
  }
  for (std::size_t field = 0; field < sizes_.fields(); ++field) result.weights.push_back(weight(field));
  return result;
}

const RCP<Matrix>& SystemModel::stiffness(const std::shared_ptr<const EvaluatedSystem>& at) const {
  if (!matrix_of_.owner_before(at) && !at.owner_before(matrix_of_)) return matrix_;
  matrix_of_.reset();
  const RCP<const Graph> graph = graph_of(*at);
  const bool has_internal = !internal_forces_of_matrix_.is_null() && internal_forces_of_matrix_ == at->internal && matrix_->getCrsGraph() == graph;
  if (!has_internal) open_matrix(graph);
  internal_forces_of_matrix_ = Teuchos::null;
  std::optional<StepFailure> failure;
  add_jacobians(*at, !has_internal, failure);
  matrix_->fillComplete(parts_.dofs, parts_.dofs);
  throw_if_any(comm(), failure);
  matrix_of_ = at;
  if (stiffness_scale() == 0.0) stiffness_scales_ = scales_of_diagonal();
  return matrix_;
}

// The bulk's graph, or the larger one that the present candidates of contact ask for.
RCP<const Graph> SystemModel::graph_of(const EvaluatedSystem& at) const {
  const long version = parts_.bulk_version ? parts_.bulk_version() : 0;
  if (at.contact) return parts_.contact->graph(*at.contact, parts_.bulk_graph, version);
  return matrix_.is_null() ? parts_.bulk_graph() : matrix_->getCrsGraph();
}

// Entries of internal forces are in any graph.
void SystemModel::widen_matrix(const RCP<const Graph>& graph) const {
  const RCP<Matrix> narrow = matrix_;
  matrix_ = rcp(new Matrix(graph));
  const auto from = narrow->getLocalMatrixHost();
  std::vector<LocalOrdinal> place(local_id_count(*narrow->getColMap()));
  for (std::size_t column = 0; column < place.size(); ++column)
    place[column] = matrix_->getColMap()->getLocalElement(narrow->getColMap()->getGlobalElement(static_cast<LocalOrdinal>(column)));
  std::vector<LocalOrdinal> columns;
  std::vector<double> values;
  for (LocalOrdinal row = 0; row < from.numRows(); ++row) {
    columns.clear(), values.clear();
    for (std::size_t k = from.graph.row_map(row); k < from.graph.row_map(row + 1); ++k) {
      if (from.values(k) == 0.0) continue;  // of contact
      columns.push_back(place[static_cast<std::size_t>(from.graph.entries(k))]);
      values.push_back(from.values(k));
    }
    matrix_->sumIntoLocalValues(row, static_cast<LocalOrdinal>(columns.size()), values.data(), columns.data());
  }
}

void SystemModel::open_matrix(const RCP<const Graph>& graph) const {
  forget_stiffness();
  if (matrix_.is_null() || matrix_->getCrsGraph() != graph)
    matrix_ = rcp(new Matrix(graph));
  else if (matrix_->isFillComplete())
    matrix_->resumeFill();
  matrix_->setAllToScalar(0.0);
}

JacobianWeights SystemModel::weights_of_forces(const TimeStep* step) const {
  JacobianWeights weights;
  if (step != nullptr) weights.unknowns = step->integration->scheme.force_share();
  return weights;
}

void SystemModel::add_jacobians(const EvaluatedSystem& at, bool with_internal, std::optional<StepFailure>& failure) const {
  const TimeStep* step = at.context.step.get();
  const Configuration configuration = this->configuration(at.context.time, *at.d, step);
  const JacobianWeights of_forces = weights_of_forces(step);
  for (const auto& contribution : parts_.contributions)
    if (contribution->uses().time_derivatives == 0 && (with_internal || contribution->kind() != Contribution::Kind::internal))
      contribution->add_jacobian(configuration, contribution->kind() == Contribution::Kind::interaction ? JacobianWeights{} : of_forces, *matrix_,
                                 failure);
  if (step == nullptr) return;
  std::vector<double> of_statics;
  if (mass_scales_.empty()) of_statics = scales_of_diagonal();
  JacobianWeights weights = step->weights();
  if (rates_.local_shares.is_null()) rates_.local_shares = rcp(new Vector(parts_.local_dofs));
  rates_.local_shares->doImport(*velocity_shares(*step), to_local_, Tpetra::REPLACE);
  weights.local_velocity_shares = rates_.local_shares.get();
  for (const auto& contribution : parts_.contributions)
    if (contribution->uses().time_derivatives > 0) contribution->add_jacobian(configuration, weights, *matrix_, failure);
  if (of_statics.empty()) return;
  const std::vector<double> of_all = scales_of_diagonal();
  for (std::size_t field = 0; field < of_all.size(); ++field) {
    static_scales_.push_back(of_statics[field] / of_forces.unknowns);
    mass_scales_.push_back(std::max(0.0, of_all[field] - of_statics[field]) / weights.acceleration);
  }
}

std::vector<double> SystemModel::scales_of_diagonal() const {
  Vector diagonal(parts_.dofs);
  matrix_->getLocalDiagCopy(diagonal);
  std::vector<double> scales = sizes_.means(diagonal);
  for (double& scale : scales)
    if (!(scale > 0.0 && std::isfinite(scale))) scale = 1.0;
  return scales;
}

RCP<Matrix> SystemModel::take_stiffness(const std::shared_ptr<const EvaluatedSystem>& at) const {
  stiffness(at);
  matrix_of_.reset();
  matrix_->resumeFill();
  return matrix_;
}

}  // namespace mortise::detail
