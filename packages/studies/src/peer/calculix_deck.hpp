#pragma once
// A scene as an input deck of CalculiX.

#include <optional>
#include <string>
#include <vector>

#include "mortise/simulation/model/model.hpp"
#include "mortise/studies/peer.hpp"

namespace mortise {

/// Numbers of a deck. Nodes and elements are those of the mesh, counted from 1. A plane mesh becomes one layer of bricks and wedges between z = 0 and
/// z = thickness, with every node held in z: that is plane strain. The plane elements of CalculiX would not do for its mortar contact. CalculiX makes
/// them of bricks by multiple point constraints, and mortar contact refuses nodes with such constraints. The second layer of nodes follows the first.
struct DeckNumbers {
  explicit DeckNumbers(const Mesh& mesh) : nodes(mesh.owned_count()), dimension(mesh.dimension), layers(mesh.dimension == 2 ? 2 : 1) {}

  GlobalOrdinal nodes;  ///< of one layer
  int dimension;        ///< of the mesh: components of its unknowns that are in the deck
  int layers;           ///< nodes of the deck for one of the mesh, which share its forces
  GlobalOrdinal node(GlobalOrdinal id, int layer) const { return id + 1 + layer * nodes; }
};

/// The element of CalculiX that a cell of the mesh becomes: "C3D8"; empty if there is none.
std::string calculix_element(CellShape shape);

/// A given name as a line of a deck, which says nothing to CalculiX whatever the name is.
std::string deck_comment(const std::string& text);

/// Everything in the scene that a deck cannot hold, each at its place.
std::vector<Diagnostic> calculix_obstacles(const Scene& scene, const Model& model);

/// Ends of the fixed steps, and 0 before them.
std::vector<double> deck_times(const SteppingOptions& stepping);

/// Nodes, elements, sections, materials.
std::string deck_bodies(const Model& model);

/// Surfaces and contact pairs. `penalty`: of peers that press by one, in multiples of E/h.
std::string deck_contact(const Scene& scene, const Model& model, Peer peer, std::optional<double> penalty);

/// Prescribed displacements and nodal forces over time: what stands before the step and what stands in it.
struct DeckConditions {
  std::string before, within;
};
DeckConditions deck_conditions(const Scene& scene, const Model& model);

/// The whole deck, for a scene without obstacles. The mesh is on one rank.
std::string calculix_deck(const Scene& scene, const Model& model, Peer peer, std::optional<double> penalty);

}  // namespace mortise
