#pragma once
// Reports on a pair at an iterate: states of its nodes, resultants, kinks, distribution of its integrals over the ranks.

#include <array>
#include <vector>

#include "mortise/contact/contact_evaluation.hpp"
#include "mortise/mortar/coupling.hpp"

namespace mortise {

/// State of an owned slave node after a solve.
struct ContactNodeState {
  GlobalOrdinal node = 0;                   ///< of the model
  LocalOrdinal owned_node = 0;              ///< local index in the map of owned nodes
  std::array<double, 3> traction{};         ///< multiplier z (compression positive along the normal), force per area; third component 0 in 2D
  std::array<double, 3> normal{};           ///< unit normal n of the slave
  double pressure = 0.0;                    ///< z . n
  double gap = 0.0;                         ///< weighted gap / A_j
  double weight = 0.0;                      ///< A_j
  bool carries = true;                      ///< false: it has no multiplier, others act in its place
  bool closed = false;                      ///< its state is not open
  ContactState state = ContactState::open;  ///< open, stick or slip
  double covered = 0.0;                     ///< sum_k D_jk: the force on the slave side is -covered * traction
  double shear = 0.0;                       ///< z . tau, tau = n turned by +90 degrees; in 3D |z - (z . n) n|
  double shear_bound = 0.0;                 ///< rho, of closed nodes; friction only
  double slip = 0.0;                        ///< along tau, in 3D its size, since the start of the step [length]; friction only
  double slip_path = 0.0;                   ///< |slip| summed over the accepted steps [length]; friction only
  std::array<double, 3>
      force{};  ///< the force of this node's multiplier on the slave side is -force: sum_k D_jk z_j, with variational mortar that of the gap
};

/// Distribution of the integrals of a pair over the ranks in the last evaluation; of both passes if there are two.
struct IntegrationLoad {
  long facets = 0;                  ///< slave facets that overlap a master facet, over all ranks
  long segments = 0;                ///< their overlaps
  double imbalance = 1.0;           ///< largest over mean number of segments of a rank
  double imbalance_as_owned = 1.0;  ///< the same at the last search, had every facet stayed with an owner of its nodes
  int redistributions = 0;          ///< searches that gave facets to other ranks
};

/// Kinks of a pair's slave surfaces, and what gives them their normals.
struct CornerReport {
  long kinks = 0;                          ///< over all ranks
  CornerRule rule = CornerRule::averaged;  ///< the one that acts
  bool as_asked = true;                    ///< the rule is the pair's option; false: something else of the pair calls for this one
};

/// Sides on which the master stands, as the slave nodes of a pair see it, over all ranks.
struct FacetOrientation {
  long facing = 0;  ///< nodes with a master facet within reach along their normals that faces them
  long turned = 0;  ///< others with a master facet within reach that faces away
  /// Surfaces of bodies that can meet have few turned ones, as where a thin body stands behind its own surface.
  bool is_inside_out() const { return turned > facing; }
};
/// Collective. For a check by hosts, once at the start: facets of one surface that are given inside out never touch.
FacetOrientation facet_orientation(const ContactEvaluation& evaluation, std::size_t pair);

/// States of the owned slave nodes of a pair. The slip path includes the slip of the step. A node without multiplier has the mean traction of the
/// multipliers that act at it, and is closed if most of them are. Collective.
std::vector<ContactNodeState> node_states(const ContactLaws& laws, std::size_t pair);
/// Depth by which the surfaces of a pair may overlap without touching: the overlap that its history allows, and its largest clearance above 0
/// [length]. Collective.
double allowed_overlap(const ContactLaws& laws, std::size_t pair);
/// Resultant (over all ranks) of the contact forces on the slave side of a pair, of both passes if there are two. Collective.
std::array<double, 3> resultant(const ContactLaws& laws, std::size_t pair);
/// Collective.
CornerReport corners(const ContactEvaluation& evaluation, std::size_t pair);

}  // namespace mortise
