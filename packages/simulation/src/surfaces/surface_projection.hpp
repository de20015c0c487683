#pragma once
// Projection of what the multipliers of a pair say onto the shape functions of its slave surface.

#include <functional>
#include <vector>

#include "mortise/contact/contact_system.hpp"
#include "mortise/core/types.hpp"
#include "mortise/solid/bodies.hpp"

namespace mortise {

/// q^ = sum_k N_k q^_k with  sum_l (integral of N_k N_l dA) q^_l = sum_j D_jk q_j: the L2 projection of the field sum_j phi_j q_j, phi_j the
/// functions of the multipliers. It acts on any continuous field as q_j do, and is of higher order than these at the nodes. Collective.
/// @param laws   of `contact`, at the displacement
/// @param value  q_j of the slave node with the index s in ContactSystem::slave_ids()
/// @return  q^_k [owned nodes]; 0 away from the slave surface
std::vector<double> projected_on_slave(const Bodies& bodies, const ContactSystem& contact, const ContactLaws& laws, const Vector& local_displacement,
                                       std::size_t pair, const std::function<double(std::size_t s)>& value);

}  // namespace mortise
