#pragma once
// The check of a mesh's elements.

#include <string>
#include <vector>

#include "distribution/body_set.hpp"
#include "mortise/mesh/mesh.hpp"

namespace mortise {

/// Elements with det J <= 0.
struct InvertedElements {
  std::vector<Diagnostic> errors;     ///< the first of each block on this rank that cannot be integrated
  std::vector<std::string> warnings;  ///< of blocks with elements where it is so in corners alone; the same on every rank
};

/// Looks at all elements. Collective.
InvertedElements find_inverted_elements(const Mesh& mesh, const BodySet& set, const std::vector<BodyDescription>& bodies);

}  // namespace mortise
