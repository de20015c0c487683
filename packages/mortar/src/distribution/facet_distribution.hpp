#pragma once
// Choice of the rank that integrates each slave facet, whoever owns its nodes.

#include <array>
#include <map>
#include <set>
#include <vector>

#include "exchange/word_stream.hpp"
#include "mortise/mortar/facet_partition.hpp"
#include "slave/slave_surface.hpp"

namespace mortise {

/// A slave facet that is integrated away from the ranks that own its nodes, with all that this takes; nodes by their ids.
struct TravellingFacet {
  struct Tangents {
    SurfaceFacet nodes;
    decltype(NodeTangents::slope) slope;
  };
  struct Stencil {
    std::vector<Tangents> facets;
    std::array<bool, 3> projected{};
    bool of_node = true;  ///< and of all facets there; not of one side of a kink
  };
  SurfaceFacet nodes;
  std::vector<int> receivers;     ///< ranks that want its coupling
  std::vector<Stencil> stencils;  ///< [nodes] of their normals
  FacetMultipliers multipliers;   ///< but for the basis, which its nodes tell
  SurfaceFacets candidates;
};

/// Every facet is known to the owners of its nodes, its receivers. One of them, which they agree on by ids alone, is its home. It integrates the
/// facet as long as work stays balanced, and gives it away when it does not. Facets are numbered as in SlaveSurface. Several ranks only.
class FacetDistribution {
 public:
  /// Collective.
  FacetDistribution(const RCP<const Map>& owned_nodes, const SlaveSurface& slave);

  bool is_home(std::size_t f) const { return home_[f] == rank_; }
  bool integrated_here(std::size_t f) const { return integrator_[f] == rank_; }
  /// Ranks that want the coupling of facet f, this one among them.
  const std::vector<int>& receivers(std::size_t f) const { return receivers_[f]; }

  /// Largest over mean work of a rank, where homes give the work of their facets; 1 where there is none. Collective.
  /// @param as_owned  if each home did what it is home to; otherwise as facets are distributed
  double imbalance(const std::vector<double>& work, bool as_owned) const;

  /// Gives each facet a rank by place and work. Stays as it is, and returns false, where that is not worth_moving() to. Collective.
  /// @param facets  [facets] those that this rank is not home to do not count
  bool redistribute(const std::vector<PartitionedFacet>& facets, double bound);

  /// Facets that this rank is no receiver of and integrates, after which exchange() knows who talks to whom. Collective.
  /// @param candidates  [facets] of those that this rank is home to
  std::vector<TravellingFacet> send_away(const SlaveSurface& slave, const std::vector<SurfaceFacets>& candidates);

  /// The message for another rank that is a receiver of a facet integrated here, for exchange().
  Words& message_to(int receiver) { return outgoing_[receiver]; }
  /// Sends all messages; gives those for this rank and leaves empty ones. Collective.
  std::vector<Words> exchange();
  /// The number of the facet of these nodes, of which this rank is a receiver.
  std::size_t facet_of(const SurfaceFacet& nodes) const { return number_.at(nodes); }

 private:
  RCP<const Communicator> comm_;
  int rank_;
  std::vector<std::vector<int>> receivers_;  ///< [facets] ascending
  std::vector<int> home_, integrator_;       ///< [facets]
  std::vector<SurfaceFacet> ids_;            ///< [facets]
  std::map<SurfaceFacet, std::size_t> number_;
  std::map<int, Words> outgoing_;  ///< by rank: all other receivers of the facets that this rank integrates
  std::set<int> sources_;          ///< other ranks that integrate facets that this one receives
};

}  // namespace mortise
