#pragma once
// The loops over the elements of one body, for one kind of cell.

#include <memory>

#include "elements/conduction.hpp"
#include "elements/storage.hpp"
#include "elements/thermal_block.hpp"

namespace mortise {

template <class Cell, bool axisymmetric>
class ThermalCellBlock final : public ThermalBlock {
  using Geometry = ElementGeometry<Cell, axisymmetric>;
  using Loop = ElementLoop<Cell>;

 public:
  explicit ThermalCellBlock(const ThermalBlockContext& context)
      : context_(context),
        loop_(context.space, context.block, context.temperature, context.conducts_by_displacement() ? context.displacement : std::nullopt) {}

  void add_conduction(const ThermalState& at, const AssemblyTarget& target, std::optional<StepFailure>& failure) const override {
    const ThermalProperties& properties = *context_.properties;
    if (context_.conducts_by_displacement())
      add(CurrentConduction<Geometry>{properties.conductivity, properties.acts_in == ConductivityActsIn::current}, at,
          std::array{of(at.unknowns), displacements(at)}, target, failure);
    else
      add(ReferenceConduction<Geometry>{properties.conductivity}, at, std::array{of(at.unknowns)}, target, failure);
  }

  void add_capacity(const ThermalState& at, double by_velocity, double by_unknowns, const AssemblyTarget& target,
                    std::optional<StepFailure>& failure) const override {
    const TemperatureFunction& c = context_.properties->specific_heat;
    if (!c.is_given()) return;
    const std::array fields{of(at.unknowns), of(at.velocity), of(at.velocity_shares)};
    if constexpr (Cell::nodes == Cell::corners)
      if (context_.properties->lumped_capacity)
        return add(LumpedCapacity<Geometry>{c, context_.density, by_velocity, by_unknowns, at.time_step}, at, fields, target, failure);
    add(ConsistentCapacity<Geometry>{c, context_.density, by_velocity, by_unknowns, at.time_step}, at, fields, target, failure);
  }

  void add_source(const ThermalState& at, const AssemblyTarget& target, std::optional<StepFailure>& failure) const override {
    if (const auto& source = context_.properties->source)
      add(VolumeSource<Geometry>{*source, at.time}, at, std::array{of(at.unknowns)}, target, failure);
  }

  void visit_fluxes(const ThermalState& at, LocalOrdinal count, const std::function<void(const HeatFluxPoint&)>& visit) const override {
    const ThermalProperties& properties = *context_.properties;
    const auto visit_each = [&](auto integrand, const auto& fields, const auto& visit_point) {
      using Integrand = decltype(integrand);
      const BlockIntegral<Integrand> integral(integrand, context_.block, context_.thickness);
      for (LocalOrdinal element = 0; element < count; ++element) {
        const auto points = loop_.template points_of<Integrand>(element, integral.rule, fields);
        for (int q = 0; q < Integrand::point_count; ++q) {
          const auto point = points[q];
          const auto& theta = std::get<0>(point.fields);
          HeatFluxPoint result{element, q, point.weight, {}};
          visit_point(point, theta, properties.conductivity.at(theta.value), result);
          visit(result);
        }
      }
    };
    if (context_.displacement)
      visit_each(CurrentConduction<Geometry>{properties.conductivity, true}, std::array{of(at.unknowns), displacements(at)},
                 [&](const auto& point, const auto& theta, double k, HeatFluxPoint& result) {
                   const auto& motion = std::get<1>(point.fields);
                   result.weight *= motion.determinant;
                   result.flux = current_flux<Geometry>(motion, theta.gradient, k, properties.acts_in);
                 });
    else
      visit_each(ReferenceConduction<Geometry>{properties.conductivity}, std::array{of(at.unknowns)},
                 [](const auto&, const auto& theta, double k, HeatFluxPoint& result) {
                   for (int i = 0; i < Cell::dimension; ++i) result.flux[i] = -k * theta.gradient[i];
                 });
  }

 private:
  FieldView<const double> of(const double* values) const { return {values, loop_.rows()}; }
  FieldView<const double> displacements(const ThermalState& at) const { return {at.unknowns, context_.space.rows(*context_.displacement)}; }

  // The tangent's loop has the residual at hand, and is compiled once with it.
  template <class Integrand, std::size_t fields>
  void add(const Integrand& integrand, const ThermalState& at, const std::array<FieldView<const double>, fields>& values,
           const AssemblyTarget& target, std::optional<StepFailure>& failure) const {
    const BlockIntegral<Integrand> integral(integrand, context_.block, context_.thickness);
    const auto report = [&](LocalOrdinal element, const HeatTrouble& trouble) {
      if (!failure) failure = failure_of(trouble, context_, element, at.time);
    };
    if (target.matrix != nullptr)
      loop_.template add<true, true>(integral, values, target, report);
    else
      loop_.template add<true, false>(integral, values, target, report);
  }

  ThermalBlockContext context_;
  Loop loop_;
};

/// The block if the context's cells are of the kind that `takes(cell)` is true of.
template <class Takes>
std::unique_ptr<ThermalBlock> make_cell_block(const ThermalBlockContext& context, const Takes& takes) {
  return visit_cell(context.block.shape, [&](auto cell) -> std::unique_ptr<ThermalBlock> {
    using Cell = decltype(cell);
    if constexpr (decltype(takes(cell))::value) {
      if constexpr (Cell::dimension == 2)
        if (context.kinematics == Kinematics::axisymmetric) return std::make_unique<ThermalCellBlock<Cell, true>>(context);
      return std::make_unique<ThermalCellBlock<Cell, false>>(context);
    }
    throw std::logic_error("a cell that another source makes blocks of");
  });
}

}  // namespace mortise
