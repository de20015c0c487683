#include "multigrid/multigrid_hierarchy.hpp"

#include <MueLu_CreateTpetraPreconditioner.hpp>
#include <MueLu_TpetraOperator.hpp>

#include "multigrid/multigrid_parameters.hpp"

namespace mortise::detail {
namespace {

/// Size of an entry of a rigid body mode that counts as 0, as a share of its largest one.
constexpr double vanishing = 1e-14;

/// Moves the marked nodes, each of as many dofs as it has coordinates, away from all others, so that aggregates are made of them alone.
void move_marked(MultiVector& coordinates, const Vector& marks, double distance) {
  const auto x = coordinates.getLocalViewHost(Tpetra::Access::ReadWrite);
  const auto mark = marks.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t node = 0; node < x.extent(0); ++node)
    if (mark(node * x.extent(1), 0) != 0.0) x(node, 1) += distance;
}

/// The partitioner of coarse levels asks for coordinates, even of rows that have none.
RCP<MultiVector> row_numbers(const Matrix& matrix) {
  const auto numbers = rcp(new MultiVector(matrix.getRowMap(), 1));
  for (std::size_t row = 0; row < numbers->getLocalLength(); ++row)
    numbers->replaceLocalValue(static_cast<LocalOrdinal>(row), 0, static_cast<double>(matrix.getRowMap()->getGlobalElement(row)));
  return numbers;
}

// A row that is a multiple of the identity's (Dirichlet) takes no part in a rigid motion. Elsewhere no entry is exactly 0. MueLu ends, on one rank
// alone, where a mode vanishes on an aggregate of a single node. A rotation does so on its axis, a translation at a node that slips across it.
RCP<MultiVector> modes_without_fixed_rows(const MultiVector& rigid_body_modes, const Matrix& A, const DecoupledSystem* decoupled) {
  const auto modes = rcp(new MultiVector(rigid_body_modes, Teuchos::Copy));
  if (decoupled != nullptr) decoupled->take_out_eliminated(*modes);
  Teuchos::Array<double> largest(modes->getNumVectors());
  modes->normInf(largest());
  const auto view = modes->getLocalViewHost(Tpetra::Access::ReadWrite);
  const auto local = A.getLocalMatrixHost();
  const auto local_columns = A.getColMap()->getLocalMap();
  const auto local_rows = A.getRowMap()->getLocalMap();
  for (LocalOrdinal row = 0; row < local.numRows(); ++row) {
    const auto entries = local.rowConst(row);
    bool fixed = true;
    for (LocalOrdinal k = 0; k < entries.length && fixed; ++k)
      fixed = entries.value(k) == 0.0 || local_columns.getGlobalElement(entries.colidx(k)) == local_rows.getGlobalElement(row);
    for (std::size_t mode = 0; mode < view.extent(1); ++mode)
      if (fixed || view(row, mode) == 0.0) view(row, mode) = fixed ? 0.0 : vanishing * largest[mode];
  }
  return modes;
}

}  // namespace

MultigridHierarchy make_hierarchy(const RCP<const Matrix>& A, const DecoupledSystem* decoupled, const NearNullSpace& near_null_space,
                                  const Teuchos::ParameterList& given, Smoother smoother, double weakest) {
  const bool has_coordinates = !near_null_space.coordinates.is_null();
  MultigridSize size;
  if (has_coordinates) size.equations = static_cast<int>(A->getGlobalNumRows() / near_null_space.coordinates->getGlobalLength());
  const RCP<Matrix> matrix = decoupled != nullptr ? decoupled->matrix() : Teuchos::rcp_const_cast<Matrix>(A);
  size.rows = static_cast<GlobalOrdinal>(matrix->getGlobalNumRows());
  size.ranks = matrix->getComm()->getSize();
  Teuchos::ParameterList list = multigrid_parameters(given, smoother, size);
  auto& user_data = list.sublist("user data");
  if (has_coordinates) {
    const auto coordinates = rcp(new MultiVector(*near_null_space.coordinates, Teuchos::Copy));
    if (decoupled != nullptr) move_marked(*coordinates, decoupled->master_dofs(), near_null_space.separation);
    user_data.set("Coordinates", coordinates);
  } else {
    list.set("aggregation: drop scheme", "classical");
    list.set("aggregation: drop tol", weakest);
    user_data.set("Coordinates", row_numbers(*matrix));
  }
  if (!near_null_space.rigid_body_modes.is_null())
    user_data.set("Nullspace", modes_without_fixed_rows(*near_null_space.rigid_body_modes, *A, decoupled));

  const RCP<Operator> as_operator = matrix;
  return {MueLu::CreateTpetraPreconditioner<Scalar, LocalOrdinal, GlobalOrdinal, NodeType>(as_operator, list),
          decoupled != nullptr ? decoupled->contact_dofs() : Teuchos::null};
}

}  // namespace mortise::detail
