#include "surfaces/adjustment.hpp"

#include <Eigen/Geometry>
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <algorithm>
#include <cmath>
#include <map>

#include "surfaces/body_surfaces.hpp"
#include "surfaces/facet_kinks.hpp"

namespace mortise {
namespace {

constexpr double opposite = 0.5;        ///< cosine of the angle between normals that face one another
constexpr double no_direction = 1e-10;  ///< rest of a unit vector that is held, by round-off

/// Unit normals of owned nodes: means over their facets, without what is held of the nodes.
std::map<LocalOrdinal, Eigen::Vector3d> nodal_normals(const Mesh& mesh, const SideSet& slave, const HeldNodes& held) {
  const PlaceOfNode at = reference_places(mesh);
  std::map<LocalOrdinal, Eigen::Vector3d> normals;
  for (const Side& side : slave.sides) {
    const Eigen::Vector3d normal = facet_normal(mesh.dimension, places_of(mesh, side, at));
    for (const LocalOrdinal node : mesh.side_nodes(side))
      if (node < mesh.owned_count()) normals.emplace(node, Eigen::Vector3d::Zero()).first->second += normal;
  }
  for (auto& [node, normal] : normals) {
    const double length = normal.norm();
    normal = free_part(held, node, normal);
    if (normal.norm() <= no_direction * length)
      normal.setZero();
    else
      normal.normalize();
  }
  return normals;
}

}  // namespace

Eigen::Vector3d free_part(const HeldNodes& held, LocalOrdinal node, Eigen::Vector3d v) {
  std::vector<Eigen::Vector3d> orthonormal;
  const auto take_away = [&](Eigen::Vector3d n) {
    for (const Eigen::Vector3d& other : orthonormal) n -= n.dot(other) * other;
    if (n.norm() < no_direction) return;
    orthonormal.push_back(n.normalized());
    v -= v.dot(orthonormal.back()) * orthonormal.back();
  };
  for (int i = 0; i < 3; ++i)
    if (held.components[static_cast<std::size_t>(node)][static_cast<std::size_t>(i)]) take_away(Eigen::Vector3d::Unit(i));
  if (const auto inclined = held.directions.find(node); inclined != held.directions.end())
    for (const auto& direction : inclined->second) take_away(Eigen::Vector3d(direction.data()));
  return v;
}

void share_positions(Mesh& mesh) {
  MultiVector owned(mesh.owned_nodes, 3), local(mesh.local_nodes, 3);
  {
    const auto view = owned.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node)
      for (int i = 0; i < 3; ++i) view(node, i) = mesh.coordinates[static_cast<std::size_t>(node)][static_cast<std::size_t>(i)];
  }
  local.doImport(owned, Import(mesh.owned_nodes, mesh.local_nodes), Tpetra::INSERT);
  const auto view = local.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (LocalOrdinal node = mesh.owned_count(); node < mesh.local_count(); ++node)
    for (int i = 0; i < 3; ++i) mesh.coordinates[static_cast<std::size_t>(node)][static_cast<std::size_t>(i)] = view(node, i);
}

Adjustment adjust_onto_master(Mesh& mesh, const SideSet& slave, const SideSet& master, double tolerance, const HeldNodes& held) {
  const PlaceOfNode at = reference_places(mesh);
  std::vector<TaggedFacet> facets;
  for (LocalOrdinal s = 0; s < master.owned; ++s) facets.push_back({places_of(mesh, master.sides[static_cast<std::size_t>(s)], at), 0});
  std::vector<LineSegment> lines;
  std::vector<LocalOrdinal> nodes;
  for (const auto& [node, normal] : nodal_normals(mesh, slave, held)) {
    if (normal.isZero(0.0)) continue;
    lines.push_back({at(node), normal, -tolerance, tolerance});
    nodes.push_back(node);
  }
  double mine[2] = {0.0, 0.0};  // moved nodes, largest
  const auto found = crossings(*mesh.comm, mesh.dimension, facets, lines);
  for (std::size_t line = 0; line < lines.size(); ++line) {
    const Crossing* nearest = nullptr;
    for (const Crossing& crossing : found[line])
      if (crossing.along < -opposite && (nearest == nullptr || std::abs(crossing.s) < std::abs(nearest->s))) nearest = &crossing;
    if (nearest == nullptr || nearest->s == 0.0) continue;
    for (int i = 0; i < 3; ++i) mesh.coordinates[static_cast<std::size_t>(nodes[line])][static_cast<std::size_t>(i)] += nearest->s * lines[line].d[i];
    mine[0] += 1.0;
    mine[1] = std::max(mine[1], std::abs(nearest->s));
  }
  share_positions(mesh);
  double moved = 0.0, largest = 0.0;
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_SUM, mine[0], Teuchos::outArg(moved));
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MAX, mine[1], Teuchos::outArg(largest));
  return {static_cast<GlobalOrdinal>(moved), largest, 0.0};
}

}  // namespace mortise
