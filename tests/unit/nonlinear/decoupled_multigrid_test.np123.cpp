// Multigrid of a condensed contact system: the iterations are those of the bodies.

#include "multigrid/decoupled_multigrid.hpp"

#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>
#include <algorithm>

#include "mortise/core/trilinos_versions.hpp"
#include "multigrid/interface_correction.hpp"
#include "multigrid/sparse_parts.hpp"
#include "spring_grid.hpp"

namespace mortise {
namespace {

using test::Numbering;
using test::SpringGrid;

void add(Matrix& matrix, GlobalOrdinal row, GlobalOrdinal column, double value) { matrix.insertGlobalValues(row, 1, &value, &column); }

/// Two bodies of springs, one above the other, each node of the upper one's lower edge bound to the node below it: in y, free to slide in x.
class TwoBodies {
 public:
  /// @param open   slave nodes, from the left, that are not in contact
  /// @param ratio  of the upper body's stiffness to the lower one's
  TwoBodies(const RCP<const Communicator>& comm, int nx, int ny, int open = 0, double ratio = 1.0)
      : grid_(std::make_shared<SpringGrid>(comm, nx, ny, Numbering::blocks, ny / 2)), open_(open), ratio_(ratio) {}

  const SpringGrid& grid() const { return *grid_; }

  /// K of the bodies, held at the lower and at the upper edge.
  RCP<Matrix> stiffness() const {
    const auto matrix = rcp(new Matrix(grid_->graph));
    Vector zero(grid_->dofs), local_zero(grid_->local_dofs);
    std::optional<StepFailure> failure;
    test::Springs(grid_, 1.0).add_jacobian({0.0, zero, local_zero}, {}, *matrix, failure);
    matrix->fillComplete(grid_->dofs, grid_->dofs);
    matrix->resumeFill();
    for (const int node : grid_->owned_nodes())
      for (int i = 0; i < 2; ++i) {
        const auto row = matrix->getLocalMatrixHost().row(grid_->dofs->getLocalElement(grid_->dof(node, i)));
        for (LocalOrdinal k = 0; k < row.length; ++k) {
          if (node / grid_->nx() >= grid_->cut()) row.value(k) *= ratio_;
          if (is_held(node)) row.value(k) = matrix->getColMap()->getGlobalElement(row.colidx(k)) == grid_->dof(node, i) ? 1.0 : 0.0;
        }
      }
    matrix->fillComplete(grid_->dofs, grid_->dofs);
    return matrix;
  }

  /// Rows of a slave j above a master m: d_jy - d_my = 0 and its momentum in x, which is 0; the master receives all of the slave's momentum.
  RCP<Matrix> condensed() const {
    const RCP<Matrix> K = stiffness();
    const auto A = rcp(new Matrix(grid_->dofs, 64));
    const auto local = K->getLocalMatrixHost();
    for (const int node : grid_->owned_nodes())
      for (int i = 0; i < 2; ++i) {
        const auto row = local.row(grid_->dofs->getLocalElement(grid_->dof(node, i)));
        for (LocalOrdinal k = 0; k < row.length; ++k) {
          const GlobalOrdinal column = K->getColMap()->getGlobalElement(row.colidx(k));
          if (!is_slave(node) || i == 0) add(*A, grid_->dof(node, i), column, row.value(k));
          if (is_slave(node)) add(*A, grid_->dof(master(node), i), column, row.value(k));
        }
        if (!is_slave(node) || i == 0) continue;
        add(*A, grid_->dof(node, 1), grid_->dof(node, 1), 1.0);
        add(*A, grid_->dof(node, 1), grid_->dof(master(node), 1), -1.0);
      }
    A->fillComplete(grid_->dofs, grid_->dofs);
    return A;
  }

  NearNullSpace near_null_space() const {
    NearNullSpace result = grid_->near_null_space();
    const auto far_apart = rcp(new MultiVector(*result.coordinates, Teuchos::Copy));
    LocalOrdinal place = -1;
    for (const int node : grid_->owned_nodes()) {
      ++place;
      if (node / grid_->nx() >= grid_->cut()) far_apart->sumIntoLocalValue(place, 1, 1e6);
    }
    result.coordinates = far_apart;
    result.separation = 1e6;
    return result;
  }

  /// N = e_y e_y^T, M^ = 1.
  Decoupling decoupling() const {
    const auto trial = rcp(new Matrix(grid_->dofs, 2)), test = rcp(new Matrix(grid_->dofs, 2)), eliminated = rcp(new Matrix(grid_->dofs, 1));
    for (const int node : grid_->owned_nodes()) {
      if (!is_slave(node)) continue;
      const GlobalOrdinal x = grid_->dof(node, 0), y = grid_->dof(node, 1);
      add(*trial, y, y, -1.0);
      add(*trial, y, grid_->dof(master(node), 1), 1.0);
      add(*test, y, y, -1.0);
      add(*test, x, grid_->dof(master(node), 0), -1.0);
      add(*eliminated, y, y, 1.0);
    }
    for (const auto& matrix : {trial, test, eliminated}) matrix->fillComplete(grid_->dofs, grid_->dofs);
    return {trial, test, eliminated, 2};
  }

  /// The right-hand side of gaps along y at closed slave nodes, -1 and 1 in turn, and nothing else.
  Vector gaps() const {
    Vector result(grid_->dofs);
    for (const int node : grid_->owned_nodes())
      if (is_slave(node)) result.replaceGlobalValue(grid_->dof(node, 1), node % 2 == 0 ? 1.0 : -1.0);
    return result;
  }

  bool is_held(int node) const { return node < grid_->nx() || node / grid_->nx() == grid_->ny() - 1; }

 private:
  bool is_slave(int node) const { return node / grid_->nx() == grid_->cut() && node % grid_->nx() >= open_; }
  int master(int slave) const { return slave - grid_->nx(); }
  std::shared_ptr<const SpringGrid> grid_;
  int open_;
  double ratio_;
};

struct Solved {
  int iterations;
  double residual;
};

Vector wavy(const RCP<const Map>& map) {
  Vector result(map);
  for (const GlobalOrdinal id : local_ids(*map)) result.replaceGlobalValue(id, std::sin(0.7 * static_cast<double>(id)) + 0.3);
  return result;
}

std::unique_ptr<LinearSolver> multigrid_solver(const RCP<const Communicator>& comm, int coarse_size) {
  LinearSolverOptions options;
  options.kind.value = LinearSolverOptions::Kind::iterative;
  options.muelu.value.set("coarse: max size", coarse_size);
  return make_linear_solver(options, comm, Timers());
}

Solved solved(LinearSolver& solver, const RCP<Matrix>& matrix, const MultigridInput& multigrid) {
  solver.set_matrix(matrix, true, multigrid);
  Vector b = wavy(matrix->getRowMap()), x(b.getMap()), r(b.getMap());
  const LinearSolveReport report = solver.solve(b, x);
  matrix->apply(x, r);
  r.update(1.0, b, -1.0);
  return {report.iterations, r.norm2() / b.norm2()};
}

Solved solved(const SpringGrid& grid, const RCP<Matrix>& matrix, int coarse_size, const MultigridInput& multigrid) {
  return solved(*multigrid_solver(grid.dofs->getComm(), coarse_size), matrix, multigrid);
}

MultigridInput in_contact(const TwoBodies& bodies) {
  return {[&] { return bodies.near_null_space(); }, [&] { return bodies.decoupling(); }};
}

// Conditions that hold for single nodes are solved by themselves, and the rest is what S' C^-1 L' solves: with C factorised nothing is left to
// iterate.
TEST(Decoupled, IsExactWhereTheBodiesAreSolvedExactly) {
  const TwoBodies bodies(test::this_rank_only(), 12, 12);  // the coarse solver is right where the whole matrix is on one rank
  const Solved result = solved(bodies.grid(), bodies.condensed(), 1000000, in_contact(bodies));
  EXPECT_EQ(result.iterations, 1);
  EXPECT_LE(result.residual, 1e-9);
}

TEST(Decoupled, TakesAboutAsManyIterationsAsTheBodies) {
  const TwoBodies bodies(Tpetra::getDefaultComm(), 32, 32);
  const Solved of_bodies = solved(bodies.grid(), bodies.stiffness(), 100, {[&] { return bodies.grid().near_null_space(); }, {}});
  const Solved of_contact = solved(bodies.grid(), bodies.condensed(), 100, in_contact(bodies));
  EXPECT_LE(of_contact.residual, 1e-9);
  EXPECT_LE(of_contact.iterations, 2 * of_bodies.iterations);
  RecordProperty("iterations_of_bodies", of_bodies.iterations);
  RecordProperty("iterations_in_contact", of_contact.iterations);
}

// The nodes that lose contact are solved for exactly too, so that the earlier hierarchy is good enough. It takes fewer iterations than a new one plus
// the ten that its set-up is worth.
TEST(Decoupled, KeepsItsHierarchyWhenHalfOfTheContactOpens) {
  const RCP<const Communicator> comm = Tpetra::getDefaultComm();
  const TwoBodies closed(comm, 32, 32), half_open(comm, 32, 32, 16);
  const auto kept = multigrid_solver(comm, 100), fresh = multigrid_solver(comm, 100);
  solved(*kept, closed.condensed(), in_contact(closed));
  const Solved with_kept = solved(*kept, half_open.condensed(), in_contact(half_open));
  const Solved with_fresh = solved(*fresh, half_open.condensed(), in_contact(half_open));
  EXPECT_EQ(kept->symbolic_setups(), 1);
  EXPECT_LE(with_kept.residual, 1e-9);
  EXPECT_LT(with_kept.iterations, with_fresh.iterations + 10);
}

/// The entries of x that are in `map`, of which every rank has those it owns.
Vector part(const Vector& x, const RCP<const Map>& map) {
  Vector result(map);
  result.doImport(x, Import(x.getMap(), map), Tpetra::INSERT);
  return result;
}

class Contact : public testing::Test {
 protected:
  static constexpr int nx = 16;
  TwoBodies bodies{Tpetra::getDefaultComm(), nx, 16};
  RCP<const Matrix> condensed = bodies.condensed();
  detail::DecoupledSystem system{condensed, bodies.decoupling()};
  RCP<const Matrix> C = system.matrix();
  RCP<const Map> contact_dofs = detail::marked_ids(*system.contact_dofs());
};

TEST_F(Contact, HoldsSlavesAndTheirMasters) { EXPECT_EQ(contact_dofs->getGlobalNumElements(), 2 * 2 * nx); }

TEST_F(Contact, MastersAreThoseBelowSlaves) {
  const RCP<const Map> masters = detail::marked_ids(system.master_dofs());
  const SpringGrid& grid = bodies.grid();
  for (const int node : grid.owned_nodes())
    for (int i = 0; i < 2; ++i) EXPECT_EQ(masters->isNodeGlobalElement(grid.dof(node, i)), node / nx == grid.cut() - 1) << node;
}

TEST_F(Contact, NeighboursAreThoseOfTheMatrix) {
  const RCP<Matrix> K = bodies.stiffness();
  Vector marks(K->getRowMap()), expected(K->getRowMap());
  const SpringGrid& grid = bodies.grid();
  const auto is_marked = [](int node) { return node % 37 == 20; };
  for (const int node : grid.owned_nodes()) {
    const std::vector<int> neighbours = grid.neighbours(node);
    // Nodes that are held are not coupled to any other.
    const bool near = !bodies.is_held(node) && std::any_of(neighbours.begin(), neighbours.end(), is_marked);
    for (int i = 0; i < 2 && is_marked(node); ++i) marks.replaceGlobalValue(grid.dof(node, i), 1.0);
    for (int i = 0; i < 2 && (near || is_marked(node)); ++i) expected.replaceGlobalValue(grid.dof(node, i), 1.0);
  }
  Vector found = detail::marked_and_neighbours(*K, marks, 2);
  EXPECT_GT(expected.norm1(), 4.0 * marks.norm1());
  found.update(-1.0, expected, 1.0);
  EXPECT_EQ(found.normInf(), 0.0);
}

TEST_F(Contact, RowsAreThoseOfTheWholeMatrix) {
  const Vector x = wavy(C->getDomainMap());
  Vector of_matrix(C->getRangeMap()), of_rows(contact_dofs);
  C->apply(x, of_matrix);
  system.rows(contact_dofs).apply(x, of_rows, Teuchos::NO_TRANS, 1.0, 0.0);
  const Vector expected = part(of_matrix, contact_dofs);
  of_rows.update(-1.0, expected, 1.0);
  EXPECT_GT(expected.normInf(), 1.0);
  EXPECT_LE(of_rows.normInf(), 1e-13 * expected.normInf());
}

TEST_F(Contact, SolutionAloneLeavesNoResidualThere) {
  const detail::InterfaceSolution solution(system.rows(contact_dofs).block(), C->getRowMap());
  const Vector x = wavy(C->getRangeMap());
  Vector y(C->getDomainMap()), residual(x, Teuchos::Copy);
  y.putScalar(1.0);
  solution.apply(x, y, Teuchos::NO_TRANS, 1.0, 0.0);
  C->apply(y, residual, Teuchos::NO_TRANS, -1.0, 1.0);
  EXPECT_LE(part(residual, contact_dofs).normInf(), 1e-12 * x.normInf());
  EXPECT_GT(part(y, contact_dofs).normInf(), 0.1);
  for (const GlobalOrdinal id : local_ids(*contact_dofs)) y.replaceGlobalValue(id, 0.0);
  EXPECT_EQ(y.normInf(), 0.0);
}

// Whatever went before: nothing is left of the residual where it corrects, and nothing is changed elsewhere.
TEST_F(Contact, CorrectionLeavesNoResidualThere) {
  const auto diagonal = rcp(new Matrix(C->getRowMap(), 1));
  for (const GlobalOrdinal id : local_ids(*C->getRowMap())) add(*diagonal, id, id, 0.1 + 0.01 * static_cast<double>(id % 7));
  diagonal->fillComplete(C->getDomainMap(), C->getRangeMap());
  const auto rows = rcp(new detail::RowsOfDecoupled(system.rows(contact_dofs)));
  const detail::InterfaceCorrection correction(rows, rcp(new detail::InterfaceSolution(rows->block(), C->getRowMap())), diagonal);
  const Vector x = wavy(C->getRangeMap());
  Vector y(C->getDomainMap()), before(C->getDomainMap()), residual(x, Teuchos::Copy);
  correction.apply(x, y, Teuchos::NO_TRANS, 1.0, 0.0);
  diagonal->apply(x, before);
  C->apply(y, residual, Teuchos::NO_TRANS, -1.0, 1.0);
  EXPECT_LE(part(residual, contact_dofs).normInf(), 1e-12 * x.normInf());
  y.update(-1.0, before, 1.0);
  EXPECT_GT(part(y, contact_dofs).normInf(), 0.1);
  for (const GlobalOrdinal id : local_ids(*contact_dofs)) y.replaceGlobalValue(id, 0.0);
  EXPECT_EQ(y.normInf(), 0.0);
}

/// Of right-hand side b, as a share of it, what is left where the nodes in contact and their neighbours alone have been solved for.
double left_by_start(const TwoBodies& bodies, const Vector& b) {
  const RCP<const Matrix> A = bodies.condensed();
  const auto system = std::make_shared<const detail::DecoupledSystem>(A, bodies.decoupling());
  const RCP<const Map> m = detail::marked_ids(detail::marked_and_neighbours(*A, *system->contact_dofs(), 2));
  const auto solution = rcp(new detail::InterfaceSolution(system->rows(m).block(), A->getRowMap()));
  Vector x(b.getMap()), r(b, Teuchos::Copy);
  detail::DecoupledPreconditioner(system, solution).apply(b, x, Teuchos::NO_TRANS, 1.0, 0.0);
  A->apply(x, r, Teuchos::NO_TRANS, -1.0, 1.0);
  return r.norm2() / b.norm2();
}

// A gap closed by the slave alone, its body at rest, leaves the slave's stiffness times the gap. Solved for with what is around them, bodies alike
// give way by a half each, and of a stiff and a soft one the soft one by all of it.
TEST(Start, LeavesOfAGapWhatTheSofterBodyFeels) {
  const RCP<const Communicator> comm = Tpetra::getDefaultComm();
  const TwoBodies alike(comm, 16, 16), stiff(comm, 16, 16, 0, 1000.0);
  EXPECT_GT(left_by_start(alike, alike.gaps()), 1e-3);
  EXPECT_LE(left_by_start(stiff, stiff.gaps()), 2.0 * left_by_start(alike, alike.gaps()));
}

TEST(Start, IsWhereASolveBegins) {
  const RCP<const Communicator> comm = Tpetra::getDefaultComm();
  const TwoBodies bodies(comm, 16, 16, 0, 1000.0);
  const RCP<Matrix> A = bodies.condensed();
  const Vector b = bodies.gaps();
  const double left = left_by_start(bodies, b);
  ASSERT_LT(left, 0.9);
  const auto solver = multigrid_solver(comm, 100);
  solver->set_matrix(A, true, in_contact(bodies));
  Vector x(b.getMap());
  EXPECT_EQ(solver->solve(b, x, 1.01 * left).iterations, 0);
  EXPECT_GT(solver->solve(b, x, 0.5 * left).iterations, 0);
}

}  // namespace
}  // namespace mortise
