#pragma once
// Fields of a run as one Exodus file.

#include <functional>
#include <string>

namespace mortise {

/// Contents of an Exodus file.
struct ExodusContent {
  long long nodes = 0, elements = 0;
  int blocks = 0;             ///< one for each body
  int steps = 0;              ///< with fields
  int node_variables = 0;     ///< components of fields on nodes
  int element_variables = 0;  ///< components of fields on elements
};

/// Writes mesh and fields of all steps below `run`, which a FieldWriter left, to an Exodus II file (64-bit offsets, double precision). A body is an
/// element block with its name. A component of a field is a variable, as displacement_x and cauchy_stress_xy; models in 2D have the in-plane ones,
/// and zz of tensors. Where a step lacks a field that another one has, its values are not numbers. Node and element ids are those of the run, plus 1.
/// Memory does not grow with the mesh: rows are copied in chunks. The file has ".part" behind its name until it is complete. No communication.
/// @param file  gives the path of the file; called once the run has been read and found good
/// @throws FileError  what cannot be read, is damaged, has no steps, or cannot be written
ExodusContent write_exodus(const std::string& run, const std::function<std::string()>& file);

}  // namespace mortise
