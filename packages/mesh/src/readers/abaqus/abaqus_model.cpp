#include "readers/abaqus/abaqus_model.hpp"

#include "readers/abaqus/abaqus_keyword.hpp"

namespace mortise {

template <class Entry>
Entry& AbaqusNames<Entry>::operator[](const std::string& name) {
  const auto [place, added] = places_.emplace(in_capitals(name), static_cast<std::int32_t>(entries_.size()));
  if (added) {
    entries_.emplace_back();
    entries_.back().name = name;
  }
  return entries_[static_cast<std::size_t>(place->second)];
}

template <class Entry>
std::int32_t AbaqusNames<Entry>::find(const std::string& name) const {
  const auto found = places_.find(in_capitals(name));
  return found == places_.end() ? -1 : found->second;
}

template class AbaqusNames<AbaqusSet>;
template class AbaqusNames<AbaqusSurface>;

std::vector<std::int32_t> AbaqusScope::first_cells() const {
  std::vector<std::int32_t> first{0};
  for (const FileCells& group : cells) first.push_back(first.back() + static_cast<std::int32_t>(group.labels.size()));
  return first;
}

}  // namespace mortise
