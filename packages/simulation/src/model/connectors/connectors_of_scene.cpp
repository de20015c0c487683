#include "model/connectors/connectors_of_scene.hpp"

#include <Tpetra_CrsMatrix.hpp>

#include "model/connectors/connector_contributions.hpp"
#include "model/edges/widened_graph.hpp"

namespace mortise {

ConnectorsOfModel add_connectors(const Scene& scene, const std::shared_ptr<const Bodies>& bodies, const Timers& timers, SystemParts& parts) {
  ConnectorsOfModel result;
  const auto couple = [&](const Connectors& connectors) {
    parts.bulk_graph = [inner = parts.bulk_graph, space = bodies->shared_space(), coupled = connectors.coupled()] {
      return with_couplings(inner(), *space, coupled);
    };
  };
  if (!scene.springs.empty()) {
    result.springs = std::make_shared<const Connectors>(bodies, scene.springs);
    parts.contributions.push_back(std::make_shared<SpringForces>(result.springs, timers));
    couple(*result.springs);
  }
  if (!scene.dashpots.empty()) {
    result.dashpots = std::make_shared<const Connectors>(bodies, scene.dashpots);
    result.dashpot_forces = std::make_shared<DashpotForces>(result.dashpots, !scene.inertia.acts(), timers);
    parts.contributions.push_back(result.dashpot_forces);
    couple(*result.dashpots);
  }
  return result;
}

std::vector<double> weights_of_points(const Scene& scene, const Bodies& bodies) {
  if (scene.point_masses.empty()) return {};
  return weighing_masses(*bodies.mesh(), *matrix_of_point_masses(bodies, scene.point_masses));
}

}  // namespace mortise
