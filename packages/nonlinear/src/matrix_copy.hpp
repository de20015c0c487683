#pragma once
// Copies of a matrix into one with a larger graph.

#include <cstddef>
#include <vector>

#include "mortise/core/types.hpp"

namespace mortise {

/// For each local entry of `source` its place among the local entries of `target`, whose graph holds source's. Both filled.
std::vector<std::size_t> places_of_entries(const Matrix& source, const Matrix& target);

/// target = source where source has entries, 0 elsewhere. `target` is open for sums afterwards.
void copy_entries(const Matrix& source, const std::vector<std::size_t>& places, Matrix& target);

}  // namespace mortise
