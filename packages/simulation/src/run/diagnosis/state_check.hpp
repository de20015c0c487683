#pragma once
// A state is accepted only if it is an equilibrium that holds.

#include <functional>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "mortise/simulation/model/model.hpp"
#include "mortise/simulation/run/diagnosis/body_motion.hpp"
#include "mortise/simulation/run/diagnosis/contact_hold.hpp"
#include "run/diagnosis/held_bodies.hpp"
#include "run/stepping/step_guard.hpp"

namespace mortise {

/// Looks at each state that Newton's method found, for the bodies that contact alone holds. It finds which of their rigid motions nothing holds
/// there, and how far they went along these in the step. Collective in all members.
class StateCheck final : public StepGuard {
 public:
  /// @param resolution  what displacements are known to [length]
  /// @param warn        gets what is said of motions that are free, on every rank
  StateCheck(const Model& model, double resolution, Timers timers, std::function<void(const std::string&)> warn);

  /// True if a model has bodies that contact alone holds. Collective.
  static bool is_needed(const Model& model);

  /// From the accepted state to the solution `found`. Says which motions are free, each once.
  ///
  /// A motion that nothing holds costs nothing, so equilibrium does not say how far a body goes along it. It may have been moved within the step by
  /// the bodies that it touches: by their own motion and by deformation. Let m be the largest motion over the step of a node of bodies that boundary
  /// conditions hold, of a prescribed dof and of another body that contact moved. Let e be the largest deformation over the step. A body that is
  /// carried goes no farther than m + e, plus what Newton's method leaves undetermined. Twice that is allowed, as motions of different nodes add up:
  /// a body that turns with what carries it goes farther at its rim. A body that leaves an equilibrium for another place goes as far however small
  /// the step is, while m and e fall with it.
  ///
  /// The motions are those that nothing holds in `found`, or those that nothing held in the accepted state. The latter count too since a body that
  /// was thrown out of a gap may lie on an edge that holds it.
  ///
  /// A body that went farther may have been thrown there by an iterate on the way. In the first round of a try it is put back along its free motions,
  /// deformed as it is: surfaces that overlap then are closed. A body that nothing touches, neither before nor after, is put back from any distance
  /// beyond its own deformation. If it has to go out of the way, it does so again.
  /// @returns null if `found` is accepted, else another start
  /// @throws StepFailure(lost_contact), on every rank, for a body that went farther again, or, held or not, farther than the model is long; with
  /// the words of statics if no force could hold it
  RCP<Vector> verify(const SemiSmoothSystem& system, const AcceptedState& from, const SystemEvaluation& found, int round) override;

  /// True if a body, held or not, went farther than that in the state that verify() passed last. Contact that turns or levers it may take it there,
  /// but so may a jump.
  bool went_far() const { return went_far_; }

  void begin() override { refused_.clear(); }
  /// Why a solution of this try was refused, if one was.
  const std::string& refused() const { return refused_; }

  void accept(const SemiSmoothSystem& system, const SystemEvaluation& at) override;
  /// Takes free motions of the accepted state out of the rate.
  void predict(const SemiSmoothSystem& system, const Vector& x, double dt, Vector& rate) override;
  void serialize(StateArchive& archive) override;

  const ContactRecord& record() const { return record_; }

 private:
  RCP<Vector> examine(const SemiSmoothSystem& system, const Vector& before, const SystemEvaluation& found, int round);
  void say_new(const RigidModes& modes, const Eigen::MatrixXd& free, const BodyMotions& motions);

  const Model& model_;
  double resolution_;
  Timers timers_;
  std::function<void(const std::string&)> warn_;
  std::vector<int> bodies_;
  ContactRecord record_;
  std::vector<PairHold> pairs_;
  std::unique_ptr<const RigidModes> modes_;     ///< of the state that verify() passed last
  Eigen::MatrixXd free_, free_before_;          ///< free_motions() of that state, and of the one accepted last; no columns before the first
  std::vector<char> touches_, touches_before_;  ///< [bodies] whether contact or a boundary condition held anything of them then
  Eigen::VectorXd freely_;                      ///< its step's motion along what was free
  std::vector<Eigen::Vector3d> middle_;
  std::set<std::pair<int, int>> said_;
  std::string refused_;
  bool went_far_ = false;
};

}  // namespace mortise
