#include "mortise/solid/nodal_mass.hpp"

#include <TpetraExt_MatrixMatrix.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <stdexcept>
#include <vector>

namespace mortise {

RCP<Vector> NodalMass::times(const Vector& v) const {
  const auto result = rcp(new Vector(v.getMap()));
  MultiVector by_direction(matrix_->getDomainMap(), dimension_), product(matrix_->getRangeMap(), dimension_);
  {
    const auto from = v.getLocalViewHost(Tpetra::Access::ReadOnly);
    const auto to = by_direction.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (std::size_t row = 0; row < from.extent(0); ++row) to(row / dimension_, row % dimension_) = from(row, 0);
  }
  matrix_->apply(by_direction, product);
  const auto from = product.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto to = result->getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (std::size_t row = 0; row < to.extent(0); ++row) to(row, 0) = from(row / dimension_, row % dimension_);
  return result;
}

void NodalMass::add_to(Matrix& jacobian, double factor) const {
  const auto mass = matrix_->getLocalMatrixHost();
  const Map &nodes = *matrix_->getColMap(), &columns = *jacobian.getColMap();
  std::vector<LocalOrdinal> first(nodes.getNodeNumElements());  // column of a node's first dof
  for (std::size_t n = 0; n < first.size(); ++n)
    first[n] = columns.getLocalElement(dimension_ * nodes.getGlobalElement(static_cast<LocalOrdinal>(n)));
  std::vector<double> values;
  std::vector<LocalOrdinal> places;
  for (LocalOrdinal node = 0; node < static_cast<LocalOrdinal>(matrix_->getNodeNumRows()); ++node) {
    values.clear();
    places.clear();
    for (std::size_t k = mass.graph.row_map(node); k < mass.graph.row_map(node + 1); ++k) {
      if (mass.values(k) == 0.0) continue;
      values.push_back(factor * mass.values(k));
      places.push_back(first[mass.graph.entries(k)]);
    }
    const auto count = static_cast<LocalOrdinal>(values.size());
    for (int i = 0; i < dimension_; ++i) {
      if (jacobian.sumIntoLocalValues(dimension_ * node + i, count, values.data(), places.data()) != count)
        throw std::logic_error("a matrix lacks entries of the mass");
      for (LocalOrdinal& place : places) ++place;
    }
  }
}

RCP<const Matrix> consistent_mass(const Bodies& bodies) {
  const Mesh& mesh = *bodies.mesh();
  Matrix of_dofs(bodies.graph());
  of_dofs.setAllToScalar(0.0);
  bodies.add_mass(of_dofs);
  const auto local = of_dofs.getLocalMatrixHost();
  const int dimension = mesh.dimension;
  const auto result = rcp(new Matrix(mesh.owned_nodes, mesh.local_nodes, of_dofs.getCrsGraph()->getNodeMaxNumRowEntries() / dimension));
  std::vector<double> values;
  std::vector<LocalOrdinal> columns;
  for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node) {
    values.clear();
    columns.clear();
    for (std::size_t k = local.graph.row_map(dimension * node); k < local.graph.row_map(dimension * node + 1); ++k) {
      if (local.graph.entries(k) % dimension != 0) continue;
      values.push_back(local.values(k));
      columns.push_back(local.graph.entries(k) / dimension);
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

RCP<const Matrix> mass_of_extension(const Matrix& M, const Matrix& P) {
  Matrix MP(M.getRowMap(), 0);
  Tpetra::MatrixMatrix::Multiply(M, false, P, false, MP);
  const auto result = rcp(new Matrix(M.getRowMap(), 0));
  Tpetra::MatrixMatrix::Multiply(P, true, MP, false, *result);
  return result;
}

RCP<const Matrix> for_each_component(const Matrix& of_nodes, const RCP<const Map>& dofs, int dimension) {
  const auto local = of_nodes.getLocalMatrixHost();
  const auto result = rcp(new Matrix(dofs, of_nodes.getNodeMaxNumRowEntries()));
  for (LocalOrdinal node = 0; node < static_cast<LocalOrdinal>(of_nodes.getNodeNumRows()); ++node)
    for (std::size_t k = local.graph.row_map(node); k < local.graph.row_map(node + 1); ++k)
      for (int i = 0; i < dimension; ++i) {
        const GlobalOrdinal column = dimension * of_nodes.getColMap()->getGlobalElement(local.graph.entries(k)) + i;
        const double value = local.values(k);
        result->insertGlobalValues(dofs->getGlobalElement(dimension * node + i), 1, &value, &column);
      }
  result->fillComplete(dofs, dofs);
  return result;
}

}  // namespace mortise
