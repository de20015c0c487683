#include "linearisation/left_out_couplings.hpp"

#include <BelosConfigDefs.hpp>
#include <BelosLinearProblem.hpp>
#include <BelosSolverFactory_Tpetra.hpp>
#include <BelosTpetraAdapter.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>

namespace mortise::detail {
namespace {

constexpr int most_iterations = 100;

using Solve = std::function<void(const Vector&, Vector&, Vector&)>;
using LeftOut = std::function<void(const Vector&, const Vector&, Vector&)>;

/// v -> v - W L s(W^-1 v), W the weights: rows are forces.
class Correction : public Operator {
 public:
  Correction(const Vector& weights, const Solve& solve, const LeftOut& left_out, const RCP<const Map>& dofs)
      : weights_(weights), solve_(solve), left_out_(left_out), dofs_(dofs) {}
  RCP<const Map> getDomainMap() const override { return weights_.getMap(); }
  RCP<const Map> getRangeMap() const override { return weights_.getMap(); }
  void apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp, Scalar alpha, Scalar beta) const override {
    for (std::size_t v = 0; v < x.getNumVectors(); ++v) {
      Vector w(weights_.getMap()), dd(dofs_), dz(weights_.getMap()), change(weights_.getMap());
      traction(*x.getVector(v), w);
      solve_(w, dd, dz);
      left_out_(dd, dz, change);
      w.elementWiseMultiply(-1.0, weights_, change, 0.0);
      w.update(1.0, *x.getVector(v), 1.0);
      y.getVectorNonConst(v)->update(alpha, w, beta);
    }
  }
  void traction(const Vector& force, Vector& w) const {
    const auto from = force.getLocalViewHost(Tpetra::Access::ReadOnly), weight = weights_.getLocalViewHost(Tpetra::Access::ReadOnly);
    const auto to = w.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (std::size_t i = 0; i < to.extent(0); ++i) to(i, 0) = from(i, 0) / weight(i, 0);
  }

 private:
  const Vector& weights_;
  const Solve& solve_;
  const LeftOut& left_out_;
  RCP<const Map> dofs_;
};

}  // namespace

void correct_step(const Vector& weights, double tolerance, const Solve& solve, const LeftOut& left_out, Vector& dd, Vector& dz) {
  const auto correction = rcp(new Correction(weights, solve, left_out, dd.getMap()));
  Vector change(weights.getMap());
  left_out(dd, dz, change);
  const auto b = rcp(new Vector(weights.getMap())), v = rcp(new Vector(weights.getMap()));
  b->elementWiseMultiply(1.0, weights, change, 0.0);
  if (b->norm2() == 0.0) return;
  const auto list = Teuchos::parameterList("Belos");
  list->set("Convergence Tolerance", tolerance);
  list->set("Maximum Iterations", most_iterations);
  list->set("Num Blocks", most_iterations);
  list->set("Verbosity", 0);
  Belos::TpetraSolverFactory<Scalar, MultiVector, Operator> factory;
  const auto gmres = factory.create("GMRES", list);
  const auto problem = rcp(new Belos::LinearProblem<Scalar, MultiVector, Operator>(correction, v, b));
  if (!problem->setProblem()) throw std::logic_error("Belos refuses the equations of tied multipliers");
  gmres->setProblem(problem);
  gmres->solve();
  Vector w(weights.getMap()), change_d(dd.getMap()), change_z(weights.getMap());
  correction->traction(*v, w);
  solve(w, change_d, change_z);
  dd.update(1.0, change_d, 1.0);
  dz.update(1.0, change_z, 1.0);
}

}  // namespace mortise::detail
