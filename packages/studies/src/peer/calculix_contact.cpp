// Surfaces and contact pairs of a deck of CalculiX.

#include <fmt/format.h>

#include <Tpetra_Map.hpp>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "peer/calculix_deck.hpp"

namespace mortise {
namespace {

using Text = std::back_insert_iterator<std::string>;

/// Faces of solids are counted as here. Bricks and wedges made of plane cells: faces 1 and 2 are the layers, face 3 + a the one over the side from
/// node a to the next.
void write_surface(Text text, const std::string& name, const Mesh& mesh, const SideSet& set) {
  fmt::format_to(text, "*SURFACE,NAME={},TYPE=ELEMENT\n", name);
  for (const Side& side : set.sides) {
    const Block& block = mesh.blocks[side.block];
    const int face = mesh.dimension == 2 ? 3 + topology(block.shape).sides[side.side].nodes.front() : 1 + side.side;
    fmt::format_to(text, "{},S{}\n", block.element_ids[side.element] + 1, face);
  }
}

/// Shortest distance of corners of a facet that follow each other: in 2D the shortest facet, in 3D the shortest edge of one.
double shortest(const Mesh& mesh, const SideSet& set) {
  double length = std::numeric_limits<double>::max();
  for (const Side& side : set.sides) {
    const auto nodes = mesh.side_nodes(side);
    const int corners = topology(mesh.side_shape(side)).corners;
    for (int corner = 0; corner < corners; ++corner) {
      const auto &a = mesh.coordinates[nodes[corner]], &b = mesh.coordinates[nodes[(corner + 1) % corners]];
      length = std::min(length, std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]));
    }
  }
  return length;
}

double softest(const Model& model, std::initializer_list<const SideSet*> sets) {
  double modulus = std::numeric_limits<double>::max();
  for (const SideSet* set : sets)
    for (const Side& side : set->sides) modulus = std::min(modulus, model.bodies()->properties()[side.block].material->youngs_modulus);
  return modulus;
}

}  // namespace

std::string deck_contact(const Scene& scene, const Model& model, Peer peer, std::optional<double> penalty) {
  const Mesh& mesh = *model.mesh();
  std::string deck;
  const auto text = std::back_inserter(deck);
  for (std::size_t p = 0; p < scene.contact.size(); ++p) {
    const auto& pair = scene.contact[p].value;
    const SideSet &slave = mesh.side_sets.at(pair.slave.value), &master = mesh.side_sets.at(pair.master.value);
    write_surface(text, fmt::format("SLAVE{}", p), mesh, slave);
    write_surface(text, fmt::format("MASTER{}", p), mesh, master);
    // Penalties, stress per length, against E/h, the stiffness of an element at the interface. Mortar has one for sticking only and bears a stiff
    // one. The other two have one for the pressure as well. In 2D ten times stiffer ones end in divergence on the finer of the shipped meshes. In 3D,
    // on flat surfaces, a softer one would take percents of the force.
    const bool mortar = peer == Peer::calculix_mortar;
    const double of_element = softest(model, {&slave, &master}) / shortest(mesh, slave);
    const double pressing = penalty.value_or(mesh.dimension == 2 ? 1.0 : 50.0) * of_element, sticking = mortar ? 10.0 * of_element : 0.1 * pressing;
    fmt::format_to(text, "*SURFACE INTERACTION,NAME=INTERACTION{}\n", p);
    if (!mortar) fmt::format_to(text, "*SURFACE BEHAVIOR,PRESSURE-OVERCLOSURE=LINEAR\n{:.10g}\n", pressing);
    if (const auto* coulomb = dynamic_cast<const CoulombFriction*>(pair.contact.friction.options.get()); coulomb != nullptr && coulomb->acts())
      fmt::format_to(text, "*FRICTION\n{:.10g},{:.10g}\n", coulomb->coefficient.at({0.0, 0.0}), sticking);
    const char* const type = mortar ? "MORTAR" : peer == Peer::calculix_surface_to_surface ? "SURFACE TO SURFACE" : "NODE TO SURFACE";
    fmt::format_to(text, "*CONTACT PAIR,INTERACTION=INTERACTION{0},TYPE={1}\nSLAVE{0},MASTER{0}\n", p, type);
  }
  return deck;
}

}  // namespace mortise
