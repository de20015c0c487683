#include "run/diagnosis/static_guards.hpp"

#include "mortise/simulation/run/path/jump_check.hpp"
#include "run/diagnosis/motion_hold.hpp"
#include "run/diagnosis/parts_apart.hpp"
#include "run/diagnosis/slip_settlement.hpp"
#include "run/diagnosis/stabilisation_watch.hpp"
#include "run/diagnosis/start_rule.hpp"
#include "run/diagnosis/state_check.hpp"
#include "run/diagnosis/static_reasons.hpp"
#include "run/path/stability_check.hpp"

namespace mortise {
namespace {

class PartsApartAdvice final : public StepGuard {
 public:
  PartsApartAdvice(const Model& model, const Scene& scene) : model_(model), scene_(scene) {}

  FailureExplanation explain(const SemiSmoothSystem& system, const FailedTry& failed) override {
    const std::string words = advise_parts_apart(failed, model_, scene_, system);
    return {words, !words.empty()};
  }

 private:
  const Model& model_;
  const Scene& scene_;
};

class JumpGuard final : public StepGuard {
 public:
  /// @param carried  null: no body is held by contact alone
  JumpGuard(double length, std::shared_ptr<const StateCheck> carried) : jump_(length), carried_(std::move(carried)) {}

  RCP<Vector> verify(const SemiSmoothSystem& system, const AcceptedState& from, const SystemEvaluation& found, int) override {
    const RCP<const Vector> before = system.unknowns(*from.x), now = system.unknowns(found.x());
    jump_.verify(*system.first_field(*before), *system.first_field(*now), found.context().time - from.context.time, carried_ && carried_->went_far());
    return Teuchos::null;
  }
  void accept(const SemiSmoothSystem&, const SystemEvaluation&) override { jump_.accept(); }
  void serialize(StateArchive& archive) override { jump_.serialize(archive); }

 private:
  JumpCheck jump_;
  std::shared_ptr<const StateCheck> carried_;
};

/// What bodies that contact alone holds need of the system while it is solved.
void hold_bodies(const StaticGuardSettings& settings, const std::vector<int>& loose, const std::shared_ptr<SlipSettlement>& settlement,
                 SystemParts& parts) {
  if (settlement) parts.better_start = [settlement](const SystemEvaluation& at) { return settlement->better_start(at); };
  parts.held_motions = [&model = settings.model, timers = settings.timers, loose,
                        tolerance = settings.scene.newton.momentum_tolerance](const SystemEvaluation& at) {
    const auto timer = timers.scope("free motions");
    return motions_without_load(model, at, loose, tolerance);
  };
}

}  // namespace

StepGuards static_guards(const StaticGuardSettings& settings, SystemParts& parts) {
  const Model& model = settings.model;
  const Scene& scene = settings.scene;
  const double resolution = scene.newton.increment_tolerance * model.parts().length;
  StepGuards guards;
  std::shared_ptr<StateCheck> check;
  std::shared_ptr<SlipSettlement> settlement;
  if (StateCheck::is_needed(model)) {
    const std::vector<int> loose = bodies_held_by_contact_only(model);
    check = std::make_shared<StateCheck>(model, resolution, settings.timers, settings.warn);
    if (SlipSettlement::is_needed(model)) settlement = std::make_shared<SlipSettlement>(model);
    hold_bodies(settings, loose, settlement, parts);
    guards = {std::make_shared<PartsApartAdvice>(model, scene),
              std::make_shared<StartRule>(model, loose, scene.newton.momentum_tolerance, settings.say), check};
    if (settlement) guards.push_back(settlement);
  }
  if (model.connectors().stabilisation)  // viscous paths have no jumps
    guards.push_back(std::make_shared<StabilisationWatch>(model, settings.say, settings.warn));
  else
    guards.push_back(std::make_shared<JumpGuard>(model.parts().length, check));
  guards.push_back(std::make_shared<StabilityCheck>(resolution, settings.warn));
  guards.push_back(std::make_shared<StaticReasons>(model, scene.stepping, check, settlement));
  return guards;
}

}  // namespace mortise
