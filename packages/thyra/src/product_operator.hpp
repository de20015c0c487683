#pragma once
// W of a model whose unknowns are displacements and multipliers.

#include <Thyra_LinearOpBase.hpp>
#include <Thyra_LinearOpDefaultBase.hpp>
#include <Thyra_ProductVectorSpaceBase.hpp>
#include <memory>
#include <optional>

#include "condensed_matrix.hpp"
#include "contact_solve.hpp"
#include "mortise/contact/contact_linearisation.hpp"
#include "step_memory.hpp"

namespace mortise::detail {

/// weight [ K~ B ; A_j C_d  A_j C_z ]. K~ and B have the rows of heat of contact too. weight K has the weights of time derivatives in
/// it. Rows of prescribed dofs are the model's, or those that replace them.
class ProductOperator : public ::Thyra::LinearOpDefaultBase<Scalar>, public SolvedByCondensing {
 public:
  ProductOperator(std::shared_ptr<StepMemory> memory, RCP<const ::Thyra::ProductVectorSpaceBase<Scalar>> space);
  /// W at an iterate, of the application's own matrix.
  void assemble(const RCP<const Matrix>& K, double weight, const ContactIterate& iterate);

  RCP<const ::Thyra::VectorSpaceBase<Scalar>> range() const override { return space_; }
  RCP<const ::Thyra::VectorSpaceBase<Scalar>> domain() const override { return space_; }
  RCP<const ::Thyra::LinearOpBase<Scalar>> condensed() const override;
  long graph_number() const override { return graph_number_; }
  void solve(const ::Thyra::VectorBase<Scalar>& b, const NodeElimination::Solve& inner, ::Thyra::VectorBase<Scalar>& x) const override;

 protected:
  bool opSupportedImpl(::Thyra::EOpTransp transposed) const override { return transposed == ::Thyra::NOTRANS; }
  void applyImpl(const ::Thyra::EOpTransp transposed, const ::Thyra::MultiVectorBase<Scalar>& x,
                 const Teuchos::Ptr<::Thyra::MultiVectorBase<Scalar>>& y, const Scalar alpha, const Scalar beta) const override;

 private:
  RCP<const ::Thyra::LinearOpBase<Scalar>> merged() const;
  const Matrix* of_heat() const { return heat_ ? heat_->of_multipliers().get() : nullptr; }  ///< the rows of heat in B; null: none

  std::shared_ptr<StepMemory> memory_;
  RCP<const ::Thyra::ProductVectorSpaceBase<Scalar>> space_;
  RCP<const Matrix> K_;    ///< the application's
  CondensedMatrix whole_;  ///< K~
  SaddlePointBlocks blocks_;
  std::optional<ContactLinearisation> linearised_;
  std::optional<HeatOfIterate> heat_;  ///< none: the model has no heat
  double weight_ = 1.0;
  long graph_number_ = 0;
  mutable RCP<Matrix> solved_;                          ///< the matrix of the solver: condensed or merged
  mutable std::optional<NodeElimination> elimination_;  ///< none: multipliers stay
};

}  // namespace mortise::detail
