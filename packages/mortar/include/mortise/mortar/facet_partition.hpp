#pragma once
// Choice of the rank that integrates a facet: the rules that runs and plans share.

#include <array>
#include <vector>

#include "mortise/core/types.hpp"
#include "mortise/shape/surface_facet.hpp"

namespace mortise {

/// A facet as the partition sees it.
struct PartitionedFacet {
  std::array<double, 3> centre{};  ///< third component 0 in 2D
  double work = 0.0;               ///< >= 0
};

/// The rank that integrates a facet as long as work is balanced: one of the owners of its nodes, chosen by their ids alone.
/// @param owners  of its nodes, ascending, without repeats
int home_of(const SurfaceFacet& facet, const std::vector<int>& owners);

/// Largest over mean of what the ranks have to do; 1 where there is nothing to do.
double largest_over_mean(const std::vector<double>& work_of_rank);

/// True if facets should move, for a bound on largest_over_mean(). The bound is missed now, and then it would hold, or at least come nearer by a
/// tenth. The latter keeps facets that are too few for the ranks from moving at every search.
bool worth_moving(double now, double then, double bound);

/// Bytes of the message in which the coupling of a facet travels, with derivatives.
/// @param columns  nodes that it depends on
std::size_t coupling_bytes(std::size_t slaves, std::size_t masters, std::size_t columns, int dimension);

/// Collective: the part of each facet of this rank, in 0 ... parts - 1, so that all parts have about the same work and facets that lie together stay
/// together. Facets may stand on any ranks, each on one; no rank sees all of them. Cuts the surface by coordinates (recursive bisection of Zoltan).
std::vector<int> partition_facets(const RCP<const Communicator>& comm, const std::vector<PartitionedFacet>& facets, int parts);

}  // namespace mortise
