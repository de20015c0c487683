#pragma once
// Load of each of many ranks: what it would hold and do.

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "mortise/mesh/mesh_plan.hpp"
#include "mortise/simulation/scene/scene.hpp"

namespace mortise {

/// One rank's.
struct RankPlan {
  MeshShare mesh;
  long facets = 0, segments = 0;  ///< slave facets that it integrates, and their overlaps, over all pairs
  /// Received from each other rank: ghost values of one nodal vector; couplings of facets in one evaluation with derivatives [bytes].
  std::map<int, double> vector_bytes, coupling_bytes;
  double memory_mib = 0.0;

  /// Ranks that it receives from.
  std::size_t neighbours() const;
};

/// A contact pair over all ranks.
struct PairPlan {
  std::string name;
  long facets = 0, segments = 0;    ///< slave facets that overlap a master facet in the reference configuration, and their overlaps
  long most_segments = 0;           ///< of one facet: no rank can do less
  double imbalance_as_owned = 1.0;  ///< largest over mean work of the ranks, if every facet is integrated by an owner of its nodes
  double imbalance = 1.0;           ///< the same as facets are given to ranks
  bool is_moved = false;            ///< facets are given to other ranks

  /// Least imbalance that facets as a whole allow.
  double least_imbalance(int ranks) const;
};

struct ScalePlan {
  int dimension = 0;
  std::vector<RankPlan> ranks;
  std::vector<PairPlan> pairs;
};

/// Makes plans of one scene: mesh, search and integrals are done once for all numbers of ranks.
class ScalePlanner {
 public:
  /// `comm` has one rank. Throws InputError for what is wrong with the scene's meshes and contact pairs, and for a mesh that `most_ranks` cannot
  /// number.
  ScalePlanner(const RCP<const Communicator>& comm, const Scene& scene, int most_ranks);
  ~ScalePlanner();

  /// Shares the scene out to so many ranks.
  ScalePlan plan(int ranks) const;

 private:
  struct Model;
  std::unique_ptr<const Model> model_;
};

}  // namespace mortise
