#include "model/pairs/search_reach.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <algorithm>

#include "mortise/contact/enforcement.hpp"
#include "mortise/mesh/sets.hpp"

namespace mortise {

void reach_for_clearances(const Mesh& mesh, const Scene& scene, SurfacesAtStart& surfaces) {
  constexpr int times = 100;
  for (std::size_t p = 0; p < surfaces.pairs.size(); ++p) {
    const ContactPairOptions& options = scene.contact[p].value;
    if (!options.contact.clearance || options.contact.mortar.search_reach) continue;
    double mine = 0.0, largest = 0.0;
    for (const LocalOrdinal node : require_node_set(mesh, options.slave)) {
      const auto& x = mesh.coordinates[static_cast<std::size_t>(node)];
      for (int n = 0; n <= times; ++n) {
        try {
          mine = std::max(mine, -(*options.contact.clearance)(scene.stepping.end_time * n / times, x[0], x[1], x[2]));
        } catch (const InputError&) {  // the step that asks for it says so
        }
        if (options.contact.clearance->is_constant()) break;
      }
    }
    Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(largest));
    PairAtStart& pair = surfaces.pairs[p];
    if (largest > 0.0) pair.reach = std::max(pair.reach.value_or(0.0), pair.longest + largest);
  }
}

// The iteration that pushes surfaces apart that overlap by d leaves pressures of E d / L, L the size of the bodies, and gaps of second order, d^2 / 2
// R. Nodes stay closed through it if c_n A < 2 E R / (L d); half of E / d is that for R = L / 4. Beside it E / h of short facets makes all nodes
// open, and close again, endlessly.
void take_up(const PairAtStart& start, ContactPair& pair) {
  if (!start.reach) return;
  pair.options.mortar.search_reach = start.reach;
  if (start.overlap.depth <= 0.5 * start.longest) return;  // the reach is that of a clearance
  constexpr double share = 0.5;
  auto& constant = pair.options.complementarity_constant;
  if (!constant && pair.options.formulation.options->enforcement()->holds_exactly()) constant = share * pair.youngs_modulus / start.overlap.depth;
}

}  // namespace mortise
