#pragma once
// What a block has in the reference configuration, whatever its law: volumes, masses, the determinant of its cells.

#include <algorithm>
#include <limits>

#include "elements/element_block.hpp"
#include "elements/inertia.hpp"
#include "mortise/solid/element_loop.hpp"

namespace mortise {

template <class Cell, bool axisymmetric>
class ReferenceBlock : public ElementBlock {
  using Geometry = ElementGeometry<Cell, axisymmetric>;

 public:
  /// `coupled`: a field whose columns the rows of displacements have entries in.
  ReferenceBlock(const BlockContext& context, double thickness, std::optional<std::size_t> coupled = std::nullopt)
      : context_(context), loop_(context.space, context.block, 0, coupled), thickness_(thickness) {}

  void add_mass(double density, const NodalSparsity::Values& matrix, double factor) const override {
    add<false, true>(Inertia<Geometry>{density}, {{}, &matrix, factor});
  }

  void add_nodal_masses(double density, std::vector<double>& masses) const override {
    add<true, false>(LumpedInertia<Geometry>{density}, {{masses.data()}});
  }

  void add_nodal_volumes(std::vector<double>& volumes) const override { add<true, false>(Volume<Geometry>{}, {{volumes.data()}}); }

  std::pair<LocalOrdinal, double> smallest_reference_determinant() const override {
    const ElementRule<Geometry, Geometry::stiffness_points> rule(thickness_);
    std::pair<LocalOrdinal, double> smallest{-1, std::numeric_limits<double>::infinity()};
    for (LocalOrdinal element = 0; element < context_.block.size(); ++element) {
      const auto X = loop_.reference(context_.block.nodes(element));
      double determinant = Geometry::jacobian(rule.centre, X).determinant();
      for (const auto& shape : rule.points) determinant = std::min(determinant, Geometry::jacobian(shape, X).determinant());
      if (!(determinant >= smallest.second)) smallest = {element, determinant};
    }
    return smallest;
  }

 protected:
  const BlockContext& context() const { return context_; }
  const ElementLoop<Cell>& loop() const { return loop_; }

 private:
  template <bool residual_wanted, bool tangent_wanted, class Integrand>
  void add(const Integrand& integrand, const AssemblyTarget& target) const {
    loop_.template add<residual_wanted, tangent_wanted>(BlockIntegral<Integrand>(integrand, context_.block, thickness_),
                                                        typename ElementLoop<Cell>::template Fields<0>{}, target);
  }

  BlockContext context_;
  ElementLoop<Cell> loop_;
  double thickness_;
};

}  // namespace mortise
