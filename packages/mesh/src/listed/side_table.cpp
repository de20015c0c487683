#include "listed/side_table.hpp"

#include <algorithm>

namespace mortise {

CornerKey corner_key(const std::int32_t* corners, int count) {
  CornerKey key;
  key.fill(-1);
  std::copy_n(corners, count, key.begin());
  std::sort(key.begin(), key.begin() + count);
  return key;
}

namespace {

/// visit(side) for each side of each element.
template <class Visit>
void for_each_side(const BodyElements& elements, const Visit& visit) {
  std::int32_t element = 0;
  for (const BodyPart& part : elements.parts) {
    const auto sides = static_cast<std::int32_t>(topology(part.shape).sides.size());
    for (GlobalOrdinal e = 0; e < part.elements; ++e, ++element)
      for (std::int32_t side = 0; side < sides; ++side) visit(ElementSide{element, side});
  }
}

}  // namespace

CornerKey SideTable::key(const ElementSide& side) const {
  const CellSide& of = elements_.cell(side.element).sides[static_cast<std::size_t>(side.side)];
  const std::int32_t* nodes = elements_.nodes_of(side.element);
  std::array<std::int32_t, 4> corners{};
  for (int c = 0; c < of.corners; ++c) corners[c] = nodes[of.nodes[c]];
  return corner_key(corners.data(), of.corners);
}

SideTable::SideTable(const BodyElements& elements, std::int32_t nodes) : elements_(elements), first_(static_cast<std::size_t>(nodes) + 1, 0) {
  for_each_side(elements, [&](const ElementSide& side) { ++first_[static_cast<std::size_t>(key(side)[0]) + 1]; });
  for (std::size_t node = 1; node < first_.size(); ++node) first_[node] += first_[node - 1];
  sides_.resize(static_cast<std::size_t>(first_.back()));
  auto next = first_;
  for_each_side(elements, [&](const ElementSide& side) { sides_[static_cast<std::size_t>(next[static_cast<std::size_t>(key(side)[0])]++)] = side; });
  std::vector<std::pair<CornerKey, ElementSide>> sorted;
  for (std::size_t node = 0; node + 1 < first_.size(); ++node) {
    const auto begin = sides_.begin() + first_[node], end = sides_.begin() + first_[node + 1];
    sorted.clear();
    for (auto side = begin; side != end; ++side) sorted.emplace_back(key(*side), *side);
    std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::transform(sorted.begin(), sorted.end(), begin, [](const auto& one) { return one.second; });
  }
}

/// visit(first, last) for each group of sides with the same corners.
template <class Visit>
void SideTable::for_each_run(const Visit& visit) const {
  for (auto first = sides_.begin(); first != sides_.end();) {
    const CornerKey of_first = key(*first);
    auto last = first + 1;
    while (last != sides_.end() && key(*last) == of_first) ++last;
    visit(first, last);
    first = last;
  }
}

std::vector<ElementSide> SideTable::surface() const {
  std::vector<ElementSide> found;
  for_each_run([&](auto first, auto last) {
    if (last - first == 1) found.push_back(*first);
  });
  std::sort(found.begin(), found.end(),
            [](const ElementSide& a, const ElementSide& b) { return a.element != b.element ? a.element < b.element : a.side < b.side; });
  return found;
}

std::vector<ElementSide> SideTable::shared_by_many() const {
  std::vector<ElementSide> found;
  for_each_run([&](auto first, auto last) {
    if (last - first > 2 && found.empty()) found.assign(first, last);
  });
  return found;
}

std::vector<ElementSide> SideTable::find(const CornerKey& corners) const {
  if (corners[0] < 0 || corners[0] + 1 >= static_cast<std::int32_t>(first_.size())) return {};
  const auto begin = sides_.begin() + first_[static_cast<std::size_t>(corners[0])],
             end = sides_.begin() + first_[static_cast<std::size_t>(corners[0]) + 1];
  const auto first = std::lower_bound(begin, end, corners, [&](const ElementSide& side, const CornerKey& of) { return key(side) < of; });
  auto last = first;
  while (last != end && key(*last) == corners) ++last;
  return {first, last};
}

}  // namespace mortise
