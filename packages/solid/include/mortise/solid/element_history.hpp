#pragma once
// What the points of a block's elements remember from step to step.

#include <array>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include "mortise/core/state_archive.hpp"
#include "mortise/material/history.hpp"
#include "mortise/mesh/mesh.hpp"

namespace mortise {

/// A state for each of the `points` of each element; nothing for integrands whose state is NoState.
template <class State, int points>
class ElementHistory {
 public:
  using States = std::array<State, points>;  ///< of an element
  static constexpr bool exists = !std::is_same_v<State, NoState>;

  explicit ElementHistory(const Block& block) {
    if constexpr (exists) states_.resize(block.size());
  }

  const States& operator[]([[maybe_unused]] LocalOrdinal element) const {
    if constexpr (exists) {
      return states_[element];
    } else {
      static constexpr States none{};
      return none;
    }
  }
  States& operator[](LocalOrdinal element) {
    static_assert(exists);
    return states_[element];
  }

  std::size_t bytes() const { return states_.capacity() * sizeof(States); }

  /// Stores or restores by the ids of the elements. Collective.
  void serialize([[maybe_unused]] StateArchive& archive, [[maybe_unused]] const std::string& name, [[maybe_unused]] const Block& block) {
    if constexpr (exists) {
      static_assert(std::is_trivially_copyable_v<States> && sizeof(States) % sizeof(double) == 0, "a history is stored as numbers");
      constexpr std::size_t columns = sizeof(States) / sizeof(double);
      std::vector<double> rows(columns * states_.size());
      std::memcpy(rows.data(), states_.data(), rows.size() * sizeof(double));
      archive.rows(name + ".history", {name + ".elements", block.element_ids, static_cast<std::size_t>(block.owned)}, columns, rows);
      if (archive.restores()) std::memcpy(static_cast<void*>(states_.data()), rows.data(), rows.size() * sizeof(double));
    }
  }

 private:
  std::vector<States> states_;  ///< [elements]
};

}  // namespace mortise
