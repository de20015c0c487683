#pragma once
// Rows of values by number: whole on rank 0, and what was fetched from there on the others.

#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

#include "mortise/core/types.hpp"

namespace mortise {

/// A row of a RowStore.
template <class T>
struct Row {
  const T *first = nullptr, *last = nullptr;
  const T* begin() const { return first; }
  const T* end() const { return last; }
  std::size_t size() const { return static_cast<std::size_t>(last - first); }
};

/// Rows of different lengths. Either all of them, by their numbers, or those of some ids.
template <class T>
class RowStore {
 public:
  /// Of all rows: their lengths first, then their values.
  void assign(std::vector<std::int64_t> offsets, std::vector<T> values) {
    ids_.clear(), offsets_ = std::move(offsets), values_ = std::move(values);
    is_whole_ = true;
  }
  /// Throws std::logic_error if the row was not fetched.
  Row<T> row(GlobalOrdinal id) const {
    const std::size_t place = is_whole_ ? static_cast<std::size_t>(id) : find(id);
    return {values_.data() + offsets_.at(place), values_.data() + offsets_.at(place + 1)};
  }
  /// Replaces what was fetched before by the rows of `ids` (ascending, without repeats) of the whole store on rank 0. Collective; a whole store on
  /// rank 0 answers and stays as it is, `ids` are passed over there.
  void fetch(const Communicator& comm, const std::vector<GlobalOrdinal>& ids);

 private:
  std::size_t find(GlobalOrdinal id) const;

  bool is_whole_ = false;
  std::vector<GlobalOrdinal> ids_;        ///< [rows] ascending; none: all
  std::vector<std::int64_t> offsets_{0};  ///< [rows + 1]
  std::vector<T> values_;
};

extern template class RowStore<std::int32_t>;
extern template class RowStore<double>;

}  // namespace mortise
