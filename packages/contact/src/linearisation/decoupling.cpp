// The change of unknowns under which a condensed contact system falls apart into that of the bodies, joined, and one of the gaps.

#include <Eigen/Core>
#include <TpetraExt_MatrixMatrix.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <functional>
#include <utility>

#include "linearisation/condensation.hpp"
#include "mortise/core/trilinos_versions.hpp"

namespace mortise {

namespace {

RCP<Matrix> product(const Matrix& A, const Matrix& B) {
  const auto result = rcp(new Matrix(A.getRowMap(), 0));
  Tpetra::MatrixMatrix::Multiply(A, false, B, false, *result);
  return result;
}

RCP<Matrix> sum(const Matrix& A, const Matrix& B) { return Tpetra::MatrixMatrix::add(1.0, false, A, 1.0, false, B); }

// Rows of slave nodes, of an operator less the identity, with respect to what the nodes they are coupled to move by. A mid-side node is coupled to
// corners, which are slave nodes themselves: rows of mid-side nodes act on what rows of corners give.
class SlaveRows {
 public:
  SlaveRows(const RCP<const Map>& dofs, const std::vector<std::size_t>& sizes, bool any_middles)
      : corners_(rcp(new Matrix(dofs, Teuchos::arrayViewFromVector(sizes)))) {
    if (any_middles) middles_ = rcp(new Matrix(dofs, Teuchos::arrayViewFromVector(sizes)));
  }

  void add(LocalOrdinal row, bool middle, GlobalOrdinal column, double value) {
    const auto& matrix = middle ? middles_ : corners_;
    if (value != 0.0) matrix->insertGlobalValues(matrix->getRowMap()->getGlobalElement(row), 1, &value, &column);
  }
  RCP<Matrix> finish() {
    const RCP<const Map> dofs = corners_->getRowMap();
    corners_->fillComplete(dofs, dofs);
    if (middles_.is_null()) return corners_;
    middles_->fillComplete(dofs, dofs);
    return sum(*sum(*middles_, *corners_), *product(*middles_, *corners_));  // (I + middles) (I + corners) - I
  }

 private:
  RCP<Matrix> corners_, middles_;
};

/// The linearised momentum of a condensed node, as its own motion changes it, of the z = b + S dd that was kept.
SpatialMatrix own_stiffness(const detail::EliminatedNode& kept, const detail::NodePositions& positions, LocalOrdinal node, double D, int dimension) {
  SpatialMatrix K(dimension, dimension);
  for (int k = 0; k < dimension; ++k) {
    const LocalOrdinal own = positions.column[dimension * node + k];
    if (own < 0) {  // it does not move
      K.col(k).setZero();
      continue;
    }
    const auto column = std::lower_bound(kept.columns.begin(), kept.columns.end(), own) - kept.columns.begin();
    for (int i = 0; i < dimension; ++i) K(i, k) = -D * kept.S[i][static_cast<std::size_t>(column)];
  }
  return K;
}

/// N_j, P_j = I - F_j - N_j and Q_j of a closed node.
struct Directions {
  SpatialMatrix N, P, Q;
};

// A node that sticks after it closed a gap is a spring along the surface next to a share of its momentum.
// In 3D friction holds a node that slips across the direction t of slip. Its condition there is that of a spring next to the share 1 - rho / |y| of
// the node's momentum. Either the spring is the stiffer part, and t is eliminated, or Q makes the momentum whole.
Directions directions(const SpatialMatrix& free, const detail::NodeRow& row, const Frame& frame, const Complementarity& law,
                      const std::function<SpatialMatrix()>& stiffness_of_node) {
  const SpatialMatrix none = SpatialMatrix::Zero(free.rows(), free.cols());
  const bool sticks = law.state == ContactState::stick;
  const Eigen::Index last = frame.tangents.rows() - 1;  // that of a partly fixed node which is free
  const double borne = sticks ? law.C_z.row(1 + last).dot(frame.tangents.row(last)) : 0.0;
  if (sticks && !(borne > 0.0)) return {free, none, none};
  Directions result;
  const SpatialVector normal = (free * row.normal).normalized();
  result.N = normal * normal.transpose();
  result.Q = result.P = free - result.N;
  if (law.slip_factor.size() == 0) return result;
  if (sticks) {
    const SpatialVector tangent = frame.tangents.row(last).transpose();
    if (-row.D * row.D * law.slip_factor(last, last) > borne * tangent.dot(stiffness_of_node() * tangent)) return {free, none, none};
    result.Q /= borne;
    return result;
  }
  const Eigen::MatrixXd along = result.P * frame.tangents.transpose();
  const SpatialMatrix spring = -row.D * row.D * along * law.slip_factor * along.transpose();
  const double stiffness = spring.trace();
  if (!(stiffness > 0.0)) return result;
  const SpatialMatrix across = spring / stiffness;  // t t^T
  const double share = (across * along * law.C_z.bottomRows(frame.tangents.rows())).trace();
  if (stiffness > share * (stiffness_of_node() * across).trace()) {
    result.N += across;
    result.P -= across;
    result.Q = result.P;
  } else {
    result.Q += (1.0 / share - 1.0) * across;
  }
  return result;
}

}  // namespace

Decoupling NodeElimination::decoupling() const {
  const detail::EvaluatedLaws& laws = condensation_->at();
  const detail::ContactModel& self = *laws.contact->model;
  const int dimension = self.dimension;
  std::vector<std::size_t> sizes(local_id_count(*self.dofs), 0), sizes_of_blocks(sizes);
  for (const detail::PairEvaluation& pair : laws.contact->pairs)
    for (std::size_t s = 0; s < pair.rows().size(); ++s) {
      for (int i = 0; i < dimension; ++i) {
        const LocalOrdinal row = condensation_->own_rows_of(pair.slave_nodes()[s])[i];
        if (row < 0) continue;
        sizes[static_cast<std::size_t>(row)] = dimension * (1 + pair.coupled_nodes(s).size());
        sizes_of_blocks[static_cast<std::size_t>(row)] = static_cast<std::size_t>(dimension);
      }
    }
  std::vector<std::size_t> kept_of(laws.z->getLocalLength());
  for (std::size_t k = 0; k < condensation_->nodes.size(); ++k) kept_of[static_cast<std::size_t>(condensation_->nodes[k].multiplier)] = k;
  SlaveRows trial(self.dofs, sizes, self.middles_first), test(self.dofs, sizes, self.middles_first);
  Decoupling result;
  std::vector<std::pair<const LocalOrdinal*, SpatialMatrix>> eliminated;  // own rows, N_j
  for (std::size_t p = 0; p < self.pairs.size(); ++p) {
    const detail::PairEvaluation& pair = laws.contact->pairs[p];
    if (!pair.pair().enforcement().needs_diagonal_coupling()) continue;
    const detail::EvaluatedContact& contact = *laws.contact;
    const InterfacePattern& pattern = *pair.geometry()->pattern;
    MultiVector fixed(pattern.local_nodes, static_cast<std::size_t>(dimension));
    fixed.doImport(*self.fixed, *pattern.import, Tpetra::REPLACE);
    const auto is_fixed = fixed.getLocalViewHost(Tpetra::Access::ReadOnly);
    for (std::size_t s = 0; s < pair.rows().size(); ++s) {
      if (laws.state(p, s) == ContactState::open || pair.is_eliminated_by_law(s)) continue;
      const SlaveNode& slave = pair.slave_nodes()[s];
      const detail::NodeRow& row = pair.row(s);
      SpatialMatrix free = SpatialMatrix::Zero(dimension, dimension);  // I - F
      for (int i = 0; i < dimension; ++i) free(i, i) = slave.fixed[i] ? 0.0 : 1.0;
      const auto stiffness_of_node = [&] {
        const detail::EliminatedNode& kept = condensation_->nodes[kept_of[static_cast<std::size_t>(self.multiplier_of[p][s])]];
        return own_stiffness(kept, condensation_->scatter->positions(p), slave.local_node, row.D, dimension);
      };
      const auto [N, P, Q] = directions(free, row, pair.frame(s), laws.laws[p][s], stiffness_of_node);
      const LocalOrdinal* own_rows = condensation_->own_rows_of(slave);
      for (int i = 0; i < dimension; ++i) {
        const LocalOrdinal dof = own_rows[i];
        if (dof < 0) continue;
        const bool middle = pair.pair().before_corners(s);
        for (int k = 0; k < dimension; ++k) {
          if (own_rows[k] < 0) continue;
          const GlobalOrdinal column = self.dofs->getGlobalElement(own_rows[k]);
          trial.add(dof, middle, column, -N(i, k));
          test.add(dof, middle, column, Q(k, i) - P(k, i) - N(k, i));
        }
        const std::vector<LocalOrdinal>& coupled = pair.coupled_nodes(s);
        for (std::size_t c = 0; c < coupled.size(); ++c) {
          const double share = -row.coefficients[c] / row.D;
          if (share == 0.0) continue;
          for (int k = 0; k < dimension; ++k) {
            if (is_fixed(coupled[c], k) != 0.0) continue;
            trial.add(dof, middle, contact.id(p, coupled[c], k), share * N(i, k));
            test.add(dof, middle, contact.id(p, coupled[c], k), -share * Q(k, i));
          }
        }
      }
      eliminated.emplace_back(own_rows, N);
    }
  }
  result.trial = trial.finish();
  result.test = test.finish();
  const auto normal = rcp(new Matrix(self.dofs, Teuchos::arrayViewFromVector(sizes_of_blocks)));
  for (const auto& [own_rows, N] : eliminated)
    for (int i = 0; i < dimension; ++i)
      for (int k = 0; k < dimension; ++k) {
        if (own_rows[i] < 0 || own_rows[k] < 0) continue;
        const GlobalOrdinal column = self.dofs->getGlobalElement(own_rows[k]);
        normal->insertGlobalValues(self.dofs->getGlobalElement(own_rows[i]), 1, &N(i, k), &column);
      }
  normal->fillComplete(self.dofs, self.dofs);
  result.eliminated = normal;
  result.dimension = dimension;
  return result;
}

}  // namespace mortise
