#pragma once
// Pairs of edges that may touch: sharp edges of the slave near those of the master.

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "mortise/mortar/edge_crossing.hpp"
#include "mortise/simulation/scene/scene.hpp"
#include "surfaces/sharp_edges.hpp"

namespace mortise {

/// Two edges near one another. Nodes are places in EdgeSpots::nodes.
struct EdgeSpot {
  std::size_t contact = 0;  ///< pair of the scene
  double reach = 0.0;       ///< of that pair
  double area = 0.0;        ///< of the section of the overlap, over the depth squared
  EdgePair edges;
};

/// All of them, the same on every rank. Edges cross at places, whose number does not grow on a finer mesh.
struct EdgeSpots {
  std::vector<GlobalOrdinal> nodes;  ///< ids, ascending
  std::vector<EdgeSpot> spots;
};

/// Sharp edges of the pairs of a scene, and which of them are near one another.
class EdgeSearch {
 public:
  /// Pairs in the geometry of the reference configuration, and of a body with itself, have none. Collective.
  /// @param compliances  [blocks of the mesh] (1 - nu^2)/E, 0: rigid
  /// @param reaches      [pairs of the scene] search reach
  EdgeSearch(const Mesh& mesh, const Scene& scene, const std::vector<double>& compliances, const std::vector<double>& reaches);

  /// True if some pair has edges on both sides, on whichever ranks.
  bool any() const { return !pairs_.empty(); }

  /// Edges that may touch from these positions on. Collective.
  EdgeSpots find(const PlacedBodies& bodies) const;

 private:
  struct Surface {
    std::size_t body = 0;
    SharpEdges edges;
    std::map<GlobalOrdinal, EdgeNode> node;  ///< edges.nodes by their ids
  };
  /// Of two bodies: a pair of the scene may have several.
  struct Pair {
    std::size_t contact = 0;
    double reach = 0.0;
    Surface slave, master;
  };
  std::vector<EdgePiece> pieces(const Surface& surface, const PlaceOfNode& at) const;
  bool ways_are_blocked(const PlacedBodies& bodies, const Pair& pair, const std::vector<EdgeCrossing>& crossings) const;

  const Mesh& mesh_;
  std::vector<double> compliances_;
  std::vector<Pair> pairs_;
};

/// Positions of nodes that are given by their ids, on every rank. Collective.
std::vector<Eigen::Vector3d> places_on_all_ranks(const Mesh& mesh, const std::vector<GlobalOrdinal>& nodes, const PlaceOfNode& at);

}  // namespace mortise
