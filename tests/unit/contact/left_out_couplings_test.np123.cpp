// Newton's step where condensation leaves couplings out, against the solution of the whole system.
#include "linearisation/left_out_couplings.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Core.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <cmath>

#include "mortise/core/trilinos_versions.hpp"

namespace mortise::detail {
namespace {

constexpr int count = 24;

// Of each i a displacement and a multiplier:  J~ = [k b; g h],  which is condensed as it stands.
Eigen::Matrix2d block(GlobalOrdinal i) {
  const double x = static_cast<double>(i);
  return (Eigen::Matrix2d() << 5.0 + std::sin(x), 1.0, 0.3 * std::cos(2.0 * x), 0.8 + 0.1 * std::sin(3.0 * x)).finished();
}

/// Left out: in every third row of C multipliers and displacements of others, of other ranks too.
struct LeftOut {
  RCP<Matrix> of_multipliers, of_positions;
  explicit LeftOut(const RCP<const Map>& map, double size) {
    of_multipliers = rcp(new Matrix(map, 2));
    of_positions = rcp(new Matrix(map, 1));
    for (const GlobalOrdinal row : local_ids(*map)) {
      if (row % 3 != 0) continue;
      const std::array<GlobalOrdinal, 2> others = {(row + 1) % count, (row + 9) % count};
      const std::array<double, 2> values = {-0.7 * size, 0.2 * size};
      of_multipliers->insertGlobalValues(row, 2, values.data(), others.data());
      const GlobalOrdinal far = (row + count / 2) % count;
      const double value = size * std::cos(static_cast<double>(row));
      of_positions->insertGlobalValues(row, 1, &value, &far);
    }
    of_multipliers->fillComplete(map, map);
    of_positions->fillComplete(map, map);
  }
  void operator()(const Vector& dd, const Vector& dz, Vector& y) const {
    of_multipliers->apply(dz, y);
    of_positions->apply(dd, y, Teuchos::NO_TRANS, 1.0, 1.0);
  }
};

// (dd, dz) = -J~^-1 (r, w)
void solve_blocks(const Vector* r, const Vector& w, Vector& dd, Vector& dz) {
  const auto of_r = r == nullptr ? w.getLocalViewHost(Tpetra::Access::ReadOnly) : r->getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto of_w = w.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto d = dd.getLocalViewHost(Tpetra::Access::OverwriteAll), z = dz.getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (std::size_t k = 0; k < d.extent(0); ++k) {
    const Eigen::Vector2d right(r == nullptr ? 0.0 : of_r(k, 0), of_w(k, 0));
    const Eigen::Vector2d x = -block(w.getMap()->getGlobalElement(static_cast<LocalOrdinal>(k))).inverse() * right;
    d(k, 0) = x[0];
    z(k, 0) = x[1];
  }
}

struct System {
  RCP<const Map> map = rcp(new Map(count, 0, Tpetra::getDefaultComm()));
  Vector r{map}, C{map}, weights{map}, dd{map}, dz{map};
  LeftOut left_out;
  int solves = 0;

  explicit System(double size, double spread = 1.0) : left_out(map, size) {
    for (const GlobalOrdinal i : local_ids(*map)) {
      r.replaceGlobalValue(i, std::cos(1.7 * static_cast<double>(i)));
      C.replaceGlobalValue(i, std::sin(0.6 * static_cast<double>(i) + 0.2));
      weights.replaceGlobalValue(i, std::pow(spread, std::sin(5.0 * static_cast<double>(i))));
    }
    solve_blocks(&r, C, dd, dz);
  }
  void correct(double tolerance) {
    const auto solve = [this](const Vector& w, Vector& change_d, Vector& change_z) {
      ++solves;
      solve_blocks(nullptr, w, change_d, change_z);
    };
    correct_step(weights, tolerance, solve, left_out, dd, dz);
  }
  /// Of the rows of momentum, and of those of C: J dx + F.
  std::array<double, 2> residual() const {
    Vector of_r(r, Teuchos::Copy), of_C(map);
    left_out(dd, dz, of_C);
    of_C.update(1.0, C, 1.0);
    const auto d = dd.getLocalViewHost(Tpetra::Access::ReadOnly), z = dz.getLocalViewHost(Tpetra::Access::ReadOnly);
    for (std::size_t k = 0; k < d.extent(0); ++k) {
      const Eigen::Vector2d y = block(map->getGlobalElement(static_cast<LocalOrdinal>(k))) * Eigen::Vector2d(d(k, 0), z(k, 0));
      of_r.sumIntoLocalValue(static_cast<LocalOrdinal>(k), y[0]);
      of_C.sumIntoLocalValue(static_cast<LocalOrdinal>(k), y[1]);
    }
    return {of_r.normInf(), of_C.normInf()};
  }
};

TEST(LeftOutCouplings, TheStepIsThatOfTheWholeSystem) {
  for (const double size : {1e-3, 0.5, 3.0})
    for (const double spread : {1.0, 1e2}) {
      System system(size, spread);
      ASSERT_GT(system.residual()[1], 1e-2 * size);
      system.correct(1e-13);
      EXPECT_LE(system.residual()[0], 1e-11) << size << ", weights " << spread;
      EXPECT_LE(system.residual()[1], 1e-9) << size << ", weights " << spread;
    }
}

// L has rows at 8 multipliers, so that I - L s is the identity but for them: 9 Krylov vectors are enough. Belos asks for the residual at its start
// and at its end besides, and one solve takes the step.
TEST(LeftOutCouplings, AsManySolvesAsRows) {
  System system(3.0);
  system.correct(1e-13);
  EXPECT_LE(system.solves, count / 3 + 4);
}

// Rows of forces: with tolerance t the part that is left out is met to t in the norm of weights.
TEST(LeftOutCouplings, MeetsItsToleranceInForces) {
  System system(0.5, 10.0);
  Vector change(system.map);
  system.left_out(system.dd, system.dz, change);
  change.elementWiseMultiply(1.0, system.weights, change, 0.0);
  const double all = change.norm2(), tolerance = 1e-3;
  system.correct(tolerance);
  EXPECT_LE(system.residual()[1] * 0.1, tolerance * all);  // the least weight is 0.1
  EXPECT_GT(system.residual()[1], 1e-9 * all);             // and no more was done than asked for
}

TEST(LeftOutCouplings, NothingLeftOutTakesNoSolve) {
  System system(0.0);
  const Vector before(system.dz, Teuchos::Copy);
  system.correct(1e-13);
  EXPECT_EQ(system.solves, 0);
  Vector difference(system.dz, Teuchos::Copy);
  difference.update(-1.0, before, 1.0);
  EXPECT_EQ(difference.normInf(), 0.0);
}

}  // namespace
}  // namespace mortise::detail
