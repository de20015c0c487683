#pragma once
// The graph of elements that is cut to share them out.

#include <metis.h>

#include <vector>

#include "distribution/body_set.hpp"

namespace mortise {

/// In compressed rows: neighbours[offsets[e]] to neighbours[offsets[e + 1] - 1] are those of element e, each with its weight.
struct ElementGraph {
  std::vector<idx_t> offsets, neighbours, weights;
};

/// Elements that share a side, and elements that face one another across contact (facing_elements), so that what contact couples stays together.
/// @param is_contact  [body][side name index]
/// Throws std::runtime_error if METIS cannot build it.
ElementGraph element_graph(const BodySet& bodies, const std::vector<std::vector<bool>>& is_contact);

}  // namespace mortise
