#include "mortise/solid/nodal_mass.hpp"

#include <TpetraExt_MatrixMatrix.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <stdexcept>
#include <vector>

#include "mortise/core/trilinos_versions.hpp"

namespace mortise {

RCP<Vector> NodalMass::times(const Vector& v) const {
  const auto result = rcp(new Vector(v.getMap()));
  const FieldRows& rows = space_->rows(0);
  MultiVector by_direction(matrix_->getDomainMap(), rows.components), product(matrix_->getRangeMap(), rows.components);
  {
    const auto from = v.getLocalViewHost(Tpetra::Access::ReadOnly);
    const auto to = by_direction.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (LocalOrdinal node = 0; node < rows.owned_nodes; ++node)
      for (int i = 0; i < rows.components; ++i) to(node, i) = from(rows(node, i), 0);
  }
  matrix_->apply(by_direction, product);
  const auto from = product.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto to = result->getLocalViewHost(Tpetra::Access::ReadWrite);
  for (LocalOrdinal node = 0; node < rows.owned_nodes; ++node)
    for (int i = 0; i < rows.components; ++i) to(rows(node, i), 0) = from(node, i);
  return result;
}

void NodalMass::add_to(Matrix& jacobian, double factor) const {
  const auto mass = matrix_->getLocalMatrixHost();
  const Map &nodes = *matrix_->getColMap(), &columns = *jacobian.getColMap();
  std::vector<LocalOrdinal> first(local_id_count(nodes));  // column of a node's first dof
  for (std::size_t n = 0; n < first.size(); ++n)
    first[n] = columns.getLocalElement(space_->id(0, nodes.getGlobalElement(static_cast<LocalOrdinal>(n)), 0));
  std::vector<double> values;
  std::vector<LocalOrdinal> places;
  for (LocalOrdinal node = 0; node < static_cast<LocalOrdinal>(local_row_count(*matrix_)); ++node) {
    values.clear();
    places.clear();
    for (std::size_t k = mass.graph.row_map(node); k < mass.graph.row_map(node + 1); ++k) {
      if (mass.values(k) == 0.0) continue;
      values.push_back(factor * mass.values(k));
      places.push_back(first[mass.graph.entries(k)]);
    }
    const auto count = static_cast<LocalOrdinal>(values.size());
    for (int i = 0; i < space_->rows(0).components; ++i) {
      if (jacobian.sumIntoLocalValues(space_->row(node, i), count, values.data(), places.data()) != count)
        throw std::logic_error("a matrix lacks entries of the mass");
      for (LocalOrdinal& place : places) ++place;
    }
  }
}

RCP<const Matrix> consistent_mass(const Bodies& bodies) {
  const Mesh& mesh = *bodies.mesh();
  Matrix of_dofs(bodies.space().graph());
  of_dofs.setAllToScalar(0.0);
  bodies.add_mass(of_dofs);
  const auto local = of_dofs.getLocalMatrixHost();
  const FieldRows& rows = bodies.space().rows(0);
  std::vector<LocalOrdinal> node_of(local_id_count(*bodies.space().local_dofs()), -1);  // by columns of first components
  for (LocalOrdinal node = 0; node < mesh.local_count(); ++node) node_of[rows(node, 0)] = node;
  const auto result = rcp(new Matrix(mesh.owned_nodes, mesh.local_nodes, longest_local_row(*of_dofs.getCrsGraph()) / rows.components));
  std::vector<double> values;
  std::vector<LocalOrdinal> columns;
  for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node) {
    values.clear();
    columns.clear();
    const LocalOrdinal row = rows(node, 0);
    for (std::size_t k = local.graph.row_map(row); k < local.graph.row_map(row + 1); ++k) {
      if (node_of[local.graph.entries(k)] < 0) continue;
      values.push_back(local.values(k));
      columns.push_back(node_of[local.graph.entries(k)]);
    }
    result->insertLocalValues(node, static_cast<LocalOrdinal>(values.size()), values.data(), columns.data());
  }
  result->fillComplete(mesh.owned_nodes, mesh.owned_nodes);
  return result;
}

RCP<const Matrix> mass_of_nodes(const RCP<const Map>& owned_nodes, const std::vector<double>& masses) {
  const auto result = rcp(new Matrix(owned_nodes, 1));
  for (std::size_t n = 0; n < masses.size(); ++n) {
    const GlobalOrdinal id = owned_nodes->getGlobalElement(static_cast<LocalOrdinal>(n));
    result->insertGlobalValues(id, 1, &masses[n], &id);
  }
  result->fillComplete();
  return result;
}

RCP<const Matrix> mass_of_rows(const RCP<const Map>& owned_nodes, const MassRows& rows) {
  std::size_t most = 1;
  for (const auto& row : rows) most = std::max(most, row.size());
  const auto result = rcp(new Matrix(owned_nodes, most));
  for (std::size_t node = 0; node < rows.size(); ++node)
    for (const auto& [column, value] : rows[node])
      result->insertGlobalValues(owned_nodes->getGlobalElement(static_cast<LocalOrdinal>(node)), 1, &value, &column);
  result->fillComplete(owned_nodes, owned_nodes);
  return result;
}

RCP<const Matrix> mass_of_extension(const Matrix& M, const Matrix& P) {
  Matrix MP(M.getRowMap(), 0);
  Tpetra::MatrixMatrix::Multiply(M, false, P, false, MP);
  const auto result = rcp(new Matrix(M.getRowMap(), 0));
  Tpetra::MatrixMatrix::Multiply(P, true, MP, false, *result);
  return result;
}

RCP<const Matrix> for_each_component(const Matrix& of_nodes, const FieldSpace& space) {
  const RCP<const Map>& dofs = space.dofs();
  const auto local = of_nodes.getLocalMatrixHost();
  const auto result = rcp(new Matrix(dofs, longest_local_row(of_nodes)));
  for (LocalOrdinal node = 0; node < static_cast<LocalOrdinal>(local_row_count(of_nodes)); ++node)
    for (std::size_t k = local.graph.row_map(node); k < local.graph.row_map(node + 1); ++k)
      for (int i = 0; i < space.rows(0).components; ++i) {
        const GlobalOrdinal column = space.id(0, of_nodes.getColMap()->getGlobalElement(local.graph.entries(k)), i);
        const double value = local.values(k);
        result->insertGlobalValues(dofs->getGlobalElement(space.row(node, i)), 1, &value, &column);
      }
  result->fillComplete(dofs, dofs);
  return result;
}

}  // namespace mortise
