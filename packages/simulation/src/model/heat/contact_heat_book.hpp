#pragma once
// Heat across the contact pairs of a scene, and what was booked of it.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/stages/contact_model.hpp"
#include "mortise/core/timers.hpp"
#include "mortise/nonlinear/contact_contribution.hpp"
#include "mortise/thermal_contact/thermal_contact.hpp"

namespace mortise {

/// The rows of heat of all pairs that conduct or that friction heats.
class ContactHeatBook final : public ContactContribution {
 public:
  /// Sums over a pair.
  struct Sums {
    HeatFlow power;   ///< at the end of the last step
    HeatFlow energy;  ///< since the start
  };
  /// @param pairs  of the scene, for each ThermalPair
  ContactHeatBook(const MeshedScene& meshed, const Scene& scene, const HeatOfModel& heat, const ContactSystem& contact,
                  std::vector<ThermalPair> pairs, Timers timers);
  std::string name() const override { return "contact heat"; }
  FieldUse uses() const override { return {{"displacement", "temperature"}, {"temperature"}, 0}; }
  void add_residual(const ContactLaws& laws, const Configuration& at, Vector& residual, std::optional<StepFailure>& failure) override;
  Derivatives differentiate(const ContactLinearisation& linearised, const Configuration& at, std::optional<StepFailure>& failure) override;
  void commit(const ContactLaws& laws, const Configuration& at) override;
  void serialize(StateArchive& archive) override;

  long calls() const { return calls_; }
  const std::vector<ThermalPair>& pairs() const { return pairs_; }
  /// Index of a pair of the scene among pairs(); none: no heat flows across it.
  std::optional<std::size_t> index(std::size_t pair_of_scene) const;
  /// A history in which friction sees the temperatures of the state that was committed last; at the start those of the slave nodes themselves. Any
  /// history where no law of friction reads them. Collective.
  /// @param time, unknowns  of that state
  ContactHistory with_temperatures(const ContactSystem& contact, ContactHistory history, double time, const Vector& unknowns) const;
  /// Pairs across which heat is conducted in the state that was committed last. Collective.
  std::vector<ThermalPair> conducting_now() const;
  const std::vector<Sums>& sums() const { return sums_; }  ///< [thermal pairs]
  /// Slave nodes of a pair in the state that was committed last.
  const std::vector<NodeHeat>& nodes(std::size_t thermal_pair) const { return nodes_[thermal_pair]; }

 private:
  /// Length of the step that ends at `at`; between two steps that of the last one.
  double time_step(const Configuration& at) const { return at.time > time_ ? at.time - time_ : last_step_; }
  /// Temperatures of rigid bodies at a time [owned nodes]; null: none has one.
  RCP<const Vector> of_rigid_bodies(double time, std::optional<StepFailure>& failure) const;
  template <class Function>
  auto at_temperatures(double time, const Vector& unknowns, std::optional<StepFailure>& failure, const Function& function) const;

  RCP<const Mesh> mesh_;
  std::vector<std::optional<ScalarFunction>> rigid_;  ///< [mesh bodies]
  bool any_rigid_ = false;
  std::vector<std::size_t> pairs_of_scene_;  ///< [thermal pairs]
  std::vector<ThermalPair> pairs_;
  ThermalContact heat_;
  Timers timers_;
  long calls_ = 0;
  double time_ = 0.0, last_step_ = 0.0;
  std::vector<Sums> sums_;
  std::vector<std::vector<NodeHeat>> nodes_;
  std::vector<char> rubs_by_temperature_;                                  ///< [thermal pairs] friction reads the temperature
  std::vector<ThermalContact::SurfaceTemperatures> surface_temperatures_;  ///< of these pairs' passes in that state; empty: none was committed
  bool is_restored_ = false;                                               ///< nothing was committed since: the history has its temperatures
};

/// Pairs of the scene across which heat flows. Collective.
/// @throws InputError on all ranks for laws of pairs that have no temperature on a side, and numbers that make no law
std::vector<ThermalPair> thermal_pairs(const MeshedScene& meshed, const Scene& scene, const HeatOfModel& heat);

/// [mesh bodies] a number that bodies share which ties or conducting pairs join. Collective.
std::vector<int> bodies_that_conduct(const Mesh& mesh, const Scene& scene, const std::vector<ThermalPair>& pairs);

}  // namespace mortise
