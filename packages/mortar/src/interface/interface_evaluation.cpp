#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <algorithm>

#include "distribution/coupling_message.hpp"
#include "interface/interface.hpp"

namespace mortise {

// Integrates one facet; how many segments its coupling is the sum of, 0 if there is none.
template <int dim>
std::size_t Interface<dim>::segments_of(SlaveFacetData& data, const std::vector<Facet<LocalOrdinal>>& candidates, const Positions<dim>& x,
                                        bool derivatives, FacetCoupling& coupling) {
  if (candidates.empty()) return 0;
  return integrator_.integrate(data, candidates, limits_of(data.nodes, x), x, derivatives, coupling) ? integrator_.segments() : 0;
}

// Couplings of this rank's facets, in their order, whoever integrates them: sums do not depend on that. Collective, after a failure too.
template <int dim>
void Interface<dim>::couple_facets(const Positions<dim>& x, bool derivatives, std::vector<NodalNormal>& normals,
                                   std::vector<FacetCoupling>& couplings, std::optional<StepFailure>& failure) {
  const bool master_normals = options_.corner_rule(dim) == CornerRule::master_normal;
  couplings.resize(slave.facets.size());
  guest_couplings_.resize(guests_.facets.size());
  segments_of_facet_.assign(slave.facets.size(), 0);
  segments_of_guest_.assign(guests_.facets.size(), 0);
  SlaveFacetData data;
  const auto goes_on = [this](const auto& numbers) {  // normals of the ends; on a line of symmetry the image goes on
    return dim == 2 && std::all_of(numbers.begin(), numbers.begin() + 2, [this](std::size_t n) {
             const std::size_t own = slave.stencils.size();
             const NormalStencil& stencil = n < own ? slave.stencils[n] : guests_.stencils[n - own];
             return stencil.facets.size() == 2 || is_projected(stencil);
           });
  };
  try {
    for (std::size_t f = 0; f < slave.facets.size() && !failure; ++f) {
      if (distribution_ && !distribution_->integrated_here(f)) continue;
      data.nodes = slave.facets[f];
      data.multipliers = &slave.multipliers[f];
      data.normals.clear();
      for (const LocalOrdinal normal : slave.normals[f]) data.normals.push_back(&normals[normal]);
      data.goes_on = goes_on(slave.normals[f]);
      data.at_corner = master_normals && slave.normals[f] != slave.facets[f];
      segments_of_facet_[f] = segments_of(data, candidates_[f], x, derivatives, couplings[f]);
    }
    for (std::size_t g = 0; g < guests_.facets.size() && !failure; ++g) {
      const GuestFacet& guest = guests_.facets[g];
      data.nodes = guest.nodes;
      data.multipliers = &guest.multipliers;
      data.normals.clear();
      for (const std::size_t normal : guest.normals) data.normals.push_back(&normals[normal]);
      data.goes_on = goes_on(guest.normals);
      data.at_corner = master_normals && guest.at_kink;
      segments_of_guest_[g] = segments_of(data, guest.candidates, x, derivatives, guest_couplings_[g]);
    }
  } catch (const StepFailure& one) {
    std::vector<std::string> nodes;
    for (const LocalOrdinal node : data.nodes)
      nodes.push_back(fmt::format("{}, now at ({:.6g})", local_nodes->getGlobalElement(node), fmt::join(x[node].data(), x[node].data() + dim, ", ")));
    failure = StepFailure(one.kind(), fmt::format("{} (slave facet of nodes {})", one.what(), fmt::join(nodes, "; ")));
  }
  load.facets = load.segments = 0;
  for (const auto* counts : {&segments_of_facet_, &segments_of_guest_})
    for (const std::size_t count : *counts) {
      load.facets += count > 0;
      load.segments += static_cast<long>(count);
    }
  counted_ = true;
  if (distribution_) pass_couplings(couplings);
  if (master_normals && !failure) settle_corners(derivatives, normals, couplings);
  segments.clear();
  for (std::size_t f = 0; f < couplings.size(); ++f)
    if (segments_of_facet_[f] > 0) {
      if (segments.size() != f) std::swap(couplings[segments.size()], couplings[f]);
      segments.push_back(segments_of_facet_[f]);
    }
  couplings.resize(segments.size());
}

// Couplings of facets go to the owners of their nodes. Collective.
template <int dim>
void Interface<dim>::pass_couplings(std::vector<FacetCoupling>& couplings) {
  const auto id = [&](LocalOrdinal node) { return local_nodes->getGlobalElement(node); };
  const auto local = [&](GlobalOrdinal node) { return local_nodes->getLocalElement(node); };
  const auto send = [&](const Facet<LocalOrdinal>& nodes, std::size_t segments, const FacetCoupling& coupling, const std::vector<int>& receivers) {
    CouplingHeader header{{}, segments};
    for (const LocalOrdinal node : nodes) header.slave.push_back(id(node));
    for (const int receiver : receivers) {
      if (receiver == owned_nodes_->getComm()->getRank()) continue;
      WordWriter to(distribution_->message_to(receiver));
      put_coupling(to, header, coupling, id);
    }
  };
  for (std::size_t f = 0; f < slave.facets.size(); ++f)
    if (distribution_->integrated_here(f)) send(slave.facets[f], segments_of_facet_[f], couplings[f], distribution_->receivers(f));
  for (std::size_t g = 0; g < guests_.facets.size(); ++g)
    send(guests_.facets[g].nodes, segments_of_guest_[g], guest_couplings_[g], guests_.facets[g].receivers);
  for (const Words& message : distribution_->exchange())
    for (WordReader from(message); !from.at_end();) {
      const CouplingHeader header = get_header(from);
      const std::size_t f = distribution_->facet_of(header.slave);
      segments_of_facet_[f] = header.segments;
      if (header.segments > 0) get_coupling(from, header, local, couplings[f]);
    }
}

template <int dim>
void Interface<dim>::evaluate(const MultiVector& x, bool derivatives, std::vector<FacetCoupling>& couplings, std::vector<NodalNormal>& normals,
                              std::optional<StepFailure>& failure) {
  const Positions<dim> positions = positions_of<dim>(x.getLocalViewHost(Tpetra::Access::ReadOnly));
  for (std::size_t n = 0; n < positions.size() && !failure; ++n)
    if (!positions[n].allFinite())
      failure = StepFailure(FailureKind::not_finite,
                            fmt::format("the position of node {} is not finite: ({:g})", local_nodes->getGlobalElement(static_cast<LocalOrdinal>(n)),
                                        fmt::join(positions[n].data(), positions[n].data() + dim, ", ")));
  normals.resize(slave.stencils.size() + guests_.stencils.size());
  for (std::size_t n = 0; n < normals.size(); ++n) {
    const NormalStencil& stencil = n < slave.stencils.size() ? slave.stencils[n] : guests_.stencils[n - slave.stencils.size()];
    if (average_normal(stencil, positions, derivatives, normals[n])) continue;
    normals[n] = NodalNormal();  // of an earlier evaluation, whose nodes had other numbers
    normals[n].normal = SpatialVector::Unit(dim, 0);
    if (derivatives) normals[n].derivative.setZero(dim, 0);
    if (!failure)
      failure = StepFailure(
          FailureKind::inverted_facet,
          fmt::format("the slave surface has no normal at node {}, now at ({:.6g}): a facet lost its {}, or facets folded onto one "
                      "another",
                      local_nodes->getGlobalElement(stencil.node),
                      fmt::join(positions[stencil.node].data(), positions[stencil.node].data() + dim, ", "), dim == 2 ? "length" : "area"));
  }
  if (derivatives && options_.linearisation == Linearisation::frozen_normals)
    for (NodalNormal& normal : normals) normal.derivative.setZero();
  if (options_.coupling->integrates_facets())
    couple_facets(positions, derivatives, normals, couplings, failure);
  else
    couplings.resize(couple_nodes(positions, derivatives, normals, couplings, failure));
  normals.resize(slave.owned.size());
}

template <int dim>
std::vector<GapCurvature> Interface<dim>::gap_curvatures(const MultiVector& x, const std::vector<double>& pressures) {
  std::vector<GapCurvature> curvatures;
  if constexpr (dim == 2) {
    const Positions<2> positions = positions_of<2>(x.getLocalViewHost(Tpetra::Access::ReadOnly));
    std::array<NodalNormal, most_facet_nodes<2>> normals;
    SlaveFacetData data;
    for (std::size_t f = 0; f < slave.facets.size(); ++f) {
      data.nodes = slave.facets[f];
      data.multipliers = &slave.multipliers[f];
      FacetVector of_nodes = FacetVector::Zero(static_cast<Eigen::Index>(data.nodes.size()));
      for (std::size_t a = 0; a < data.nodes.size(); ++a)
        if (const auto s = static_cast<std::size_t>(data.nodes[a]); s < pressures.size()) of_nodes[static_cast<Eigen::Index>(a)] = pressures[s];
      if (of_nodes.isZero(0.0)) continue;
      data.normals.clear();
      data.stencils.clear();
      for (std::size_t a = 0; a < data.nodes.size(); ++a) {
        data.stencils.push_back(&slave.stencils[slave.normals[f][a]]);
        average_normal(*data.stencils[a], positions, true, normals[a]);
        data.normals.push_back(&normals[a]);
      }
      GapCurvature one;
      if (integrator_.curve(data, candidates_[f], limits_of(data.nodes, positions), positions, of_nodes, one)) curvatures.push_back(std::move(one));
    }
  }
  return curvatures;
}

template std::size_t Interface<2>::segments_of(SlaveFacetData&, const std::vector<Facet<LocalOrdinal>>&, const Positions<2>&, bool, FacetCoupling&);
template std::vector<GapCurvature> Interface<2>::gap_curvatures(const MultiVector&, const std::vector<double>&);
template std::vector<GapCurvature> Interface<3>::gap_curvatures(const MultiVector&, const std::vector<double>&);
template void Interface<2>::evaluate(const MultiVector&, bool, std::vector<FacetCoupling>&, std::vector<NodalNormal>&, std::optional<StepFailure>&);
template void Interface<3>::evaluate(const MultiVector&, bool, std::vector<FacetCoupling>&, std::vector<NodalNormal>&, std::optional<StepFailure>&);

}  // namespace mortise
