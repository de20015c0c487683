#include "matrices_of_heat.hpp"

#include <TpetraExt_MatrixMatrix.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Export.hpp>
#include <Tpetra_Map.hpp>
#include <stdexcept>

#include "mortise/core/matrix_sum.hpp"
#include "mortise/core/trilinos_versions.hpp"

namespace mortise::detail {
namespace {

// The rows of all ranks at their owners, added to `sum`.
void add(Matrix& on_nodes, const InterfaceRows& interface, const RCP<const Map>& columns, const RCP<const Map>& dofs, RCP<const Matrix>& sum) {
  on_nodes.fillComplete(columns, dofs);
  const RCP<const Matrix> mine = Tpetra::exportAndFillCompleteCrsMatrix<Matrix>(rcp(&on_nodes, false), *interface.to_owners, columns, dofs);
  sum = sum.is_null() ? mine : RCP<const Matrix>(Tpetra::MatrixMatrix::add(1.0, false, *sum, 1.0, false, *mine, columns, dofs));
}

}  // namespace

void add_matrices(const ThermalModel& model, const FieldTransfer& transfer, EvaluatedPass& pass, RCP<const Matrix>& of_dofs,
                  RCP<const Matrix>& of_multipliers) {
  const InterfaceRows& interface = *pass.interface;
  const int dimension = model.contact.dimension();
  std::vector<std::size_t> sizes(local_id_count(*interface.rows), 0), multipliers(sizes);
  const auto row_of = [&](LocalOrdinal node) {
    const GlobalOrdinal id = interface.ids[static_cast<std::size_t>(node)];
    return id == NodalField::none ? -1 : interface.rows->getLocalElement(id);
  };
  for (const RowsOfHeat& rows : pass.nodes)
    for (std::size_t m = 0; m < rows.nodes.size(); ++m)
      if (const LocalOrdinal row = row_of(rows.nodes[m]); row >= 0 && rows.loaded[m] != 0) {
        sizes[static_cast<std::size_t>(row)] += static_cast<std::size_t>(1 + dimension) * rows.nodes.size();
        multipliers[static_cast<std::size_t>(row)] += static_cast<std::size_t>(dimension);
      }
  Matrix dofs(interface.rows, Teuchos::arrayViewFromVector(sizes)), z(interface.rows, Teuchos::arrayViewFromVector(multipliers));
  std::vector<GlobalOrdinal> columns, of_z(static_cast<std::size_t>(dimension));
  std::vector<double> values, values_of_z(static_cast<std::size_t>(dimension));
  for (RowsOfHeat& rows : pass.nodes) {
    for (std::size_t m = 0; m < rows.nodes.size(); ++m) {
      const LocalOrdinal row = row_of(rows.nodes[m]);
      if (row < 0 || rows.loaded[m] == 0) continue;
      const auto at = static_cast<Eigen::Index>(m);
      columns.clear();
      values.clear();
      for (std::size_t n = 0; n < rows.nodes.size(); ++n) {
        if (const GlobalOrdinal id = interface.ids[static_cast<std::size_t>(rows.nodes[n])]; id != NodalField::none) {
          columns.push_back(id);
          values.push_back(rows.of_temperatures(at, static_cast<Eigen::Index>(n)));
        }
        for (int i = 0; i < dimension; ++i)
          if (const GlobalOrdinal id = transfer.displacement_id(rows.nodes[n], i); id != NodalField::none) {
            columns.push_back(id);
            values.push_back(rows.of_positions(at, dimension * static_cast<Eigen::Index>(n) + i));
          }
      }
      for (int i = 0; i < dimension; ++i) {
        of_z[static_cast<std::size_t>(i)] = rows.multiplier + i;
        values_of_z[static_cast<std::size_t>(i)] = rows.of_multipliers(at, i);
      }
      const GlobalOrdinal id = interface.rows->getGlobalElement(row);
      dofs.insertGlobalValues(id, static_cast<LocalOrdinal>(columns.size()), values.data(), columns.data());
      z.insertGlobalValues(id, dimension, values_of_z.data(), of_z.data());
    }
    rows.of_temperatures.resize(0, 0);
    rows.of_positions.resize(0, 0);
    rows.of_multipliers.resize(0, 0);
  }
  add(dofs, interface, model.dofs, model.dofs, of_dofs);
  add(z, interface, model.contact.multiplier_map(), model.dofs, of_multipliers);
}

void add_rows(const Matrix& rows, Matrix& system) {
  if (!add_entries(rows, system))
    throw std::logic_error(
        "thermal contact: an entry of the rows of heat has no place in the matrix; make it on the graph of a ContactSystem that knows of the "
        "temperature among its further fields");
}

}  // namespace mortise::detail
