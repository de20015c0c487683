#pragma once
// Data behind the values of heat: pairs with their passes, and the rows of one iterate.

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "mortise/contact/contact_system.hpp"
#include "mortise/core/nodal_field.hpp"
#include "mortise/thermal_contact/thermal_contact.hpp"
#include "rows_of_heat.hpp"

namespace mortise::detail {

/// A pair of the contact system on which heat flows: that of a ThermalPair, or its second pass, whose slave is the other side.
struct ThermalPass {
  std::size_t pair = 0;          ///< of the contact system
  std::size_t thermal_pair = 0;  ///< whose laws it has
  bool exchanged = false;        ///< its slave is the master of the ThermalPair
};

/// The rows of heat of an interface's nodes, on this rank and on others.
struct InterfaceRows {
  RCP<const Map> nodes;            ///< FieldTransfer::nodes() that it is made for
  std::vector<GlobalOrdinal> ids;  ///< [nodes] NodalField::none: no row
  RCP<const Map> rows;             ///< those that there are
  RCP<const Export> to_owners;     ///< from `rows` to the dofs
};

/// All pairs with heat, without anything that depends on an iterate.
struct ThermalModel {
  ThermalModel(const ContactSystem& of_contact, NodalField field) : contact(of_contact), temperature(std::move(field)) {}

  ContactSystem contact;
  NodalField temperature;
  RCP<const Map> dofs;
  std::vector<ThermalPair> pairs;
  std::vector<ThermalPass> passes;
  mutable std::vector<std::shared_ptr<const InterfaceRows>> interface_rows;  ///< [passes] the last of rows_of(): kept as long as candidates stay

  /// Collective.
  std::shared_ptr<const InterfaceRows> rows_of(std::size_t pass, const RCP<const Map>& nodes) const;
  /// Temperatures of the owned nodes, NaN where there is none.
  RCP<MultiVector> on_owned_nodes(const NodalTemperature& theta) const;
};

/// A pass at an iterate.
struct EvaluatedPass {
  std::shared_ptr<const InterfaceRows> interface;
  std::vector<RowsOfHeat> nodes;  ///< of the slave nodes where anything flows
};

/// All passes at an iterate.
struct EvaluatedHeat {
  std::shared_ptr<const ThermalModel> model;
  RCP<const Vector> z;
  RCP<const Map> multipliers;
  std::vector<EvaluatedPass> passes;
  RCP<const Matrix> of_dofs, of_multipliers;  ///< null without derivatives
};

}  // namespace mortise::detail
