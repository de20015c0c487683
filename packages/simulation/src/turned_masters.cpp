#include "turned_masters.hpp"

#include <fmt/format.h>

#include <Tpetra_Vector.hpp>

namespace mortise {

void warn_of_turned_masters(const Model& model, const Scene& scene, RunLog& log) {
  const auto& contact = model.contact();
  if (!contact) return;
  std::optional<StepFailure> failure;
  contact->evaluate(Vector(model.bodies()->dofs()), false, failure);
  try {
    throw_if_any(*model.mesh()->comm, failure);
  } catch (const StepFailure&) {
    return;  // the first step says so
  }
  for (const std::size_t pair : contact->pairs_with_turned_master()) {
    const auto& [name, place, options] = scene.contact[pair];
    log.warning(
        fmt::format("{}:{}: {}: the master \"{}\" turns its back on the slave \"{}\": no facet of it faces the slave, so nothing will ever be "
                    "pressed on it. A profile's body lies to the left of the way along its points: please give them in reverse, or take another "
                    "side",
                    place.file, place.line, place.path, options.master.value, options.slave.value));
  }
}

}  // namespace mortise
