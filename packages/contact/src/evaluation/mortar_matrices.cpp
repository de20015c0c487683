// D and M as matrices on nodes.

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <algorithm>
#include <set>
#include <vector>

#include "evaluation/arguments.hpp"
#include "evaluation/evaluated_contact.hpp"

namespace mortise {

MortarMatrices ContactEvaluation::mortar_matrices(std::size_t p) const {
  const detail::ContactModel& model = *evaluated_->model;
  detail::require_pair(model, p);
  const detail::PairEvaluation& pair = evaluated_->pairs[p];
  const Map& nodes = pair.local_nodes();
  std::set<GlobalOrdinal> slaves;  // among the nodes that this rank's slave nodes are coupled to
  for (const SurfaceFacet& facet : pair.pair().definition().slave) slaves.insert(facet.begin(), facet.end());
  std::vector<GlobalOrdinal> rows;
  std::size_t widest = 1;
  for (std::size_t s = 0; s < pair.slave_nodes().size(); ++s) {
    if (model.multiplier_of[p][s] < 0) continue;
    rows.push_back(pair.slave_nodes()[s].id);
    widest = std::max(widest, pair.coupled_nodes(s).size());
  }
  const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  const auto map = rcp(new Map(invalid, rows.data(), static_cast<LocalOrdinal>(rows.size()), 0, model.owned_nodes->getComm()));
  const auto D = rcp(new Matrix(map, widest)), M = rcp(new Matrix(map, widest));
  for (std::size_t s = 0; s < pair.slave_nodes().size(); ++s) {
    if (model.multiplier_of[p][s] < 0) continue;
    const GlobalOrdinal own = pair.slave_nodes()[s].id;
    const detail::NodeRow& row = pair.row(s);
    const std::vector<LocalOrdinal>& coupled = pair.coupled_nodes(s);
    D->insertGlobalValues(own, 1, &row.D, &own);
    for (std::size_t c = 0; c < coupled.size(); ++c) {
      const GlobalOrdinal node = nodes.getGlobalElement(coupled[c]);
      const double d = row.coefficients[c], m = -d;
      if (d == 0.0) continue;
      if (slaves.count(node) > 0)
        D->insertGlobalValues(own, 1, &d, &node);
      else
        M->insertGlobalValues(own, 1, &m, &node);
    }
  }
  D->fillComplete(model.owned_nodes, map);
  M->fillComplete(model.owned_nodes, map);
  return {D, M};
}

}  // namespace mortise
