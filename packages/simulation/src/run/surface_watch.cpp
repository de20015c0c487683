#include "run/surface_watch.hpp"

#include "model/current_places.hpp"

namespace mortise {

SurfaceWatch::SurfaceWatch(const Model& model, const Scene& scene, const std::function<void(const std::string&)>& warn)
    : model_(model), passages_(model, scene), corners_(model, scene, warn), overlaps_(model, scene, warn), leans_(model, scene, warn) {}

void SurfaceWatch::examine(const Vector& displacement, const ContactLaws& laws) {
  const PlacedBodies bodies = placed_bodies(model_, displacement);
  passages_.examine(bodies, laws);
  corners_.examine(bodies, laws);
  overlaps_.examine(bodies, laws);
  leans_.examine(laws);
}

void SurfaceWatch::accept() {
  corners_.accept();
  overlaps_.accept([&](std::size_t pair) { return corners_.has_warned(pair); });
  leans_.accept();
}

const std::string& SurfaceWatch::without_force() const {
  return corners_.without_force().empty() ? overlaps_.without_force() : corners_.without_force();
}

void SurfaceWatch::serialize(StateArchive& archive) {
  corners_.serialize(archive);
  overlaps_.serialize(archive);
  leans_.serialize(archive);
}

}  // namespace mortise
