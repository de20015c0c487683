#include "mortise/thermal_contact/thermal_contact.hpp"

#include <fmt/format.h>

#include <Tpetra_Export.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include "evaluated_heat.hpp"
#include "matrices_of_heat.hpp"
#include "mortise/contact/field_transfer.hpp"
#include "mortise/core/over_ranks.hpp"
#include "mortise/core/trilinos_versions.hpp"

namespace mortise {

double share_of_slave(double effusivity_of_slave, double effusivity_of_master) {
  const double sum = effusivity_of_slave + effusivity_of_master;
  if (!(effusivity_of_slave >= 0.0) || !(effusivity_of_master >= 0.0) || !(sum > 0.0) || !std::isfinite(sum))
    throw std::invalid_argument(
        fmt::format("thermal contact: the effusivities are {:g} and {:g}; give ones that are finite and not negative, and not "
                    "both 0",
                    effusivity_of_slave, effusivity_of_master));
  return effusivity_of_slave / sum;
}

namespace detail {
namespace {

// The largest pressure that a closed node of a pass bears. Collective.
double largest_pressure(const ContactLaws& laws, std::size_t pair, const Communicator& comm) {
  const FieldTransfer transfer(laws, pair);
  double mine = 0.0;
  for (std::size_t s = 0; s < transfer.size(); ++s) {
    if (!transfer.is_covered(s)) continue;
    const NodeTransfer node = transfer[s];
    if (node.state != ContactState::open) mine = std::max(mine, node.pressure.value);
  }
  return most_over_ranks(comm, mine);
}

// The mean of sum_k D_jk theta_k / w_j and sum_l M_jl theta_l / w_j; of one of them where the other side has no temperature.
template <class View>
double mean_of_sides(const FieldTransfer& transfer, const NodeTransfer& node, const View& theta, double own) {
  double slave = 0.0, master = 0.0;
  for (std::size_t m = 0; m < node.nodes.size(); ++m) {
    if (node.loaded[m] == 0 || node.coefficients[m] == 0.0) continue;
    (transfer.is_slave(node.nodes[m]) ? slave : master) += node.coefficients[m] * theta(node.nodes[m], 0);
  }
  slave /= node.weight.value;
  master /= -node.weight.value;
  if (!std::isfinite(slave)) return std::isfinite(master) ? master : own;
  return std::isfinite(master) ? 0.5 * (slave + master) : slave;
}

// Collective. Every rank throws if any has something to say; the rank that has says it.
void refuse_if_any(const Communicator& comm, const std::optional<std::string>& wrong) {
  if (most_over_ranks(comm, wrong ? 1 : 0) == 0) return;
  throw std::invalid_argument("thermal contact: " + (wrong ? *wrong : std::string("an argument does not fit on another rank")));
}

template <class At>
EvaluatedHeat evaluated_heat(const std::shared_ptr<const ThermalModel>& model, const At& at, const ContactLaws& laws, const NodalTemperature& theta,
                             double time_step, bool derivatives) {
  const Communicator& comm = *model->dofs->getComm();
  const bool needs_time = std::any_of(model->pairs.begin(), model->pairs.end(), [](const ThermalPair& pair) { return pair.slave_share.has_value(); });
  std::optional<std::string> wrong;
  if (needs_time && (!(time_step > 0.0) || !std::isfinite(time_step)))
    wrong = fmt::format("heat of friction in a step of the time {:g}; give the time of the step, above 0", time_step);
  if (!theta.dofs.getMap()->locallySameAs(*model->dofs) && theta.dofs.getMap() != model->dofs)
    wrong = "the temperatures are not on the map `dofs` of the system";
  if (theta.nodes != nullptr && !theta.nodes->getMap()->locallySameAs(*model->temperature.nodes()))
    wrong = "`NodalTemperature::nodes` is not on the map of owned nodes";
  refuse_if_any(comm, wrong);

  EvaluatedHeat heat{model, rcp(new Vector(laws.multipliers(), Teuchos::Copy)), model->contact.multiplier_map(), {}, {}, {}};
  const RCP<MultiVector> owned = model->on_owned_nodes(theta);
  const int dimension = model->contact.dimension();
  HeatFaults faults;
  for (std::size_t p = 0; p < model->passes.size(); ++p) {
    const ThermalPass& pass = model->passes[p];
    const ThermalPair& pair = model->pairs[pass.thermal_pair];
    const FieldTransfer transfer(at, pass.pair);
    EvaluatedPass& result = heat.passes.emplace_back();
    result.interface = model->rows_of(p, transfer.nodes());
    std::vector<double> temperatures(local_id_count(*transfer.nodes()));
    {
      const RCP<MultiVector> on_nodes = transfer.on_nodes(*owned);
      const auto view = on_nodes->getLocalViewHost(Tpetra::Access::ReadOnly);
      for (std::size_t node = 0; node < temperatures.size(); ++node) temperatures[node] = view(node, 0);
    }
    HeatLaws of_pass{pair.conductance.get(), pair.gap.get(), pair.slave_share, time_step, 0.0};
    if (pass.exchanged && of_pass.slave_share) of_pass.slave_share = 1.0 - *of_pass.slave_share;
    if (pair.conductance && pair.conductance->needs_largest_pressure()) of_pass.largest_pressure = largest_pressure(laws, pass.pair, comm);
    for (std::size_t s = 0; s < transfer.size(); ++s) {
      if (!transfer.is_covered(s)) continue;
      if (auto rows = rows_of_heat(transfer, s, of_pass, temperatures, dimension, model->contact.pair_name(pass.pair), faults))
        result.nodes.push_back(std::move(*rows));
    }
    if (derivatives) add_matrices(*model, transfer, result, heat.of_dofs, heat.of_multipliers);
  }
  throw_if_any(comm, faults.failure);
  throw_if_any(comm, faults.of_laws);
  refuse_if_any(comm, faults.without_temperature);
  return heat;
}

}  // namespace

std::shared_ptr<const InterfaceRows> ThermalModel::rows_of(std::size_t pass, const RCP<const Map>& nodes) const {
  std::shared_ptr<const InterfaceRows>& kept = interface_rows[pass];
  if (kept && kept->nodes == nodes) return kept;
  const auto result = std::make_shared<InterfaceRows>();
  result->nodes = nodes;
  result->ids = temperature.ids_on(nodes);
  std::vector<GlobalOrdinal> rows;
  std::copy_if(result->ids.begin(), result->ids.end(), std::back_inserter(rows), [](GlobalOrdinal id) { return id != NodalField::none; });
  const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  result->rows = rcp(new Map(invalid, rows.data(), static_cast<LocalOrdinal>(rows.size()), 0, dofs->getComm()));
  result->to_owners = rcp(new Export(result->rows, dofs));
  return kept = result;
}

RCP<MultiVector> ThermalModel::on_owned_nodes(const NodalTemperature& theta) const {
  const auto result = rcp(new MultiVector(temperature.nodes(), 1));
  const auto view = result->getLocalViewHost(Tpetra::Access::OverwriteAll);
  const auto of_dofs = theta.dofs.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t node = 0; node < view.extent(0); ++node) {
    const GlobalOrdinal id = temperature.id(static_cast<LocalOrdinal>(node), 0);
    view(node, 0) = id != NodalField::none ? of_dofs(dofs->getLocalElement(id), 0) : std::numeric_limits<double>::quiet_NaN();
  }
  if (theta.nodes == nullptr) return result;
  const auto of_nodes = theta.nodes->getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t node = 0; node < view.extent(0); ++node)
    if (temperature.id(static_cast<LocalOrdinal>(node), 0) == NodalField::none) view(node, 0) = of_nodes(node, 0);
  return result;
}

}  // namespace detail

ThermalContact::ThermalContact(const ContactSystem& contact, const NodalField& temperature, RCP<const Map> dofs, std::vector<ThermalPair> pairs) {
  const auto model = std::make_shared<detail::ThermalModel>(contact, temperature);
  if (temperature.components() != 1)
    throw std::invalid_argument(
        fmt::format("thermal contact: the field '{}' has {} components; a temperature has 1", temperature.name(), temperature.components()));
  std::set<std::size_t> named;
  for (std::size_t n = 0; n < pairs.size(); ++n) {
    const ThermalPair& pair = pairs[n];
    const std::string& name = contact.pair_name(pair.pair);
    const auto refuse = [&](const std::string& what) { throw std::invalid_argument(fmt::format("thermal contact of pair '{}': {}", name, what)); };
    if (!named.insert(pair.pair).second) refuse("it is named twice");
    if (pair.conductance)
      if (const auto fault = pair.conductance->fault()) refuse(*fault);
    if (pair.gap)
      if (const auto fault = pair.gap->fault()) refuse(*fault);
    if (pair.slave_share && !(*pair.slave_share >= 0.0 && *pair.slave_share <= 1.0))
      refuse(fmt::format("the slave's share of the heat of friction is {:g}; allowed: 0 to 1", *pair.slave_share));
    model->passes.push_back({pair.pair, n, false});
    if (const auto second = contact.second_pass(pair.pair)) model->passes.push_back({*second, n, true});
  }
  model->dofs = std::move(dofs);
  model->pairs = std::move(pairs);
  model->interface_rows.resize(model->passes.size());
  model_ = model;
}

std::vector<ThermalContact::SurfaceTemperatures> ThermalContact::surface_temperatures(const ContactLaws& laws, const NodalTemperature& theta,
                                                                                      std::size_t thermal_pair) const {
  const RCP<MultiVector> owned = model_->on_owned_nodes(theta);
  std::vector<SurfaceTemperatures> result;
  for (const detail::ThermalPass& pass : model_->passes) {
    if (pass.thermal_pair != thermal_pair) continue;
    const FieldTransfer transfer(laws, pass.pair);
    const RCP<MultiVector> on_nodes = transfer.on_nodes(*owned);
    const auto values = on_nodes->getLocalViewHost(Tpetra::Access::ReadOnly);
    SurfaceTemperatures of_pass{pass.pair, {}};
    const std::vector<GlobalOrdinal> slaves = model_->contact.slave_ids(pass.pair);
    for (std::size_t s = 0; s < transfer.size(); ++s) {
      const double own = values(transfer.nodes()->getLocalElement(slaves[s]), 0);
      of_pass.values.push_back(transfer.is_covered(s) ? detail::mean_of_sides(transfer, transfer[s], values, own) : own);
    }
    result.push_back(std::move(of_pass));
  }
  return result;
}

std::vector<ThermalContact::SurfaceTemperatures> ThermalContact::slave_temperatures(const NodalTemperature& theta, std::size_t thermal_pair) const {
  const RCP<MultiVector> owned = model_->on_owned_nodes(theta);
  const auto values = owned->getLocalViewHost(Tpetra::Access::ReadOnly);
  std::vector<SurfaceTemperatures> result;
  for (const detail::ThermalPass& pass : model_->passes) {
    if (pass.thermal_pair != thermal_pair) continue;
    SurfaceTemperatures of_pass{pass.pair, {}};
    for (const GlobalOrdinal slave : model_->contact.slave_ids(pass.pair))
      of_pass.values.push_back(values(owned->getMap()->getLocalElement(slave), 0));
    result.push_back(std::move(of_pass));
  }
  return result;
}

ContactHeat ThermalContact::evaluate(const ContactLaws& laws, const NodalTemperature& theta, double time_step) const {
  return ContactHeat(std::make_shared<const detail::EvaluatedHeat>(detail::evaluated_heat(model_, laws, laws, theta, time_step, false)));
}

DifferentiatedHeat ThermalContact::differentiate(const ContactLinearisation& at, const NodalTemperature& theta, double time_step) const {
  return DifferentiatedHeat(std::make_shared<const detail::EvaluatedHeat>(detail::evaluated_heat(model_, at, at.laws(), theta, time_step, true)));
}

}  // namespace mortise
