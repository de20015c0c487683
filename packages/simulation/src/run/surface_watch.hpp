#pragma once
// Checks of a state by the surfaces of the bodies, for what contact alone does not see.

#include <functional>
#include <string>

#include "run/contact_watch.hpp"
#include "run/corner_watch.hpp"
#include "run/lean_watch.hpp"
#include "run/overlap_watch.hpp"

namespace mortise {

/// Looks at each converged state once. It finds bodies that have passed through another, corners within a facet, bodies that
/// overlap although their pair carries no force, and leaning normals that bear what friction does not.
class SurfaceWatch {
 public:
  /// @param warn  called once for each pair and question
  SurfaceWatch(const Model& model, const Scene& scene, const std::function<void(const std::string&)>& warn);

  /// Collective. A solution.
  /// @throws StepFailure on every rank, as ContactWatch says
  void examine(const Vector& displacement, const ContactLaws& laws);
  /// The solution that was examined last is an accepted state.
  void accept();
  /// Place of the accepted state where bodies overlap and the pair carries no force; empty: none.
  const std::string& without_force() const;
  /// Stores or restores what it knows of the accepted state and has said.
  void serialize(StateArchive& archive);

 private:
  const Model& model_;
  ContactWatch passages_;
  CornerWatch corners_;
  OverlapWatch overlaps_;
  LeanWatch leans_;
};

}  // namespace mortise
