#include "run/stepping/step_preparation.hpp"

#include <Tpetra_Vector.hpp>
#include <algorithm>

#include "model/edge_contact.hpp"
#include "model/heat/contact_heat_book.hpp"

namespace mortise {

StepPreparation::StepPreparation(const Model& model, const Scene& scene, const SemiSmoothSystem& system)
    : model_(model), scene_(scene), system_(system), taken_up_(std::min(scene.stepping.step, scene.stepping.end_time)) {
  const auto& pairs = model.surfaces_at_start().pairs;
  begins_pressed_ = std::any_of(pairs.begin(), pairs.end(), [](const PairAtStart& pair) { return pair.overlap.depth > 0.0; });
}

AcceptedState StepPreparation::prepared(AcceptedState state, double time) const {
  if (model_.edges() != nullptr) model_.edges()->start_step(*system_.unknowns(*state.x));
  auto& contact = state.context.contact;
  if (!contact) return state;
  contact = model_.contact()->with_clearances(*contact, time);
  if (const auto& heat = model_.heat().contact)
    contact = heat->with_temperatures(*model_.contact(), *contact, state.context.time, *system_.unknowns(*state.x));
  return state;
}

StepContext StepPreparation::start(const AcceptedState& from, double time, const Vector& d, Vector& z) const {
  AcceptedState allowed = prepared(from, time);
  for (std::size_t pair = 0; pair < scene_.contact.size(); ++pair)
    if (const double depth = model_.surfaces_at_start().pairs[pair].overlap.depth; depth > 0.0) {
      const double left = 1.0 - time / scene_.contact[pair].value.start.taken_up_at.value_or(taken_up_);
      allowed.context.contact = model_.contact()->allow_overlap(*allowed.context.contact, pair, depth * std::max(0.0, left));
    }
  return system_.start_step(allowed, time, d, z);
}

}  // namespace mortise
