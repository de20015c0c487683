#include "mortise/thermal_contact/contact_heat.hpp"

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Export.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <array>

#include "evaluated_heat.hpp"
#include "matrices_of_heat.hpp"
#include "mortise/core/over_ranks.hpp"

namespace mortise {

// The exports of two passes may give to one row. An export with ADD replaces what the rank itself sends to itself: hence vectors that start at 0.
void ContactHeat::add_to(Vector& r) const {
  for (const detail::EvaluatedPass& pass : heat_->passes) {
    Vector on_nodes(pass.interface->rows), on_dofs(heat_->model->dofs);
    {
      const auto view = on_nodes.getLocalViewHost(Tpetra::Access::ReadWrite);
      for (const detail::RowsOfHeat& rows : pass.nodes)
        for (std::size_t m = 0; m < rows.nodes.size(); ++m)
          if (const GlobalOrdinal id = pass.interface->ids[static_cast<std::size_t>(rows.nodes[m])]; id != NodalField::none)
            view(pass.interface->rows->getLocalElement(id), 0) += rows.values[m];
    }
    on_dofs.doExport(on_nodes, *pass.interface->to_owners, Tpetra::ADD);
    r.update(1.0, on_dofs, 1.0);
  }
}

HeatFlow ContactHeat::flow(std::size_t thermal_pair) const {
  std::array<double, 4> mine{};
  auto& [conducted, friction, slave, master] = mine;
  for (std::size_t p = 0; p < heat_->passes.size(); ++p) {
    const detail::ThermalPass& pass = heat_->model->passes[p];
    if (pass.thermal_pair != thermal_pair) continue;
    const detail::EvaluatedPass& at = heat_->passes[p];
    for (const detail::RowsOfHeat& rows : at.nodes) {
      conducted += (pass.exchanged ? -1.0 : 1.0) * rows.heat.weight * rows.heat.flux;
      friction += rows.heat.friction;
      for (std::size_t m = 0; m < rows.nodes.size(); ++m)
        if (at.interface->ids[static_cast<std::size_t>(rows.nodes[m])] == NodalField::none)
          (rows.of_slave[m] != static_cast<char>(pass.exchanged) ? slave : master) -= rows.values[m];
    }
  }
  const std::vector<double> all = sum_over_ranks(*heat_->model->dofs->getComm(), std::vector<double>(mine.begin(), mine.end()));
  return {all[0], all[1], all[2], all[3]};
}

std::vector<NodeHeat> ContactHeat::nodes(std::size_t thermal_pair) const {
  std::vector<NodeHeat> result;
  for (std::size_t p = 0; p < heat_->passes.size(); ++p)
    if (heat_->model->passes[p].thermal_pair == thermal_pair)
      for (const detail::RowsOfHeat& rows : heat_->passes[p].nodes) result.push_back(rows.heat);
  return result;
}

RCP<const Matrix> DifferentiatedHeat::of_dofs() const { return heat_->of_dofs; }
RCP<const Matrix> DifferentiatedHeat::of_multipliers() const { return heat_->of_multipliers; }

// r + dr/d(theta, d) (dtheta, dd) + G (z - z^k) = 0  with  z = b + S dd.
void DifferentiatedHeat::condense(const NodeElimination& condensed, Matrix& system, Vector& rhs) const {
  if (heat_->of_dofs.is_null()) return;
  Vector r(heat_->model->dofs);
  add_to(r);
  rhs.update(-1.0, r, 1.0);
  heat_->of_multipliers->apply(*heat_->z, rhs, Teuchos::NO_TRANS, 1.0, 1.0);
  const SubstitutedRows substituted = condensed.substitute(*heat_->of_multipliers);
  rhs.update(-1.0, *substituted.constant, 1.0);
  detail::add_rows(*heat_->of_dofs, system);
  detail::add_rows(*substituted.of_dofs, system);
}

}  // namespace mortise
