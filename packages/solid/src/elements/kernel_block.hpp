#pragma once
// The loops over the elements of one body.

#include <fmt/format.h>

#include <cstring>
#include <limits>
#include <type_traits>

#include "elements/cell_block.hpp"
#include "elements/element_kernel.hpp"
#include "mortise/material/materials.hpp"

namespace mortise {

template <class Cell, Kinematics kinematics, ElementFormulation formulation, class PlainLaw>
class KernelBlock final : public ElementBlock {
  using Kernel = ElementKernel<Cell, kinematics, formulation, PlainLaw>;
  using Positions = typename Kernel::Positions;
  static constexpr int nodes = Kernel::nodes, dimension = Kernel::dimension;

 public:
  KernelBlock(const BlockContext& context, const PlainLaw& law, double thickness)
      : context_(context), kernel_(law, thickness), owned_nodes_(context.mesh.owned_count()) {
    const Block& block = context_.block;
    positions_.reserve(static_cast<std::size_t>(block.size()) * nodes * nodes);
    for (LocalOrdinal element = 0; element < block.size(); ++element)
      for (int a = 0; a < nodes; ++a)
        for (int b = 0; b < nodes; ++b) positions_.push_back(context_.sparsity.position(block.nodes(element)[a], block.nodes(element)[b]));
    if constexpr (Kernel::history) history_.resize(block.size());
  }

  void add_internal_force(const double* displacement, double* force, std::optional<StepFailure>& failure) const override {
    count_history_evaluation();
    typename Kernel::Stiffness unused;
    for (LocalOrdinal element = 0; element < context_.block.size(); ++element) {
      const LocalOrdinal* node = context_.block.nodes(element);
      if (!touches_owned(node)) continue;
      typename Kernel::Force element_force{};
      const ElementTrouble trouble = kernel_.template add<false>(reference(node), gather(node, displacement), states(element), element_force, unused);
      if (trouble) report(element, trouble, failure);
      for (int a = 0; a < nodes; ++a)
        if (node[a] < owned_nodes_)
          for (int i = 0; i < dimension; ++i) force[dimension * node[a] + i] += element_force[dimension * a + i];
    }
  }

  void add_stiffness(const double* displacement, const NodalSparsity::Values& matrix, double factor,
                     std::optional<StepFailure>& failure) const override {
    count_history_evaluation();
    for (LocalOrdinal element = 0; element < context_.block.size(); ++element) {
      const LocalOrdinal* node = context_.block.nodes(element);
      if (!touches_owned(node)) continue;
      typename Kernel::Force unused{};
      typename Kernel::Stiffness stiffness{};
      const ElementTrouble trouble = kernel_.template add<true>(reference(node), gather(node, displacement), states(element), unused, stiffness);
      if (trouble) report(element, trouble, failure);
      const LocalOrdinal* position = positions_.data() + static_cast<std::size_t>(element) * nodes * nodes;
      for (int a = 0; a < nodes; ++a) {
        if (node[a] >= owned_nodes_) continue;
        for (int i = 0; i < dimension; ++i) {
          double* row = matrix.row(dimension * node[a] + i);
          for (int b = 0; b < nodes; ++b)
            for (int k = 0; k < dimension; ++k)
              row[position[a * nodes + b] + k] += factor * stiffness[dimension * a + i][Kernel::Tangent::column(b, k)];
        }
      }
    }
  }

  void visit_points(const double* displacement, LocalOrdinal count, const std::function<void(const MaterialPoint&)>& visit) const override {
    for (LocalOrdinal element = 0; element < count; ++element) {
      const LocalOrdinal* node = context_.block.nodes(element);
      const Positions X = reference(node), u = gather(node, displacement);
      for (int q = 0; q < Kernel::points; ++q) {
        MaterialPoint point = kernel_.material_point(q, X, u, states(element));
        point.block = context_.index;
        point.element = element;
        visit(point);
      }
    }
  }

  void commit([[maybe_unused]] const double* displacement) override {
    count_history_evaluation();
    if constexpr (Kernel::history)
      for (LocalOrdinal element = 0; element < context_.block.size(); ++element) {
        const LocalOrdinal* node = context_.block.nodes(element);
        kernel_.commit(reference(node), gather(node, displacement), history_[element]);
      }
  }

  void serialize([[maybe_unused]] StateArchive& archive, [[maybe_unused]] const std::string& name) override {
    if constexpr (Kernel::history) {
      using States = typename Kernel::States;
      static_assert(std::is_trivially_copyable_v<States> && sizeof(States) % sizeof(double) == 0, "a history is stored as numbers");
      constexpr std::size_t columns = sizeof(States) / sizeof(double);
      std::vector<double> rows(columns * history_.size());
      std::memcpy(rows.data(), history_.data(), rows.size() * sizeof(double));
      archive.rows(name + ".history", {name + ".elements", context_.block.element_ids, static_cast<std::size_t>(context_.block.owned)}, columns,
                   rows);
      if (archive.restores()) std::memcpy(static_cast<void*>(history_.data()), rows.data(), rows.size() * sizeof(double));
    }
  }

  std::size_t history_bytes() const override { return history_.capacity() * sizeof(typename Kernel::States); }
  long history_evaluations() const override { return history_evaluations_; }

  void add_nodal_volumes(std::vector<double>& volumes) const override {
    for (LocalOrdinal element = 0; element < context_.block.size(); ++element) {
      const LocalOrdinal* node = context_.block.nodes(element);
      std::array<double, nodes> element_volumes{};
      kernel_.add_volumes(reference(node), element_volumes);
      for (int a = 0; a < nodes; ++a)
        if (node[a] < owned_nodes_) volumes[node[a]] += element_volumes[a];
    }
  }

  std::pair<LocalOrdinal, double> smallest_reference_determinant() const override {
    std::pair<LocalOrdinal, double> smallest{-1, std::numeric_limits<double>::infinity()};
    for (LocalOrdinal element = 0; element < context_.block.size(); ++element) {
      const double determinant = kernel_.smallest_reference_determinant(reference(context_.block.nodes(element)));
      if (!(determinant >= smallest.second)) smallest = {element, determinant};
    }
    return smallest;
  }

 private:
  bool touches_owned(const LocalOrdinal* node) const {
    for (int a = 0; a < nodes; ++a)
      if (node[a] < owned_nodes_) return true;
    return false;
  }

  void count_history_evaluation() const {
    if constexpr (Kernel::history) ++history_evaluations_;
  }

  Positions reference(const LocalOrdinal* node) const {
    Positions X;
    for (int a = 0; a < nodes; ++a) std::copy_n(context_.mesh.coordinates[node[a]].begin(), dimension, X[a].begin());
    return X;
  }

  static Positions gather(const LocalOrdinal* node, const double* displacement) {
    Positions u;
    for (int a = 0; a < nodes; ++a) std::copy_n(displacement + dimension * node[a], dimension, u[a].begin());
    return u;
  }

  const typename Kernel::States& states([[maybe_unused]] LocalOrdinal element) const {
    if constexpr (Kernel::history) {
      return history_[element];
    } else {
      static constexpr typename Kernel::States none{};
      return none;
    }
  }

  void report(LocalOrdinal element, const ElementTrouble& trouble, std::optional<StepFailure>& failure) const {
    if (failure) return;
    const GlobalOrdinal id = context_.block.element_ids[element];
    if (trouble.kind == ElementTrouble::Kind::inverted)
      failure.emplace(FailureKind::inverted_element,
                      fmt::format("body \"{}\": element {} {} is turned inside out, det F = {:.3g}", context_.mesh.body_of(context_.block).name, id,
                                  element_place(context_, element), trouble.determinant));
    else
      failure.emplace(FailureKind::material,
                      fmt::format("body \"{}\": the law \"{}\" finds no stress at point {} of element {} {}, where det F = {:.3g}",
                                  context_.mesh.body_of(context_.block).name, PlainLaw::name, trouble.point, id, element_place(context_, element),
                                  trouble.determinant));
  }

  BlockContext context_;
  Kernel kernel_;
  LocalOrdinal owned_nodes_;
  std::vector<typename Kernel::States> history_;  ///< [elements] of the last committed step; empty for laws without a history
  mutable long history_evaluations_ = 0;
  std::vector<LocalOrdinal> positions_;  ///< [elements x nodes x nodes] NodalSparsity::position
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
