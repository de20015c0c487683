#pragma once
// Corners of a master that lie in the middle of slave facets, where weighted gaps do not see them.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "body_surfaces.hpp"
#include "mortise/simulation/model.hpp"

namespace mortise {

/// Looks at converged states: a weighted gap is a mean, and stays open while a corner of the master lies within a slave facet.
class CornerWatch {
 public:
  /// @param warn  called once for each pair
  CornerWatch(const Model& model, const Scene& scene, std::function<void(const std::string&)> warn);

  /// Collective. A solution, at which contact was evaluated last.
  void examine(const Vector& displacement, const Vector& multipliers);
  /// The solution that was examined last is an accepted state.
  void accept();
  /// Which corners of the accepted state lie in slave facets that carry no force; empty: none.
  const std::string& without_force() const { return accepted_; }

 private:
  /// A corner node with the facets of its body around it.
  struct Candidate {
    LocalOrdinal node;
    std::vector<Side> around;
  };
  struct Pair {
    std::size_t index;  ///< of the scene and the contact system
    const SideSet& slave;
    std::size_t slave_body, master_body;
    RCP<const Map> facets;  ///< of the slave, one to one: their numbers are tags
    std::vector<Candidate> candidates;
    bool is_warned = false;
  };
  struct Found {
    std::size_t pair;
    bool carries;
    std::string text;
  };

  std::vector<SurfaceProbe> corners(const Pair& pair, const PlaceOfNode& at, const Box3& slave_box, double touching) const;
  std::optional<Found> deepest(std::size_t p, const std::vector<SurfaceProbe>& corners, const PlaceOfNode& at, const std::vector<Box3>& boxes,
                               double touching, const Vector& multipliers) const;

  const Model& model_;
  const Scene& scene_;
  std::function<void(const std::string&)> warn_;
  std::vector<Pair> pairs_;
  std::vector<Found> found_;
  std::string accepted_;
};

}  // namespace mortise
