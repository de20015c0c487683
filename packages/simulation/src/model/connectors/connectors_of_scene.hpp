#pragma once
// Springs, dashpots and point masses of a scene, made into parts of its system.

#include <memory>
#include <vector>

#include "mortise/core/timers.hpp"
#include "mortise/simulation/model/model.hpp"

namespace mortise {

/// Adds springs and dashpots to a system, and what they couple to its graph. Nothing for a scene without. Collective.
/// @throws InputError on all ranks for what is wrong with them
ConnectorsOfModel add_connectors(const Scene& scene, const std::shared_ptr<const Bodies>& bodies, const Timers& timers, SystemParts& parts);

/// [owned nodes] point masses that have weight. Empty: nothing. Collective.
/// @throws InputError on all ranks for what is wrong with point masses
std::vector<double> weights_of_points(const Scene& scene, const Bodies& bodies);

}  // namespace mortise
