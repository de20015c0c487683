#pragma once
// The third stage of a model: its contact.

#include <memory>
#include <vector>

#include "model/stages/solid_model.hpp"
#include "mortise/contact/contact_system.hpp"
#include "mortise/simulation/model/surfaces_at_start.hpp"

namespace mortise {

class EdgeContact;

/// Contact, how its surfaces lie, and what it alone holds.
struct ContactModel {
  SurfacesAtStart at_start;
  std::vector<std::vector<int>> bodies_of_pairs;
  std::vector<char> held_by_contact_only;  ///< [mesh.bodies]; of a stabilised scene those that nothing but contact holds, or nothing
  std::shared_ptr<EdgeContact> edges;
  std::shared_ptr<ContactSystem> system;
};

/// Pairs of the scene, then their second passes. Collective.
std::vector<ContactPair> make_pairs(const MeshedScene& meshed, const Bodies& bodies, const Scene& scene, Collector& collect);

/// Collective. Throws InputError, on all ranks, for surfaces that cannot lie as they do and for bodies that nothing holds.
ContactModel make_contact(const MeshedScene& meshed, const SolidModel& solid, const Scene& scene, std::vector<ContactPair> pairs,
                          const Timers& timers);

}  // namespace mortise
