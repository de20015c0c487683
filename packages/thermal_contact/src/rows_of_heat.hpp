#pragma once
// Rows of heat of one slave node: values and derivatives.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "mortise/contact/field_transfer.hpp"
#include "mortise/core/error.hpp"
#include "mortise/thermal_contact/thermal_contact.hpp"

namespace mortise::detail {

/// What a slave node adds to the rows of the nodes m that it is coupled to. Rows of derivatives are those nodes that it loads.
struct RowsOfHeat {
  NodeHeat heat;
  std::vector<LocalOrdinal> nodes;     ///< m, local nodes of the interface
  std::vector<char> loaded, of_slave;  ///< [nodes]
  std::vector<double> values;          ///< [nodes] what it adds to row m
  GlobalOrdinal multiplier = 0;        ///< id of the first component of z_j
  Eigen::MatrixXd of_temperatures;     ///< [nodes x nodes]; without size: no derivatives
  Eigen::MatrixXd of_positions;        ///< [nodes x dim nodes]
  Eigen::MatrixXd of_multipliers;      ///< [nodes x dim]
};

/// Laws of a pass, and what all of its nodes have in common.
struct HeatLaws {
  const ConductanceLaw* conductance = nullptr;
  const GapConductance* gap = nullptr;
  std::optional<double> slave_share;
  double time_step = 0.0;
  double largest_pressure = 0.0;
};

/// What is wrong at a node, on this rank.
struct HeatFaults {
  std::optional<StepFailure> failure;              ///< a conductance that is none
  std::optional<std::string> without_temperature;  ///< a node that conducts and has no temperature
  std::vector<Diagnostic> of_laws;                 ///< laws that do not join
};

/// The rows of a slave node; nothing where nothing flows.
/// @param theta  [nodes of the interface] NaN: it has none
std::optional<RowsOfHeat> rows_of_heat(const FieldTransfer& transfer, std::size_t slave, const HeatLaws& laws, const std::vector<double>& theta,
                                       int dimension, const std::string& pair_name, HeatFaults& faults);

}  // namespace mortise::detail
