#pragma once
// From the labels of a file to indices.

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace mortise {

/// Finds the index of a label: by a dense table where the labels are nearly all numbers of an interval, else by bisection.
class LabelTable {
 public:
  LabelTable() = default;
  /// label of index n: labels[n]
  explicit LabelTable(const std::vector<std::int64_t>& labels);

  /// The index, or -1.
  std::int32_t find(std::int64_t label) const {
    if (dense_.empty()) return find_sorted(label);
    return label < low_ || label > high_ ? -1 : dense_[static_cast<std::size_t>(label - low_)];
  }
  /// The two lowest indices of a label that stands twice, if there is one.
  const std::optional<std::array<std::int32_t, 2>>& repeated() const { return repeated_; }

  /// visit(index) for each label that there is of first, first + step, ... up to last; step > 0. Returns how many of these numbers are no label.
  template <class Visit>
  std::int64_t visit_range(std::int64_t first, std::int64_t last, std::int64_t step, Visit&& visit) const {
    const std::int64_t numbers = last < first ? 0 : (last - first) / step + 1;
    std::int64_t found = 0;
    // The numbers below the lowest label and above the highest one are skipped at once.
    const std::int64_t begin = first >= low_ ? first : first + (low_ - first + step - 1) / step * step, end = std::min(last, high_);
    if (dense_.empty()) {
      for (auto entry = lower_bound(begin); entry != sorted_.end() && entry->label <= end; ++entry)
        if ((entry->label - first) % step == 0) visit(entry->index), ++found;
    } else {
      for (std::int64_t label = begin; label <= end; label += step)
        if (const std::int32_t index = find(label); index >= 0) visit(index), ++found;
    }
    return numbers - found;
  }

 private:
  struct Entry {
    std::int64_t label;
    std::int32_t index;
  };
  std::int32_t find_sorted(std::int64_t label) const;
  std::vector<Entry>::const_iterator lower_bound(std::int64_t label) const {
    return std::lower_bound(sorted_.begin(), sorted_.end(), label, [](const Entry& entry, std::int64_t value) { return entry.label < value; });
  }

  std::int64_t low_ = 0, high_ = -1;
  std::vector<std::int32_t> dense_;
  std::vector<Entry> sorted_;
  std::optional<std::array<std::int32_t, 2>> repeated_;
};

}  // namespace mortise
