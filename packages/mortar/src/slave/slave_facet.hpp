#pragma once
// A slave facet as the integration needs it, in 2D and in 3D.

#include <algorithm>
#include <boost/container/static_vector.hpp>
#include <cmath>
#include <optional>
#include <vector>

#include "normals/nodal_normal.hpp"
#include "slave/facet_moments.hpp"

namespace mortise {

struct SlaveFacetData {
  Facet<LocalOrdinal> nodes;
  boost::container::static_vector<const NodalNormal*, most_side_nodes> normals;
  boost::container::static_vector<const NormalStencil*, most_side_nodes> stencils;  ///< of the normals; for second derivatives only
  const FacetMultipliers* multipliers = nullptr;
  bool goes_on = false;    ///< at both its ends the surface goes on smoothly: what the master has behind a corner may yield (2D)
  bool at_corner = false;  ///< one of its nodes takes the master's normal: FacetCoupling::facing is asked for
};

/// Distances within which master facets take part: at least one that overlaps within `touch`, then all that do within `all`.
struct FacetReach {
  double touch = 0.0, all = 0.0;
};

/// Candidates of a slave facet that may take part. Those that overlap it beyond `touch` may not if no nodes lead from them, over candidates, to one
/// within `touch`. Such ones are of another surface, and the near one may stand between.
/// @param distances  of the candidates that overlap; of others infinite
/// @return none if all may
template <class Masters>
std::optional<Masters> without_surfaces_behind(const Masters& masters, const std::vector<double>& distances, double touch) {
  const auto is_far = [&](std::size_t f) { return distances[f] > touch && std::isfinite(distances[f]); };
  bool any_far = false, any_near = false;
  for (std::size_t f = 0; f < masters.size(); ++f) {
    any_far = any_far || is_far(f);
    any_near = any_near || distances[f] <= touch;
  }
  if (!any_far || !any_near) return std::nullopt;
  std::vector<char> reached(masters.size(), 0);
  for (std::size_t f = 0; f < masters.size(); ++f) reached[f] = distances[f] <= touch ? 1 : 0;
  const auto meet = [&](std::size_t f, std::size_t g) {
    return std::find_first_of(masters[f].begin(), masters[f].end(), masters[g].begin(), masters[g].end()) != masters[f].end();
  };
  for (bool grows = true; grows;) {
    grows = false;
    for (std::size_t f = 0; f < masters.size(); ++f)
      for (std::size_t g = 0; reached[f] == 0 && g < masters.size(); ++g)
        if (reached[g] != 0 && meet(f, g)) reached[f] = 1, grows = true;
  }
  Masters kept;
  for (std::size_t f = 0; f < masters.size(); ++f)
    if (reached[f] != 0 || !is_far(f)) kept.push_back(masters[f]);
  return kept.size() < masters.size() ? std::optional(kept) : std::nullopt;
}

/// Where `node` stands in `list`; put at its end if it is new.
inline Eigen::Index place_of(std::vector<LocalOrdinal>& list, LocalOrdinal node) {
  for (std::size_t place = 0; place < list.size(); ++place)
    if (list[place] == node) return static_cast<Eigen::Index>(place);
  list.push_back(node);
  return static_cast<Eigen::Index>(list.size()) - 1;
}

}  // namespace mortise
