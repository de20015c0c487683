#include "fields/id_order.hpp"

#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <stdexcept>

#include "mortise/core/trilinos_versions.hpp"

namespace mortise {

IdOrder::IdOrder(const RCP<const Map>& owned) : owned_(owned), size_(static_cast<GlobalOrdinal>(owned->getGlobalNumElements())) {
  if (size_ > 0 && (owned->getMinAllGlobalIndex() != 0 || owned->getMaxAllGlobalIndex() != size_ - 1 || !owned->isOneToOne()))
    throw std::invalid_argument("ids of nodes and elements have to be 0 ... number - 1");
  rows_ = rcp(new Map(static_cast<Tpetra::global_size_t>(size_), 0, owned->getComm()));
  local_size_ = static_cast<LocalOrdinal>(local_id_count(*rows_));
  first_ = local_size_ > 0 ? rows_->getMinGlobalIndex() : 0;
  import_ = rcp(new Import(owned_, rows_));
}

std::vector<double> IdOrder::arrange(const std::vector<double>& owned_values, int components) const {
  MultiVector source(owned_, components), target(rows_, components);
  {
    const auto view = source.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (std::size_t row = 0; row < view.extent(0); ++row)
      for (int c = 0; c < components; ++c) view(row, c) = owned_values[row * components + c];
  }
  target.doImport(source, *import_, Tpetra::INSERT);
  std::vector<double> result(static_cast<std::size_t>(local_size_) * components);
  const auto view = target.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (LocalOrdinal row = 0; row < local_size_; ++row)
    for (int c = 0; c < components; ++c) result[static_cast<std::size_t>(row) * components + c] = view(row, c);
  return result;
}

}  // namespace mortise
