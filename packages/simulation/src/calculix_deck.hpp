#pragma once
// A scene as an input deck of CalculiX.

#include <string>
#include <vector>

#include "mortise/simulation/model.hpp"
#include "mortise/simulation/peer.hpp"

namespace mortise {

/// Numbers of a deck. The plane mesh becomes one layer of bricks and wedges between z = 0 and z = thickness, every node of which is held in z: that
/// is plane strain, also for the mortar contact, which refuses the plane elements of CalculiX (it does not take nodes with multiple point
/// constraints, by which they are made of bricks). Nodes and elements are those of the mesh, counted from 1; the second layer of nodes follows the
/// first.
struct DeckNumbers {
  GlobalOrdinal nodes = 0;  ///< of one layer
  GlobalOrdinal node(GlobalOrdinal id, int layer) const { return id + 1 + layer * nodes; }
};

/// Everything in the scene that a deck cannot hold, each at its place.
std::vector<Diagnostic> calculix_obstacles(const Scene& scene, const Model& model);

/// Ends of the fixed steps, and 0 before them.
std::vector<double> deck_times(const SteppingOptions& stepping);

/// Nodes, elements, sections, materials.
std::string deck_bodies(const Scene& scene, const Model& model);

/// Surfaces and contact pairs.
std::string deck_contact(const Scene& scene, const Model& model, Peer peer);

/// Prescribed displacements and nodal forces over time: what stands before the step and what stands in it.
struct DeckConditions {
  std::string before, within;
};
DeckConditions deck_conditions(const Scene& scene, const Model& model);

/// The whole deck, for a scene without obstacles. The mesh is on one rank.
std::string calculix_deck(const Scene& scene, const Model& model, Peer peer);

}  // namespace mortise
