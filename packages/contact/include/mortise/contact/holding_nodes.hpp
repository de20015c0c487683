#pragma once
// Nodes by which contact holds bodies at an iterate, or could hold them, and the shear that friction bears where it slips.

#include <array>
#include <vector>

#include "mortise/contact/contact_evaluation.hpp"

namespace mortise {

/// A direction in which a closed slave node holds bodies to one another, as what a traction along it does to each of them. Rigid motions that do no
/// work against any of these forces are not held by contact.
struct HoldingRow {
  /// On the nodes of one body, over the largest coefficient c_jm of the slave node: no unit. In 2D the moment has its third component alone.
  struct Wrench {
    int body = 0;                    ///< its number, as `places` of holding_rows() says it
    std::array<double, 3> force{};   ///< sum of the forces
    std::array<double, 3> moment{};  ///< about the point of the body that `places` refers to
  };
  std::size_t pair = 0;        ///< its contact pair
  bool along_surface = false;  ///< a tangent of a node that sticks; else the normal
  std::vector<Wrench> bodies;  ///< all that the node touches
};

/// A closed slave node that slips against friction: the shear traction rho y / |y| at y = z_tau + c_t u.
struct SlidingNode {
  std::size_t pair = 0;                         ///< its contact pair
  LocalOrdinal multiplier = 0;                  ///< local index of the first component of its z
  std::vector<std::array<double, 3>> tangents;  ///< tau_a: one in 2D, two in 3D; third component 0 in 2D
  double bound = 0.0;                           ///< rho, above 0
  double stiffness = 0.0;                       ///< c_t
  double weight = 0.0;                          ///< sum_k D_jk: u / weight is a length
  std::vector<double> slip;                     ///< [tangents] weighted slip u of the step
  /// [tangents] What a unit traction along tau_a does to each body: forces are areas. A rigid motion changes u_a by its work on them.
  std::vector<std::vector<HoldingRow::Wrench>> along;
};

/// A covered slave node that bears pressure, or would if it closed.
struct BearingNode {
  std::size_t pair = 0;         ///< its contact pair
  std::size_t slave = 0;        ///< its place among the owned slave nodes of the pair
  LocalOrdinal owned_node = 0;  ///< local index in the map of owned nodes
  bool closed = false;          ///< its state; open: it may close
  double gap = 0.0;             ///< distance to where it bears pressure, in the mean [length]
  double near = 0.0;            ///< the gap up to which an open node counts as about to close: 0.1 h
  double friction = 0.0;        ///< |z_tau| <= friction z_n whatever z_n; infinite: the law gives no such bound
  /// Effect of a unit pressure on each body, as f_c: forces on bodies are its negative.
  std::vector<HoldingRow::Wrench> normal;
  /// [tangents that may bear shear] What a unit traction along tau_a does to each body; empty without friction.
  std::vector<std::vector<HoldingRow::Wrench>> along;
};

/// Meaning of a node that holds.
enum class Holds {
  /// Forces of contact work on the motion: along the normals of closed nodes, and the tangents of those that stick.
  by_forces,
  /// Conditions of contact forbid the motion, or friction bears a load along it: it changes the gap of a closed node, or goes along its tangents,
  /// also
  /// if it slips. Normals that lean, as those of strained facets do, hold nothing along a plane. Laws of an evaluation with derivatives.
  by_conditions
};
/// Directions in which the owned slave nodes of all pairs hold. They are the normal of each closed node, and with friction the tangents along which
/// it may bear shear. Collective.
/// @param places  [owned nodes x 1 + dim] the body that a node counts for, below 0: none. The other columns are its position, in any unit, relative
///                to the point of the body that moments are taken about
std::vector<HoldingRow> holding_rows(const ContactLaws& laws, const MultiVector& places, Holds holds = Holds::by_forces);
/// Of the owned slave nodes of all pairs with friction that is not regularised; those that bear shear freely, without a fixed component. `places` as
/// above. Collective.
std::vector<SlidingNode> sliding_nodes(const ContactLaws& laws, const MultiVector& places);
/// Open nodes that count among those that may bear something.
enum class OpenNodes {
  near,    ///< whose gap is no larger than BearingNode::near
  covered  ///< all that stand before a master within the search reach
};
/// Of the owned slave nodes of all pairs those that are closed, and some that are open. `places` as above. Collective.
std::vector<BearingNode> bearing_nodes(const ContactLaws& laws, const MultiVector& places, OpenNodes open = OpenNodes::near);
/// Gives an open node a guess of its multiplier with which it is closed, at a pressure that no result can see: z_n = max(0, c_n g) + 1e-6 E.
/// @param slides  whether it starts as one that slips without a bound: a body then comes along the surface until it touches, where the normals of
///                closed nodes hold it. Nodes with prescribed components stick all the same
void guess_closed(const ContactLaws& laws, const BearingNode& node, Vector& z, bool slides = false);

}  // namespace mortise
