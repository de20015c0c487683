#include "linearisation/left_out_couplings.hpp"

#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>

#include "linearisation/gmres.hpp"

namespace mortise::detail {
namespace {

constexpr int most_iterations = 100;

Vector over_weights(const Vector& force, const Vector& weights) {
  Vector w(weights.getMap());
  const auto from = force.getLocalViewHost(Tpetra::Access::ReadOnly), weight = weights.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto to = w.getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (std::size_t i = 0; i < to.extent(0); ++i) to(i, 0) = from(i, 0) / weight(i, 0);
  return w;
}

}  // namespace

// Rows of the equations are forces:  v - W L s(W^-1 v) = W L (dd, dz),  W the weights.
void correct_step(const Vector& weights, double tolerance, const std::function<void(const Vector&, Vector&, Vector&)>& solve,
                  const std::function<void(const Vector&, const Vector&, Vector&)>& left_out, Vector& dd, Vector& dz) {
  Vector change_d(dd.getMap()), change_z(weights.getMap()), change(weights.getMap()), b(weights.getMap());
  left_out(dd, dz, change);
  b.elementWiseMultiply(1.0, weights, change, 0.0);
  if (b.norm2() == 0.0) return;
  const auto equations = [&](const Vector& v, Vector& y) {
    Vector step_d(dd.getMap()), step_z(weights.getMap());
    solve(over_weights(v, weights), step_d, step_z);
    left_out(step_d, step_z, change);
    y.elementWiseMultiply(-1.0, weights, change, 0.0);
    y.update(1.0, v, 1.0);
  };
  solve(over_weights(gmres(equations, b, tolerance, most_iterations), weights), change_d, change_z);
  dd.update(1.0, change_d, 1.0);
  dz.update(1.0, change_z, 1.0);
}

}  // namespace mortise::detail
