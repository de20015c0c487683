#include "multigrid/fields/field_preconditioner.hpp"

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <utility>

#include "multigrid/fields/scalar_decoupling.hpp"

namespace mortise::detail {
namespace {

/// Of the diagonal: what aggregates of fields of one unknown at a node do not reach across. Cells that are not stretched couple corners by 3 % and
/// more.
constexpr double weakest_coupling = 0.02;

/// The inverse of a block of held unknowns, which is a diagonal.
class InverseOfDiagonal : public Operator {
 public:
  explicit InverseOfDiagonal(const Matrix& matrix) : inverse_(matrix.getRowMap()) {
    matrix.getLocalDiagCopy(inverse_);
    inverse_.reciprocal(inverse_);
  }
  RCP<const Map> getDomainMap() const override { return inverse_.getMap(); }
  RCP<const Map> getRangeMap() const override { return inverse_.getMap(); }
  void apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp, Scalar alpha, Scalar beta) const override {
    y.elementWiseMultiply(alpha, inverse_, x, beta);
  }

 private:
  Vector inverse_;
};

}  // namespace

EquationsOfFields::EquationsOfFields(const RCP<const Matrix>& matrix, const MultigridInput& multigrid, const FieldsOfRows* fields)
    : rows_(matrix->getRowMap()) {
  const auto decoupled = [](const RCP<const Matrix>& A, const Decoupling& decoupling) {
    return std::make_shared<const DecoupledSystem>(A, decoupling);
  };
  if (fields == nullptr) {
    fields_.push_back({matrix, multigrid.decoupling ? decoupled(matrix, multigrid.decoupling()) : nullptr, multigrid.near_null_space});
    return;
  }
  blocks_ = std::make_shared<const FieldBlocks>(*matrix, *fields);
  for (std::size_t field = 0; field < blocks_->fields(); ++field) fields_.push_back({blocks_->block(field, field), nullptr, {}});
  if (multigrid.alone) {
    for (std::size_t field = 0; field < fields_.size(); ++field) fields_[field].is_held = field != *multigrid.alone;
    if (*multigrid.alone != 0) return;  // temperatures by themselves: contact keeps its multipliers
  }
  if (multigrid.decoupling) {
    const FieldPart& first = blocks_->part(0);
    const Decoupling of_first = part_of(multigrid.decoupling(), first);
    fields_[0].decoupled = decoupled(fields_[0].matrix, of_first);
    for (std::size_t field = 1; field < fields_.size(); ++field)
      if (!fields_[field].is_held)
        fields_[field].decoupled = decoupled(fields_[field].matrix, scalar_decoupling(*fields_[field].matrix, blocks_->part(field), first, of_first));
  }
  if (multigrid.near_null_space)
    fields_[0].near_null_space = [of_all = multigrid.near_null_space, blocks = blocks_] { return part_of(of_all(), blocks->part(0)); };
}

std::vector<MultigridHierarchy> EquationsOfFields::hierarchies(const Teuchos::ParameterList& given, Smoother smoother) const {
  std::vector<MultigridHierarchy> result;
  for (std::size_t field = 0; field < fields_.size(); ++field) {
    const auto& [matrix, decoupled, near_null_space, is_held] = fields_[field];
    if (is_held) {
      result.push_back({rcp(new InverseOfDiagonal(*matrix)), Teuchos::null});
      continue;
    }
    const NearNullSpace modes = near_null_space ? near_null_space() : NearNullSpace{};
    result.push_back(make_hierarchy(matrix, decoupled.get(), modes, given, smoother, field == 0 ? 0.0 : weakest_coupling));
  }
  return result;
}

ContactPreconditioner EquationsOfFields::preconditioner(const std::vector<MultigridHierarchy>& hierarchies) const {
  std::vector<ContactPreconditioner> of_fields;
  for (std::size_t field = 0; field < fields_.size(); ++field)
    of_fields.push_back(make_preconditioner(fields_[field].matrix, fields_[field].decoupled, hierarchies[field]));
  if (!blocks_) return of_fields[0];
  std::vector<RCP<const Operator>> inverses;
  for (const ContactPreconditioner& of_field : of_fields) inverses.push_back(of_field.inverse);
  ContactPreconditioner result{rcp(new BlockGaussSeidel(rows_, blocks_, inverses)), Teuchos::null};
  if (of_fields[0].start.is_null()) return result;
  inverses[0] = of_fields[0].start;
  result.start = rcp(new BlockGaussSeidel(rows_, blocks_, inverses));
  return result;
}

}  // namespace mortise::detail
