#include "run/watches/surface_watch.hpp"

#include "model/current_places.hpp"

namespace mortise {

SurfaceWatch::SurfaceWatch(const Model& model, const Scene& scene, const std::function<void(const std::string&)>& warn)
    : model_(model), passages_(model, scene), corners_(model, scene, warn), overlaps_(model, scene, warn), leans_(model, scene, warn) {}

RCP<Vector> SurfaceWatch::verify(const SemiSmoothSystem& system, const AcceptedState&, const SystemEvaluation& found, int) {
  const PlacedBodies bodies = placed_bodies(model_, *system.unknowns(found.x()));
  const ContactLaws& laws = found.contact_laws();
  passages_.examine(bodies, laws);
  corners_.examine(bodies, laws);
  overlaps_.examine(bodies, laws);
  leans_.examine(laws);
  return Teuchos::null;
}

void SurfaceWatch::accept(const SemiSmoothSystem&, const SystemEvaluation&) {
  corners_.accept();
  overlaps_.accept([&](std::size_t pair) { return corners_.has_warned(pair); });
  leans_.accept();
}

std::optional<StepFailure> SurfaceWatch::end(const SemiSmoothSystem&, const EndOfSteps& end) {
  const std::string& without_force = corners_.without_force().empty() ? overlaps_.without_force() : corners_.without_force();
  if (!end.is_converged || without_force.empty()) return std::nullopt;
  return StepFailure(FailureKind::lost_contact, without_force + "; please make the slave finer there, or exchange slave and master");
}

void SurfaceWatch::serialize(StateArchive& archive) {
  corners_.serialize(archive);
  overlaps_.serialize(archive);
  leans_.serialize(archive);
}

}  // namespace mortise
