#include "system/field_sizes.hpp"

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "mortise/core/trilinos_versions.hpp"

namespace mortise::detail {

FieldSizes::FieldSizes(const SystemParts& parts) : sizes_{parts.length} {
  if (parts.fields.size() < 2) return;
  sizes_.clear();
  field_of_row_.assign(local_id_count(*parts.dofs), parts.fields.size());
  node_of_row_.assign(field_of_row_.size(), 0);
  for (const SystemField& of : parts.fields) {
    const NodalField& field = of.unknowns;
    for (LocalOrdinal node = 0; node < static_cast<LocalOrdinal>(local_id_count(*field.nodes())); ++node)
      for (int i = 0; i < field.components(); ++i)
        if (const GlobalOrdinal id = field.id(node, i); id != NodalField::none) {
          const auto row = static_cast<std::size_t>(parts.dofs->getLocalElement(id));
          field_of_row_.at(row) = sizes_.size();
          node_of_row_.at(row) = node;
        }
    sizes_.push_back(of.size);
  }
  const auto none = std::find(field_of_row_.begin(), field_of_row_.end(), parts.fields.size());
  if (none != field_of_row_.end())
    throw std::invalid_argument(fmt::format("the system's dof {} belongs to none of its fields",
                                            parts.dofs->getGlobalElement(static_cast<LocalOrdinal>(none - field_of_row_.begin()))));
}

std::vector<double> FieldSizes::norms(const Vector& v) const {
  if (fields() == 1) return {v.norm2()};
  std::vector<double> mine(fields(), 0.0), all(fields());
  const auto view = v.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t row = 0; row < field_of_row_.size(); ++row) mine[field_of_row_[row]] += view(row, 0) * view(row, 0);
  Teuchos::reduceAll(*v.getMap()->getComm(), Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), all.data());
  for (double& sum : all) sum = std::sqrt(sum);
  return all;
}

std::vector<double> FieldSizes::means(const Vector& v) const {
  if (fields() == 1) return {v.norm1() / std::max<double>(1.0, static_cast<double>(v.getGlobalLength()))};
  std::vector<double> mine(2 * fields(), 0.0), all(2 * fields()), means;
  const auto view = v.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t row = 0; row < field_of_row_.size(); ++row) {
    mine[2 * field_of_row_[row]] += std::abs(view(row, 0));
    mine[2 * field_of_row_[row] + 1] += 1.0;
  }
  Teuchos::reduceAll(*v.getMap()->getComm(), Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), all.data());
  for (std::size_t field = 0; field < fields(); ++field) means.push_back(all[2 * field] / std::max(1.0, all[2 * field + 1]));
  return means;
}

double FieldSizes::largest(const Vector& v) const {
  if (fields() == 1) return v.normInf();
  double mine = 0.0, all = 0.0;
  const auto view = v.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t row = 0; row < field_of_row_.size(); ++row) {
    const double value = std::abs(view(row, 0)) * sizes_[0] / sizes_[field_of_row_[row]];
    mine = std::max(mine, std::isnan(value) ? std::numeric_limits<double>::infinity() : value);
  }
  Teuchos::reduceAll(*v.getMap()->getComm(), Teuchos::REDUCE_MAX, mine, Teuchos::outArg(all));
  return all;
}

}  // namespace mortise::detail
