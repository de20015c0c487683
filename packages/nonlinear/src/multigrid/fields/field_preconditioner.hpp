#pragma once
// Preconditioner of a matrix, whether it has one field or several.

#include <memory>
#include <vector>

#include "multigrid/contact_preconditioner.hpp"
#include "multigrid/fields/block_gauss_seidel.hpp"

namespace mortise::detail {

/// The equations of each field of a matrix by itself, and what preconditions them. Of one field they are the matrix.
class EquationsOfFields {
 public:
  /// Collective.
  /// @param fields  null: the matrix has one
  EquationsOfFields(const RCP<const Matrix>& matrix, const MultigridInput& multigrid, const FieldsOfRows* fields);

  /// A hierarchy of each field. That of displacements is cut across contact. That of a field of one unknown at a node follows the entries of the
  /// matrix: where surfaces conduct well, no cut is weak. Collective.
  /// @param given  parameters of MueLu
  std::vector<MultigridHierarchy> hierarchies(const Teuchos::ParameterList& given, Smoother smoother) const;

  /// Block Gauss-Seidel around the preconditioners of the fields, that of displacements with the present contact. Collective.
  ContactPreconditioner preconditioner(const std::vector<MultigridHierarchy>& hierarchies) const;

 private:
  struct Equations {
    RCP<const Matrix> matrix;
    std::shared_ptr<const DecoupledSystem> decoupled;  ///< null: without contact
    std::function<NearNullSpace()> near_null_space;    ///< empty: of one unknown at a node
    bool is_held = false;                              ///< its unknowns keep their values: the matrix is a diagonal
  };
  RCP<const Map> rows_;
  std::shared_ptr<const FieldBlocks> blocks_;  ///< null: there is one field
  std::vector<Equations> fields_;
};

}  // namespace mortise::detail
