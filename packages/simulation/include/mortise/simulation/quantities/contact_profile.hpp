#pragma once
// Contact along the arc length of a slave surface.

#include <string>
#include <vector>

#include "mortise/contact/complementarity.hpp"
#include "mortise/simulation/quantities/fields.hpp"
#include "mortise/simulation/quantities/quantity.hpp"

namespace mortise {

/// A slave node on its surface, where the geometry of its pair is (current or reference configuration).
struct ProfilePoint {
  int part = 0;             ///< piece of the surface, counted from 0
  double arc_length = 0.0;  ///< from the start of the piece [length]
  double x = 0.0, y = 0.0;
  double pressure = 0.0, shear = 0.0;  ///< z . n and z . tau, tau = n turned by +90 degrees [stress]
  double gap = 0.0;                    ///< weighted gap over weight [length]
  ContactState state = ContactState::open;
};

/// The nodes of a pair's slave surface in the direction of travel (the body on the left), piece after piece. An open piece starts at the node that no
/// facet leads to; open pieces come in the order of these nodes' ids. A closed piece starts at its node of the lowest id and ends before it. Only
/// rank 0 holds the order.
class ContactProfile {
 public:
  /// Collective. `pair` is the pair's index.
  ContactProfile(const Mesh& mesh, const PairSurfaces& surfaces, std::size_t pair);

  /// The points in order on rank 0, nothing elsewhere. Collective; the contact was last evaluated at the state's displacement.
  std::vector<ProfilePoint> points(const FieldState& state) const;

 private:
  std::size_t pair_;
  std::vector<int> parts_;    ///< [nodes in order]
  RCP<const Import> import_;  ///< from the owned nodes to the nodes in order
};

}  // namespace mortise
