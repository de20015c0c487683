#include "mortise/simulation/quantities/contact_profile.hpp"

#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "mortise/mortar/quadratic_facet.hpp"

namespace mortise {
namespace {

const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();

/// The node that follows each one along the facets, by ids, on rank 0.
std::map<GlobalOrdinal, GlobalOrdinal> links_on_root(const Mesh& mesh, const SideSet& slave) {
  std::vector<std::array<GlobalOrdinal, 2>> links;
  for (LocalOrdinal side = 0; side < slave.owned; ++side) {
    const auto nodes = mesh.side_nodes(slave.sides[side]);
    const auto id = [&](int place) { return mesh.local_nodes->getGlobalElement(nodes[static_cast<std::size_t>(place)]); };
    for (const FacetPart& part : linear_parts(2, nodes.size())) links.push_back({id(part[0]), id(part[1])});
  }
  const auto owned = rcp(new Map(invalid, links.size(), 0, mesh.comm));
  const std::size_t all = mesh.comm->getRank() == 0 ? owned->getGlobalNumElements() : 0;
  const auto root = rcp(new Map(invalid, all, 0, mesh.comm));
  MultiVector mine(owned, 2), collected(root, 2);  // ids are far below 2^53
  {
    const auto ids = mine.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (std::size_t link = 0; link < links.size(); ++link)
      for (int end = 0; end < 2; ++end) ids(link, end) = static_cast<double>(links[link][end]);
  }
  collected.doImport(mine, Import(owned, root), Tpetra::INSERT);
  std::map<GlobalOrdinal, GlobalOrdinal> next;
  const auto ids = collected.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t link = 0; link < all; ++link) next[static_cast<GlobalOrdinal>(ids(link, 0))] = static_cast<GlobalOrdinal>(ids(link, 1));
  return next;
}

}  // namespace

ContactProfile::ContactProfile(const Mesh& mesh, const PairSurfaces& surfaces, std::size_t pair) : pair_(pair) {
  auto next = links_on_root(mesh, mesh.side_sets.at(surfaces.slave));
  std::set<GlobalOrdinal> reached;
  for (const auto& facet : next) reached.insert(facet.second);
  std::vector<GlobalOrdinal> order, starts;
  for (const auto& facet : next)
    if (reached.count(facet.first) == 0) starts.push_back(facet.first);
  int part = 0;
  const auto follow = [&](const GlobalOrdinal start) {
    for (GlobalOrdinal node = start;;) {
      order.push_back(node);
      parts_.push_back(part);
      const auto facet = next.find(node);
      if (facet == next.end()) break;
      node = facet->second;
      next.erase(facet);
      if (node == start) break;  // closed
    }
    ++part;
  };
  for (const GlobalOrdinal start : starts) follow(start);
  while (!next.empty()) follow(next.begin()->first);
  const auto nodes = rcp(new Map(invalid, order.data(), static_cast<LocalOrdinal>(order.size()), 0, mesh.comm));
  import_ = rcp(new Import(mesh.owned_nodes, nodes));
}

std::vector<ProfilePoint> ContactProfile::points(const FieldState& state) const {
  const Mesh& mesh = *state.bodies.mesh();
  MultiVector owned(mesh.owned_nodes, 6), ordered(import_->getTargetMap(), 6);
  {
    const auto values = owned.getLocalViewHost(Tpetra::Access::ReadWrite);
    const auto displacement = state.displacement.getLocalViewHost(Tpetra::Access::ReadOnly);
    const double moves = state.contact->geometry(pair_) == ContactGeometry::current ? 1.0 : 0.0;
    for (const auto& node : node_states(*state.laws, pair_)) {
      const LocalOrdinal row = node.owned_node;
      for (int i = 0; i < 2; ++i) values(row, i) = mesh.coordinates[row][i] + moves * displacement(2 * row + i, 0);
      values(row, 2) = node.pressure;
      values(row, 3) = node.shear;
      values(row, 4) = node.gap;
      values(row, 5) = static_cast<double>(node.state);
    }
  }
  ordered.doImport(owned, *import_, Tpetra::INSERT);
  const auto values = ordered.getLocalViewHost(Tpetra::Access::ReadOnly);
  std::vector<ProfilePoint> points;
  for (std::size_t n = 0; n < parts_.size(); ++n) {
    ProfilePoint point{parts_[n], 0.0, values(n, 0), values(n, 1), values(n, 2), values(n, 3), values(n, 4)};
    point.state = static_cast<ContactState>(static_cast<int>(values(n, 5)));
    if (n > 0 && parts_[n - 1] == point.part)
      point.arc_length = points.back().arc_length + std::hypot(point.x - points.back().x, point.y - points.back().y);
    points.push_back(point);
  }
  return points;
}

}  // namespace mortise
