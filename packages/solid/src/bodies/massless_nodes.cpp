#include "mortise/solid/massless_nodes.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <TpetraExt_MatrixMatrix.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <map>
#include <set>

#include "mortise/solid/loaded_side.hpp"

namespace mortise {
namespace {

/// A node this near to the line along the normal, over its distance to the surface's node, is below it.
constexpr double straight_below = 1e-6;

enum class Role : char { interior, on_surface, follower };

/// [local nodes]. Collective.
std::vector<Role> roles(const Mesh& mesh, const std::vector<std::vector<LoadedSide>>& surfaces, const std::vector<char>& keeps) {
  Vector owned(mesh.owned_nodes), local(mesh.local_nodes);
  {
    const auto role = owned.getLocalViewHost(Tpetra::Access::ReadWrite);
    for (const auto& sides : surfaces)
      for (const LoadedSide& side : sides)
        for (const LocalOrdinal node : side.nodes)
          if (node < mesh.owned_count() && !mesh.bodies[mesh.body_of_node[node]].is_surface && !keeps[mesh.body_of_node[node]]) role(node, 0) = 1.0;
    for (const ReferencePoint& point : mesh.reference_points)
      for (const LocalOrdinal node : point.followers)
        if (node < mesh.owned_count()) role(node, 0) = 2.0;
  }
  local.doImport(owned, Import(mesh.owned_nodes, mesh.local_nodes), Tpetra::INSERT);
  const auto role = local.getLocalViewHost(Tpetra::Access::ReadOnly);
  std::vector<Role> result;
  for (LocalOrdinal node = 0; node < mesh.local_count(); ++node) result.push_back(static_cast<Role>(static_cast<char>(role(node, 0))));
  return result;
}

Eigen::Vector3d place(const Mesh& mesh, LocalOrdinal node) { return Eigen::Map<const Eigen::Vector3d>(mesh.coordinates[node].data()); }

/// Nodes of the elements at owned nodes of the surfaces, and integral N n dA there.
struct Surroundings {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  std::vector<LocalOrdinal> interior, surface;  ///< ascending
};

std::map<LocalOrdinal, Surroundings> surroundings(const Mesh& mesh, const std::vector<std::vector<LoadedSide>>& surfaces,
                                                  const std::vector<Role>& role) {
  std::map<LocalOrdinal, Surroundings> around;
  for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node)
    if (role[node] == Role::on_surface) around[node];
  for (const auto& sides : surfaces)
    for (const LoadedSide& side : sides)
      for (const SidePoint& point : *side.rule)
        for (std::size_t a = 0; a < side.nodes.size(); ++a)
          if (const auto found = around.find(side.nodes[a]); found != around.end())
            found->second.normal += point.weight * point.N[a] * side.at(point, mesh, {}).area;
  for (const Block& block : mesh.blocks) {
    if (mesh.body_of(block).is_surface) continue;
    for (LocalOrdinal e = 0; e < block.size(); ++e) {
      const LocalOrdinal *first = block.nodes(e), *last = first + block.nodes_per_element;
      for (const LocalOrdinal* a = first; a != last; ++a) {
        const auto found = around.find(*a);
        if (found == around.end()) continue;
        for (const LocalOrdinal* b = first; b != last; ++b)
          if (b != a && role[*b] != Role::follower) (role[*b] == Role::interior ? found->second.interior : found->second.surface).push_back(*b);
      }
    }
  }
  for (auto& [node, of] : around)
    for (auto* nodes : {&of.interior, &of.surface}) {
      std::sort(nodes->begin(), nodes->end());
      nodes->erase(std::unique(nodes->begin(), nodes->end()), nodes->end());
    }
  return around;
}

/// Weights of the interior nodes, by their distances to the line along the normal.
std::vector<double> weights(const Mesh& mesh, LocalOrdinal node, const Surroundings& around) {
  const Eigen::Vector3d n = around.normal.normalized();
  std::vector<double> result;
  double sum = 0.0;
  bool has_below = false;
  const auto distance = [&](LocalOrdinal other) {
    const Eigen::Vector3d arm = place(mesh, other) - place(mesh, node);
    return (arm - arm.dot(n) * n).norm() / arm.norm();
  };
  for (const LocalOrdinal other : around.interior) has_below = has_below || distance(other) <= straight_below;
  for (const LocalOrdinal other : around.interior) {
    const double away = distance(other) * (place(mesh, other) - place(mesh, node)).norm();
    result.push_back(has_below ? (distance(other) <= straight_below ? 1.0 : 0.0) : 1.0 / away);
    sum += result.back();
  }
  for (double& weight : result) weight /= sum;
  return result;
}

}  // namespace

MasslessNodes massless_nodes(const Mesh& mesh, const std::vector<Located<std::string>>& surfaces, const std::vector<char>& keeps) {
  std::vector<std::vector<LoadedSide>> sides;
  for (const auto& surface : surfaces) sides.push_back(sides_at_owned_nodes(mesh, surface));
  const std::vector<Role> role = roles(mesh, sides, keeps);
  const auto around = surroundings(mesh, sides, role);

  // Nodes with interior nodes beside them, then those with such neighbours.
  Vector owned(mesh.owned_nodes), has_interior(mesh.local_nodes);
  {
    const auto view = owned.getLocalViewHost(Tpetra::Access::ReadWrite);
    for (const auto& [node, of] : around) view(node, 0) = of.interior.empty() ? 0.0 : 1.0;
  }
  has_interior.doImport(owned, Import(mesh.owned_nodes, mesh.local_nodes), Tpetra::INSERT);
  const auto takes = has_interior.getLocalViewHost(Tpetra::Access::ReadOnly);

  std::set<LocalOrdinal> on_surface;
  for (const auto& set : sides)
    for (const LoadedSide& side : set) on_surface.insert(side.nodes.begin(), side.nodes.end());
  MasslessNodes result;
  std::size_t most = 1;
  for (const auto& [node, of] : around) most = std::max({most, of.interior.size(), of.surface.size()});
  const auto P = rcp(new Matrix(mesh.owned_nodes, most));
  bool any_by_neighbours = false;
  const auto insert = [&](LocalOrdinal row, LocalOrdinal column, double weight) {
    const GlobalOrdinal id = mesh.local_nodes->getGlobalElement(column);
    if (weight != 0.0) P->insertGlobalValues(mesh.owned_nodes->getGlobalElement(row), 1, &weight, &id);
  };
  for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node) {
    const auto found = around.find(node);
    if (found == around.end()) {
      insert(node, node, 1.0);
      if (role[node] == Role::follower && on_surface.count(node) > 0) result.kept.push_back(node);
      continue;
    }
    const Surroundings& of = found->second;
    std::vector<LocalOrdinal> neighbours;
    for (const LocalOrdinal other : of.surface)
      if (takes(other, 0) > 0.0) neighbours.push_back(other);
    if (!of.interior.empty()) {
      const std::vector<double> share = weights(mesh, node, of);
      for (std::size_t i = 0; i < share.size(); ++i) insert(node, of.interior[i], share[i]);
    } else if (!neighbours.empty()) {
      any_by_neighbours = true;
      for (const LocalOrdinal other : neighbours) insert(node, other, 1.0 / static_cast<double>(neighbours.size()));
    } else {
      insert(node, node, 1.0);
      result.kept.push_back(node);
      continue;
    }
    result.nodes.push_back(node);
  }
  P->fillComplete();
  result.extension = P;
  int mine = any_by_neighbours ? 1 : 0, anywhere = 0;
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(anywhere));
  if (anywhere == 0) return result;
  const auto twice = rcp(new Matrix(mesh.owned_nodes, 0));
  Tpetra::MatrixMatrix::Multiply(*P, false, *P, false, *twice);
  result.extension = twice;
  return result;
}

}  // namespace mortise
