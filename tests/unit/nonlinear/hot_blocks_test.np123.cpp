// Multigrid of systems with two fields: displacements and temperatures on a grid of springs that conduct and expand.

#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>

#include "linear_systems.hpp"
#include "multigrid/fields/block_gauss_seidel.hpp"

namespace mortise {
namespace {

using namespace test;

/// Units that the rows and the unknowns of temperatures are given in.
struct Units {
  double rows = 1.0;      ///< factor of the rows of heat
  double unknowns = 1.0;  ///< of temperatures
};

/// On a grid whose lower edge is held and cold:
///   ( K   -a G ) (u)        ( f )
///   ( c G'  H  ) (theta)  = ( q ),
/// K the stiffness of springs, H their conduction, G a first difference.
class HotGrid {
 public:
  HotGrid(int n, double expansion, double feedback, Units units = {})
      : grid_(std::make_shared<SpringGrid>(Tpetra::getDefaultComm(), n, n, Numbering::blocks)), units_(units) {
    std::vector<GlobalOrdinal> ids;
    for (std::size_t node = 0; node < grid_->owned_nodes().size(); ++node)
      for (int i = 0; i < 2; ++i) ids.push_back(grid_->dof(grid_->owned_nodes()[node], i)), add_row(0, node);
    for (std::size_t node = 0; node < grid_->owned_nodes().size(); ++node) ids.push_back(temperature(grid_->owned_nodes()[node])), add_row(1, node);
    fields_.weights = {1.0, 1.0 / units.rows};
    const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
    rows_ = rcp(new Map(invalid, ids.data(), static_cast<LocalOrdinal>(ids.size()), 0, grid_->dofs->getComm()));
    fill(expansion, feedback);
  }

  const RCP<Matrix>& matrix() const { return matrix_; }
  const FieldsOfRows& fields() const { return fields_; }
  MultigridInput multigrid() const {
    return {[this] {
              NearNullSpace result = grid_->near_null_space();
              const auto modes = rcp(new MultiVector(rows_, 3));
              const auto from = result.rigid_body_modes->getLocalViewHost(Tpetra::Access::ReadOnly);
              const auto to = modes->getLocalViewHost(Tpetra::Access::ReadWrite);
              for (std::size_t mode = 0; mode < 3; ++mode)
                for (std::size_t row = 0; row < from.extent(0); ++row) to(row, mode) = from(row, mode);
              result.rigid_body_modes = modes;
              return result;
            },
            {},
            [this] { return fields_; }};
  }

  /// Forces and heat of the sizes given, 0 on held rows.
  Vector loads(double forces, double heat) const {
    Vector b(rows_);
    for (const int node : grid_->owned_nodes()) {
      if (is_held(node)) continue;
      for (int i = 0; i < 2; ++i) b.replaceGlobalValue(grid_->dof(node, i), forces * (0.3 + std::sin(0.7 * node + i)));
      b.replaceGlobalValue(temperature(node), units_.rows * heat * (0.3 + std::sin(0.3 * node)));
    }
    return b;
  }

  /// |v| of a field.
  double norm(std::size_t field, const Vector& v) const {
    double mine = 0.0, all = 0.0;
    for (std::size_t row = 0; row < fields_.field_of_row.size(); ++row)
      if (fields_.field_of_row[row] == field) mine += std::pow(v.getLocalViewHost(Tpetra::Access::ReadOnly)(row, 0), 2);
    Teuchos::reduceAll(*rows_->getComm(), Teuchos::REDUCE_SUM, mine, Teuchos::outArg(all));
    return std::sqrt(all);
  }

 private:
  GlobalOrdinal temperature(int node) const { return 2 * grid_->nx() * grid_->ny() + node; }
  bool is_held(int node) const { return node < grid_->nx(); }

  void fill(double expansion, double feedback) {
    const RCP<Matrix> K = stiffness(grid_, true, 1.0, 0.0);
    matrix_ = rcp(new Matrix(rows_, 27));
    const auto local = K->getLocalMatrixHost();
    for (LocalOrdinal row = 0; row < local.numRows(); ++row)
      for (LocalOrdinal k = 0; k < local.row(row).length; ++k)
        add(rows_->getGlobalElement(row), K->getColMap()->getGlobalElement(local.row(row).colidx(k)), local.row(row).value(k));
    for (const int node : grid_->owned_nodes()) {
      const double size = units_.rows / units_.unknowns;
      if (is_held(node)) {
        add(temperature(node), temperature(node), size);
        continue;
      }
      const auto x = grid_->position(node);
      for (const int other : grid_->neighbours(node)) {
        add(temperature(node), temperature(node), size);
        if (is_held(other)) continue;
        add(temperature(node), temperature(other), -size);
        const auto y = grid_->position(other);
        for (int i = 0; i < 2; ++i) {
          add(grid_->dof(node, i), temperature(other), -expansion * (y[i] - x[i]) / units_.unknowns);
          add(temperature(node), grid_->dof(other, i), units_.rows * feedback * (y[i] - x[i]));
        }
      }
    }
    matrix_->fillComplete(rows_, rows_);
  }
  void add_row(std::size_t field, std::size_t node) {
    fields_.field_of_row.push_back(field);
    fields_.node_of_row.push_back(static_cast<LocalOrdinal>(node));
  }
  void add(GlobalOrdinal row, GlobalOrdinal column, double value) { matrix_->insertGlobalValues(row, 1, &value, &column); }

  std::shared_ptr<SpringGrid> grid_;
  Units units_;
  FieldsOfRows fields_;
  RCP<const Map> rows_;
  RCP<Matrix> matrix_;
};

struct Solved {
  int iterations;
  std::vector<double> residuals;  ///< |b - A x| of each field
};

Solved solve(const HotGrid& grid, const Vector& b, double tolerance = 1e-10) {
  const auto solver = solver_of(Kind::iterative, tolerance);
  solver->set_matrix(grid.matrix(), true, grid.multigrid());
  Vector x(b.getMap()), r(b, Teuchos::Copy);
  const int iterations = solver->solve(b, x).iterations;
  grid.matrix()->apply(x, r, Teuchos::NO_TRANS, -1.0, 1.0);
  return {iterations, {grid.norm(0, r), grid.norm(1, r)}};
}

// Units are anybody's choice: iterations are the same, and each field is solved to the tolerance of its own right-hand side.
TEST(HotBlocks, AreSolvedFieldByFieldInAnyUnits) {
  const double tolerance = 1e-8;
  std::vector<int> iterations;
  for (const Units units : {Units{}, Units{1e9, 1.0}, Units{1e-7, 1e6}}) {
    const HotGrid grid(32, 1.0, 0.01, units);
    const Vector b = grid.loads(1.0, 1e-3);
    const Solved solved = solve(grid, b, tolerance);
    for (std::size_t field = 0; field < 2; ++field)
      EXPECT_LE(solved.residuals[field], 10.0 * tolerance * std::sqrt(2.0) * grid.norm(field, b)) << field << " with rows in " << units.rows;
    iterations.push_back(solved.iterations);
  }
  EXPECT_LE(std::abs(iterations[1] - iterations[0]), 1);
  EXPECT_LE(std::abs(iterations[2] - iterations[0]), 1);
}

// Heat alone moves the bodies, and motion alone heats them: a field without a right-hand side of its own is solved too.
TEST(HotBlocks, AreSolvedWhereOneFieldHasNoLoads) {
  const double tolerance = 1e-8;
  for (const bool is_hot : {true, false}) {
    const HotGrid grid(32, 1.0, 0.01);
    const Vector b = grid.loads(is_hot ? 0.0 : 1.0, is_hot ? 1.0 : 0.0);
    const Solved solved = solve(grid, b, tolerance);
    EXPECT_LE(std::max(solved.residuals[0], solved.residuals[1]), 10.0 * tolerance * std::sqrt(2.0) * b.norm2());
    EXPECT_LE(solved.residuals[is_hot ? 0 : 1], 1e-3 * tolerance * std::sqrt(2.0) * b.norm2()) << is_hot;
  }
}

// Without feedback the blocks on and above the diagonal are all of the matrix.
TEST(HotBlocks, AreAllOfTheMatrix) {
  const HotGrid grid(12, 1.0, 0.0);
  const detail::FieldBlocks blocks(*grid.matrix(), grid.fields());
  const Vector x = grid.loads(1.0, 2.0);
  Vector expected(x.getMap()), sum(x.getMap());
  grid.matrix()->apply(x, expected);
  for (std::size_t field = 0; field < 2; ++field) {
    MultiVector row(blocks.part(field).map(), 1);
    for (std::size_t other = field; other < 2; ++other)
      blocks.block(field, other)->apply(*blocks.part(other).of(x), row, Teuchos::NO_TRANS, 1.0, 1.0);
    blocks.part(field).put(row, sum);
  }
  sum.update(-1.0, expected, 1.0);
  EXPECT_GT(expected.normInf(), 0.1);
  EXPECT_LE(sum.normInf(), 1e-14 * expected.normInf());
}

// With the blocks' inverses it solves what no field gives back: A_10 = 0.
TEST(HotBlocks, AreSolvedAtOnceWithoutFeedback) {
  const HotGrid grid(16, 1.0, 0.0);
  const auto blocks = std::make_shared<const detail::FieldBlocks>(*grid.matrix(), grid.fields());
  struct Inverse : Operator {
    explicit Inverse(RCP<const Matrix> A) : matrix(std::move(A)), solver(solver_of(Kind::mumps)) { solver->set_matrix(matrix, true, {}); }
    Teuchos::RCP<const Map> getDomainMap() const override { return matrix->getDomainMap(); }
    Teuchos::RCP<const Map> getRangeMap() const override { return matrix->getRangeMap(); }
    void apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp, Scalar, Scalar) const override {
      solver->solve(*x.getVector(0), *y.getVectorNonConst(0));
    }
    RCP<const Matrix> matrix;
    std::unique_ptr<LinearSolver> solver;
  };
  std::vector<RCP<const Operator>> inverses;
  for (std::size_t field = 0; field < 2; ++field) inverses.push_back(rcp(new Inverse(blocks->block(field, field))));
  const Vector b = grid.loads(1.0, 1.0);
  Vector x(b.getMap()), r(b, Teuchos::Copy);
  detail::BlockGaussSeidel(b.getMap(), blocks, inverses).apply(b, x, Teuchos::NO_TRANS, 1.0, 0.0);
  grid.matrix()->apply(x, r, Teuchos::NO_TRANS, -1.0, 1.0);
  EXPECT_LE(r.norm2(), 1e-12 * b.norm2());
}

}  // namespace
}  // namespace mortise
