// The change of unknowns under which a condensed contact system falls apart into that of the bodies, joined, and one of the gaps.

#include <Eigen/Core>
#include <TpetraExt_MatrixMatrix.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <optional>
#include <utility>

#include "implementation.hpp"
#include "mortise/core/dof_map.hpp"

namespace mortise {

namespace {

// Rows of an operator that is the identity but for the rows of some slave nodes.
class NearIdentity {
 public:
  NearIdentity(const RCP<const Map>& dofs, const std::vector<std::size_t>& sizes)
      : matrix_(rcp(new Matrix(dofs, Teuchos::arrayViewFromVector(sizes)))) {}

  void add(LocalOrdinal row, GlobalOrdinal column, double value) {
    if (value != 0.0) matrix_->insertGlobalValues(matrix_->getRowMap()->getGlobalElement(row), 1, &value, &column);
  }
  RCP<Matrix> finish(const std::vector<char>& is_slave) {
    const RCP<const Map> dofs = matrix_->getRowMap();
    const double one = 1.0;
    for (std::size_t row = 0; row < is_slave.size(); ++row) {
      const GlobalOrdinal id = dofs->getGlobalElement(static_cast<LocalOrdinal>(row));
      if (!is_slave[row]) matrix_->insertGlobalValues(id, 1, &one, &id);
    }
    matrix_->fillComplete(dofs, dofs);
    return matrix_;
  }

 private:
  RCP<Matrix> matrix_;
};

// Rows of slave nodes with respect to what the nodes they are coupled to move by. A middle of an edge is coupled to corners, which are slave nodes
// themselves: rows of middles act on what rows of corners give.
class SlaveRows {
 public:
  SlaveRows(const RCP<const Map>& dofs, const std::vector<std::size_t>& sizes, bool any_middles)
      : corners_(dofs, sizes), is_corner_(sizes.size(), 0), is_middle_(sizes.size(), 0) {
    if (any_middles) middles_.emplace(dofs, sizes);
  }

  void mark(LocalOrdinal dof, bool middle) { (middle ? is_middle_ : is_corner_)[dof] = 1; }
  void add(LocalOrdinal row, bool middle, GlobalOrdinal column, double value) { (middle ? *middles_ : corners_).add(row, column, value); }
  RCP<Matrix> finish() {
    RCP<Matrix> last = corners_.finish(is_corner_);
    if (!middles_) return last;
    const auto product = rcp(new Matrix(last->getRowMap(), last->getNodeMaxNumRowEntries()));
    Tpetra::MatrixMatrix::Multiply(*middles_->finish(is_middle_), false, *last, false, *product);
    return product;
  }

 private:
  NearIdentity corners_;
  std::optional<NearIdentity> middles_;
  std::vector<char> is_corner_, is_middle_;  ///< [dofs]
};

}  // namespace

Decoupling ContactSystem::decoupling(const Vector& z) const {
  const Implementation& self = *implementation_;
  const int dimension = self.dimension;
  const auto values = z.getLocalViewHost(Tpetra::Access::ReadOnly);
  std::vector<std::size_t> sizes(self.dofs->getNodeNumElements(), 1);
  for (const auto& pair : self.pairs)
    for (std::size_t s = 0; s < pair->rows().size(); ++s)
      std::fill_n(sizes.begin() + dimension * pair->slave_nodes()[s].owned_node, dimension,
                  dimension * (1 + pair->interface().coupled_nodes(s).size()));
  SlaveRows trial(self.dofs, sizes, self.middles_first), test(self.dofs, sizes, self.middles_first);
  Decoupling result;
  std::vector<std::pair<LocalOrdinal, SpatialMatrix>> eliminated;  // owned node, N_j
  for (std::size_t p = 0; p < self.pairs.size(); ++p) {
    const detail::PairCoupling& pair = *self.pairs[p];
    if (pair.formulation().elimination() != Elimination::momentum) continue;
    const Map& nodes = *pair.interface().local_nodes();
    MultiVector fixed(pair.interface().local_nodes(), static_cast<std::size_t>(dimension));
    fixed.doImport(*self.fixed, Import(self.owned_nodes, pair.interface().local_nodes()), Tpetra::REPLACE);
    const auto is_fixed = fixed.getLocalViewHost(Tpetra::Access::ReadOnly);
    for (std::size_t s = 0; s < pair.rows().size(); ++s) {
      const SpatialVector zs = self.z_of(values, p, s);
      if (self.multiplier_of[p][s] < 0 || !pair.closed(s, zs)) continue;
      const SlaveNode& slave = pair.slave_nodes()[s];
      const detail::NodeRow& row = pair.rows()[s];
      SpatialMatrix held = SpatialMatrix::Zero(dimension, dimension), free = held;  // F, I - F
      for (int i = 0; i < dimension; ++i) (slave.fixed[i] ? held : free)(i, i) = 1.0;
      const bool sticks = pair.complementarity(s, zs).state == ContactState::stick;
      const SpatialMatrix N = sticks ? free : SpatialMatrix(row.normal * row.normal.transpose());
      const SpatialMatrix along = free - N, kept = SpatialMatrix::Identity(dimension, dimension) - N;
      for (int i = 0; i < dimension; ++i) {
        const LocalOrdinal dof = dimension * slave.owned_node + i;
        const bool middle = pair.before_corners(s);
        trial.mark(dof, middle);
        test.mark(dof, middle);
        for (int k = 0; k < dimension; ++k) {
          trial.add(dof, middle, dimension * slave.id + k, kept(i, k));
          test.add(dof, middle, dimension * slave.id + k, kept(i, k));
        }
        const std::vector<LocalOrdinal>& coupled = pair.interface().coupled_nodes(s);
        for (std::size_t c = 0; c < coupled.size(); ++c) {
          const double share = -row.coefficients[c] / row.D;
          if (share == 0.0) continue;
          for (int k = 0; k < dimension; ++k) {
            if (is_fixed(coupled[c], k) != 0.0) continue;
            trial.add(dof, middle, dimension * nodes.getGlobalElement(coupled[c]) + k, share * N(i, k));
            test.add(dof, middle, dimension * nodes.getGlobalElement(coupled[c]) + k, -share * along(i, k));
          }
        }
      }
      eliminated.emplace_back(slave.owned_node, N);
    }
  }
  result.trial = trial.finish();
  result.test = test.finish();
  // N, block diagonal.
  const auto normal = rcp(new Matrix(self.dofs, static_cast<std::size_t>(dimension)));
  for (const auto& [node, N] : eliminated)
    for (int i = 0; i < dimension; ++i)
      for (int k = 0; k < dimension; ++k) {
        const GlobalOrdinal column = self.dofs->getGlobalElement(dimension * node + k);
        normal->insertGlobalValues(self.dofs->getGlobalElement(dimension * node + i), 1, &N(i, k), &column);
      }
  normal->fillComplete(self.dofs, self.dofs);
  result.eliminated = normal;
  return result;
}

}  // namespace mortise
