#pragma once
// Bodies that overlap although their pair carries no force.

#include <functional>
#include <string>
#include <vector>

#include "mortise/simulation/model/model.hpp"
#include "surfaces/body_surfaces.hpp"

namespace mortise {

/// Looks at converged states: weighted gaps are means, and may all be open while nodes of one surface lie within the other body.
class OverlapWatch {
 public:
  /// @param warn  called once for each pair, when the overlap is deeper than facets of an arc make contact begin late
  OverlapWatch(const Model& model, const Scene& scene, std::function<void(const std::string&)> warn);

  /// Collective. A solution: its bodies and its contact.
  void examine(const PlacedBodies& bodies, const ContactLaws& laws);
  /// The solution that was examined last is an accepted state.
  /// @param is_told  of a pair of the scene: a warning that says more has been given
  void accept(const std::function<bool(std::size_t)>& is_told);
  /// Pairs of the accepted state that carry no force although their bodies overlap; empty: none.
  const std::string& without_force() const { return accepted_; }
  /// Stores or restores what it knows of the accepted state and has said.
  void serialize(StateArchive& archive);

 private:
  /// An own node of a surface with the facets of that surface around it.
  struct SurfaceNode {
    LocalOrdinal node;
    std::vector<Side> around;
  };
  struct Surface {
    SidesOfBody sides;
    std::vector<SurfaceNode> nodes;
  };
  struct Pair {
    std::size_t index;  ///< of the scene and the contact system
    Surface slave, master;
    bool is_warned = false;
  };
  struct Found {
    std::size_t pair;
    bool is_deep;
    std::string text;
  };

  Surface surface(const SidesOfBody& sides) const;
  bool carries_force(const Pair& pair, const ContactLaws& laws) const;
  std::vector<SurfaceProbe> probes(const Surface& surface, const PlaceOfNode& at) const;
  double sagitta(const Surface& surface, const PlaceOfNode& at) const;

  const Model& model_;
  const Scene& scene_;
  std::function<void(const std::string&)> warn_;
  std::vector<Pair> pairs_;  ///< of two bodies each: a pair of the scene may have several
  std::vector<Found> found_;
  std::string accepted_;
};

}  // namespace mortise
