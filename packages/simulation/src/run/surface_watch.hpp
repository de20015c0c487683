#pragma once
// What the surfaces of the bodies tell of a state that contact alone does not see.

#include <functional>
#include <string>

#include "run/contact_watch.hpp"
#include "run/corner_watch.hpp"
#include "run/lean_watch.hpp"
#include "run/overlap_watch.hpp"

namespace mortise {

/// Looks at each converged state once. It asks whether a body has passed through another, whether a corner lies within a facet, whether bodies
/// overlap although their pair carries no force, and whether leaning normals bear what friction does not.
class SurfaceWatch {
 public:
  /// @param warn  called once for each pair and question
  SurfaceWatch(const Model& model, const Scene& scene, const std::function<void(const std::string&)>& warn);

  /// Collective. A solution.
  /// @throws StepFailure on every rank, as ContactWatch says
  void examine(const Vector& displacement, const ContactLaws& laws);
  /// The solution that was examined last is an accepted state.
  void accept();
  /// What of the accepted state lies in the other body where the pair carries no force; empty: nothing.
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
