#pragma once
// Acceptance of steps by NOX.

#include <NOX_Abstract_Group.H>
#include <NOX_Solver_Generic.H>
#include <NOX_Thyra_Vector.H>

#include <NOX_Observer.hpp>

#include "mortise/thyra/model_with_contact.hpp"

namespace mortise {

/// Accepts what a nonlinear solve converged to. For applications in which each converged solve is an accepted step. Where a step may still be
/// rejected, as by an error of the time scheme, call accept_step() itself, or let Piro observe.
class NoxObserver : public NOX::Observer {
 public:
  /// Accepts steps of `model`.
  explicit NoxObserver(RCP<ModelWithContact> model) : model_(std::move(model)) {}
  /// Accepts the solution of a solve that converged.
  void runPostSolve(const NOX::Solver::Generic& solver) override {
    if (solver.getStatus() == NOX::StatusTest::Converged)
      model_->accept_step(dynamic_cast<const NOX::Thyra::Vector&>(solver.getSolutionGroup().getX()).getThyraVector());
  }

 private:
  RCP<ModelWithContact> model_;
};

}  // namespace mortise
