// A factorisation that needs more work space than MUMPS foresaw.

#include <gtest/gtest.h>

#include <Amesos2_Solver_decl.hpp>
#include <Tpetra_Core.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <cmath>
#include <random>

#include "linear/direct_solver.hpp"
#include "mortise/core/trilinos_versions.hpp"

namespace mortise {
namespace {

// Entries of many magnitudes and nothing on the diagonal: nearly every pivot has to be looked for.
RCP<Matrix> hard_to_pivot(GlobalOrdinal size) {
  const auto map = rcp(new Map(size, 0, Tpetra::getDefaultComm()));
  const auto matrix = rcp(new Matrix(map, 13));
  for (const GlobalOrdinal row : local_ids(*map)) {
    std::mt19937 random(static_cast<unsigned>(row));
    const auto uniform = [&] { return 2.0 * static_cast<double>(random()) / 4294967295.0 - 1.0; };
    for (const GlobalOrdinal offset : {-62, -61, -60, -3, -2, -1, 0, 1, 2, 3, 60, 61, 62}) {
      const GlobalOrdinal column = row + offset;
      if (column < 0 || column >= size) continue;
      const double value = offset == 0 ? 0.0 : uniform() * std::pow(10.0, 2.0 * uniform());
      matrix->insertGlobalValues(row, 1, &value, &column);
    }
  }
  matrix->fillComplete();
  return matrix;
}

TEST(MumpsWorkSpace, IsRaisedUntilItIsEnough) {
  const auto matrix = hard_to_pivot(3000);
  const auto mumps = detail::make_mumps_adapter(matrix);
  detail::set_mumps_work_space(*mumps, 0);
  mumps->symbolicFactorization();
  try {
    mumps->numericFactorization();
    FAIL() << "this matrix should need more work space than was foreseen";
  } catch (const detail::MumpsError& error) {
    EXPECT_TRUE(error.needs_work_space()) << error.what();
  }

  const auto solver = detail::make_mumps_solver({}, Timers(), "MUMPS", 0);
  Vector b(matrix->getRowMap()), x(matrix->getRowMap()), r(matrix->getRowMap());
  b.putScalar(1.0);
  solver->set_matrix(matrix, true, {});
  solver->solve(b, x);
  r.update(1.0, b, 0.0);
  matrix->apply(x, r, Teuchos::NO_TRANS, -1.0, 1.0);
  EXPECT_LE(r.norm2(), 1e-8 * b.norm2());
}

}  // namespace
}  // namespace mortise
