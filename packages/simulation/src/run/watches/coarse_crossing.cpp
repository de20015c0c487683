#include "run/watches/coarse_crossing.hpp"

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <algorithm>
#include <cmath>

#include "model/current_places.hpp"
#include "model/edge_contact.hpp"

namespace mortise {
namespace {

constexpr double pieces = 2.0;  ///< fewer of them across the contact do not resolve it

}  // namespace

RCP<Vector> CrossingExamination::verify(const SemiSmoothSystem& system, const AcceptedState&, const SystemEvaluation& found, int) {
  model_.edges()->examine(*system.unknowns(found.x()));
  return Teuchos::null;
}

// A force F on crossing edges comes of an approach d = sqrt(F/K), over a section sqrt(A) d wide. Where that is less than two facets of length h, F is
// that of the few nodes there, which give way by about F/(E* h): too much force for the approach, about h/d times. Or it is K d^2 of the edges
// themselves, which is right as far as the bodies are half spaces, and pressures around have no meaning. Nodes that bear far too much make d too
// large as well: two facets are resolved where nodes beyond the one with the crossing bear some of the force.
std::optional<StepFailure> CoarseCrossingWatch::end(const SemiSmoothSystem& system, const EndOfSteps& end) {
  if (!end.is_converged || end.last == nullptr) return std::nullopt;
  const Mesh& mesh = *model_.mesh();
  const PlaceOfNode at = current_places(*model_.bodies(), *system.unknowns(end.last->x()));
  for (const CrossingEdges& crossing : model_.edges()->crossings()) {
    double mine = 0.0, of_nodes = 0.0, reached = 0.0, reached_of_all = 0.0;
    for (const ContactNodeState& node : node_states(end.last->contact_laws(), crossing.contact))
      if (const double distance = (at(node.owned_node) - crossing.place).norm(); node.closed && distance < pieces * crossing.length) {
        mine += Eigen::Map<const Eigen::Vector3d>(node.force.data()).dot(crossing.normal);
        reached = std::max(reached, distance);
      }
    Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_SUM, mine, Teuchos::outArg(of_nodes));
    Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MAX, reached, Teuchos::outArg(reached_of_all));
    const double force = crossing.force + std::max(0.0, of_nodes), depth = std::sqrt(force / crossing.stiffness);
    const bool is_wide = std::sqrt(crossing.area) * depth > pieces * crossing.length;
    if (!(force > 0.0) || (is_wide && reached_of_all > crossing.length)) continue;
    const auto& x = crossing.place;
    warn_(fmt::format(
        "contact \"{}\": edges cross at ({:.6g}, {:.6g}, {:.6g}) and press with {:.3g}, by nodes within {:.2g} of there or over a width of {:.2g}, "
        "which is less than {:.0f} facets of length {:.2g}; a law for two elastic wedges bears {:.2g} of it, nodes of these facets the rest; so the "
        "force is known to its order of magnitude, and pressures are not; please make both sides finer there, or take \"gap weighting\" \"standard\"",
        scene_.contact[crossing.contact].name, x[0], x[1], x[2], force, reached_of_all, std::sqrt(crossing.area) * depth, pieces, crossing.length,
        crossing.force));
  }
  return std::nullopt;
}

}  // namespace mortise
