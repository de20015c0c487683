#include "mortise/mesh/build_mesh.hpp"

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_OrdinalTraits.hpp>
#include <Tpetra_Map.hpp>
#include <algorithm>
#include <iterator>
#include <optional>
#include <set>

#include "distribution/body_set.hpp"
#include "distribution/inverted_elements.hpp"
#include "distribution/partition.hpp"
#include "mortise/core/trilinos_versions.hpp"

namespace mortise {

void check_bodies(const std::vector<BodyDescription>& bodies) {
  if (bodies.empty()) throw InputError(Place{}, "there is no body to be meshed");
  std::vector<Diagnostic> diagnostics;
  std::set<std::string> names;
  for (const auto& body : bodies) {
    if (!names.insert(body.name).second) diagnostics.push_back({body.place, fmt::format("there is already a body named \"{}\"", body.name)});
    if (!body.mesh && !body.listed) diagnostics.push_back({body.place, fmt::format("body \"{}\" has no mesh", body.name)});
  }
  if (!diagnostics.empty()) throw InputError(diagnostics);
  const char* const where[] = {"", "line", "2D", "3D"};
  const int dimension = bodies.front().dimension();
  for (const auto& body : bodies) {
    const int own = body.dimension(), of_cells = topology(body.shape).dimension;
    if (own != dimension)
      diagnostics.push_back({body.place, fmt::format("body \"{}\" has a {} mesh, but body \"{}\" a {} one; all bodies need the same", body.name,
                                                     where[own], bodies.front().name, where[dimension])});
    if (!body.listed && of_cells != own && body.shape != rigid_shape(own))
      diagnostics.push_back({body.place, fmt::format("body \"{}\" has a {} mesh, but {} elements", body.name, where[own], where[of_cells])});
  }
  if (!diagnostics.empty()) throw InputError(diagnostics);
}

namespace {

/// Elements that touch an owned node without being owned, ascending.
std::vector<GlobalOrdinal> ghost_elements(const BodySet& bodies, const Map& owned_nodes, const std::vector<GlobalOrdinal>& owned_elements) {
  std::vector<GlobalOrdinal> ghosts;
  if (owned_nodes.getComm()->getSize() == 1) return ghosts;
  for (const GlobalOrdinal node : local_ids(owned_nodes)) {
    if (node >= bodies.node_count()) continue;  // a reference point
    for (const GlobalOrdinal element : bodies.elements_of_node(node))
      if (!std::binary_search(owned_elements.begin(), owned_elements.end(), element)) ghosts.push_back(element);
  }
  std::sort(ghosts.begin(), ghosts.end());
  ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());
  return ghosts;
}

/// Owned nodes, then all other nodes of the local elements and the reference points, ascending.
RCP<const Map> local_node_map(const BodySet& bodies, const RCP<const Map>& owned_nodes, const std::vector<Block>& blocks) {
  const auto owned = local_ids(*owned_nodes);
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
  const auto owned_nodes = local_ids(*mesh.owned_nodes);
  set.fetch_elements_around(*mesh.comm, {owned_nodes.begin(), owned_nodes.end()});
  const auto ghosts = ghost_elements(set, *mesh.owned_nodes, owned_elements);
  std::vector<GlobalOrdinal> all;
  std::merge(owned_elements.begin(), owned_elements.end(), ghosts.begin(), ghosts.end(), std::back_inserter(all));
  set.fetch_elements(*mesh.comm, all);
  for (const BodyDescription& body : bodies) mesh.bodies.push_back({body.name, false});
  for (std::size_t b = 0; b < set.blocks().size(); ++b) {
    const BlockRange& range = set.blocks()[b];
    Block block;
    block.body = range.body;
    block.part = range.part;
    block.shape = range.shape;
    block.nodes_per_element = topology(range.shape).nodes;
    mesh.bodies[range.body].is_surface = topology(range.shape).dimension < set.dimension();
    const auto add = [&](const std::vector<GlobalOrdinal>& elements) {
      block.element_ids.insert(block.element_ids.end(), std::lower_bound(elements.begin(), elements.end(), range.first_element),
                               std::lower_bound(elements.begin(), elements.end(), set.end_of_block(b)));
    };
    add(owned_elements);
    block.owned = block.size();
    add(ghosts);
    mesh.blocks.push_back(std::move(block));
  }
  mesh.local_nodes = local_node_map(set, mesh.owned_nodes, mesh.blocks);
  for (auto& block : mesh.blocks)
    for (const GlobalOrdinal element : block.element_ids)
      for (const GlobalOrdinal node : set.element_nodes(element)) block.connectivity.push_back(mesh.local_nodes->getLocalElement(node));
}

void fill_nodes(Mesh& mesh, const BodySet& set) {
  const auto local = local_ids(*mesh.local_nodes);
  std::vector<GlobalOrdinal> ids(local.begin(), local.end());
  std::sort(ids.begin(), ids.end());
  set.fetch_nodes(*mesh.comm, ids);
  for (const GlobalOrdinal node : local_ids(*mesh.local_nodes)) {
    if (node >= set.node_count()) {  // a reference point, placed with its followers
      mesh.coordinates.push_back({});
      mesh.body_of_node.push_back(-1);
      continue;
    }
    mesh.coordinates.push_back(set.coordinate(node));
    mesh.body_of_node.push_back(set.body_of_node(node));
  }
}

/// The empty sets of a body, which every rank has.
void declare_sets(Mesh& mesh, const BodySet& set, int b) {
  const std::string& body = mesh.bodies[b].name;
  for (std::string side : set.side_names(b)) {
    side = body + "/" + side;
    mesh.side_sets[side], mesh.node_sets[side];
  }
  const std::string surface = body + "/surface";
  mesh.side_sets[surface], mesh.node_sets[surface], mesh.node_sets[body];
  for (const std::string& name : set.node_set_names(b)) mesh.node_sets[body + "/" + name];
  for (const LeftOutSet& left_out : set.left_out_sets(b)) mesh.left_out_sets[body + "/" + left_out.name] = left_out.reason;
}

void add_side_sets(Mesh& mesh, const BodySet& set, LocalOrdinal b) {
  const auto& block = mesh.blocks[b];
  const auto add = [&](const std::string& name, const Side& side) {
    auto& sides = mesh.side_sets.at(mesh.body_of(block).name + "/" + name);
    sides.sides.push_back(side);
    if (side.element < block.owned) ++sides.owned;
  };
  for (LocalOrdinal e = 0; e < block.size(); ++e) {
    std::optional<int> last;  // a side may have several names
    for (const auto& [side, name] : set.surface_sides(block.element_ids[e])) {
      if (name >= 0) add(set.side_names(block.body)[name], {b, e, side});
      if (last != side) add("surface", {b, e, side});
      last = side;
    }
  }
}

void add_to_node_sets(Mesh& mesh, const BodySet& set, LocalOrdinal node) {
  const int b = mesh.body_of_node[node];
  const auto& body = mesh.bodies[b].name;
  const GlobalOrdinal id = mesh.local_nodes->getGlobalElement(node);
  mesh.node_sets[body].push_back(node);
  const auto sides = set.sides_of_node(id);
  for (const int side : sides)
    if (side >= 0) mesh.node_sets[body + "/" + set.side_names(b)[side]].push_back(node);
  if (!sides.empty()) mesh.node_sets[body + "/surface"].push_back(node);
  for (const int name : set.node_sets_of_node(id)) mesh.node_sets[body + "/" + set.node_set_names(b)[name]].push_back(node);
}

/// Sides of owned elements come before those of ghosts: a body may have several blocks.
void put_owned_first(Mesh& mesh) {
  for (auto& [name, set] : mesh.side_sets)
    std::stable_partition(set.sides.begin(), set.sides.end(), [&](const Side& side) { return side.element < mesh.blocks[side.block].owned; });
}

void fill_sets(Mesh& mesh, const BodySet& set) {
  for (int b = 0; b < set.size(); ++b) declare_sets(mesh, set, b);
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) add_side_sets(mesh, set, static_cast<LocalOrdinal>(b));
  put_owned_first(mesh);
  for (LocalOrdinal n = 0; n < mesh.local_count(); ++n)
    if (mesh.body_of_node[n] >= 0) add_to_node_sets(mesh, set, n);
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
  set.fetch_elements(*comm, owned_elements);
  mesh->owned_nodes = share_out_nodes(comm, set, owned_elements, nodes_of(reference_points));
  fill_blocks(*mesh, set, bodies, owned_elements);
  fill_nodes(*mesh, set);
  InvertedElements inverted = find_inverted_elements(*mesh, set, bodies);
  throw_if_any(*comm, inverted.errors);
  mesh->warnings = std::move(inverted.warnings);
  fill_sets(*mesh, set);
  fill_reference_points(*mesh, set, reference_points);
  return mesh;
}

}  // namespace mortise
