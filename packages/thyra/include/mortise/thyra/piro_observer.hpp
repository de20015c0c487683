#pragma once
// Acceptance of steps by Piro.

#include <Piro_ObserverBase.hpp>

#include "mortise/thyra/model_with_contact.hpp"

namespace mortise {

/// Accepts what Piro's solvers give to observers, which are solutions, and hands it on.
class PiroObserver : public Piro::ObserverBase<Scalar> {
 public:
  /// @param next  the application's own observer; null: none
  explicit PiroObserver(RCP<ModelWithContact> model, RCP<Piro::ObserverBase<Scalar>> next = Teuchos::null)
      : model_(std::move(model)), next_(std::move(next)) {}
  using Piro::ObserverBase<Scalar>::observeSolution;
  /// Accepts x.
  void observeSolution(const ThyraVector& x) override {
    model_->accept_step(x);
    if (!next_.is_null()) next_->observeSolution(x);
  }
  /// Accepts x.
  void observeSolution(const ThyraVector& x, const Scalar stamp) override {
    model_->accept_step(x);
    if (!next_.is_null()) next_->observeSolution(x, stamp);
  }
  /// Accepts x.
  void observeSolution(const ThyraVector& x, const ThyraVector& x_dot, const Scalar stamp) override {
    model_->accept_step(x);
    if (!next_.is_null()) next_->observeSolution(x, x_dot, stamp);
  }
  /// Accepts x.
  void observeSolution(const ThyraVector& x, const ThyraVector& x_dot, const ThyraVector& x_dot_dot, const Scalar stamp) override {
    model_->accept_step(x);
    if (!next_.is_null()) next_->observeSolution(x, x_dot, x_dot_dot, stamp);
  }

 private:
  RCP<ModelWithContact> model_;
  RCP<Piro::ObserverBase<Scalar>> next_;
};

}  // namespace mortise
