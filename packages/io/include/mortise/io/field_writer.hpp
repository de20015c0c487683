#pragma once
// Fields over the mesh and over time, for ParaView: fields.xdmf (XDMF 3) and HDF5 files, one for each step.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mortise/mesh/mesh.hpp"

namespace mortise {

enum class FieldKind {
  scalar,            ///< 1 component
  vector,            ///< 2 or 3 components; the third is written as 0 if it is not given
  symmetric_tensor,  ///< 4 components xx, yy, zz, xy, or 6: xx, yy, zz, xy, yz, xz
  integer            ///< 1 component, a whole number
};

/// A field on the nodes or on the elements.
struct Field {
  enum class Center { node, cell };
  std::string name;
  Center center = Center::node;
  FieldKind kind = FieldKind::scalar;
  int components = 1;
  /// [owned nodes x components], or [owned elements of all blocks, block after block, x components]
  std::vector<double> values;
};

/// Writes fields of one mesh step by step. All members are collective; what goes wrong with a file is a FileError on all ranks.
///
/// fields/mesh.h5 holds
///   /coordinates  [nodes x 3], reference
///   /topology     mixed: each element its XDMF type and its nodes
///   /body         [elements], index of the body
/// fields/step-000012.h5 holds the fields of step 12, each a dataset in `/` with attributes `kind` and `center`. Attributes of the file: `step`,
/// `time`. fields.xdmf is the index of these files.
///
/// Tensors have XDMF's order xx, xy, xz, yy, yz, zz. Nodes and elements are in the order of their ids, whatever the number of ranks. A file gets
/// its name when it is complete and does not change any more; the index alone grows, by a step at a time. So whatever ends the program leaves all
/// earlier steps as they are. Written data is with the operating system, not yet on the disk: sync_file() brings it there.
class FieldWriter {
 public:
  /// Writes the mesh and an index without steps in `directory`. Node ids and element ids have to be 0 ... number - 1: std::invalid_argument.
  /// @param continue_after  a step of an earlier run in the directory, which is to be continued. Its mesh and its steps up to this one stay. The
  ///                        index is made from their files. Those of later steps are removed. Without: all of them are removed.
  /// @throws FileError also if the mesh of the earlier run has other numbers of nodes or elements
  FieldWriter(RCP<const Mesh> mesh, const std::string& directory, std::optional<int> continue_after = {});
  ~FieldWriter();

  /// Adds the fields of a step at pseudo-time `time`. Throws std::invalid_argument on all ranks for values that do not fit the mesh, and for a step
  /// that does not come after those that were written.
  void write(int step, double time, const std::vector<Field>& fields);

  /// Steps whose fields the index names, ascending, the same on every rank: those that were written, and those that a run that goes on found.
  const std::vector<int>& steps() const;

  /// Returns when all that was written is on the disk: it outlives a loss of power.
  void sync();

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace mortise
