#pragma once
// Heat across contact in a model: its rows at an iterate, with multipliers that are unknowns or condensed.

#include <vector>

#include "mortise/contact/node_elimination.hpp"
#include "mortise/thyra/model_with_contact.hpp"

namespace mortise::detail {

/// What an evaluation gives to the heat of contact beside x.
struct HeatConditions {
  double time_step = 0.0;      ///< 0: laws see no slip rate
  RCP<const Vector> of_nodes;  ///< temperatures of nodes without a row; null: none
};

/// True, on every rank, if they are alike.
bool are_equal(const HeatConditions& one, const HeatConditions& other);

/// The rows of heat at an iterate (x, z): r, dr/dx, G = dr/dz. Collective in all members.
class HeatOfIterate {
 public:
  /// @param prescribed  rows of prescribed temperatures
  HeatOfIterate(const DifferentiatedHeat& rows, const HeatConditions& conditions, RCP<const Vector> z, const std::vector<LocalOrdinal>& prescribed);

  const DifferentiatedHeat& rows() const { return rows_; }
  const HeatConditions& conditions() const { return conditions_; }  ///< at which they are
  /// G, with rows of prescribed temperatures that are 0: NodeElimination::solve() takes it. Null: no pair has heat.
  const RCP<const Matrix>& of_multipliers() const { return G_; }
  /// A += dr/dx.
  void add_slopes(Matrix& A) const;
  /// A += G S.
  void add_substituted(const NodeElimination& elimination, Matrix& A) const;
  /// right -= r + G (b - z).
  void condense(const NodeElimination& elimination, Vector& right) const;
  /// right -= G b.
  void take_constant(const NodeElimination& elimination, Vector& right) const;

 private:
  DifferentiatedHeat rows_;
  HeatConditions conditions_;
  RCP<const Vector> z_;
  RCP<const Matrix> G_;
};

/// Heat across contact of a model, without anything that depends on an iterate. Collective in all members but the accessors.
class HeatOfModel {
 public:
  /// @throws std::invalid_argument on every rank, see with_contact()
  HeatOfModel(HostHeat of_host, const NodalField& displacement, const ContactSystem& contact, const RCP<const Map>& dofs);

  const std::vector<LocalOrdinal>& prescribed() const { return prescribed_; }  ///< rows of prescribed temperatures
  HeatConditions conditions(const ThyraInArgs& at) const;
  ContactHeat evaluate(const ContactLaws& laws, const Vector& x, const HeatConditions& at) const;
  HeatOfIterate differentiate(const ContactLinearisation& linearised, const Vector& x, const HeatConditions& at) const;

 private:
  HostHeat of_host_;
  ThermalContact thermal_;
  std::vector<LocalOrdinal> prescribed_;
};

}  // namespace mortise::detail
