#pragma once
// Heat across the pairs of a contact system: conduction, heat of friction, their rows and their derivatives.

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "mortise/contact/contact_system.hpp"
#include "mortise/core/nodal_field.hpp"
#include "mortise/core/types.hpp"
#include "mortise/thermal_contact/conductance.hpp"
#include "mortise/thermal_contact/contact_heat.hpp"
#include "mortise/thermal_contact/gap_conductance.hpp"

namespace mortise {

namespace detail {
struct ThermalModel;
}  // namespace detail

/// Heat across one pair of a contact system. With two passes it counts for both.
struct ThermalPair {
  std::size_t pair = 0;                               ///< of the contact system
  std::shared_ptr<const ConductanceLaw> conductance;  ///< of nodes that are closed; null: they conduct nothing
  std::shared_ptr<const GapConductance> gap;          ///< of nodes that are open, up to the search reach; null: they conduct nothing
  std::optional<double> slave_share;                  ///< delta in [0, 1] of the heat of friction; none: friction gives no heat
};

/// delta = e_s / (e_s + e_m) with the effusivities e = sqrt(k rho c): as the temperature of two half spaces that come to touch.
double share_of_slave(double effusivity_of_slave, double effusivity_of_master);

/// Temperatures of the owned nodes: from a vector on the dofs, and from the host's vector where they are no unknowns.
struct NodalTemperature {
  /// Nodes without a row of heat have no temperature.
  NodalTemperature(const Vector& of_dofs) : dofs(of_dofs) {}
  /// @param of_nodes  [owned nodes], read at nodes without a row of heat; NaN: the node has no temperature
  NodalTemperature(const Vector& of_dofs, const Vector& of_nodes) : dofs(of_dofs), nodes(&of_nodes) {}
  const Vector& dofs;             ///< of the unknowns
  const Vector* nodes = nullptr;  ///< of the rest; null: it has none
};

/// Heat across pairs of a contact system. Let j be the slave nodes that are covered, w_j = sum_k D_jk, and c_jk = D_jk at slave nodes, c_jl = -M_jl
/// at master nodes:
///   jump       [theta]_j = sum_m c_jm theta_m / w_j
///   flux       q_j = h_j [theta]_j                      out of the slave, per area; h_j of pressure, mean temperature, slip rate, or of the gap
///   friction   P_j = (T_j z_j) . s_j / dt               where it slips
///   rows       slave k:   sum_j D_jk (q_j - delta P_j / w_j)        master l:   -sum_j M_jl (q_j + (1 - delta) P_j / w_j)
/// They stand on the left of the equations of heat, as what leaves a node. Rows of conduction sum to 0, those of friction to minus its power, since
/// sum_k D_jk = sum_l M_jl. The power that conduction dissipates, sum_j w_j h_j [theta]_j^2, is never negative. Hueeber, Wohlmuth 2009; Seitz, Wall,
/// Popp 2018.
///
/// A slave node without a multiplier conducts through the functions of the nodes around it, with their pressures. A node without a row of heat takes
/// heat that HeatFlow counts. A value: copies share what it holds. Collective in all members.
class ThermalContact {
 public:
  /// @param contact      made with `temperature` among its further fields, so that its graph has place for rows of heat
  /// @param temperature  a field of one component on the owned nodes
  /// @param dofs         owned rows of the host's system
  /// @throws std::invalid_argument for a field of more components, a share outside of [0, 1], numbers that make no law, a pair that is named twice
  /// @throws std::out_of_range for a pair that does not exist
  ThermalContact(const ContactSystem& contact, const NodalField& temperature, RCP<const Map> dofs, std::vector<ThermalPair> pairs);

  /// The rows of heat at an iterate.
  /// @param time_step  dt, above 0 where friction gives heat; where it is 0 laws see no slip rate
  /// @throws StepFailure on every rank for a conductance that is negative or not finite
  /// @throws std::invalid_argument on every rank for a step of time that is not above 0, or a node that conducts and has no temperature
  /// @throws InputError on every rank where the laws of closed and open nodes differ by more than 1 % at p = 0, g = 0
  ContactHeat evaluate(const ContactLaws& laws, const NodalTemperature& theta, double time_step) const;
  /// Temperatures at the slave nodes of a pass, as ContactSystem::with_temperatures() takes them for friction.
  struct SurfaceTemperatures {
    std::size_t pair = 0;        ///< of the contact system
    std::vector<double> values;  ///< [ContactSystem::slave_ids(pair)]; NaN where there is none
  };
  /// Means of both sides, of one of the pairs that it was given, by its place in their list. A node that is not covered has its own.
  /// @return  one for each pass of the pair
  std::vector<SurfaceTemperatures> surface_temperatures(const ContactLaws& laws, const NodalTemperature& theta, std::size_t thermal_pair) const;
  /// Those of the slave nodes themselves, as before anything was evaluated.
  std::vector<SurfaceTemperatures> slave_temperatures(const NodalTemperature& theta, std::size_t thermal_pair) const;

  /// The rows with their derivatives, as evaluate().
  DifferentiatedHeat differentiate(const ContactLinearisation& at, const NodalTemperature& theta, double time_step) const;

 private:
  std::shared_ptr<const detail::ThermalModel> model_;
};

}  // namespace mortise
