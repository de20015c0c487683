#pragma once
// A slave facet as the integration needs it, in 2D and in 3D.

#include <boost/container/static_vector.hpp>

#include "facet_moments.hpp"
#include "nodal_normal.hpp"

namespace mortise {

struct SlaveFacetData {
  Facet<LocalOrdinal> nodes;
  boost::container::static_vector<const NodalNormal*, most_side_nodes> normals;
  boost::container::static_vector<const NormalStencil*, most_side_nodes> stencils;  ///< of the normals; for second derivatives only
  const FacetMultipliers* multipliers = nullptr;
  bool goes_on = false;    ///< at both its ends the surface goes on smoothly: what the master has behind a corner may yield (2D)
  bool at_corner = false;  ///< one of its nodes takes the master's normal: FacetCoupling::facing is asked for
};

/// How near a master facet has to be: at least one that overlaps within `touch`, then all that do within `all` take part.
struct FacetReach {
  double touch = 0.0, all = 0.0;
};

/// Where `node` stands in `list`; put at its end if it is new.
inline Eigen::Index place_of(std::vector<LocalOrdinal>& list, LocalOrdinal node) {
  for (std::size_t place = 0; place < list.size(); ++place)
    if (list[place] == node) return static_cast<Eigen::Index>(place);
  list.push_back(node);
  return static_cast<Eigen::Index>(list.size()) - 1;
}

}  // namespace mortise
