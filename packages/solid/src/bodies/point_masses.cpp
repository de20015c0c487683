#include "mortise/solid/point_masses.hpp"

#include <fmt/format.h>

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <map>

#include "loads/load_support.hpp"
#include "mortise/core/over_ranks.hpp"
#include "mortise/mesh/reference_point.hpp"
#include "mortise/mesh/sets.hpp"
#include "mortise/solid/loaded_side.hpp"
#include "mortise/solid/rigid_mass.hpp"

namespace mortise {

void PointMassOptions::describe(Parameters& parameters) {
  parameters.add("set", set, Says("node or side set, or reference point (\"body/reference\" of a rigid body), that has the mass").required());
  parameters.add(
      "mass", mass,
      Says("of the whole set, spread evenly over the area of sides or over nodes; axisymmetric: of the whole ring").unit("mass").at_least(0.0));
  parameters.add("moments of inertia", moments_of_inertia,
                 Says("of a reference point that rotates, about it: in 2D one number, in 3D three, about x, y and z at the start; left out: none")
                     .unit("mass length^2"));
  if (!(mass > 0.0) && moments_of_inertia.empty())
    parameters.error("mass", "is 0, and there are no \"moments of inertia\"; please give one of the two");
}

namespace {

void add_over_sides(const Bodies& bodies, const PointMassOptions& options, MassRows& rows) {
  const Mesh& mesh = *bodies.mesh();
  double mine = 0.0;
  for (const LoadedSide& side : owned_sides(mesh, options.set))
    for (const SidePoint& point : *side.rule) mine += reference_area(bodies, side, point);
  const double area = sum_over_ranks(*mesh.comm, mine);
  for (const LoadedSide& side : sides_at_owned_nodes(mesh, options.set))
    for (const SidePoint& point : *side.rule) {
      const double share = options.mass * reference_area(bodies, side, point) / area;
      for (std::size_t a = 0; a < side.nodes.size(); ++a)
        for (std::size_t b = 0; b < side.nodes.size() && side.nodes[a] < mesh.owned_count(); ++b)
          rows[static_cast<std::size_t>(side.nodes[a])][mesh.local_nodes->getGlobalElement(side.nodes[b])] += share * point.N[a] * point.N[b];
    }
}

void add_to_diagonal(const Mesh& mesh, LocalOrdinal node, double mass, MassRows& rows) {
  rows[static_cast<std::size_t>(node)][mesh.local_nodes->getGlobalElement(node)] += mass;
}

void add_at_nodes(const Mesh& mesh, const PointMassOptions& options, MassRows& rows) {
  std::vector<LocalOrdinal> nodes;
  for (const LocalOrdinal node : require_node_set(mesh, options.set))
    if (node < mesh.owned_count()) nodes.push_back(node);
  const double count = sum_over_ranks(*mesh.comm, static_cast<double>(nodes.size()));
  for (const LocalOrdinal node : nodes) add_to_diagonal(mesh, node, options.mass / count, rows);
}

void add_moments(const Bodies& bodies, const Named<PointMassOptions>& mass, const ReferencePoint& point, MassRows& rows) {
  const Mesh& mesh = *bodies.mesh();
  const std::vector<double>& J = mass.value.moments_of_inertia;
  if (mesh.dimension == 2) {
    if (point.rotation_node < mesh.owned_count()) add_to_diagonal(mesh, point.rotation_node, J[0] / (point.arm * point.arm), rows);
    return;
  }
  std::vector<LocalOrdinal> nodes;
  for (const LocalOrdinal node : point.followers)
    if (node < mesh.owned_count()) nodes.push_back(node);
  const Eigen::Vector3d at(mesh.coordinates[point.node].data());
  const auto found = mass_on_nodes(mesh, nodes, rigid_mass(0.0, at, Eigen::Vector3d(J[0], J[1], J[2])));
  if (!found)
    throw InputError(mass.place, fmt::format("the nodes that follow \"{}\" do not span the space, so that they cannot carry its moments of inertia; "
                                             "please let more nodes follow it",
                                             mass.value.set.value));
  add_block(mesh, *found, rows);
}

/// Null without moments of inertia.
const ReferencePoint* turning_point(const Mesh& mesh, const Named<PointMassOptions>& mass) {
  const std::vector<double>& J = mass.value.moments_of_inertia;
  if (J.empty()) return nullptr;
  const ReferencePoint& point = require_rotating_point(mesh, mass.value.set);
  const std::size_t needed = mesh.dimension == 2 ? 1 : 3;
  if (J.size() != needed) throw InputError(mass.place, fmt::format("\"moments of inertia\" has {} numbers; {} are needed", J.size(), needed));
  double sum = 0.0;
  for (const double one : J) sum += one;
  for (const double one : J)
    if (!(one > 0.0) || (needed == 3 && 2.0 * one > (1.0 + 1e-12) * sum))
      throw InputError(mass.place, "each of the \"moments of inertia\" has to be above 0 and not larger than the sum of the other two");
  return &point;
}

}  // namespace

RCP<const Matrix> matrix_of_point_masses(const Bodies& bodies, const std::vector<Named<PointMassOptions>>& masses) {
  const Mesh& mesh = *bodies.mesh();
  MassRows rows(static_cast<std::size_t>(mesh.owned_count()));
  std::vector<Diagnostic> diagnostics;
  for (const auto& mass : masses) {
    try {  // what is thrown here is the same on all ranks
      require_node_set(mesh, mass.value.set);
      const ReferencePoint* point = turning_point(mesh, mass);
      if (mass.value.mass > 0.0) {
        if (mesh.side_sets.count(mass.value.set.value) > 0)
          add_over_sides(bodies, mass.value, rows);
        else
          add_at_nodes(mesh, mass.value, rows);
      }
      if (point != nullptr) add_moments(bodies, mass, *point, rows);
    } catch (const InputError& error) {
      diagnostics.insert(diagnostics.end(), error.diagnostics().begin(), error.diagnostics().end());
    }
  }
  throw_if_any(*mesh.comm, diagnostics);
  return mass_of_rows(mesh.owned_nodes, rows);
}

std::vector<double> weighing_masses(const Mesh& mesh, const Matrix& of_nodes) {
  Vector ones(of_nodes.getDomainMap()), sums(of_nodes.getRangeMap());
  ones.putScalar(1.0);
  of_nodes.apply(ones, sums);
  const auto view = sums.getLocalViewHost(Tpetra::Access::ReadOnly);
  std::vector<double> result(static_cast<std::size_t>(mesh.owned_count()));
  for (std::size_t node = 0; node < result.size(); ++node) result[node] = view(node, 0);
  for (const ReferencePoint& point : mesh.reference_points)
    if (point.rotation_node >= 0 && point.rotation_node < mesh.owned_count()) result[static_cast<std::size_t>(point.rotation_node)] = 0.0;
  return result;
}

}  // namespace mortise
