#pragma once
// One interface for every way to solve the condensed linear system.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mortise/contact/decoupling.hpp"
#include "mortise/core/error.hpp"
#include "mortise/core/types.hpp"

namespace mortise {

/// Report of one solve.
struct LinearSolveReport {
  int iterations = 0;              ///< 0 for a direct solver
  double relative_residual = 0.0;  ///< true one, |b - A x| / |b|
};

/// Data for a multigrid hierarchy besides the matrix, on the current configuration.
struct NearNullSpace {
  RCP<const MultiVector> rigid_body_modes;  ///< on the dofs of the matrix, 0 at those of other fields
  RCP<const MultiVector> coordinates;       ///< on the nodes, `dimension` columns, with bodies moved away from one another by `separation`
  double separation = 0.0;                  ///< a length beside which bodies are points, so that no aggregate crosses contact
};

/// The fields of a matrix with the equations of several: displacements first, then fields of one unknown at a node, as temperatures.
struct FieldsOfRows {
  std::vector<std::size_t> field_of_row;  ///< [owned rows]
  std::vector<LocalOrdinal> node_of_row;  ///< [owned rows] local index of the owned node; those of a node are neighbours within a field
  std::vector<double> weights;            ///< [fields] make residuals comparable: those that changes by the fields' sizes bring about are alike
};

/// Data that an iterative solver may ask of a system, each only if it is needed; any may be empty.
struct MultigridInput {
  std::function<NearNullSpace()> near_null_space;  ///< rigid body modes and coordinates, of displacements
  std::function<Decoupling()> decoupling;          ///< of a condensed system with contact
  std::function<FieldsOfRows()> fields = {};       ///< empty: the matrix has one
  std::optional<std::size_t> alone = {};           ///< the field that is solved for while unknowns of the others are held; none: all are
};

/// A way to solve linear systems of equations. Collective in all its members.
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;
  virtual std::string name() const = 0;  ///< as messages say it

  /// Number of times that the work that depends on the pattern alone was done (analysis of a direct solver, set-up of multigrid).
  virtual int symbolic_setups() const = 0;

  /// Takes the matrix of the next solves. `graph_changed`: the pattern is not that of the last call, so nothing symbolic may be reused.
  /// The matrix must live, unchanged, until the next call, and so must what `multigrid` looks at, which solve() asks.
  virtual void set_matrix(const RCP<const Matrix>& matrix, bool graph_changed, const MultigridInput& multigrid) = 0;

  /// Relative residuals that solve() may be asked for.
  struct Tolerances {
    double least;    ///< the most exact
    double largest;  ///< the least exact
  };
  /// Those of an iterative solver. A direct one has none: it is as exact as it can be.
  virtual std::optional<Tolerances> tolerances() const { return std::nullopt; }

  /// Solves A x = b (the first solve after set_matrix() factorises) to a relative residual of `tolerance`, or of tolerances()->least if that is
  /// larger, and checks the true residual.
  /// @throws StepFailure (linear_solver), on every rank, if
  /// * the matrix or b is not finite,
  /// * the matrix is singular,
  /// * the backward error of a direct solver exceeds the bound of the options,
  /// * the true relative residual of the iterative solver exceeds ten times the tolerance.
  virtual LinearSolveReport solve(const Vector& b, Vector& x, double tolerance = 0.0) = 0;

  /// Forgets what it kept of earlier matrices: from the next one on it solves as a new solver would. So a run that goes on from a checkpoint takes
  /// the way of the run that wrote it.
  virtual void forget() {}

  /// Sign of the determinant of the matrix that was factorised last; 0: not known.
  virtual int determinant_sign() const { return 0; }
};

}  // namespace mortise
