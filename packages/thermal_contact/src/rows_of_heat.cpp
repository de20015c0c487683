#include "rows_of_heat.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace mortise::detail {
namespace {

using Row = Eigen::RowVectorXd;

/// A number with its derivatives by the temperatures and positions of the nodes and by z_j. Without derivatives rows have no size.
struct Dependent {
  double value = 0.0;
  Row of_temperatures, of_positions, of_multiplier;

  Dependent& operator+=(const Dependent& other) {
    value += other.value;
    of_temperatures += other.of_temperatures;
    of_positions += other.of_positions;
    of_multiplier += other.of_multiplier;
    return *this;
  }
  friend Dependent operator*(double a, Dependent b) {
    b.value *= a;
    b.of_temperatures *= a;
    b.of_positions *= a;
    b.of_multiplier *= a;
    return b;
  }
  friend Dependent operator*(const Dependent& a, const Dependent& b) {
    Dependent result = b.value * a;
    result += a.value * b;
    result.value = a.value * b.value;
    return result;
  }
  friend Dependent operator/(const Dependent& a, const Dependent& b) {
    Dependent result = 1.0 / b.value * a;
    result += -result.value / b.value * b;
    result.value = a.value / b.value;
    return result;
  }
};

/// Numbers of one node in the form that depends on temperatures too.
class OfNode {
 public:
  OfNode(const NodeTransfer& node, int dimension) : node_(node), dimension_(dimension), differentiates_(!node.coefficient_slopes.empty()) {}

  Eigen::Index nodes() const { return static_cast<Eigen::Index>(node_.nodes.size()); }
  Dependent zero() const {
    if (!differentiates_) return {};
    return {0.0, Row::Zero(nodes()), Row::Zero(dimension_ * nodes()), Row::Zero(dimension_)};
  }
  Dependent of(const NodeQuantity& quantity) const {
    Dependent result = zero();
    result.value = quantity.value;
    if (!differentiates_) return result;
    result.of_positions = Eigen::Map<const Row>(quantity.of_positions.data(), dimension_ * nodes());
    result.of_multiplier = Eigen::Map<const Row>(quantity.of_multiplier.data(), dimension_);
    return result;
  }
  /// c_jm.
  Dependent coefficient(Eigen::Index m) const {
    Dependent result = zero();
    result.value = node_.coefficients[static_cast<std::size_t>(m)];
    if (differentiates_)
      result.of_positions = Eigen::Map<const Row>(node_.coefficient_slopes.data() + dimension_ * nodes() * m, dimension_ * nodes());
    return result;
  }
  /// sum_m sign_m c_jm theta_m.
  template <class Sign, class Theta>
  Dependent sum(const Sign& sign, const Theta& theta) const {
    Dependent result = zero();
    for (Eigen::Index m = 0; m < nodes(); ++m) {
      const double c = node_.coefficients[static_cast<std::size_t>(m)];
      if (node_.loaded[static_cast<std::size_t>(m)] == 0) continue;
      const double factor = sign(m) * theta(m);
      result.value += factor * c;
      if (!differentiates_) continue;
      result.of_temperatures[m] += sign(m) * c;
      result.of_positions += factor * Eigen::Map<const Row>(node_.coefficient_slopes.data() + dimension_ * nodes() * m, dimension_ * nodes());
    }
    return result;
  }

 private:
  const NodeTransfer& node_;
  int dimension_;
  bool differentiates_;
};

// Both laws describe surfaces that just touch: a jump of h there would make Newton's method cycle.
constexpr double largest_difference = 0.01;

}  // namespace

// With q = h [theta], F = P / w and f_m = -delta at slave nodes, 1 - delta at master nodes, all rows are  c_jm (q_j + f_m F_j).
std::optional<RowsOfHeat> rows_of_heat(const FieldTransfer& transfer, std::size_t slave, const HeatLaws& laws, const std::vector<double>& theta,
                                       int dimension, const std::string& pair_name, HeatFaults& faults) {
  const NodeTransfer node = transfer[slave];
  const bool closed = node.state != ContactState::open;
  const bool conducts = closed ? laws.conductance != nullptr : laws.gap != nullptr;
  const bool rubs = laws.slave_share.has_value() && node.state == ContactState::slip && node.friction_work.value != 0.0;
  if (!conducts && !rubs) return std::nullopt;

  const OfNode of_node(node, dimension);
  const auto is_slave = [&](Eigen::Index m) { return transfer.is_slave(node.nodes[static_cast<std::size_t>(m)]); };
  const Dependent weight = of_node.of(node.weight);
  RowsOfHeat rows;
  rows.heat.node = node.node;
  rows.heat.weight = node.weight.value;
  rows.nodes = node.nodes;
  rows.loaded = node.loaded;
  for (Eigen::Index m = 0; m < of_node.nodes(); ++m) rows.of_slave.push_back(is_slave(m) ? 1 : 0);
  rows.multiplier = node.multiplier;

  Dependent flux = of_node.zero();
  if (conducts) {
    const auto theta_of = [&](Eigen::Index m) { return theta[static_cast<std::size_t>(node.nodes[static_cast<std::size_t>(m)])]; };
    for (Eigen::Index m = 0; m < of_node.nodes(); ++m)
      if (node.loaded[static_cast<std::size_t>(m)] != 0 && node.coefficients[static_cast<std::size_t>(m)] != 0.0 && !std::isfinite(theta_of(m))) {
        if (!faults.without_temperature)
          faults.without_temperature = fmt::format(
              "pair '{}' conducts heat at slave node {}, and node {} has no temperature that is finite; give it a row of heat, give its "
              "temperature in NodalTemperature::nodes, or leave out the conductance of the pair",
              pair_name, node.node, transfer.nodes()->getGlobalElement(node.nodes[static_cast<std::size_t>(m)]));
        return std::nullopt;
      }
    const auto known = [&](Eigen::Index m) {  // nodes with a coefficient of 0 may have no temperature
      const double value = theta_of(m);
      return std::isfinite(value) ? value : 0.0;
    };
    const Dependent jump = of_node.sum([](Eigen::Index) { return 1.0; }, known) / weight;
    const Dependent mean = 0.5 * (of_node.sum([&](Eigen::Index m) { return is_slave(m) ? 1.0 : -1.0; }, known) / weight);
    Dependent h = of_node.zero();
    if (closed) {
      // A node that has just closed has p = 0. There the slope is that to the right: the first correction already sees that heat comes with pressure.
      const bool presses = node.pressure.value >= 0.0;
      const double rate = laws.time_step > 0.0 ? node.slip.value / laws.time_step : 0.0;
      const Conductance law = laws.conductance->at({presses ? node.pressure.value : 0.0, mean.value, rate, laws.largest_pressure});
      if (presses) h += law.of_pressure * of_node.of(node.pressure);
      h += law.of_temperature * mean;
      if (rate > 0.0) h += law.of_slip_rate / laws.time_step * of_node.of(node.slip);
      h.value = law.value;
    } else {
      const bool apart = node.gap.value > 0.0;
      const ConductanceOfGap law = laws.gap->at(apart ? node.gap.value : 0.0);
      if (apart) h += law.of_gap * of_node.of(node.gap);
      h.value = law.value;
    }
    if (!(h.value >= 0.0) || !std::isfinite(h.value)) {
      if (!faults.failure)
        faults.failure = StepFailure(
            FailureKind::input,
            fmt::format(
                "the conductance of pair '{}' is {:g} at slave node {}, at the pressure {:g}, the mean temperature {:g} and the mean gap {:g}; "
                "allowed: >= 0 and finite",
                pair_name, h.value, node.node, node.pressure.value, mean.value, node.gap.value));
      return std::nullopt;
    }
    if (laws.gap != nullptr && faults.of_laws.empty()) {
      const double touching = laws.conductance != nullptr ? laws.conductance->at({0.0, mean.value, 0.0, laws.largest_pressure}).value : 0.0;
      const double apart = laws.gap->at(0.0).value;
      if (std::abs(touching - apart) > largest_difference * std::max(touching, apart))
        faults.of_laws.push_back(
            {{{}, 0, "contact/" + pair_name},
             fmt::format(
                 "surfaces that just touch conduct {:g} by the law of the pressure, at 0, and {:g} by that of the gap, at 0, at the temperature "
                 "{:g}; let them differ by 1 % at most, as by \"without pressure\" of the former",
                 touching, apart, mean.value)});
    }
    flux = h * jump;
    rows.heat.jump = jump.value;
    rows.heat.conductance = h.value;
    rows.heat.flux = flux.value;
  }
  Dependent friction = of_node.zero();
  if (rubs) {
    const Dependent power = 1.0 / laws.time_step * of_node.of(node.friction_work);
    rows.heat.friction = power.value;
    friction = power / weight;
  }

  const bool differentiates = !node.coefficient_slopes.empty();
  if (differentiates) {
    rows.of_temperatures.setZero(of_node.nodes(), of_node.nodes());
    rows.of_positions.setZero(of_node.nodes(), dimension * of_node.nodes());
    rows.of_multipliers.setZero(of_node.nodes(), dimension);
  }
  std::array<Dependent, 2> through = {flux, flux};  // into the rows of master and slave nodes, over c
  if (rubs) {
    through[0] += (1.0 - *laws.slave_share) * friction;
    through[1] += -*laws.slave_share * friction;
  }
  for (Eigen::Index m = 0; m < of_node.nodes(); ++m) {
    if (rows.loaded[static_cast<std::size_t>(m)] == 0) {
      rows.values.push_back(0.0);
      continue;
    }
    const Dependent row = of_node.coefficient(m) * through[is_slave(m) ? 1 : 0];
    rows.values.push_back(row.value);
    if (!differentiates) continue;
    rows.of_temperatures.row(m) = row.of_temperatures;
    rows.of_positions.row(m) = row.of_positions;
    rows.of_multipliers.row(m) = row.of_multiplier;
  }
  return rows;
}

}  // namespace mortise::detail
