#pragma once
// Heat of contact at one iterate: its rows, what flows, its derivatives and the elimination of multipliers from them. Immutable values.

#include <cstddef>
#include <memory>
#include <vector>

#include "mortise/contact/node_elimination.hpp"
#include "mortise/core/types.hpp"

namespace mortise {

class ThermalContact;

namespace detail {
struct EvaluatedHeat;
}  // namespace detail

/// Heat at an owned slave node that conducts or slips.
struct NodeHeat {
  GlobalOrdinal node = 0;    ///< its id
  double weight = 0.0;       ///< w_j, its covered share of the surface
  double jump = 0.0;         ///< [theta]_j, of the slave over the master
  double conductance = 0.0;  ///< h_j
  double flux = 0.0;         ///< q_j from slave to master, per area
  double friction = 0.0;     ///< P_j, power that friction takes
};

/// Heat of a pair, over all ranks [power].
struct HeatFlow {
  double conducted = 0.0;               ///< from slave to master: sum_j w_j q_j
  double friction = 0.0;                ///< what friction takes and gives as heat: sum_j P_j; 0 without a share
  double to_slave_without_rows = 0.0;   ///< heat that flows into slave nodes without a row of heat, as of a rigid body
  double to_master_without_rows = 0.0;  ///< into master nodes without one
};

/// The rows of heat of all pairs at an iterate. Collective in all members but nodes().
class ContactHeat {
 public:
  /// r += the rows of heat, on the owned dofs.
  void add_to(Vector& r) const;
  /// Of one of the pairs that ThermalContact was given, by its place in their list.
  HeatFlow flow(std::size_t thermal_pair) const;
  /// Owned slave nodes of such a pair where anything flows; those of a second pass behind those of the first.
  std::vector<NodeHeat> nodes(std::size_t thermal_pair) const;

 protected:
  friend class ThermalContact;
  /// ThermalContact makes them.
  explicit ContactHeat(std::shared_ptr<const detail::EvaluatedHeat> heat) : heat_(std::move(heat)) {}
  std::shared_ptr<const detail::EvaluatedHeat> heat_;  ///< rows of all nodes
};

/// Rows of heat with their derivatives: r(theta, d, z). Collective in all members.
class DifferentiatedHeat : public ContactHeat {
 public:
  /// [dofs x dofs] derivatives by temperatures and displacements.
  RCP<const Matrix> of_dofs() const;
  /// [dofs x multipliers] G = dr/dz. NodeElimination::solve() takes it as `further`.
  RCP<const Matrix> of_multipliers() const;
  /// Adds the linearised rows of heat to a system whose multipliers `condensed` has eliminated:
  ///   A += dr/d(theta, d) + G S,   rhs += -r + G (z^k - b).
  /// So `rhs` comes without the heat of contact, as condense() takes it without the forces. Rows of prescribed temperatures are replaced afterwards.
  /// @param system  on ContactSystem::graph(), open for changes
  /// @throws std::logic_error for a matrix without place for an entry
  void condense(const NodeElimination& condensed, Matrix& system, Vector& rhs) const;

 private:
  friend class ThermalContact;
  using ContactHeat::ContactHeat;
};

}  // namespace mortise
