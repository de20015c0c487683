#include "surfaces/surface_projection.hpp"

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Export.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <map>

#include "mortise/contact/field_transfer.hpp"
#include "mortise/core/timers.hpp"
#include "mortise/nonlinear/linear_solver_factory.hpp"
#include "mortise/solid/loaded_side.hpp"

namespace mortise {
namespace {

/// [owned slave nodes] entries of the surface's mass matrix, by ids of the nodes.
using MassRows = std::map<GlobalOrdinal, std::map<GlobalOrdinal, double>>;

// Facets stand on each rank that owns a node of them: rows of owned nodes are whole.
MassRows mass_rows(const Bodies& bodies, const ContactSystem& contact, const Vector& local_displacement, std::size_t pair) {
  const Mesh& mesh = *bodies.mesh();
  const auto view = local_displacement.getLocalViewHost(Tpetra::Access::ReadOnly);
  const bool moves = contact.geometry(pair) == ContactGeometry::current;
  const FieldView<const double> displacement = moves ? FieldView<const double>{view.data(), bodies.space().rows(0)} : FieldView<const double>{};
  MassRows rows;
  for (const SurfaceFacet& facet : contact.slave_facets(pair)) {
    const LoadedSide side = side_of(mesh, facet);
    for (const SidePoint& point : *side.rule) {
      const SidePosition at = side.at(point, mesh, displacement);
      const double area = point.weight * at.area.norm() * bodies.depth(at.position[0]);
      for (std::size_t a = 0; a < facet.size(); ++a) {
        if (!mesh.owned_nodes->isNodeGlobalElement(facet[a])) continue;
        for (std::size_t b = 0; b < facet.size(); ++b) rows[facet[a]][facet[b]] += area * point.N[a] * point.N[b];
      }
    }
  }
  return rows;
}

RCP<const Matrix> mass_matrix(const Mesh& mesh, const MassRows& rows) {
  std::vector<GlobalOrdinal> ids;
  std::vector<std::size_t> counts;
  for (const auto& [node, entries] : rows) {
    ids.push_back(node);
    counts.push_back(entries.size());
  }
  const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  const auto map = rcp(new Map(invalid, ids.data(), static_cast<LocalOrdinal>(ids.size()), 0, mesh.comm));
  const auto matrix = rcp(new Matrix(map, Teuchos::ArrayView<const std::size_t>(counts)));
  for (const auto& [node, entries] : rows)
    for (const auto& [other, value] : entries) matrix->insertGlobalValues(node, 1, &value, &other);
  matrix->fillComplete();
  return matrix;
}

/// sum_j D_jk q_j
RCP<const Vector> moments(const Mesh& mesh, const ContactLaws& laws, std::size_t pair, const RCP<const Map>& rows,
                          const std::function<double(std::size_t)>& value) {
  const FieldTransfer transfer(laws, pair);
  Vector on_nodes(transfer.nodes());
  {
    const auto sums = on_nodes.getLocalViewHost(Tpetra::Access::ReadWrite);
    for (std::size_t s = 0; s < transfer.size(); ++s) {
      if (!transfer.is_covered(s)) continue;
      const NodeTransfer node = transfer[s];
      for (std::size_t m = 0; m < node.nodes.size(); ++m)
        if (node.loaded[m] != 0 && transfer.is_slave(node.nodes[m])) sums(node.nodes[m], 0) += node.coefficients[m] * value(s);
    }
  }
  const auto owned = rcp(new Vector(mesh.owned_nodes)), result = rcp(new Vector(rows));
  owned->doExport(on_nodes, Export(transfer.nodes(), owned->getMap()), Tpetra::ADD);
  const auto from = owned->getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto to = result->getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (std::size_t n = 0; n < to.extent(0); ++n)
    to(n, 0) = from(owned->getMap()->getLocalElement(rows->getGlobalElement(static_cast<LocalOrdinal>(n))), 0);
  return result;
}

}  // namespace

std::vector<double> projected_on_slave(const Bodies& bodies, const ContactSystem& contact, const ContactLaws& laws, const Vector& local_displacement,
                                       std::size_t pair, const std::function<double(std::size_t s)>& value) {
  const Mesh& mesh = *bodies.mesh();
  std::vector<double> result(static_cast<std::size_t>(mesh.owned_count()), 0.0);
  const RCP<const Matrix> mass = mass_matrix(mesh, mass_rows(bodies, contact, local_displacement, pair));
  const RCP<const Vector> b = moments(mesh, laws, pair, mass->getRowMap(), value);
  Vector x(mass->getRowMap());
  const std::unique_ptr<LinearSolver> solver = make_linear_solver({}, mesh.comm, Timers());
  solver->set_matrix(mass, true, {});
  solver->solve(*b, x);
  const auto values = x.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t n = 0; n < values.extent(0); ++n)
    result[static_cast<std::size_t>(mesh.owned_nodes->getLocalElement(mass->getRowMap()->getGlobalElement(static_cast<LocalOrdinal>(n))))] =
        values(n, 0);
  return result;
}

}  // namespace mortise
