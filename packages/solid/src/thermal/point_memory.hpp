#pragma once
// What points remember where the law says at run time how much that is.

#include <cstddef>
#include <string>
#include <vector>

#include "mortise/core/state_archive.hpp"
#include "mortise/material/thermal_law.hpp"
#include "mortise/mesh/mesh.hpp"

namespace mortise {

/// The numbers of each point of each element of a block; none for laws without memory.
class PointMemory {
 public:
  PointMemory(const Block& block, int points, const ThermalLaw& law) : points_(points), size_(law.state_size()) {
    numbers_.resize(static_cast<std::size_t>(block.size()) * points_ * size_);
    if (size_ > 0)
      for (auto at = numbers_.begin(); at != numbers_.end(); at += size_) law.start(&*at);
  }

  bool exists() const { return size_ > 0; }
  const double* at(LocalOrdinal element, int point) const { return numbers_.data() + place(element, point); }
  double* at(LocalOrdinal element, int point) { return numbers_.data() + place(element, point); }
  std::size_t bytes() const { return numbers_.capacity() * sizeof(double); }

  /// Stores or restores by the ids of the elements. Collective.
  void serialize(StateArchive& archive, const std::string& name, const Block& block) {
    if (!exists()) return;
    archive.rows(name + ".history", {name + ".elements", block.element_ids, static_cast<std::size_t>(block.owned)},
                 static_cast<std::size_t>(points_) * size_, numbers_);
  }

 private:
  std::size_t place(LocalOrdinal element, int point) const { return (static_cast<std::size_t>(element) * points_ + point) * size_; }

  int points_, size_;
  std::vector<double> numbers_;  ///< [elements x points x size]
};

}  // namespace mortise
