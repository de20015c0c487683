#pragma once
// Numbers that are shared out in consecutive intervals.

#include <algorithm>
#include <vector>

#include "mortise/core/types.hpp"

namespace mortise {

/// Index of the interval [offsets[k], offsets[k+1]) that holds `number`.
inline int interval(const std::vector<GlobalOrdinal>& offsets, GlobalOrdinal number) {
  return static_cast<int>(std::upper_bound(offsets.begin(), offsets.end(), number) - offsets.begin()) - 1;
}

}  // namespace mortise
