#include "linearisation/gmres.hpp"

#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <cmath>
#include <vector>

namespace mortise::detail {
namespace {

/// What turns (a, b) into (r, 0).
struct Rotation {
  double c = 1.0, s = 0.0;
  void turn(double& a, double& b) const {
    const double first = c * a + s * b;
    b = c * b - s * a;
    a = first;
  }
};

}  // namespace

Vector gmres(const LinearMap& A, const Vector& b, double tolerance, int most) {
  Vector x(b.getMap());
  const double size = b.norm2();
  if (!(size > 0.0)) return x;
  std::vector<Vector> basis{Vector(b, Teuchos::Copy)};
  basis[0].scale(1.0 / size);
  std::vector<std::vector<double>> R;  // columns of the triangle that the rotations make of the Hessenberg matrix
  std::vector<Rotation> rotations;
  std::vector<double> g{size};  // size e_1, rotated; its last entry is the residual's norm
  while (static_cast<int>(R.size()) < most && std::abs(g.back()) > tolerance * size) {
    Vector w(b.getMap());
    A(basis.back(), w);
    const double before = w.norm2();
    std::vector<double> h(basis.size());
    for (int pass = 0; pass < 2; ++pass)  // a second time for what round-off leaves of the first
      for (std::size_t i = 0; i < basis.size(); ++i) {
        const double along = basis[i].dot(w);
        h[i] += along;
        w.update(-along, basis[i], 1.0);
      }
    double next = w.norm2();
    const bool is_complete = !(next > 1e-15 * before);  // the basis spans the solution
    for (std::size_t i = 0; i < rotations.size(); ++i) rotations[i].turn(h[i], h[i + 1]);
    const double length = std::hypot(h.back(), next);
    if (!(length > 0.0)) break;  // a singular matrix
    rotations.push_back({h.back() / length, next / length});
    if (!is_complete) w.scale(1.0 / next);
    g.push_back(0.0);
    rotations.back().turn(g[g.size() - 2], g.back());
    rotations.back().turn(h.back(), next);
    R.push_back(std::move(h));
    if (is_complete) break;
    basis.push_back(std::move(w));
  }
  for (std::size_t j = R.size(); j-- > 0;) {
    const double y = g[j] / R[j][j];
    for (std::size_t i = 0; i < j; ++i) g[i] -= y * R[j][i];
    x.update(y, basis[j], 1.0);
  }
  return x;
}

}  // namespace mortise::detail
