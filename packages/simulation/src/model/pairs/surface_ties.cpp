#include "model/pairs/surface_ties.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Export.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "model/precision.hpp"
#include "model/stages/meshed_scene.hpp"
#include "mortise/core/over_ranks.hpp"
#include "mortise/mesh/sets.hpp"
#include "surfaces/body_surfaces.hpp"

namespace mortise {
namespace {

constexpr double default_tolerance = 0.1;  ///< over the longest facet of a tie
// P depends on where slave nodes are. Once they are on the master, nodes move along it alone, by what curvature leaves: each round by h / R of the
// one before, so that few rounds do. X_s = P X_m holds however many there are, for both are of the last one.
constexpr int most_rounds = 10;
constexpr double settled = 1e-10;  ///< of moves, over the tolerance of a tie

/// 1 where components of owned nodes are prescribed, 2 where they follow reference points.
RCP<const MultiVector> held_marks(const Mesh& mesh, const std::vector<std::array<bool, 3>>& held) {
  const auto marks = rcp(new MultiVector(mesh.owned_nodes, static_cast<std::size_t>(mesh.dimension)));
  const auto view = marks->getLocalViewHost(Tpetra::Access::ReadWrite);
  for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node)
    for (int i = 0; i < mesh.dimension; ++i) view(node, i) = held[static_cast<std::size_t>(node)][static_cast<std::size_t>(i)] ? 1.0 : 0.0;
  for (const ReferencePoint& point : mesh.reference_points)
    for (const LocalOrdinal node : point.followers)
      for (int i = 0; i < mesh.dimension && node < mesh.owned_count(); ++i)
        if (point.follows[static_cast<std::size_t>(i)] ||
            mesh.bodies[static_cast<std::size_t>(mesh.body_of_node[static_cast<std::size_t>(node)])].is_surface)
          view(node, i) = 2.0;
  return marks;
}

RCP<MultiVector> positions_from(const Mesh& mesh, const std::array<double, 3>& origin) {
  const auto positions = rcp(new MultiVector(mesh.owned_nodes, static_cast<std::size_t>(mesh.dimension)));
  const auto view = positions->getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node)
    for (std::size_t i = 0; i < view.extent(1); ++i) view(node, i) = mesh.coordinates[static_cast<std::size_t>(node)][i] - origin[i];
  return positions;
}

std::vector<TiedPair> pairs_of(const Mesh& mesh, const Scene& scene) {
  const PlaceOfNode at = reference_places(mesh);
  std::vector<TiedPair> pairs;
  std::vector<Diagnostic> diagnostics;
  for (const auto& tie : scene.ties) {
    try {
      const SideSet &slave = require_side_set(mesh, tie.value.slave), &master = require_side_set(mesh, tie.value.master);
      const double longest = std::max(longest_facet(mesh, slave, at), longest_facet(mesh, master, at));
      pairs.push_back({tie.name, tie.place, facets_at_owned_nodes(mesh, slave), facets_of_owned_elements(mesh, master),
                       tie.value.tolerance.value_or(default_tolerance * longest)});
    } catch (const InputError& error) {
      diagnostics.insert(diagnostics.end(), error.diagnostics().begin(), error.diagnostics().end());
    }
  }
  throw_if_any(*mesh.comm, diagnostics);
  return pairs;
}

bool adjusts(const Scene& scene, std::size_t tie) { return scene.ties[tie].value.mesh == MeshAtStart::adjusted; }

/// X_s = P X_m in the ties that adjust, but along what inclined supports hold. Returns the largest move over its tie's tolerance, over all ranks.
double move_slaves(Mesh& mesh, const FieldSpace& space, const Scene& scene, const HeldNodes& held, const std::vector<TiedPair>& pairs,
                   const TieRows& rows, const std::array<double, 3>& origin) {
  Vector X(space.dofs()), moved(space.dofs());
  {
    const auto view = X.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node)
      for (int i = 0; i < mesh.dimension; ++i)
        view(space.row(node, i), 0) =
            mesh.coordinates[static_cast<std::size_t>(node)][static_cast<std::size_t>(i)] - origin[static_cast<std::size_t>(i)];
  }
  rows.T->apply(X, moved);
  double mine = 0.0, largest = 0.0;
  {
    const auto view = moved.getLocalViewHost(Tpetra::Access::ReadOnly);
    for (std::size_t n = 0; n < rows.dofs.size(); ++n) {
      const LocalOrdinal node = space.place(rows.dofs[n]).node;
      if (!adjusts(scene, rows.tie_of[n]) || (n > 0 && space.place(rows.dofs[n - 1]).node == node)) continue;
      auto& x = mesh.coordinates[static_cast<std::size_t>(node)];
      Eigen::Vector3d move = Eigen::Vector3d::Zero();
      for (std::size_t of_node = n; of_node < rows.dofs.size() && space.place(rows.dofs[of_node]).node == node; ++of_node) {
        const auto i = static_cast<std::size_t>(space.place(rows.dofs[of_node]).component);
        move[static_cast<Eigen::Index>(i)] = view(rows.dofs[of_node], 0) + origin[i] - x[i];
      }
      if (held.directions.count(node) > 0) move = free_part(held, node, move);
      mine = std::max(mine, move.cwiseAbs().maxCoeff() / pairs[rows.tie_of[n]].tolerance);
      for (std::size_t i = 0; i < 3; ++i) x[i] += move[static_cast<Eigen::Index>(i)];
    }
  }
  share_positions(mesh);
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(largest));
  return largest;
}

/// Counts how far owned slave nodes have come from `before`, by ties. Collective.
void count_moves(const Mesh& mesh, const Scene& scene, const std::vector<std::array<double, 3>>& before, std::vector<TieAtStart>& at_start) {
  for (std::size_t t = 0; t < at_start.size(); ++t) {
    double largest = 0.0;
    GlobalOrdinal moved = 0;
    for (const LocalOrdinal node : require_node_set(mesh, scene.ties[t].value.slave)) {
      if (node >= mesh.owned_count()) continue;
      const auto n = static_cast<std::size_t>(node);
      const double by = (Eigen::Vector3d(mesh.coordinates[n].data()) - Eigen::Vector3d(before[n].data())).norm();
      moved += by > 0.0 ? 1 : 0;
      largest = std::max(largest, by);
    }
    Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_SUM, moved, Teuchos::outArg(at_start[t].moved));
    Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MAX, largest, Teuchos::outArg(at_start[t].furthest));
  }
}

}  // namespace

SurfaceTies tie_scene(Mesh& mesh, const FieldSpace& space, const Scene& scene, const HeldNodes& held, const InterfaceMeasure& measure,
                      const std::array<double, 3>& origin) {
  const std::vector<TiedPair> pairs = pairs_of(mesh, scene);
  const RCP<const MultiVector> marks = held_marks(mesh, held.components);
  const std::vector<std::array<double, 3>> before = mesh.coordinates;
  const auto rows_now = [&] { return tie_surfaces(mesh.owned_nodes, space.dofs(), positions_from(mesh, origin), marks, pairs, measure); };
  bool any_adjusts = false;
  for (std::size_t t = 0; t < pairs.size(); ++t) {
    if (!adjusts(scene, t)) continue;
    any_adjusts = true;
    adjust_onto_master(mesh, require_side_set(mesh, scene.ties[t].value.slave), require_side_set(mesh, scene.ties[t].value.master),
                       pairs[t].tolerance, held);
  }
  TieRows rows = rows_now();
  for (int round = 1; any_adjusts && move_slaves(mesh, space, scene, held, pairs, rows, origin) > settled && round < most_rounds; ++round)
    rows = rows_now();
  SurfaceTies result;
  result.tied = std::make_shared<const TieRows>(rows);
  for (std::size_t t = 0; t < pairs.size(); ++t) result.at_start.push_back({rows.counts[t].tied, rows.counts[t].open, pairs[t].tolerance, 0, 0.0});
  if (any_adjusts) count_moves(mesh, scene, before, result.at_start);
  return result;
}

std::shared_ptr<const TieRows> tie_temperatures(const MeshedScene& meshed, const Scene& scene, const FieldRows& rows, const std::vector<char>& held) {
  const Mesh& mesh = *meshed.mesh;
  const auto marks = rcp(new MultiVector(mesh.owned_nodes, static_cast<std::size_t>(mesh.dimension)));
  {
    const auto view = marks->getLocalViewHost(Tpetra::Access::ReadWrite);
    for (std::size_t node = 0; node < held.size(); ++node) view(node, 0) = held[node];
  }
  const std::vector<TiedPair> all = pairs_of(mesh, scene);
  std::vector<TiedPair> conducting;
  for (std::size_t t = 0; t < all.size(); ++t) {
    int without = 0, free = 0;
    const std::vector<LocalOrdinal>& slaves = require_node_set(mesh, scene.ties[t].value.slave);
    for (const auto* nodes : {&slaves, &require_node_set(mesh, scene.ties[t].value.master)})
      for (const LocalOrdinal node : *nodes) without |= node < mesh.owned_count() && !rows.lives(node) ? 1 : 0;
    for (const LocalOrdinal node : slaves) free |= node < mesh.owned_count() && held[static_cast<std::size_t>(node)] == 0 ? 1 : 0;
    const std::vector<int> any = most_over_ranks(*mesh.comm, std::vector<int>{without, free});
    if (any[0] == 0 && any[1] != 0) conducting.push_back(all[t]);
  }
  if (conducting.empty()) return nullptr;
  const std::array<double, 3> origin = contact_origin(mesh, meshed.size.length, scene.kinematics == Kinematics::axisymmetric);
  return std::make_shared<const TieRows>(
      tie_surfaces(mesh.owned_nodes, meshed.space->dofs(), positions_from(mesh, origin), marks, conducting, measure_of(scene)));
}

std::vector<int> joined_bodies(const Mesh& mesh, const Scene& scene) {
  std::vector<int> number(mesh.bodies.size());
  std::iota(number.begin(), number.end(), 0);
  for (const auto& tie : scene.ties) {
    std::vector<std::size_t> bodies;
    for (const auto* set : {&tie.value.slave, &tie.value.master})
      for (const SidesOfBody& sides : sides_by_body(mesh, require_side_set(mesh, *set))) bodies.push_back(sides.body);
    for (const std::size_t body : bodies) std::replace(number.begin(), number.end(), number[body], number[bodies.front()]);
  }
  return number;
}

std::vector<char> followed_by_dependents(const FieldSpace& space, const AffineConstraints& constraints) {
  const Matrix& T = *constraints.T();
  Vector columns(T.getColMap()), dofs(T.getDomainMap());
  {
    const auto mark = columns.getLocalViewHost(Tpetra::Access::ReadWrite);
    const auto local = T.getLocalMatrixHost();
    for (const LocalOrdinal dof : constraints.dependent()) {
      if (space.place(dof).field != 0) continue;
      for (LocalOrdinal k = 0; k < local.rowConst(dof).length; ++k) mark(local.rowConst(dof).colidx(k), 0) = 1.0;
    }
  }
  dofs.doExport(columns, Export(T.getColMap(), T.getDomainMap()), Tpetra::ADD);
  std::vector<char> followed(static_cast<std::size_t>(space.mesh()->owned_count()), 0);
  const auto mark = dofs.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t dof = 0; dof < mark.extent(0); ++dof)
    if (mark(dof, 0) != 0.0) followed[static_cast<std::size_t>(space.place(static_cast<LocalOrdinal>(dof)).node)] = 1;
  return followed;
}

}  // namespace mortise
