#pragma once
// The check of a mesh's elements.

#include <vector>

#include "distribution/body_set.hpp"
#include "mortise/mesh/mesh.hpp"

namespace mortise {

/// The first inverted element of each body on this rank, with its det J.
std::vector<Diagnostic> inverted_elements(const Mesh& mesh, const BodySet& set, const std::vector<BodyDescription>& bodies);

}  // namespace mortise
