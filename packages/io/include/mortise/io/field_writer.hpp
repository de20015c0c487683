#pragma once
// Fields over the mesh and over time, for ParaView: fields.xdmf (XDMF 3) and fields.h5 (parallel HDF5).

#include <memory>
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
/// fields.h5 holds
///   /mesh/coordinates  [nodes x 3], reference
///   /mesh/topology     mixed: each element its XDMF type and its nodes
///   /mesh/body         [elements], index of the body
///   /steps/<number>/<field>
/// Tensors have XDMF's order xx, xy, xz, yy, yz, zz. Nodes and elements stand in the order of their ids, whatever the number of ranks. Both files are
/// complete and closed after each call.
class FieldWriter {
 public:
  /// Makes both files in `directory` and writes the mesh. Node ids and element ids have to be 0 ... number - 1: std::invalid_argument.
  FieldWriter(RCP<const Mesh> mesh, const std::string& directory);
  ~FieldWriter();

  /// Adds the fields at pseudo-time `time`. Throws std::invalid_argument on all ranks for values that do not fit the mesh.
  void write(double time, const std::vector<Field>& fields);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace mortise
