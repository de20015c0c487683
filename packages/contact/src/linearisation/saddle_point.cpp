// The blocks of the saddle point form: the same linearisation, multipliers kept.

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Export.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>

#include "evaluation/evaluated_contact.hpp"
#include "mortise/core/trilinos_versions.hpp"

namespace mortise {

namespace {
bool loads(const detail::PairEvaluation& pair, std::size_t s, LocalOrdinal node) {
  const std::vector<LocalOrdinal>& nodes = pair.loaded_nodes(s);
  return std::binary_search(nodes.begin(), nodes.end(), node);
}

// to += from, which may be null; neither is read before.
void add_rows(const RCP<const Matrix>& from, Matrix& to) {
  if (from.is_null()) return;
  for (LocalOrdinal row = 0; row < static_cast<LocalOrdinal>(local_row_count(*from)); ++row) {
    Matrix::local_inds_host_view_type columns;
    Matrix::values_host_view_type values;
    from->getLocalRowView(row, columns, values);
    for (std::size_t k = 0; k < columns.extent(0); ++k) {
      const GlobalOrdinal column = from->getColMap()->getGlobalElement(columns(k));
      to.insertGlobalValues(from->getRowMap()->getGlobalElement(row), 1, &values(k), &column);
    }
  }
}
}  // namespace

SaddlePointBlocks ContactLinearisation::saddle_point_blocks() const {
  const detail::EvaluatedLaws& laws = detail::evaluated(laws_);
  const detail::EvaluatedContact& contact = *laws.contact;
  const detail::ContactModel& self = *contact.model;
  const int dimension = self.dimension;
  const detail::TieBlocks tied = detail::tied_conditions(laws);

  std::vector<GlobalOrdinal> rows;  // of B, also of other ranks' nodes
  std::size_t widest = 1;
  for (std::size_t p = 0; p < contact.pairs.size(); ++p) {
    const detail::PairEvaluation& pair = contact.pairs[p];
    for (const GlobalOrdinal id : contact.dofs[p]->ids)
      if (id != NodalField::none) rows.push_back(id);
    for (std::size_t s = 0; s < pair.slave_nodes().size(); ++s) widest = std::max(widest, dimension * pair.coupled_nodes(s).size());
  }
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  const auto row_map = rcp(new Map(invalid, rows.data(), static_cast<LocalOrdinal>(rows.size()), 0, self.dofs->getComm()));

  std::vector<std::size_t> sizes(rows.size(), 0);
  for (std::size_t p = 0; p < contact.pairs.size(); ++p) {
    const detail::PairEvaluation& pair = contact.pairs[p];
    for (std::size_t s = 0; s < pair.slave_nodes().size(); ++s)
      for (const LocalOrdinal node : pair.loaded_nodes(s))
        for (int i = 0; i < dimension; ++i)
          if (const GlobalOrdinal id = contact.id(p, node, i); id != NodalField::none)
            sizes[row_map->getLocalElement(id)] += static_cast<std::size_t>(pair.pair().has_forces_of_gaps() ? dimension : 1);
  }
  Matrix B(row_map, Teuchos::arrayViewFromVector(sizes));
  SaddlePointBlocks blocks;
  const std::size_t wider_d = tied.of_positions.is_null() ? 0 : longest_local_row(*tied.of_positions),
                    wider_z = tied.of_multipliers.is_null() ? 0 : longest_local_row(*tied.of_multipliers);
  blocks.C_d = rcp(new Matrix(self.multipliers, widest + wider_d));
  blocks.C_z = rcp(new Matrix(self.multipliers, static_cast<std::size_t>(dimension) + wider_z));
  for (std::size_t p = 0; p < self.pairs.size(); ++p) {
    const detail::PairEvaluation& pair = contact.pairs[p];
    for (std::size_t s = 0; s < pair.slave_nodes().size(); ++s) {
      const LocalOrdinal first = self.multiplier_of[p][s];
      if (first < 0) continue;
      const detail::NodeRow& row = pair.row(s);
      const Complementarity& law = laws.laws[p][s];
      const std::vector<LocalOrdinal>& coupled = pair.coupled_nodes(s);
      for (int k = 0; k < dimension; ++k) {  // the force of the unit multiplier e_k
        const GlobalOrdinal multiplier = self.multipliers->getGlobalElement(first + k);
        const SpatialVector unit = SpatialVector::Unit(dimension, k), through = pair.coupled_part(s, unit);
        const double pressure = pair.gap_pressure(s, unit);
        const auto insert = [&](LocalOrdinal node, int component, double value) {
          if (const GlobalOrdinal id = contact.id(p, node, component); id != NodalField::none) B.insertGlobalValues(id, 1, &value, &multiplier);
        };
        for (int i = 0; i < dimension; ++i) {
          if (i != k && !pair.pair().has_forces_of_gaps()) continue;
          insert(pair.slave_nodes()[s].local_node, i, row.D * through[i]);
          for (std::size_t c = 0; c < coupled.size(); ++c)
            if (loads(pair, s, coupled[c]))
              insert(coupled[c], i,
                     row.coefficients[c] * through[i] - (pair.pair().has_forces_of_gaps() ? pressure * row.dgap[dimension * c + i] : 0.0));
        }
      }
      // Each row is inserted whole: Tpetra looks it up once.
      std::vector<GlobalOrdinal> dofs, columns(static_cast<std::size_t>(dimension));
      std::vector<std::vector<double>> gradients(static_cast<std::size_t>(dimension));
      for (std::size_t c = 0; c < dimension * coupled.size(); ++c) {
        const GlobalOrdinal id = contact.id(p, coupled[c / dimension], static_cast<int>(c % dimension));
        if (id == NodalField::none) continue;
        dofs.push_back(id);
        const SpatialVector gradient = pair.constraint_gradient(law, s, c, laws.multipliers[p][s]);
        for (int i = 0; i < dimension; ++i) gradients[i].push_back(gradient[i]);
      }
      for (int k = 0; k < dimension; ++k) columns[k] = self.multipliers->getGlobalElement(first + k);
      for (int i = 0; i < dimension; ++i) {
        std::vector<double> of_multipliers(static_cast<std::size_t>(dimension));
        for (int k = 0; k < dimension; ++k) of_multipliers[k] = law.C_z(i, k);
        blocks.C_z->insertGlobalValues(columns[i], dimension, of_multipliers.data(), columns.data());
        blocks.C_d->insertGlobalValues(columns[i], static_cast<LocalOrdinal>(dofs.size()), gradients[i].data(), dofs.data());
      }
    }
  }
  add_rows(tied.of_multipliers, *blocks.C_z);
  add_rows(tied.of_positions, *blocks.C_d);
  B.fillComplete(self.multipliers, self.dofs);
  blocks.B = Tpetra::exportAndFillCompleteCrsMatrix<Matrix>(rcp(&B, false), Export(row_map, self.dofs), self.multipliers, self.dofs);
  blocks.C_d->fillComplete(self.dofs, self.multipliers);
  blocks.C_z->fillComplete(self.multipliers, self.multipliers);
  return blocks;
}

}  // namespace mortise
