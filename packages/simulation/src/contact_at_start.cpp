#include "contact_at_start.hpp"

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>

#include "report_corners.hpp"

namespace mortise {
namespace {

constexpr double worth_a_word = 1e-6;  // overlap over the size of the model: less is round-off of what was meant to touch

void warn_of_turned_masters(const Model& model, const Scene& scene, RunLog& log) {
  for (const std::size_t pair : model.contact()->pairs_with_turned_master()) {
    const auto& [name, place, options] = scene.contact[pair];
    log.warning(
        fmt::format("{}:{}: {}: the master \"{}\" turns its back on the slave \"{}\": no facet of it faces the slave, so nothing will ever be "
                    "pressed on it. A profile's body lies to the left of the way along its points: please give them in reverse, or take another "
                    "side",
                    place.file, place.line, place.path, options.master.value, options.slave.value));
  }
}

void report_overlaps(const Model& model, const Scene& scene, RunLog& log) {
  const Vector no_pressure(model.contact()->multiplier_map());
  for (std::size_t pair = 0; pair < scene.contact.size(); ++pair) {
    double mine = 0.0, overlap = 0.0;
    for (const ContactNodeState& node : model.contact()->node_states(pair, no_pressure))
      if (node.covered > 0.0) mine = std::max(mine, -node.gap);
    Teuchos::reduceAll(*model.mesh()->comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(overlap));
    if (overlap > worth_a_word * model.size().length)
      log.info(fmt::format("  contact {}: the surfaces begin by up to {:.3g} in one another; the first step pushes them apart",
                           scene.contact[pair].name, overlap));
  }
}

}  // namespace

void report_contact_at_start(const Model& model, const Scene& scene, RunLog& log) {
  const auto& contact = model.contact();
  if (!contact) return;
  std::optional<StepFailure> failure;
  contact->evaluate(Vector(model.bodies()->dofs()), false, failure);
  try {
    throw_if_any(*model.mesh()->comm, failure);
  } catch (const StepFailure&) {
    return;  // the first step says so
  }
  warn_of_turned_masters(model, scene, log);
  report_overlaps(model, scene, log);
  report_corners(*contact, log);
}

}  // namespace mortise
