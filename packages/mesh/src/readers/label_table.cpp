#include "readers/label_table.hpp"

namespace mortise {
namespace {

/// A dense table may have so many entries for each label: it is then no larger than a sorted one.
constexpr std::uint64_t most_dense_entries_per_label = 4;

}  // namespace

LabelTable::LabelTable(const std::vector<std::int64_t>& labels) {
  if (labels.empty()) return;
  const auto [low, high] = std::minmax_element(labels.begin(), labels.end());
  low_ = *low;
  high_ = *high;
  const std::uint64_t span = static_cast<std::uint64_t>(high_) - static_cast<std::uint64_t>(low_);
  const auto count = static_cast<std::int32_t>(labels.size());
  if (span / most_dense_entries_per_label < labels.size()) {
    dense_.assign(static_cast<std::size_t>(span) + 1, -1);
    for (std::int32_t n = 0; n < count; ++n) {
      std::int32_t& index = dense_[static_cast<std::size_t>(labels[n] - low_)];
      if (index < 0)
        index = n;
      else if (!repeated_)
        repeated_ = {index, n};
    }
    return;
  }
  sorted_.reserve(labels.size());
  for (std::int32_t n = 0; n < count; ++n) sorted_.push_back({labels[n], n});
  std::sort(sorted_.begin(), sorted_.end(),
            [](const Entry& a, const Entry& b) { return a.label != b.label ? a.label < b.label : a.index < b.index; });
  const auto same = std::adjacent_find(sorted_.begin(), sorted_.end(), [](const Entry& a, const Entry& b) { return a.label == b.label; });
  if (same != sorted_.end()) repeated_ = {same->index, std::next(same)->index};
}

std::int32_t LabelTable::find_sorted(std::int64_t label) const {
  const auto found = lower_bound(label);
  return found != sorted_.end() && found->label == label ? found->index : -1;
}

}  // namespace mortise
