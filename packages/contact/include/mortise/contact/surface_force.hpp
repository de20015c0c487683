#pragma once
// Force of a pair along its surfaces, against the most that its law of friction lets it bear.

#include "mortise/contact/contact_evaluation.hpp"

namespace mortise {

/// Over all ranks.
struct SurfaceForce {
  double along = 0.0;    ///< size of the sum of what the forces of slave nodes have along the master that they cover
  double allowed = 0.0;  ///< the most that friction bears at these nodes, rho_j sum_k D_jk; no sum of what it bears is larger
  double lean = 0.0;     ///< by which the normals of the nodes lean from the master's, in the mean over their normal forces [radians]
};

/// Forces of slave nodes along a master that is flat where the node covers it, |sum_j f_j - (f_j . e_j) e_j|. Other nodes count with their own
/// normals e_j = n_j, as if these did not lean. The master's normal e_j is the direction of sum_l dg_j/dx_l over the master's nodes: its motion along
/// itself changes no gap. Nothing of frozen geometry, nor where forces are the gaps' derivatives, which do not lean. Collective.
SurfaceForce surface_force(const ContactLaws& laws, std::size_t pair);

}  // namespace mortise
