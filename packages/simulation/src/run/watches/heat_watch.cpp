#include "run/watches/heat_watch.hpp"

#include <fmt/format.h>

#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>

#include "model/heat/contact_heat_book.hpp"
#include "model/heat/heat_of_scene.hpp"
#include "model/heat/heat_of_step.hpp"
#include "mortise/core/names.hpp"
#include "mortise/core/over_ranks.hpp"

namespace mortise {
namespace {

/// Residuals of heat are 1e-9 of the flows; sums of N rows leave sqrt(N) times as much, with 1e6 rows.
constexpr double balanced = 1e-6;
constexpr double round_off = 1e-9;  ///< of temperatures, in the range of all
/// Of the range of temperatures that anything causes, by which others may fall below it.
constexpr double noticeable = 0.01;

}  // namespace

HeatWatch::HeatWatch(const Model& model, const Scene& scene, std::function<void(const std::string&)> warn)
    : model_(model), scene_(scene), warn_(std::move(warn)) {
  Vector start(model.space().dofs());
  put_initial_temperatures(scene, model.space(), start);
  {
    const FieldRows& rows = model.space().rows(model.heat().bodies->temperature());
    const auto theta = start.getLocalViewHost(Tpetra::Access::ReadOnly);
    for (LocalOrdinal node = 0; node < model.mesh()->owned_count(); ++node)
      if (rows.lives(node)) lowest_ = std::min(lowest_, theta(rows(node, 0), 0)), highest_ = std::max(highest_, theta(rows(node, 0), 0));
  }
  for (const ThermalBody& body : model.heat().bodies->bodies())
    if (body.properties && !body.properties->specific_heat.is_given()) stores_everywhere_ = false;
  // Heat that goes away at any temperature lowers it without a bound that is known.
  bool is_known = !model.heat().bodies->has_source();
  for (const auto& load : scene.heat.loads)
    is_known = is_known && load.value.load.options && load.value.load.options->surroundings_temperature() != nullptr;
  for (const auto& material : scene.materials)
    if (material.value.law.options->thermal.thermoelastic_heating) is_known = false;  // what is stretched cools
  for (const ScalarFunction* around : temperatures_around(scene)) {
    is_known = is_known && around->is_constant();
    if (!is_known) break;
    const double value = around->at({0.0, 0.0, 0.0, 0.0});
    lowest_ = std::min(lowest_, value), highest_ = std::max(highest_, value);
  }
  lowest_ = is_known ? least_over_ranks(*model.mesh()->comm, lowest_) : -std::numeric_limits<double>::infinity();
  highest_ = most_over_ranks(*model.mesh()->comm, highest_);
}

void HeatWatch::look_for_undershoot(const SemiSmoothSystem& system, const SystemEvaluation& at) {
  const Mesh& mesh = *model_.mesh();
  const FieldRows& rows = model_.space().rows(model_.heat().bodies->temperature());
  const RCP<const Vector> unknowns = system.unknowns(at.x());
  const auto theta = unknowns->getLocalViewHost(Tpetra::Access::ReadOnly);
  std::optional<StepFailure> failure;  // the step has passed with it
  for (const double value : model_.heat().prescribed->values(at.context().time, failure))
    lowest_ = std::min(lowest_, value), highest_ = std::max(highest_, value);
  lowest_ = least_over_ranks(*mesh.comm, lowest_);
  highest_ = most_over_ranks(*mesh.comm, highest_);
  double least = std::numeric_limits<double>::infinity(), most = -least;
  LocalOrdinal where = -1;
  for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node) {
    if (!rows.lives(node)) continue;
    most = std::max(most, theta(rows(node, 0), 0));
    if (theta(rows(node, 0), 0) < least) least = theta(rows(node, 0), 0), where = node;
  }
  const double least_of_all = least_over_ranks(*mesh.comm, least), range = std::max(highest_, most_over_ranks(*mesh.comm, most)) - lowest_;
  if (is_said_ || !(range > round_off * std::abs(lowest_)) || !(least_of_all < lowest_ - noticeable * range)) return;
  is_said_ = true;
  const int rank = least_over_ranks(*mesh.comm, least == least_of_all ? mesh.comm->getRank() : mesh.comm->getSize());
  std::array<double, 3> x{};
  if (mesh.comm->getRank() == rank) x = mesh.coordinates[static_cast<std::size_t>(where)];
  x = {sum_over_ranks(*mesh.comm, x[0]), sum_over_ranks(*mesh.comm, x[1]), sum_over_ranks(*mesh.comm, x[2])};
  warn_(fmt::format(
      "  the temperature {:.6g} at ({:.6g}, {:.6g}, {:.6g}) is {:.2g} below {:.6g}, the lowest of the start and of all that is prescribed: "
      "steps are too short for the mesh, or elements too large; please take a \"lumped capacity\", longer steps, or a finer mesh there",
      least_of_all, x[0], x[1], x[2], lowest_ - least_of_all, lowest_));
}

FailureExplanation HeatWatch::explain(const SemiSmoothSystem& system, const FailedTry& failed) {
  const FailureKind kind = failed.failure.kind();
  const bool may_be = kind == FailureKind::cycling_active_set || kind == FailureKind::too_many_iterations || kind == FailureKind::line_search;
  if (!may_be || !model_.heat().contact || !failed.linearised) return {};
  const bool expands = std::any_of(scene_.materials.begin(), scene_.materials.end(),
                                   [](const auto& material) { return material.value.law.options->thermal.expansion.is_given(); });
  if (!expands) return {};
  const SystemEvaluation evaluation = system.evaluate(*failed.linearised->x, failed.linearised->context);
  for (const ThermalPair& pair : model_.heat().contact->pairs()) {
    if (!pair.conductance || pair.gap) continue;
    const double just_closed = pair.conductance->at({0.0, highest_, 0.0, 1.0}).value;
    if (!(just_closed > 0.0)) continue;
    const std::vector<ContactNodeState> states = node_states(evaluation.contact_laws(), pair.pair);
    const bool mine =
        std::any_of(states.begin(), states.end(), [](const ContactNodeState& node) { return node.closed ? node.pressure <= 0.0 : node.gap < 0.0; });
    if (most_over_ranks(*model_.mesh()->comm, mine ? 1 : 0) == 0) continue;
    return {
        fmt::format("contact \"{}\": where surfaces begin to touch the conductance is {:.3g} at once, and 0 where they do not: contact that closes "
                    "cools, shrinks and opens, and no state need exist between the two; please give the pair a \"gap conductance\" that agrees "
                    "with it at a gap of 0, or a \"conductance\" that begins at 0 with the pressure",
                    scene_.contact[pair.pair].name, just_closed)};
  }
  return {};
}

void HeatWatch::accept(const SemiSmoothSystem& system, const SystemEvaluation& at) {
  const double time = at.context().time;
  const RCP<const Vector> forces = at.forces();
  const double imbalance = balance_.imbalance(*model_.mesh(), heat_of_step(scene_, model_, system, at, *forces, time - last_time_));
  last_time_ = time;
  if (imbalance > worst_) worst_ = imbalance, time_of_worst_ = time;
  if (stores_everywhere_) {
    if (scene_.heat.is_transient()) look_for_undershoot(system, at);
    return;
  }
  if (!undetermined_.empty()) return;
  const std::vector<ThermalPair> conducting = model_.heat().contact ? model_.heat().contact->conducting_now() : std::vector<ThermalPair>{};
  for (const int body : undetermined_bodies(scene_, model_.space(), model_.heat(), bodies_that_conduct(*model_.mesh(), scene_, conducting)))
    undetermined_.push_back(model_.mesh()->bodies[static_cast<std::size_t>(body)].name);
  time_undetermined_ = time;
}

std::optional<StepFailure> HeatWatch::end(const SemiSmoothSystem&, const EndOfSteps&) {
  if (!undetermined_.empty())
    return StepFailure(
        FailureKind::step_error,
        fmt::format("nothing determines the temperature of {} at t = {:g}: no pair conducts heat there, as it is open or its conductance is "
                    "0. Please give a \"gap conductance\", convection, or a prescribed temperature",
                    quoted_list(undetermined_), time_undetermined_));
  if (!(worst_ > balanced)) return std::nullopt;
  return StepFailure(
      FailureKind::step_error,
      fmt::format("heat is not in balance: in the step to t = {:g} {:.2e} of the largest power is missing; allowed: {:.0e}. Please take a "
                  "smaller \"momentum tolerance\"",
                  time_of_worst_, worst_, balanced));
}

void HeatWatch::serialize(StateArchive& archive) {
  balance_.serialize(archive, "heat_watch");
  mortise::serialize(archive, "heat_watch.worst", worst_);
  mortise::serialize(archive, "heat_watch.time_of_worst", time_of_worst_);
  mortise::serialize(archive, "heat_watch.last_time", last_time_);
  // Where not all causes are known there is no lowest temperature, nor a number for a file.
  const bool is_known = std::isfinite(lowest_) && std::isfinite(highest_);
  double lowest = is_known ? lowest_ : 0.0, highest = is_known ? highest_ : 0.0;
  mortise::serialize(archive, "heat_watch.lowest", lowest);
  mortise::serialize(archive, "heat_watch.highest", highest);
  if (is_known) lowest_ = lowest, highest_ = highest;
  mortise::serialize(archive, "heat_watch.time_undetermined", time_undetermined_);
  int is_said = is_said_ ? 1 : 0;
  mortise::serialize(archive, "heat_watch.is_said", is_said);
  is_said_ = is_said != 0;
}

}  // namespace mortise
