#pragma once
// Bodies that have passed through one another where contact does not see it.

#include "mortise/simulation/model/model.hpp"
#include "surfaces/body_surfaces.hpp"

namespace mortise {

/// Looks at converged states before they are accepted. Contact acts within the search reach; the surfaces of the bodies tell what went past it,
/// however slowly and from whichever side.
class ContactWatch {
 public:
  ContactWatch(const Model& model, const Scene& scene);

  /// Collective. Bodies and contact at one state.
  /// @throws StepFailure (lost_contact) on every rank if
  ///   - a slave node that no master facet covers lies within the master's body, farther behind its surface than the reach;
  ///   - most of the slave lies within that body;
  ///   - a rigid master lies within the slave's body, entered through its back; or
  ///   - no facet of a rigid master faces the slave any more and most of the slave sees its back.
  void examine(const PlacedBodies& bodies, const ContactLaws& laws) const;

 private:
  struct Pair {
    std::size_t index;  ///< of the scene and the contact system
    const SideSet &slave, &master;
    std::size_t slave_body, master_body;
    double reach;    ///< beyond which what is not covered is not seen
    bool is_frozen;  ///< its couplings are those of the reference configuration
  };

  std::vector<char> covered(const Pair& pair, const ContactLaws& laws) const;  ///< [local nodes]

  const Model& model_;
  const Scene& scene_;
  std::vector<SidesOfBody> sides_;  ///< that pairs refer to
  std::vector<Pair> pairs_;         ///< of two bodies each: a pair of the scene may have several
  Import to_local_nodes_;
};

}  // namespace mortise
