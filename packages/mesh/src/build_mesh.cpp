#include "mortise/mesh/build_mesh.hpp"

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_OrdinalTraits.hpp>
#include <Tpetra_Map.hpp>
#include <algorithm>
#include <set>

#include "body_set.hpp"
#include "inverted_elements.hpp"
#include "partition.hpp"

namespace mortise {

void check_bodies(const std::vector<BodyDescription>& bodies) {
  if (bodies.empty()) throw InputError(Place{}, "there is no body to be meshed");
  std::vector<Diagnostic> diagnostics;
  std::set<std::string> names;
  for (const auto& body : bodies) {
    if (!names.insert(body.name).second) diagnostics.push_back({body.place, fmt::format("there is already a body named \"{}\"", body.name)});
    if (!body.mesh) diagnostics.push_back({body.place, fmt::format("body \"{}\" has no mesh", body.name)});
  }
  if (!diagnostics.empty()) throw InputError(diagnostics);
  const char* const where[] = {"", "line", "2D", "3D"};
  const int dimension = bodies.front().mesh->dimension();
  for (const auto& body : bodies) {
    const int own = body.mesh->dimension(), of_cells = topology(body.shape).dimension;
    if (own != dimension)
      diagnostics.push_back({body.place, fmt::format("body \"{}\" has a {} mesh, but body \"{}\" a {} one; all bodies need the same", body.name,
                                                     where[own], bodies.front().name, where[dimension])});
    if (of_cells != own && body.shape != rigid_shape(own))
      diagnostics.push_back({body.place, fmt::format("body \"{}\" has a {} mesh, but {} elements", body.name, where[own], where[of_cells])});
  }
  if (!diagnostics.empty()) throw InputError(diagnostics);
}

namespace {

/// Elements that touch an owned node without being owned, by body; ascending.
std::vector<std::vector<GlobalOrdinal>> ghost_elements(const BodySet& bodies, const Map& owned_nodes,
                                                       const std::vector<GlobalOrdinal>& owned_elements) {
  std::vector<std::vector<GlobalOrdinal>> ghosts(bodies.size());
  if (owned_nodes.getComm()->getSize() == 1) return ghosts;
  for (const GlobalOrdinal node : owned_nodes.getNodeElementList()) {
    if (node >= bodies.node_count()) continue;  // a reference point
    const int body = bodies.body_of_node(node);
    const auto elements = bodies.with_complex(body, [&](const auto& complex) { return complex.elements_of_node(node - bodies.first_node(body)); });
    for (const GlobalOrdinal inside : elements) {
      const GlobalOrdinal element = bodies.first_element(body) + inside;
      if (!std::binary_search(owned_elements.begin(), owned_elements.end(), element)) ghosts[body].push_back(element);
    }
  }
  for (auto& elements : ghosts) {
    std::sort(elements.begin(), elements.end());
    elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
  }
  return ghosts;
}

/// Owned nodes, then all other nodes of the local elements and the reference points, ascending.
RCP<const Map> local_node_map(const BodySet& bodies, const RCP<const Map>& owned_nodes, const std::vector<Block>& blocks) {
  const auto owned = owned_nodes->getNodeElementList();
  std::vector<GlobalOrdinal> ids(owned.begin(), owned.end()), ghosts;
  for (const Block& block : blocks)
    for (const GlobalOrdinal element : block.element_ids)
      for (const GlobalOrdinal node : bodies.element_nodes(element))
        if (!owned_nodes->isNodeGlobalElement(node)) ghosts.push_back(node);
  for (GlobalOrdinal node = bodies.node_count(); node <= owned_nodes->getMaxAllGlobalIndex(); ++node)
    if (!owned_nodes->isNodeGlobalElement(node)) ghosts.push_back(node);
  std::sort(ghosts.begin(), ghosts.end());
  ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());
  ids.insert(ids.end(), ghosts.begin(), ghosts.end());
  return rcp(new Map(Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid(), Teuchos::arrayViewFromVector(ids), 0, owned_nodes->getComm()));
}

void fill_blocks(Mesh& mesh, const BodySet& set, const std::vector<BodyDescription>& bodies, const std::vector<GlobalOrdinal>& owned_elements) {
  const auto ghosts = ghost_elements(set, *mesh.owned_nodes, owned_elements);
  for (int b = 0; b < set.size(); ++b) {
    Block block;
    block.name = bodies[b].name;
    block.shape = bodies[b].shape;
    block.nodes_per_element = set.cell(b).nodes;
    const auto first = std::lower_bound(owned_elements.begin(), owned_elements.end(), set.first_element(b));
    const auto last = std::lower_bound(first, owned_elements.end(), set.first_element(b + 1));
    block.element_ids.assign(first, last);
    block.owned = block.size();
    block.element_ids.insert(block.element_ids.end(), ghosts[b].begin(), ghosts[b].end());
    mesh.blocks.push_back(std::move(block));
  }
  mesh.local_nodes = local_node_map(set, mesh.owned_nodes, mesh.blocks);
  for (auto& block : mesh.blocks)
    for (const GlobalOrdinal element : block.element_ids)
      for (const GlobalOrdinal node : set.element_nodes(element)) block.connectivity.push_back(mesh.local_nodes->getLocalElement(node));
}

void fill_nodes(Mesh& mesh, const BodySet& set) {
  for (const GlobalOrdinal node : mesh.local_nodes->getNodeElementList()) {
    if (node >= set.node_count()) {  // a reference point, placed with its followers
      mesh.coordinates.push_back({});
      mesh.body_of_node.push_back(-1);
      continue;
    }
    mesh.coordinates.push_back(set.coordinate(node));
    mesh.body_of_node.push_back(set.body_of_node(node));
  }
}

template <class Complex>
void add_side_sets(Mesh& mesh, const BodySet& set, int b, const Complex& complex) {
  const auto& block = mesh.blocks[b];
  const std::string surface = block.name + "/surface";
  std::vector<std::string> names;
  for (const auto& name : complex.side_names()) names.push_back(block.name + "/" + name);
  for (const auto& name : names) mesh.side_sets[name], mesh.node_sets[name];
  mesh.side_sets[surface], mesh.node_sets[surface], mesh.node_sets[block.name];
  for (LocalOrdinal e = 0; e < block.size(); ++e)
    for (const auto& side : complex.surface_sides(block.element_ids[e] - set.first_element(b)))
      for (const std::string& name : {names[side.name], surface}) {
        auto& sides = mesh.side_sets[name];
        sides.sides.push_back({b, e, side.side});
        if (e < block.owned) ++sides.owned;
      }
}

template <class Complex>
void add_to_node_sets(Mesh& mesh, const BodySet& set, LocalOrdinal node, const Complex& complex) {
  const int b = mesh.body_of_node[node];
  const auto& body = mesh.blocks[b].name;
  mesh.node_sets[body].push_back(node);
  const auto sides = complex.sides_of_node(mesh.local_nodes->getGlobalElement(node) - set.first_node(b));
  for (const int side : sides) mesh.node_sets[body + "/" + complex.side_names()[side]].push_back(node);
  if (!sides.empty()) mesh.node_sets[body + "/surface"].push_back(node);
}

void fill_sets(Mesh& mesh, const BodySet& set) {
  for (int b = 0; b < set.size(); ++b) set.with_complex(b, [&](const auto& complex) { add_side_sets(mesh, set, b, complex); });
  for (LocalOrdinal n = 0; n < mesh.local_count(); ++n)
    if (mesh.body_of_node[n] >= 0) set.with_complex(mesh.body_of_node[n], [&](const auto& complex) { add_to_node_sets(mesh, set, n, complex); });
}

/// Nodes that the points need, one or two each.
GlobalOrdinal nodes_of(const std::vector<ReferencePointDescription>& points) {
  GlobalOrdinal nodes = 0;
  for (const auto& point : points) nodes += point.rotates ? 2 : 1;
  return nodes;
}

void fill_reference_points(Mesh& mesh, const BodySet& set, const std::vector<ReferencePointDescription>& descriptions) {
  GlobalOrdinal next = set.node_count();
  std::vector<Diagnostic> diagnostics;
  for (const auto& description : descriptions) {
    ReferencePoint point;
    point.name = description.name;
    point.is_placed = description.position.has_value();
    point.node = mesh.local_nodes->getLocalElement(next++);
    if (point.is_placed) mesh.coordinates[point.node] = *description.position;
    if (description.rotates) point.rotation_node = mesh.local_nodes->getLocalElement(next++);
    if (!mesh.node_sets.insert({point.name, {point.node}}).second)
      diagnostics.push_back({description.place, fmt::format("there is already a set named \"{}\"", point.name)});
    mesh.reference_points.push_back(std::move(point));
  }
  throw_if_any(*mesh.comm, diagnostics);
}

}  // namespace

RCP<Mesh> build_mesh(const RCP<const Communicator>& comm, const std::vector<BodyDescription>& bodies, const std::vector<std::string>& contact_sides,
                     const std::vector<ReferencePointDescription>& reference_points) {
  // The descriptions are the same on every rank, and so are errors in them.
  check_bodies(bodies);
  const BodySet set(bodies);
  const auto owned_elements = share_out_elements(*comm, set, contact_flags(set, bodies, contact_sides));
  auto mesh = rcp(new Mesh);
  mesh->dimension = set.dimension();
  mesh->comm = comm;
  mesh->owned_nodes = share_out_nodes(comm, set, owned_elements, nodes_of(reference_points));
  fill_blocks(*mesh, set, bodies, owned_elements);
  fill_nodes(*mesh, set);
  throw_if_any(*comm, inverted_elements(*mesh, set, bodies));
  fill_sets(*mesh, set);
  fill_reference_points(*mesh, set, reference_points);
  return mesh;
}

}  // namespace mortise
