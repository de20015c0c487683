#pragma once
// Averaged normals of the slave nodes.

#include <array>
#include <optional>
#include <vector>

#include "geometry/facet_geometry.hpp"
#include "mortise/mortar/mortar_interface.hpp"

namespace mortise {

/// Tangents of a facet at one of its nodes, constant combinations of its nodes' positions:  t_i = sum_b slope(i, b) x_b.
struct NodeTangents {
  Facet<LocalOrdinal> nodes;                                                            ///< those that the tangents depend on
  Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::ColMajor, 2, most_side_nodes> slope;  ///< [dim - 1, rows beyond without use, x nodes]
};

/// Those at the node with the place `a`: to its neighbours along the edges, of quadratic facets dx/dxi_i.
template <int dim>
NodeTangents tangents_at(const Facet<LocalOrdinal>& facet, std::size_t a);

/// Facets that shape the normal of a node: its slave facets, by indices into positions.
struct NormalStencil {
  LocalOrdinal node = 0;
  std::vector<NodeTangents> facets;
  std::vector<LocalOrdinal> columns;  ///< the nodes of all of them, without repeats
  std::array<bool, 3> projected{};    ///< components without a free direction, taken out of the average
  std::optional<std::size_t> only;    ///< the one of the facets that shapes the normal alone, at a kink in 2D; none: all do
};

/// True if the node lies on a line or plane of symmetry, or is held aside.
inline bool is_projected(const NormalStencil& stencil) { return stencil.projected[0] || stencil.projected[1] || stencil.projected[2]; }

/// The stencil of a facet's own normal at one of its nodes.
NormalStencil own_side(LocalOrdinal node, const NodeTangents& facet);

/// The angle by which a plane surface turns at a node, positive where it is convex. 0 at its ends and at nodes with projected components.
double turn_at(const NormalStencil& stencil, const Positions<2>& x);

/// The angle by which a plane surface and its mirror image turn at a node on a line of symmetry, positive where they are convex. One component is
/// projected out there, and one facet ends. 0 at other nodes.
double mirrored_turn_at(const NormalStencil& stencil, const Positions<2>& x);

/// The largest angle by which a surface in 3D turns at an edge of the node, less the largest by which it turns the other way. Positive where it is
/// convex. With projected components the edges between facets and their mirror images count too.
double turn_at(const NormalStencil& stencil, const Positions<3>& x);

/// Normalised sum of the unit normals of the node's facets at the node, without the `projected` components. Both dimensions:
///   s = P sum_e n_e,  n = s / |s|,   dn = (I - n n^T) P sum_e dn_e / |s|.
/// In 2D, with R the turn by -90 degrees:  n_e = (t_y, -t_x) / |t|,   dn_e = R (I - t t^T / |t|^2) dt / |t|.
/// In 3D:  n_e = c / |c|, c = t_1 x t_2,   dn_e = (I - n_e n_e^T) dc / |c|.
/// Returns false where a facet has no normal or the average does not point out of each of them (then `normal` is not meant to be used).
bool average_normal(const NormalStencil& stencil, const Positions<2>& x, bool derivatives, NodalNormal& result);
bool average_normal(const NormalStencil& stencil, const Positions<3>& x, bool derivatives, NodalNormal& result);

/// Adds the second derivatives of `along` . n, in 2D, to a matrix of the positions of `columns`, two for each. The columns hold those of the stencil.
/// The normal n = (sin theta, -cos theta) lies at the mean of its sides' angles theta_e. Let b = dn/dtheta, t be the unit tangents and v their left
/// normals. Then, with d2theta_e in the tangent t_e,
///   d2(along . n) = -(along . n) (dtheta)^2 + (along . b) mean_e d2theta_e,   d2theta_e = -(t v^T + v t^T) / |t_e|^2.
/// With projected components n does not turn.
/// @param normal  with its derivative
void add_normal_curvature(const NormalStencil& stencil, const NodalNormal& normal, const Eigen::Vector2d& along, const Positions<2>& x,
                          const std::vector<LocalOrdinal>& columns, Eigen::MatrixXd& hessian);

}  // namespace mortise
