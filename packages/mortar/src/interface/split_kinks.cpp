// Kinks of the slave surface: corners in 2D, in 3D nodes on edges and at their ends.
//
// Where two facets meet at an angle, the average n of their normals belongs to neither. Let one of them lie flat on the master, and let the other
// stand off by the angle theta. Along a field that turns from n to the next node's normal, the gap of the facet that stands off is not linear. It is
//   g(xi) = height(xi) / cos(angle of n(xi) to the master's normal).
// The integral of phi_j g of the closed node is to see the gap at that node alone. It gets a share of what lies away from it, of the size of the
// facet. And the node's pressure leans over by theta / 2.
//
// With the facet's own normal at both ends the gap is linear, and so are the positions of the projected points. Then int phi_j g = g_j int phi_j. So
// it is with positions, and the forces' moment. The facet that stands off only gives the node its weight, until its other end comes to the master.
// The node's own normal is the master's, see settle_corners.cpp; or that of the facet that is nearest to the master, in the mean.
//
// The set of kinks, and the nearest facet, jump. So they are chosen between steps only, and with hysteresis. A corner that folds onto the
// master stays split until it is almost flat, since by the average its pressure would lean over again.
//
// In 3D the kinks are those of the undeformed surface. Around a deep punch a coarse smooth surface bends by more than 30 degrees as well. Split
// there, facets that are hardly covered stand steep to the master, and Newton's method does not converge.

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <algorithm>
#include <boost/math/constants/constants.hpp>

#include "interface/interface.hpp"

namespace mortise {
namespace {

/// Angles above which a convex node becomes a kink, and stays one. A circle of twelve facets or more has none: where facets stand for an arc, as a
/// disk that rolls, the averaged normals are the nearer ones.
constexpr double sharp = 30.0 * boost::math::double_constants::degree, flat = 5.0 * boost::math::double_constants::degree;

// On a line of symmetry the master's normal is that line, on which half of the corner is seen.
double turn_of_corner(CornerRule rule, const NormalStencil& stencil, const Positions<2>& x) {
  return rule == CornerRule::master_normal && is_projected(stencil) ? mirrored_turn_at(stencil, x) : turn_at(stencil, x);
}

double turn_of_corner(CornerRule, const NormalStencil& stencil, const Positions<3>& x) { return turn_at(stencil, x); }

}  // namespace

template <int dim>
SurfaceKinks Interface<dim>::find_kinks(const MultiVector& x, const std::vector<Facet<LocalOrdinal>>& nearest, const SurfaceKinks& before) {
  const Positions<dim> positions = (*slave_positions_)(x);
  const CornerRule rule = options_.corner_rule(dim);
  const bool is_first = before.is_kink.empty();
  SurfaceKinks kinks = before;
  kinks.is_kink.resize(slave.nodes_with_normal, 0);
  kinks.takes_normal_of.assign(kinks.is_kink.size(), std::nullopt);
  for (std::size_t n = 0; n < kinks.is_kink.size(); ++n) {
    const NormalStencil& stencil = slave.stencils[n];
    char& is_kink = kinks.is_kink[n];
    is_kink = (dim == 2 || is_first || is_kink) && turn_of_corner(rule, stencil, positions) > (is_kink ? flat : sharp);
    for (std::size_t e = 0; e < stencil.facets.size(); ++e)
      if (is_kink && rule == CornerRule::nearest_facet && n < nearest.size() && stencil.facets[e].nodes == nearest[n]) kinks.takes_normal_of[n] = e;
  }
  return kinks;
}

template <int dim>
bool Interface<dim>::set_kinks(const SurfaceKinks& chosen) {
  SurfaceKinks kinks = chosen;  // none are chosen at first
  kinks.is_kink.resize(slave.nodes_with_normal, 0);
  kinks.takes_normal_of.resize(slave.nodes_with_normal);
  int any = 0;
  Teuchos::reduceAll(*owned_nodes_->getComm(), Teuchos::REDUCE_MAX, static_cast<int>(!(kinks == kinks_)), Teuchos::outArg(any));
  if (any == 0) return false;
  kinks_ = kinks;
  const auto is_kink = [&](LocalOrdinal node) { return kinks_.is_kink[node] != 0; };
  for (std::size_t n = 0; n < slave.nodes_with_normal; ++n) slave.stencils[n].only = kinks_.takes_normal_of[n];
  slave.stencils.resize(slave.nodes_with_normal);
  for (std::size_t f = 0; f < slave.facets.size(); ++f) {
    const Facet<LocalOrdinal>& facet = slave.facets[f];
    slave.normals[f] = facet;
    if (std::none_of(facet.begin(), facet.end(), is_kink)) continue;
    for (std::size_t a = 0; a < facet.size(); ++a) {
      if (is_projected(slave.stencils[facet[a]]) && !is_kink(facet[a])) continue;
      slave.normals[f][a] = static_cast<LocalOrdinal>(slave.stencils.size());
      slave.stencils.push_back(own_side(facet[a], tangents_at<dim>(facet, a)));
    }
  }
  searched_at_ = Teuchos::null;  // other normals, other candidates
  return true;
}

template <int dim>
long Interface<dim>::kinks(const MultiVector& x) {
  const Positions<dim> positions = (*slave_positions_)(x);
  const CornerRule rule = options_.corner_rule(dim);
  return std::count_if(slave.stencils.begin(), slave.stencils.begin() + static_cast<std::ptrdiff_t>(slave.owned.size()),
                       [&](const NormalStencil& stencil) { return turn_of_corner(rule, stencil, positions) > sharp; });
}

template SurfaceKinks Interface<2>::find_kinks(const MultiVector&, const std::vector<Facet<LocalOrdinal>>&, const SurfaceKinks&);
template SurfaceKinks Interface<3>::find_kinks(const MultiVector&, const std::vector<Facet<LocalOrdinal>>&, const SurfaceKinks&);
template bool Interface<2>::set_kinks(const SurfaceKinks&);
template bool Interface<3>::set_kinks(const SurfaceKinks&);
template long Interface<2>::kinks(const MultiVector&);
template long Interface<3>::kinks(const MultiVector&);

}  // namespace mortise
