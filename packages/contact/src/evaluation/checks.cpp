#include "evaluation/checks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "mortise/contact/enforcement.hpp"
#include "mortise/core/trilinos_versions.hpp"
#include "mortise/mortar/mortar_interface.hpp"

namespace mortise::detail {

void refuse_unfit_fields(const NodalField& displacement, const Map& dofs, const MultiVector& reference, const MultiVector& fixed) {
  const Map& owned_nodes = *displacement.nodes();
  const std::size_t dimension = reference.getNumVectors();
  if (dimension != 2 && dimension != 3)
    throw std::invalid_argument(fmt::format("contact: the reference positions have {} columns; give 2 in 2D, 3 in 3D", dimension));
  if (fixed.getNumVectors() != dimension)
    throw std::invalid_argument(
        fmt::format("contact: the marks of prescribed components have {} columns, the reference positions {}", fixed.getNumVectors(), dimension));
  const auto has_rows_of_nodes = [&](const MultiVector& one) { return one.getMap()->isSameAs(owned_nodes); };
  if (!has_rows_of_nodes(reference) || !has_rows_of_nodes(fixed))
    throw std::invalid_argument(
        "contact: reference positions and marks of prescribed components need one row for each node of `owned_nodes`, in its order");
  if (displacement.components() != static_cast<int>(dimension))
    throw std::invalid_argument(
        fmt::format("contact: field '{}' has {} components, the reference positions {}", displacement.name(), displacement.components(), dimension));
  std::string mine;
  const auto marks = fixed.getLocalViewHost(Tpetra::Access::ReadOnly), places = reference.getLocalViewHost(Tpetra::Access::ReadOnly);
  std::vector<std::pair<GlobalOrdinal, LocalOrdinal>> rows;
  for (LocalOrdinal node = 0; node < static_cast<LocalOrdinal>(local_id_count(owned_nodes)) && mine.empty(); ++node)
    for (int i = 0; i < displacement.components(); ++i) {
      const GlobalOrdinal id = displacement.id(node, i);
      const auto say = [&](const std::string& what) {
        mine = fmt::format("contact: field '{}': component {} at node {} {}", displacement.name(), i, owned_nodes.getGlobalElement(node), what);
      };
      if (!std::isfinite(places(node, i))) say(fmt::format("stands at the reference position {}, which is not finite", std::abs(places(node, i))));
      if (marks(node, i) != 0.0 && marks(node, i) != 1.0 && marks(node, i) != 2.0 && marks(node, i) != crosspoint_mark)
        say(fmt::format("has the mark {} in `fixed`; allowed: 0 unknown, 1 prescribed, 2 follows a rigid body or a reference point", marks(node, i)));
      if (id != NodalField::none) rows.emplace_back(id, node);
      if (id == NodalField::none && marks(node, i) == 0.0) say("is neither an unknown nor marked as prescribed");
      if (id != NodalField::none && !dofs.isNodeGlobalElement(id))
        say(
            fmt::format("has the id {}, which is no owned row of the system; give the map of the rows that the field was numbered with, as "
                        "make_dof_map() of mortise/core/dof_map.hpp for numbered_by_nodes()",
                        id));
    }
  std::sort(rows.begin(), rows.end());
  const auto twice = std::adjacent_find(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.first == b.first; });
  if (mine.empty() && twice != rows.end())
    mine = fmt::format("contact: field '{}': row {} is given to node {} and to node {}, or twice to one; each component needs a row of its own",
                       displacement.name(), twice->first, owned_nodes.getGlobalElement(twice->second),
                       owned_nodes.getGlobalElement(std::next(twice)->second));
  int any_here = mine.empty() ? 0 : 1, any = 0;
  Teuchos::reduceAll(*owned_nodes.getComm(), Teuchos::REDUCE_MAX, any_here, Teuchos::outArg(any));
  if (any != 0) throw std::invalid_argument(mine.empty() ? "contact: the field of displacements does not fit the system on another rank" : mine);
}

void refuse_unfit_field(const NodalField& field, const Map& owned_nodes, const Map& dofs) {
  if (!field.nodes()->isSameAs(owned_nodes))
    throw std::invalid_argument(fmt::format("contact: field '{}' is on other nodes than the displacements", field.name()));
  std::string mine;
  for (LocalOrdinal node = 0; node < static_cast<LocalOrdinal>(local_id_count(owned_nodes)) && mine.empty(); ++node)
    for (int i = 0; i < field.components(); ++i)
      if (const GlobalOrdinal id = field.id(node, i); id != NodalField::none && !dofs.isNodeGlobalElement(id))
        mine = fmt::format("contact: field '{}': component {} at node {} has the id {}, which is no owned row of the system", field.name(), i,
                           owned_nodes.getGlobalElement(node), id);
  int any_here = mine.empty() ? 0 : 1, any = 0;
  Teuchos::reduceAll(*owned_nodes.getComm(), Teuchos::REDUCE_MAX, any_here, Teuchos::outArg(any));
  if (any != 0)
    throw std::invalid_argument(mine.empty() ? fmt::format("contact: field '{}' does not fit the system on another rank", field.name()) : mine);
}

namespace {

// A coupling and an enforcement that do not go together.
void refuse_misfit(const ContactPair& pair, std::vector<Diagnostic>& diagnostics) {
  const SharedCoupling coupling = pair.options.formulation.options->coupling();
  const SharedEnforcement enforcement = pair.options.formulation.options->enforcement();
  if (!coupling || !enforcement) {
    diagnostics.push_back(
        {pair.place, "the formulation has no coupling or no enforcement; Formulation::coupling() and enforcement() may not be null"});
    return;
  }
  if (enforcement->needs_diagonal_coupling() && !coupling->has_dual_multipliers())
    diagnostics.push_back({pair.place, fmt::format("the multipliers of {} cannot be condensed by the momentum of slave nodes, as D is not diagonal; "
                                                   "take an enforcement that keeps them, or dual mortar",
                                                   coupling->name())});
  const bool has_clearances = pair.options.clearance || pair.facet_gaps;
  if (has_clearances && (coupling->has_forces_of_gaps() || !coupling->integrates_facets()))
    diagnostics.push_back(
        {pair.place,
         fmt::format(
             "a clearance, or round facets, have no meaning with {}; take dual or standard mortar, penalty or augmented Lagrange, or move the "
             "surfaces in the mesh",
             coupling->name())});
  else if (has_clearances && coupling->has_dual_multipliers() && !coupling->has_dual_gap(pair.options.mortar.gap_weighting))
    diagnostics.push_back(
        {pair.place,
         "a clearance, and round facets, need gaps that are weighted by the multipliers' own functions; take the gap weighting \"dual\""});
  if (coupling->has_forces_of_gaps() && !enforcement->keeps_multipliers())
    diagnostics.push_back({pair.place, fmt::format("the multipliers of {} have to stay unknowns, as its forces are the derivatives of gaps; take an "
                                                   "enforcement that keeps them, or another coupling",
                                                   coupling->name())});
}

}  // namespace

void refuse_incomplete_pairs(const Map& owned_nodes, const std::vector<ContactPair>& pairs) {
  std::vector<Diagnostic> diagnostics;
  for (const ContactPair& pair : pairs) {
    if (!(pair.youngs_modulus > 0.0))
      diagnostics.push_back(
          {pair.place, fmt::format("Young's modulus is {}; set ContactPair::youngs_modulus to that of the softer side, above 0: no node "
                                   "closes without",
                                   pair.youngs_modulus)});
    if (pair.options.formulation.options)
      refuse_misfit(pair, diagnostics);
    else
      diagnostics.push_back({pair.place, "the formulation is null; give a Formulation, as DualMortar"});
    if (pair.facet_gaps && pair.facet_gaps->size() != local_id_count(owned_nodes))
      diagnostics.push_back({pair.place, fmt::format("`facet_gaps` has {} entries on rank {}, which owns {} nodes; give one for each",
                                                     pair.facet_gaps->size(), owned_nodes.getComm()->getRank(), local_id_count(owned_nodes))});
    for (const auto* surface : {&pair.slave, &pair.master})
      for (const SurfaceFacet& facet : *surface)
        if (const auto negative = std::find_if(facet.begin(), facet.end(), [](GlobalOrdinal node) { return node < 0; }); negative != facet.end())
          diagnostics.push_back({pair.place, fmt::format("a facet of the {} names node {}; ids are 0 or more",
                                                         surface == &pair.slave ? "slave" : "master", *negative)});
    if (!pair.options.friction.options) diagnostics.push_back({pair.place, "the law of friction is null; give NoFriction for none"});
  }
  throw_if_any(*owned_nodes.getComm(), diagnostics);
}

}  // namespace mortise::detail
