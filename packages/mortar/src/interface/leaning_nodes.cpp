// Slave nodes with prescribed components whose normals lean over along them.
//
// Where a component of a node is prescribed the surface may end at a plane of symmetry. The average of the facet's normal and of that of its mirror
// image lies along the plane. Or it may end at a support, as a hub on a cone that stands on a table: its normal leans over, and so does its pressure.
// The prescribed components do not tell. But on a smooth surface that goes on beyond the plane of symmetry the lean is that of half a facet, and a
// facet on it is three times that. And on a master without a lean, as a wedge's tip on a flat face, the pressure has none. A component stays in the
// average under two conditions. The averaged normal at the next nodes leans to the same side, at most a quarter more. The master's facets that the
// plane meets lean too, by half as much or more. This is decided once, in the reference configuration.

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <algorithm>
#include <cmath>

#include "exchange/exchange.hpp"
#include "interface/interface.hpp"

namespace mortise {
namespace {

constexpr double no_lean = 1e-3;  ///< lean of an irregular mesh of curved facets at a plane of symmetry; it carries as much of the pressure
constexpr double on_the_plane = 1e-6, of_round_off = 1e-9;
constexpr double bends = 1.25;        ///< lean at the next nodes, over that of the node, from which on the surface is smooth
constexpr double master_leans = 0.5;  ///< lean of the master, over that of the node, from which on they lie on one another

/// Of positions: component i is `at`.
struct HeldPlane {
  int component = 0;
  double at = 0.0;
};

struct LeaningNode {
  std::size_t node = 0;
  HeldPlane plane;
  double lean = 0.0;
};

NormalStencil whole(const NormalStencil& stencil) {
  NormalStencil result = stencil;
  result.projected = {};
  return result;
}

// Components of an owned node along which its surface leans, and does not bend.
template <int dim>
void add_leaning(const SlaveSurface& slave, std::size_t node, const Positions<dim>& x, std::vector<LeaningNode>& found) {
  const NormalStencil& stencil = slave.stencils[node];
  NodalNormal normal;
  if (!is_projected(stencil) || !average_normal(whole(stencil), x, false, normal)) return;
  for (int i = 0; i < dim; ++i) {
    const double lean = normal.normal[i];
    if (!stencil.projected[i] || !(std::abs(lean) > no_lean)) continue;
    bool any = false;
    double next = 0.0, least = bends;
    for (const LocalOrdinal other : stencil.columns) {
      const double length = (x[other] - x[node]).norm();
      if (static_cast<std::size_t>(other) >= slave.nodes_with_normal || std::abs(x[other][i] - x[node][i]) <= on_the_plane * length) continue;
      NodalNormal of_other;
      if (!average_normal(whole(slave.stencils[other]), x, false, of_other)) continue;
      any = true;
      next = std::max(next, of_other.normal[i] / lean);
      least = std::min(least, of_other.normal[i] / lean);
    }
    if (any && least > 0.0 && next < bends) found.push_back({node, {i, x[node][i]}, std::abs(lean)});
  }
}

Eigen::Vector2d across(const FacetPoints<2>& x) { return {x[1].y() - x[0].y(), x[0].x() - x[1].x()}; }
Eigen::Vector3d across(const FacetPoints<3>& x) { return (x[1] - x[0]).cross(x[2] - x[0]); }

/// The planes of all ranks, each once.
std::vector<HeldPlane> planes_of_all(const Communicator& comm, const std::vector<LeaningNode>& mine, double tolerance) {
  std::vector<HeldPlane> own;
  for (const LeaningNode& one : mine) own.push_back(one.plane);
  const auto thin_out = [&](std::vector<HeldPlane>& planes) {
    std::sort(planes.begin(), planes.end(),
              [](const HeldPlane& a, const HeldPlane& b) { return a.component != b.component ? a.component < b.component : a.at < b.at; });
    planes.erase(std::unique(planes.begin(), planes.end(),
                             [&](const HeldPlane& a, const HeldPlane& b) { return a.component == b.component && b.at - a.at <= tolerance; }),
                 planes.end());
  };
  thin_out(own);
  std::vector<HeldPlane> all;
  for (const auto& part : all_to_all(comm, std::vector<std::vector<HeldPlane>>(static_cast<std::size_t>(comm.getSize()), own)))
    all.insert(all.end(), part.begin(), part.end());
  thin_out(all);
  return all;
}

}  // namespace

template <int dim>
void Interface<dim>::release_leaning_nodes(const MultiVector& reference) {
  const Communicator& comm = *owned_nodes_->getComm();
  const Positions<dim> x = (*slave_positions_)(reference);
  std::vector<LeaningNode> leaning;
  for (std::size_t s = 0; s < slave.owned.size(); ++s) add_leaning<dim>(slave, s, x, leaning);
  int any = 0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, leaning.empty() ? 0 : 1, Teuchos::outArg(any));
  if (any == 0) return;
  const double tolerance = of_round_off * longest;
  const std::vector<HeldPlane> planes = planes_of_all(comm, leaning, tolerance);
  std::vector<double> mine(planes.size(), 0.0), lean(planes.size(), 0.0);
  for (const PlacedFacet<dim>& facet : place_master(reference)) {
    const FacetPoints<dim> points = facet.points();
    const auto normal = across(points).normalized().eval();
    for (std::size_t p = 0; p < planes.size(); ++p) {
      const int i = planes[p].component;
      const auto [low, high] = std::minmax_element(points.begin(), points.end(), [&](const auto& a, const auto& b) { return a[i] < b[i]; });
      if ((*low)[i] <= planes[p].at + tolerance && (*high)[i] >= planes[p].at - tolerance) mine[p] = std::max(mine[p], std::abs(normal[i]));
    }
  }
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, static_cast<int>(mine.size()), mine.data(), lean.data());
  MultiVector released(owned_nodes_, static_cast<std::size_t>(dim));
  for (const LeaningNode& one : leaning) {
    const auto plane = std::find_if(planes.begin(), planes.end(), [&](const HeldPlane& of_all) {
      return of_all.component == one.plane.component && std::abs(of_all.at - one.plane.at) <= tolerance;
    });
    if (plane == planes.end() || lean[static_cast<std::size_t>(plane - planes.begin())] < master_leans * one.lean) continue;
    released.replaceLocalValue(slave.owned[one.node].owned_node, static_cast<std::size_t>(one.plane.component), 1.0);
  }
  const Positions<dim> marks = (*slave_positions_)(released);
  for (std::size_t n = 0; n < slave.nodes_with_normal; ++n)
    for (int i = 0; i < dim; ++i)
      if (marks[n][i] != 0.0) slave.stencils[n].projected[i] = false;
}

template void Interface<2>::release_leaning_nodes(const MultiVector&);
template void Interface<3>::release_leaning_nodes(const MultiVector&);

}  // namespace mortise
