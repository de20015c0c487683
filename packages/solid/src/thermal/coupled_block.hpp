#pragma once
// The loops over the elements of one body whose law knows the temperature.

#include <fmt/format.h>

#include <memory>
#include <utility>

#include "elements/reference_block.hpp"
#include "thermal/point_memory.hpp"
#include "thermal/thermal_block.hpp"
#include "thermal/thermo_mechanics.hpp"

namespace mortise {

template <class Cell, Kinematics kinematics, ElementFormulation formulation>
class CoupledBlock final : public ReferenceBlock<Cell, kinematics == Kinematics::axisymmetric> {
  using Element = ThermoMechanics<Cell, kinematics, formulation>;
  using Base = ReferenceBlock<Cell, kinematics == Kinematics::axisymmetric>;
  using Base::context, Base::loop;

 public:
  CoupledBlock(const BlockContext& of_block, std::size_t temperature, std::unique_ptr<const ThermalLaw> law, double thickness)
      : Base(of_block, thickness, temperature),
        law_(std::move(law)),
        mechanics_(*law_),
        rule_(thickness),
        memory_(of_block.block, Element::point_count, *law_),
        heat_loop_(of_block.space, of_block.block, temperature, 0) {}

  void add(const double* unknowns, double time_step, const AssemblyTarget& target, std::optional<StepFailure>& failure) const override {
    count_history_evaluation();
    if (target.matrix != nullptr)
      add_elements<true>(unknowns, time_step, target, failure);
    else
      add_elements<false>(unknowns, time_step, target, failure);
  }

  bool heats() const override { return law_->heats(); }

  double heat(const double* unknowns, double time_step, LocalOrdinal count) const override {
    double sum = 0.0;
    if (heats())
      for (LocalOrdinal element = 0; element < count; ++element)
        sum += mechanics_.heat(points_of(element, unknowns), memory_of(memory_, element), time_step);
    return sum;
  }

  void visit_points(const double* unknowns, LocalOrdinal count, const std::function<void(const MaterialPoint&)>& visit) const override {
    for (LocalOrdinal element = 0; element < count; ++element) {
      const auto points = points_of(element, unknowns);
      for (int q = 0; q < Element::point_count; ++q) {
        MaterialPoint point = mechanics_.material_point(q, points, memory_.at(element, q));
        point.block = context().index;
        point.element = element;
        visit(point);
      }
    }
  }

  void begin(const double* unknowns) override {
    if (memory_.exists())
      for (LocalOrdinal element = 0; element < context().block.size(); ++element)
        mechanics_.begin(points_of(element, unknowns), memory_of(memory_, element));
  }

  void commit(const double* unknowns) override {
    count_history_evaluation();
    if (memory_.exists())
      for (LocalOrdinal element = 0; element < context().block.size(); ++element)
        mechanics_.commit(points_of(element, unknowns), memory_of(memory_, element));
  }

  void serialize(StateArchive& archive, const std::string& name) override { memory_.serialize(archive, name, context().block); }
  std::size_t history_bytes() const override { return memory_.bytes(); }
  long history_evaluations() const override { return history_evaluations_; }

 private:
  template <class Memory>
  static auto memory_of(Memory& memory, LocalOrdinal element) {
    return [&memory, element](int q) { return memory.at(element, q); };
  }

  auto points_of(LocalOrdinal element, const double* unknowns) const {
    const std::array<FieldView<const double>, 2> fields{{{unknowns, loop().rows()}, {unknowns, heat_loop_.rows()}}};
    return loop().template points_of<Element>(element, rule_, fields);
  }

  template <bool with_tangent>
  void add_elements(const double* unknowns, double time_step, const AssemblyTarget& target, std::optional<StepFailure>& failure) const {
    const AssemblyTarget heat_target{{target.residual.values, heat_loop_.rows()}, target.matrix, target.factor};
    for (LocalOrdinal element = 0; element < context().block.size(); ++element) {
      if (!loop().touches_owned(element)) continue;
      ElementSums<typename Element::Forces, true, with_tangent> forces;
      ElementSums<typename Element::Heat, true, with_tangent> heat;
      if (const auto trouble = mechanics_.add(points_of(element, unknowns), memory_of(memory_, element), time_step, forces, heat))
        report(element, trouble, failure);
      loop().add_sums(element, forces, target);
      if (heats()) heat_loop_.add_sums(element, heat, heat_target);
    }
  }

  void report(LocalOrdinal element, const ThermalTrouble& trouble, std::optional<StepFailure>& failure) const {
    if (failure) return;
    if (trouble.kind == ElementTrouble::Kind::inverted) {
      failure.emplace(inverted(context(), element, trouble.determinant));
      return;
    }
    const std::string fault =
        law_->fault(trouble.at, memory_.at(element, trouble.point)).value_or(fmt::format("the law \"{}\" finds no stress", law_->name()));
    failure.emplace(without_stress(context(), element, trouble.point, trouble.determinant, fault));
  }

  void count_history_evaluation() const {
    if (memory_.exists()) ++history_evaluations_;
  }

  std::unique_ptr<const ThermalLaw> law_;
  Element mechanics_;
  typename Element::Points::Rule rule_;
  PointMemory memory_;
  ElementLoop<Cell> heat_loop_;  ///< rows of the temperature, coupled to displacements
  mutable long history_evaluations_ = 0;
};

template <class Cell, ElementFormulation formulation>
std::unique_ptr<ElementBlock> make_thermal_block(const BlockContext& context, std::size_t temperature, std::unique_ptr<const ThermalLaw> law,
                                                 Kinematics kinematics, double thickness) {
  constexpr bool f_bar = formulation == ElementFormulation::f_bar;
  if constexpr (Cell::dimension == 3) {
    if (kinematics == Kinematics::three_dimensional)
      return std::make_unique<CoupledBlock<Cell, Kinematics::three_dimensional, formulation>>(context, temperature, std::move(law), thickness);
  } else {
    if (kinematics == Kinematics::plane_strain)
      return std::make_unique<CoupledBlock<Cell, Kinematics::plane_strain, formulation>>(context, temperature, std::move(law), thickness);
    if (kinematics == Kinematics::axisymmetric)
      return std::make_unique<CoupledBlock<Cell, Kinematics::axisymmetric, formulation>>(context, temperature, std::move(law), thickness);
    if constexpr (!f_bar)
      if (kinematics == Kinematics::plane_stress)
        return std::make_unique<CoupledBlock<Cell, Kinematics::plane_stress, formulation>>(context, temperature, std::move(law), thickness);
  }
  throw std::logic_error("a combination of element, kinematics and law that check_combination refuses");
}

}  // namespace mortise
