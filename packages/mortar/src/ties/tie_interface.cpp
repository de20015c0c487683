#include "ties/tie_interface.hpp"

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>

#include "mortise/core/trilinos_versions.hpp"
#include "mortise/mortar/quadratic_facet.hpp"
#include "ties/tie_checks.hpp"

namespace mortise {
namespace {

/// Facets of which some node that may carry a multiplier does: a corner, or of quadratic facets a mid-side node. Collective.
SurfaceFacets with_multipliers(const RCP<const Map>& owned_nodes, int dimension, const SurfaceFacets& facets, const std::vector<char>& without) {
  const NodeMarks marks(owned_nodes, facets, without);
  SurfaceFacets kept;
  for (const SurfaceFacet& facet : facets) {
    const std::size_t corners = facet_corners(dimension, facet.size()), first = facet.size() > corners ? corners : 0;
    if (std::any_of(facet.begin() + static_cast<std::ptrdiff_t>(first), facet.end(), [&](GlobalOrdinal node) { return marks[node] == 0; }))
      kept.push_back(facet);
  }
  return kept;
}

bool is_empty(const Communicator& comm, const SurfaceFacets& facets) {
  const int mine = facets.empty() ? 0 : 1;
  int any = 0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(any));
  return any == 0;
}

RCP<MultiVector> marks_of(const RCP<const Map>& owned_nodes, std::size_t dimension, const std::vector<char>& without) {
  const auto marks = rcp(new MultiVector(owned_nodes, dimension));
  const auto view = marks->getLocalViewHost(Tpetra::Access::ReadWrite);
  for (std::size_t node = 0; node < without.size(); ++node)
    for (std::size_t i = 0; without[node] != 0 && i < dimension; ++i) view(node, i) = crosspoint_mark;
  return marks;
}

struct Integrated {
  std::unique_ptr<MortarInterface> interface;
  std::vector<FacetCoupling> couplings;
  std::vector<NodalNormal> normals;
};

/// Collective.
Integrated integrate(const RCP<const Map>& owned_nodes, const RCP<const MultiVector>& reference, const TiedPair& tie, const SurfaceFacets& slave,
                     const std::vector<char>& without, const InterfaceMeasure& measure) {
  MortarOptions options;
  options.corners = CornerRule::averaged;
  options.search_reach = tie.tolerance;
  options.balance = std::numeric_limits<double>::infinity();  // it is integrated once: facets are not worth sending
  Integrated result;
  result.interface = std::make_unique<MortarInterface>(owned_nodes, reference, marks_of(owned_nodes, reference->getNumVectors(), without), slave,
                                                       tie.master, measure, options, tie.place);
  result.interface->search(*reference);
  const InterfacePattern& pattern = *result.interface->pattern();
  MultiVector positions(pattern.local_nodes, reference->getNumVectors());
  positions.doImport(*reference, *pattern.import, Tpetra::REPLACE);
  std::optional<StepFailure> failure;
  result.interface->evaluate(positions, false, result.couplings, result.normals, failure);
  std::vector<Diagnostic> diagnostics;
  if (failure) diagnostics.push_back({tie.place, failure->what()});
  throw_if_any(*owned_nodes->getComm(), diagnostics);
  return result;
}

/// "the nearest of them is node 5 at (0, 1), 0.3 away". Collective.
std::string nearest_node(const Integrated& of, const MultiVector& reference) {
  const Communicator& comm = *reference.getMap()->getComm();
  const std::vector<SlaveNode>& slaves = of.interface->slave_nodes();
  std::vector<std::size_t> all(slaves.size());
  std::vector<SpatialVector> normals;
  for (std::size_t s = 0; s < slaves.size(); ++s) {
    all[s] = s;
    normals.push_back(of.normals[s].normal);
  }
  const auto distances = of.interface->distances_to_master(reference, all, normals);
  double mine = std::numeric_limits<double>::max(), least = mine;
  std::size_t which = 0;
  for (std::size_t s = 0; s < distances.size(); ++s)
    if (distances[s] && std::abs(*distances[s]) < mine) {
      mine = std::abs(*distances[s]);
      which = s;
    }
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MIN, mine, Teuchos::outArg(least));
  if (least == std::numeric_limits<double>::max()) return "none of them has a master in front of it or behind it";
  std::vector<std::string> texts;
  if (mine == least) texts.push_back(fmt::format("the nearest node is {}, {:.3g} away", place_of_node(slaves[which], reference), mine));
  return first_text(comm, texts);
}

}  // namespace

TieInterface::TieInterface(const RCP<const Map>& owned_nodes, const RCP<const MultiVector>& reference, const TiedPair& tie,
                           const std::vector<char>& without, const InterfaceMeasure& measure) {
  const SurfaceFacets slave = with_multipliers(owned_nodes, static_cast<int>(reference->getNumVectors()), tie.slave, without);
  if (is_empty(*owned_nodes->getComm(), slave)) return;
  const Integrated of = integrate(owned_nodes, reference, tie, slave, without, measure);
  const std::vector<SlaveNode>& slaves = of.interface->slave_nodes();
  const Map& nodes = *of.interface->local_nodes();
  std::vector<std::map<GlobalOrdinal, double>> sums(slaves.size());  // -D_jk and M_jl; ordered, so that rows do not depend on ranks
  std::vector<double> D(slaves.size(), 0.0);
  for (const FacetCoupling& facet : of.couplings)
    for (std::size_t j = 0; j < facet.slave.size(); ++j) {
      const auto s = static_cast<std::size_t>(facet.slave[j]);
      if (s >= slaves.size() || !slaves[s].carries_multiplier) continue;
      const auto row = static_cast<Eigen::Index>(j);
      D[s] += facet.D(row, row);
      for (std::size_t k = 0; k < facet.slave.size(); ++k)
        if (const double d = facet.D(row, static_cast<Eigen::Index>(k)); k != j && d != 0.0) sums[s][nodes.getGlobalElement(facet.slave[k])] -= d;
      for (std::size_t l = 0; l < facet.master.size(); ++l)
        if (const double m = facet.M(row, static_cast<Eigen::Index>(l)); m != 0.0) sums[s][nodes.getGlobalElement(facet.master[l])] += m;
    }
  for (std::size_t s = 0; s < slaves.size(); ++s) {
    if (D[s] <= 0.0) continue;
    TieInterfaceRow& row = rows_.emplace_back();
    row.owned_node = slaves[s].owned_node;
    for (const auto& [node, sum] : sums[s]) row.sources.emplace_back(node, sum / D[s]);
  }
}

TieCover measure_cover(const RCP<const Map>& owned_nodes, const RCP<const MultiVector>& reference, const TiedPair& tie,
                       const InterfaceMeasure& measure) {
  const std::size_t count = local_id_count(*owned_nodes);
  const Integrated of = integrate(owned_nodes, reference, tie, tie.slave, std::vector<char>(count, 0), measure);
  const std::vector<SlaveNode>& slaves = of.interface->slave_nodes();
  TieCover cover{std::vector<char>(count, 0), std::vector<double>(count, 0.0), 0};
  for (const FacetCoupling& facet : of.couplings)
    for (std::size_t j = 0; j < facet.slave.size(); ++j) {
      const auto s = static_cast<std::size_t>(facet.slave[j]);
      if (s < slaves.size())
        cover.share[static_cast<std::size_t>(slaves[s].owned_node)] += facet.D.row(static_cast<Eigen::Index>(j)).sum() / slaves[s].weight;
    }
  GlobalOrdinal mine[2] = {0, 0}, all[2];
  for (const SlaveNode& slave : slaves) {
    const auto node = static_cast<std::size_t>(slave.owned_node);
    cover.on_slave[node] = 1;
    ++mine[cover.share[node] < least_tied_cover ? 0 : 1];
  }
  Teuchos::reduceAll(*owned_nodes->getComm(), Teuchos::REDUCE_SUM, 2, mine, all);
  cover.open = all[0];
  if (all[1] == 0)
    throw InputError(tie.place, fmt::format("tie \"{}\" holds nothing: no master facet covers {} % of a slave node within the tolerance {:.3g}; {}; "
                                            "please give a larger \"tolerance\", or other sides",
                                            tie.name, 100.0 * least_tied_cover, tie.tolerance, nearest_node(of, *reference)));
  return cover;
}

}  // namespace mortise
