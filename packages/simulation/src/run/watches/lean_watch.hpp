#pragma once
// Pairs that bear more along the master than their law of friction lets them, as the slave's averaged normals lean.

#include <functional>
#include <string>
#include <vector>

#include "mortise/simulation/model/model.hpp"

namespace mortise {

/// Looks at converged states. A normal force acts along the slave's normal. On a flat master the forces of all nodes have no part along it beyond
/// what friction bears, unless the normals lean. Such are those of a coarse round slave that has moved, or at the end of a slave surface.
class LeanWatch {
 public:
  /// @param warn  called once for each pair
  LeanWatch(const Model& model, const Scene& scene, std::function<void(const std::string&)> warn);

  /// Collective. A solution.
  void examine(const ContactLaws& laws);
  /// The solution that was examined last is an accepted state.
  void accept();
  /// Stores or restores what it has said.
  void serialize(StateArchive& archive);

 private:
  struct Pair {
    std::vector<std::size_t> slave, master;  ///< bodies
    bool is_warned = false;
    std::string found;  ///< in the solution examined last; empty: nothing
  };

  const Model& model_;
  const Scene& scene_;
  std::function<void(const std::string&)> warn_;
  std::vector<Pair> pairs_;      ///< [pairs of the scene]
  double hardly_strains_ = 0.0;  ///< a force: of a pair that bears less all is round-off
};

}  // namespace mortise
