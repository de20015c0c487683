#pragma once
// The XDMF file: which datasets of the HDF5 file make up which step.

#include <string>
#include <vector>

#include "mortise/io/field_writer.hpp"

namespace mortise {

/// What a step's fields are, without their values.
struct XdmfField {
  std::string name;
  Field::Center center = Field::Center::node;
  FieldKind kind = FieldKind::scalar;
};

struct XdmfStep {
  double time = 0.0;
  std::vector<XdmfField> fields;
};

/// Sizes of the mesh and what stands in the HDF5 file.
struct XdmfMesh {
  std::string hdf5_name;  ///< file name without directory
  long long nodes = 0, elements = 0, topology_size = 0;
  std::vector<std::string> bodies;
};

/// Components of a field in the file: 1, 3 or 6.
int stored_components(FieldKind kind);

/// Path of a field in the HDF5 file; `step` from 0.
std::string step_group(std::size_t step);

// The file is head, steps, tail. A step replaces the tail by itself and the tail, so that each costs the same.

/// From the document's first line to the start tag of the collection of steps.
std::string xdmf_head(const XdmfMesh& mesh);

/// The grid of one step; `index` from 0.
std::string xdmf_step(const XdmfMesh& mesh, const XdmfStep& step, std::size_t index);

/// The end tags of what the head opens.
std::string xdmf_tail();

}  // namespace mortise
