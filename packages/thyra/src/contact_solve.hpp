#pragma once
// The solve with W of a model with contact: the application's solver, with what condensation asks for around it.

#include <Thyra_LinearOpWithSolveBase.hpp>
#include <Thyra_LinearOpWithSolveFactoryBase.hpp>
#include <functional>

#include "mortise/contact/node_elimination.hpp"
#include "mortise/thyra/model_with_contact.hpp"

namespace mortise::detail {

/// A W_op that is solved with by means of another matrix, which the application's solver gets.
class SolvedByCondensing {
 public:
  virtual ~SolvedByCondensing() = default;
  /// The operator that the application's solver gets, and what numbers its graphs. Called where the solver is initialised.
  virtual RCP<const ::Thyra::LinearOpBase<Scalar>> condensed() const = 0;
  virtual long graph_number() const = 0;  ///< another one for another graph: solvers are made anew
  /// x = W^-1 b with the solver of the condensed system.
  virtual void solve(const ::Thyra::VectorBase<Scalar>& b, const NodeElimination::Solve& inner, ::Thyra::VectorBase<Scalar>& x) const = 0;
};

/// A factory of such solvers, around the application's.
RCP<const ThyraSolverFactory> contact_solver_factory(const RCP<const ThyraSolverFactory>& inner);

}  // namespace mortise::detail
