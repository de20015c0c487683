#pragma once
// The XDMF file: which datasets of the HDF5 files make up which step.

#include <string>
#include <vector>

#include "fields/field_files.hpp"

namespace mortise {

/// Sizes of the mesh, and the names of its bodies.
struct XdmfMesh {
  long long nodes = 0, elements = 0, topology_size = 0;
  std::vector<std::string> bodies;
};

/// Components of a field in the file: 1, 3 or 6.
int stored_components(FieldKind kind);

// The file is head, steps, tail. A step replaces the tail by itself and the tail, so that each costs the same.

/// From the document's first line to the start tag of the collection of steps.
std::string xdmf_head(const XdmfMesh& mesh);

/// The grid of one step.
std::string xdmf_step(const XdmfMesh& mesh, const StoredStep& step);

/// Reads the names of bodies from the head of a file, which does not have to be whole. Unreadable names are left out.
void read_body_names(const std::string& path, std::vector<std::string>& names);

/// The end tags of what the head opens.
std::string xdmf_tail();

}  // namespace mortise
