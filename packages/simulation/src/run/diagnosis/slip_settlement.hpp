#pragma once
// Bodies that friction alone holds along a surface, at iterates where all that could hold them slips.

#include <string>
#include <vector>

#include "mortise/simulation/model/model.hpp"
#include "run/stepping/step_guard.hpp"

namespace mortise {

/// A node that slips bears a given traction, whatever its slip: where all nodes of a body slip the Jacobian is singular along the surface. There is
/// an equilibrium all the same if friction can bear the load: then some nodes slip the other way, or stick. Which these are depends on where the body
/// goes to as a whole, which the Jacobian does not tell; balance_friction() does.
class SlipSettlement final : public StepGuard {
 public:
  /// Collective.
  explicit SlipSettlement(const Model& model);

  /// True if a model has bodies that contact alone holds, with friction. Collective.
  static bool is_needed(const Model& model);

  /// SystemParts::better_start: x with the bodies moved to where friction bears the load, each node with the traction that it has there, and those
  /// that rest sticking. Where friction does not bear the load at the pressures of x, the node that slipped least sticks: pressures are for the next
  /// iterate to find. Null where something else holds the bodies, or Newton's step along the free motions is no longer than the slips. Null too for
  /// the rest of a try in which a start has led back: then what hardly holds the bodies does hold them, and Newton's own steps find how.
  RCP<Vector> better_start(const SystemEvaluation& at);

  void begin() override {
    overload_.clear();
    offered_at_ = Teuchos::null;
    led_back_ = false;
  }
  /// Of the last iterate of this try, in equilibrium across the surface, where friction alone held a body and did not bear its load. Names the body,
  /// the motion, the load and what friction bears. Empty if there was none, or a later one held.
  const std::string& overload() const { return overload_; }

 private:
  struct Sliding;
  bool has_led_back(const Vector& z);
  bool find_sliding(const Vector& x, const Vector& F, const ContactLaws& laws, Sliding& found) const;
  std::string describe_overload(const Sliding& sliding, const Eigen::VectorXd& direction) const;
  double sum(double mine) const;
  void sum(std::vector<double>& values) const;

  const Model& model_;
  std::vector<int> bodies_;
  std::string overload_;
  RCP<const Vector> offered_at_;  ///< the multipliers of the iterate at which a start was given last, in this try; null: none
  bool led_back_ = false;         ///< one has led back in this try
};

}  // namespace mortise
