#pragma once
// Share in which a slave facet at a kink belongs to what the kink's other facets touch.

#include "slave/facet_moments.hpp"

namespace mortise {

/// D, M and gap of a facet as combine(), and FacetCoupling::alignment. Of a facet at a kink a node without multiplier leaves its function to others
/// in that share only. The function of j is
///   phi_j = own function of j + alignment sum_k S_jk own function of k,  k != j.
/// Otherwise a side that stands off, held at its far end, would hold the corner off by its mean gap.
/// @param coupling  with `facing`
bool combine_aligned(const FacetMoments& moments, const FacetMultipliers& multipliers, const FacetFunctions& functions, bool derivatives,
                     FacetCoupling& coupling);

}  // namespace mortise
