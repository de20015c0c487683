#pragma once
// Corners of one surface that lie in facets of the other, where weighted gaps do not see them.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mortise/simulation/model/model.hpp"
#include "surfaces/body_surfaces.hpp"

namespace mortise {

/// Looks at converged states. A weighted gap is a mean: it stays open while a corner of the master lies within a slave facet. With standard weights
/// it also stays open while a corner of the slave lies within the master.
class CornerWatch {
 public:
  /// @param warn  called once for each pair
  CornerWatch(const Model& model, const Scene& scene, std::function<void(const std::string&)> warn);

  /// Collective. A solution: its bodies and its contact.
  void examine(const PlacedBodies& bodies, const ContactLaws& laws);
  /// The solution that was examined last is an accepted state.
  void accept();
  /// True if a warning of this pair of the scene has been given.
  bool has_warned(std::size_t pair) const;
  /// Corners of the accepted state that lie in the other body where the slave carries no force; empty: none.
  const std::string& without_force() const { return accepted_; }
  /// Stores or restores what it knows of the accepted state and has said.
  void serialize(StateArchive& archive);

 private:
  /// A node that may be a corner, with the facets around it: those of its pair's surface, and of its body.
  struct Candidate {
    LocalOrdinal node;
    std::vector<Side> of_pair, around;
  };
  struct Corner {
    SurfaceProbe probe;
    const Candidate* candidate;
  };
  struct Pair {
    std::size_t index;  ///< of the scene and the contact system
    const SideSet& slave;
    std::size_t slave_body, master_body;
    RCP<const Map> facets;  ///< of the slave, one to one: their numbers are tags
    const SideSet& master;
    std::vector<Candidate> of_master, of_slave;  ///< the latter with standard weights alone
    bool is_warned = false;
  };
  struct Found {
    std::size_t pair;
    bool carries;
    std::string text;
  };

  std::vector<Candidate> candidates(const SideSet& set, std::size_t body) const;
  std::vector<Corner> corners(const std::vector<Candidate>& candidates, const PlacedBodies& bodies, const Box3& other_box) const;
  std::optional<Found> deepest_of_master(std::size_t p, const std::vector<Corner>& corners, const PlacedBodies& bodies,
                                         const ContactLaws& laws) const;
  std::optional<Found> deepest_of_slave(std::size_t p, const std::vector<Corner>& corners, const PlacedBodies& bodies, const ContactLaws& laws) const;
  static std::vector<SurfaceProbe> probes_of(const std::vector<Corner>& corners);
  std::vector<char> closed(const Pair& pair, const ContactLaws& laws) const;  ///< [local nodes]

  const Model& model_;
  const Scene& scene_;
  std::function<void(const std::string&)> warn_;
  std::vector<SidesOfBody> sides_;  ///< that pairs refer to
  std::vector<Pair> pairs_;         ///< of two bodies each: a pair of the scene may have several
  std::vector<Found> found_;
  std::string accepted_;
};

}  // namespace mortise
