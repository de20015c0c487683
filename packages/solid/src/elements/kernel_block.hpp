#pragma once
// The loops over the elements of one body.

#include <fmt/format.h>

#include "elements/cell_block.hpp"
#include "elements/element_kernel.hpp"
#include "elements/reference_block.hpp"
#include "mortise/material/materials.hpp"

namespace mortise {

template <class Cell, Kinematics kinematics, ElementFormulation formulation, class PlainLaw>
class KernelBlock final : public ReferenceBlock<Cell, kinematics == Kinematics::axisymmetric> {
  using Element = Mechanics<Cell, kinematics, formulation, PlainLaw>;
  using Base = ReferenceBlock<Cell, kinematics == Kinematics::axisymmetric>;
  using Base::context, Base::loop;

 public:
  KernelBlock(const BlockContext& of_block, const PlainLaw& law, double thickness)
      : Base(of_block, thickness), mechanics_(Element(law), of_block.block, thickness) {}

  // The tangent's loop has the forces at hand, and is compiled once with them.
  void add(const double* displacement, double /*time_step*/, const AssemblyTarget& target, std::optional<StepFailure>& failure) const override {
    count_history_evaluation();
    const auto report = [&](LocalOrdinal element, const ElementTrouble& trouble) { this->report(element, trouble, failure); };
    if (target.matrix != nullptr)
      loop().template add<true, true>(mechanics_, fields(displacement), target, report);
    else
      loop().template add<true, false>(mechanics_, fields(displacement), target, report);
  }

  void visit_points(const double* displacement, LocalOrdinal count, const std::function<void(const MaterialPoint&)>& visit) const override {
    for (LocalOrdinal element = 0; element < count; ++element) {
      const auto points = points_of(element, displacement);
      for (int q = 0; q < Element::point_count; ++q) {
        MaterialPoint point = mechanics_.integrand.material_point(q, points, mechanics_.history[element]);
        point.block = context().index;
        point.element = element;
        visit(point);
      }
    }
  }

  void commit([[maybe_unused]] const double* displacement) override {
    count_history_evaluation();
    if constexpr (Element::history)
      for (LocalOrdinal element = 0; element < context().block.size(); ++element)
        mechanics_.integrand.commit(points_of(element, displacement), mechanics_.history[element]);
  }

  void serialize(StateArchive& archive, const std::string& name) override { mechanics_.history.serialize(archive, name, context().block); }
  std::size_t history_bytes() const override { return mechanics_.history.bytes(); }
  long history_evaluations() const override { return history_evaluations_; }

 private:
  std::array<FieldView<const double>, 1> fields(const double* displacement) const { return {{{displacement, loop().rows()}}}; }

  auto points_of(LocalOrdinal element, const double* displacement) const {
    return loop().template points_of<Element>(element, mechanics_.rule, fields(displacement));
  }

  void count_history_evaluation() const {
    if constexpr (Element::history) ++history_evaluations_;
  }

  void report(LocalOrdinal element, const ElementTrouble& trouble, std::optional<StepFailure>& failure) const {
    if (failure) return;
    if (trouble.kind == ElementTrouble::Kind::inverted)
      failure.emplace(inverted(context(), element, trouble.determinant));
    else
      failure.emplace(
          without_stress(context(), element, trouble.point, trouble.determinant, fmt::format("the law \"{}\" finds no stress", PlainLaw::name)));
  }

  BlockIntegral<Element> mechanics_;
  mutable long history_evaluations_ = 0;
};

/// The block with these elements of the law, for the kinematics that they and it have.
template <class Cell, ElementFormulation formulation, class PlainLaw>
std::unique_ptr<ElementBlock> make_kernel_block(const BlockContext& context, const PlainLaw& law, Kinematics kinematics, double thickness) {
  constexpr bool f_bar = formulation == ElementFormulation::f_bar;
  if constexpr (!(f_bar && PlainLaw::small_strain)) {
    if constexpr (Cell::dimension == 3) {
      if (kinematics == Kinematics::three_dimensional)
        return std::make_unique<KernelBlock<Cell, Kinematics::three_dimensional, formulation, PlainLaw>>(context, law, thickness);
    } else {
      if (kinematics == Kinematics::plane_strain)
        return std::make_unique<KernelBlock<Cell, Kinematics::plane_strain, formulation, PlainLaw>>(context, law, thickness);
      if (kinematics == Kinematics::axisymmetric)
        return std::make_unique<KernelBlock<Cell, Kinematics::axisymmetric, formulation, PlainLaw>>(context, law, thickness);
      if constexpr (PlainLaw::plane_stress && !f_bar)
        if (kinematics == Kinematics::plane_stress)
          return std::make_unique<KernelBlock<Cell, Kinematics::plane_stress, formulation, PlainLaw>>(context, law, thickness);
    }
  }
  throw std::logic_error("a combination of element, kinematics and law that check_combination refuses");
}

template <class Cell, ElementFormulation formulation>
std::unique_ptr<ElementBlock> make_cell_block(const BlockContext& context, const Law& law, Kinematics kinematics, double thickness) {
  return std::visit([&](const auto& plain) { return make_kernel_block<Cell, formulation>(context, plain, kinematics, thickness); }, law);
}

}  // namespace mortise
