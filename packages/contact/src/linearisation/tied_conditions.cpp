// Contributions of the ties of hardly covered nodes to the conditions and to their linearisation.
//
// The conditions of node j see g_j + n_j . q_j and u_j - (T_j q_j - T_j^old q_j^old). Here q = S(d) z of MultiplierTies, and q^old is that of the
// start of the step. With G_j = dC_j / dq_j
//   dC_j = ... + G_j ( sum_k S_jk dz_k + (dS z)_j ).
// The node's own compliance sigma_j dz_j stands in C_z of its law. The rest,  L (dd, dz),  couples multipliers of different nodes, also of different
// ranks: it is left out where each node's multiplier is condensed by itself. The share of a receiver in the ties of others, T^2 sigma, belongs
// to the rest: together with the tied node's multiplier it all but cancels.

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Export.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <map>

#include "linearisation/condensation.hpp"
#include "mortise/core/trilinos_versions.hpp"

namespace mortise::detail {
namespace {

// s_j: 1 of the tied node, -T of its receivers.
double sign_of(const MultiplierTie& tie, std::size_t member) { return member == 0 ? 1.0 : -tie.shares[member - 1]; }
LocalOrdinal node_of(const MultiplierTie& tie, std::size_t member) {
  return member == 0 ? static_cast<LocalOrdinal>(tie.node) : tie.receivers[member - 1];
}

// dq_j = sum over the ties of  s_j sigma sum_m s_m dz_m  +  (s_j dsigma + ds_j sigma) r + s_j sigma dr,   dr = -sum_k dT_k z_k,  ds_k = -dT_k.
TieBlocks tie_blocks(const EvaluatedContact& contact, const Vector& z) {
  const ContactModel& model = *contact.model;
  const std::vector<PairEvaluation>& pairs = contact.pairs;
  const RCP<const Map>&dofs = model.dofs, &multipliers = model.multipliers;
  const int dimension = model.dimension;
  const GlobalOrdinal offset = dofs->getMaxAllGlobalIndex() + 1;
  const auto values = z.getLocalViewHost(Tpetra::Access::ReadOnly);
  std::vector<RCP<MultiVector>> z_on_nodes;
  std::vector<GlobalOrdinal> rows;
  std::vector<std::size_t> entries_z, entries_d;
  std::map<GlobalOrdinal, std::array<std::size_t, 2>> sizes;  // by node
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const MultiplierTies& ties = pairs[p].ties();
    z_on_nodes.emplace_back();
    if (!ties.any()) continue;
    z_on_nodes.back() = ties.on_nodes(*model.owned_multipliers(p, values, ties.owned_nodes()));
    for (const MultiplierTie& tie : ties.ties())
      for (std::size_t member = 0; member <= tie.receivers.size(); ++member) {
        auto& size = sizes[ties.nodes()->getGlobalElement(node_of(tie, member))];
        size[0] += 1 + tie.receivers.size();
        size[1] += tie.dcompliance.size();
      }
  }
  for (const auto& [node, size] : sizes)
    for (int i = 0; i < dimension; ++i) {
      rows.push_back(offset + dimension * node + i);
      entries_z.push_back(size[0]);
      entries_d.push_back(size[1]);
    }
  const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  const auto map = rcp(new Map(invalid, rows.data(), static_cast<LocalOrdinal>(rows.size()), 0, dofs->getComm()));
  Matrix of_multipliers(map, Teuchos::arrayViewFromVector(entries_z)), of_positions(map, Teuchos::arrayViewFromVector(entries_d));
  std::vector<GlobalOrdinal> columns;  // of a tie's positions that are unknowns
  std::vector<Eigen::Index> entries;   // of these in its derivatives
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const MultiplierTies& ties = pairs[p].ties();
    if (!ties.any()) continue;
    const auto of_node = z_on_nodes[p]->getLocalViewHost(Tpetra::Access::ReadOnly);
    for (const MultiplierTie& tie : ties.ties()) {
      const SpatialVector r = MultiplierTies::deviation(tie, *z_on_nodes[p]);
      columns.clear();
      entries.clear();
      for (std::size_t n = 0; n < tie.columns.size() && tie.dcompliance.size() > 0; ++n)
        for (int k = 0; k < dimension; ++k)
          if (const GlobalOrdinal id = contact.id(p, tie.columns[n], k); id != NodalField::none) {
            columns.push_back(id);
            entries.push_back(dimension * static_cast<Eigen::Index>(n) + k);
          }
      for (std::size_t j = 0; j <= tie.receivers.size(); ++j) {
        const double sign = sign_of(tie, j);
        const GlobalOrdinal first = offset + dimension * ties.nodes()->getGlobalElement(node_of(tie, j));
        for (int i = 0; i < dimension; ++i) {
          for (std::size_t m = 0; m <= tie.receivers.size(); ++m) {
            const GlobalOrdinal column = offset + dimension * ties.nodes()->getGlobalElement(node_of(tie, m)) + i;
            const double value = sign * tie.compliance * sign_of(tie, m);
            of_multipliers.insertGlobalValues(first + i, 1, &value, &column);
          }
          if (columns.empty()) continue;
          Eigen::RowVectorXd slope = sign * r[i] * tie.dcompliance;
          if (j > 0) slope -= tie.compliance * r[i] * tie.dshares.row(static_cast<Eigen::Index>(j) - 1);
          for (std::size_t k = 0; k < tie.receivers.size(); ++k)
            slope -= sign * tie.compliance * of_node(tie.receivers[k], i) * tie.dshares.row(static_cast<Eigen::Index>(k));
          const Eigen::RowVectorXd kept = slope(entries);
          of_positions.insertGlobalValues(first + i, static_cast<LocalOrdinal>(columns.size()), kept.data(), columns.data());
        }
      }
    }
  }
  of_multipliers.fillComplete(multipliers, multipliers);
  of_positions.fillComplete(dofs, multipliers);
  const Export to_owners(map, multipliers);
  return {Tpetra::exportAndFillCompleteCrsMatrix<Matrix>(rcp(&of_multipliers, false), to_owners, multipliers, multipliers),
          Tpetra::exportAndFillCompleteCrsMatrix<Matrix>(rcp(&of_positions, false), to_owners, dofs, multipliers)};
}

}  // namespace

// Rows of closed nodes, multiplied by G_j, but for sigma_j dz_j.
TieBlocks tied_conditions(const EvaluatedLaws& laws) {
  const EvaluatedContact& contact = *laws.contact;
  const ContactModel& model = *contact.model;
  const RCP<const Map>&dofs = model.dofs, &multipliers = model.multipliers;
  const int dimension = model.dimension;
  if (!contact.any_ties()) return {};
  struct Factor {
    LocalOrdinal first;  // multiplier
    double tie;
    SpatialMatrix G;
  };
  std::vector<Factor> factors;
  for (std::size_t p = 0; p < contact.pairs.size(); ++p)
    for (std::size_t s = 0; s < laws.laws[p].size(); ++s) {
      const LocalOrdinal first = model.multiplier_of[p][s];
      const NodeMultiplier& of_node = laws.multipliers[p][s];
      if (first < 0 || of_node.shift.size() == 0 || laws.state(p, s) == ContactState::open) continue;
      factors.push_back({first, of_node.tie, contact.pairs[p].shift_factor(laws.laws[p][s], s)});
    }
  if (model.maximum(factors.empty() ? 0.0 : 1.0) == 0.0) return {};
  const TieBlocks blocks = tie_blocks(contact, *laws.z);
  const auto multiplied = [&](const Matrix& block, const RCP<const Map>& domain, bool of_multipliers) {
    std::vector<std::size_t> sizes(local_id_count(*multipliers), 0);
    const auto each_row = [&](const auto& act) {
      for (const Factor& factor : factors)
        for (int m = 0; m < dimension; ++m) {
          Matrix::local_inds_host_view_type columns;
          Matrix::values_host_view_type entries;
          block.getLocalRowView(factor.first + m, columns, entries);
          act(factor, m, columns, entries);
        }
    };
    each_row([&](const Factor& factor, int, const auto& columns, const auto&) {
      for (int i = 0; i < dimension; ++i) sizes[factor.first + i] += columns.extent(0);
    });
    const auto result = rcp(new Matrix(multipliers, Teuchos::arrayViewFromVector(sizes)));
    each_row([&](const Factor& factor, int m, const auto& columns, const auto& entries) {
      for (std::size_t k = 0; k < columns.extent(0); ++k) {
        const GlobalOrdinal column = block.getColMap()->getGlobalElement(columns(k));
        const bool own = of_multipliers && column == multipliers->getGlobalElement(factor.first + m);
        const double entry = own ? entries(k) - factor.tie : entries(k);
        for (int i = 0; i < dimension && entry != 0.0; ++i) {
          const double value = factor.G(i, m) * entry;
          result->insertGlobalValues(multipliers->getGlobalElement(factor.first + i), 1, &value, &column);
        }
      }
    });
    result->fillComplete(domain, multipliers);
    return result;
  };
  return {multiplied(*blocks.of_multipliers, multipliers, true), multiplied(*blocks.of_positions, dofs, false)};
}

}  // namespace mortise::detail
