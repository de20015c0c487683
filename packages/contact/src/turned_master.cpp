// Masters that turn their backs on the slave: nothing is ever pressed on them.

#include <algorithm>

#include "implementation.hpp"

namespace mortise {
namespace {
constexpr double share_of_a_facet = 0.1;  // a back no further behind a node than that may have been meant to touch it
}

// A slave that may touch has its master before it or, where it begins in it, behind it, facing it. Along n there is nothing of that kind for any node
// if the master is turned round; along -n its facets then face the line, behind its start.
std::vector<std::size_t> ContactSystem::pairs_with_turned_master() const {
  const Implementation& self = *implementation_;
  std::vector<std::size_t> turned;
  for (std::size_t p = 0; p < self.pairs.size(); ++p) {
    const detail::PairCoupling& pair = *self.pairs[p];
    if (pair.definition().second_pass_of) continue;
    std::vector<std::size_t> nodes;
    std::vector<SpatialVector> normals, opposite;
    for (std::size_t s = 0; s < pair.slave_nodes().size(); ++s) {
      nodes.push_back(s);
      normals.push_back(pair.rows()[s].normal);
      opposite.emplace_back(-pair.rows()[s].normal);
    }
    const auto count = [&](const std::vector<SpatialVector>& along, const auto& counts) {
      const auto distances = pair.interface().distances_to_master(*self.evaluated_at, nodes, along);
      return self.sum(static_cast<double>(std::count_if(distances.begin(), distances.end(), counts)));
    };
    const double facing = count(normals, [](const auto& distance) { return distance.has_value(); });
    const double touching = share_of_a_facet * pair.size();
    const double backs = count(opposite, [&](const auto& distance) { return distance && *distance < touching; });
    if (facing == 0.0 && backs >= 0.5 * self.sum(static_cast<double>(nodes.size())) && backs > 0.0) turned.push_back(p);
  }
  return turned;
}

}  // namespace mortise
