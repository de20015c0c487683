#pragma once
// Values in the order of ids: from the rank that owns an id to the rank that writes its row.

#include <vector>

#include "mortise/core/types.hpp"

namespace mortise {

/// Spreads the rows 0 ... n - 1 in equal, contiguous parts over the ranks, so that each writes one slab of a file.
class IdOrder {
 public:
  /// Collective. Throws std::invalid_argument on all ranks if `owned` are not the ids 0 ... n - 1, each on one rank.
  explicit IdOrder(const RCP<const Map>& owned);

  /// Rows of this rank's slab from those of the owned ids. Collective.
  std::vector<double> arrange(const std::vector<double>& owned_values, int components) const;

  GlobalOrdinal size() const { return size_; }             ///< rows over all ranks
  GlobalOrdinal first() const { return first_; }           ///< first row of this rank
  LocalOrdinal local_size() const { return local_size_; }  ///< rows of this rank

 private:
  RCP<const Map> owned_, rows_;
  RCP<const Import> import_;
  GlobalOrdinal size_ = 0, first_ = 0;
  LocalOrdinal local_size_ = 0;
};

}  // namespace mortise
