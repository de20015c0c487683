#include "mortise/mesh/mesh_options.hpp"

#include "mortise/mesh/generators.hpp"

namespace mortise {

void MeshOptions::describe(Parameters& parameters) {
  describe_shape(parameters);
  parameters.add("rotation", rotation, Says("turns the mesh counterclockwise about the origin").unit("degrees"));
  parameters.add("translation", translation, Says("moves the mesh after its rotation: \"x, y\"").unit("length"));
  if (translation.size() != 2) {
    parameters.error("translation", "needs two numbers, \"x, y\"");
    translation.assign(2, 0.0);
  }
}

const Registry<MeshOptions>& mesh_registry() {
  static const Registry<MeshOptions> registry = [] {
    Registry<MeshOptions> kinds;
    kinds.add<BlockMesh>("block", "rectangle or general quadrilateral; sides bottom, right, top, left");
    kinds.add<WedgeMesh>("wedge", "trapezoid with an inclined top; sides bottom, right, top, left");
    kinds.add<RingSectorMesh>("ring sector", "part of a ring about the origin; sides inner, outer, start, end");
    kinds.add<QuarterDiskMesh>("quarter disk", "the quarter x >= 0, y <= 0 of a disk about the origin; sides diameter, axis, arc");
    kinds.add<HalfDiskMesh>("half disk", "the lower or the right half of a disk about the origin; sides diameter or axis, arc");
    kinds.add<ProfileMesh>("profile", "a polyline with rounded corners, for rigid bodies; side profile");
    return kinds;
  }();
  return registry;
}

}  // namespace mortise
