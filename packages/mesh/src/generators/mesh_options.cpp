#include "mortise/mesh/mesh_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "mortise/mesh/file_mesh.hpp"
#include "mortise/mesh/generators.hpp"
#include "mortise/mesh/volume_generators.hpp"

namespace mortise {

void MeshOptions::describe(Parameters& parameters) {
  describe_shape(parameters);
  describe_rotation(parameters);
  const std::string numbers = dimension_ == 2 ? "\"x, y\"" : "\"x, y, z\"";
  parameters.add("translation", translation, Says("moves the mesh after its rotation: " + numbers).unit("length"));
  if (translation.size() != static_cast<std::size_t>(dimension_)) {
    parameters.error("translation",
                     fmt::format("is \"{}\"; it needs {} numbers, {}", fmt::join(translation, ", "), dimension_ == 2 ? "two" : "three", numbers));
    translation.assign(dimension_, 0.0);
  }
}

void PlaneMesh::describe_rotation(Parameters& parameters) {
  parameters.add("rotation", rotation, Says("turns the mesh counterclockwise about the origin").unit("degrees"));
}

BodyComplex PlaneMesh::complex(CellShape cell, const Place& place) const {
  if (cell == CellShape::line2) return build_surface(place);
  return build(cell, place);
}

BodyComplex VolumeMesh::complex(CellShape cell, const Place& place) const {
  if (cell == CellShape::quadrilateral4) return build_surface(place);
  return build(cell, place);
}

void VolumeMesh::describe_rotation(Parameters& parameters) { describe_spatial_rotation(parameters, rotation_axis); }

void MeshOptions::describe_spatial_rotation(Parameters& parameters, std::vector<double>& rotation_axis) {
  parameters.add("rotation", rotation, Says("turns the mesh about an axis through the origin, counterclockwise seen from its tip").unit("degrees"));
  parameters.add(
      "rotation axis", rotation_axis,
      "direction of the axis that it turns about, \"x, y, z\"; for instance, 120 degrees about \"1, 1, 1\" take x to y, y to z and z to x");
  if (rotation_axis.size() != 3 || std::all_of(rotation_axis.begin(), rotation_axis.end(), [](double r) { return r == 0.0; })) {
    parameters.error("rotation axis",
                     fmt::format("is \"{}\"; it needs three numbers, \"x, y, z\", of which not all are zero", fmt::join(rotation_axis, ", ")));
    rotation_axis = {0.0, 0.0, 1.0};
  }
}

namespace {

/// Adds the kinds of the plane to a registry of them or of all meshes.
template <class Base>
void add_plane_kinds(Registry<Base>& kinds) {
  kinds.template add<BlockMesh>("block", "rectangle or general quadrilateral; sides bottom, right, top, left");
  kinds.template add<WedgeMesh>("wedge", "trapezoid with an inclined top; sides bottom, right, top, left");
  kinds.template add<RingSectorMesh>("ring sector", "part of a ring about the origin; sides inner, outer, start, end");
  kinds.template add<FullDiskMesh>("disk", "disk about the origin; side arc");
  kinds.template add<QuarterDiskMesh>("quarter disk", "the quarter x >= 0, y <= 0 of a disk about the origin; sides diameter, axis, arc");
  kinds.template add<HalfDiskMesh>("half disk", "the lower or the right half of a disk about the origin; sides diameter or axis, arc");
  kinds.template add<ProfileMesh>("profile", "a polyline with rounded corners, for rigid bodies; side profile");
}

}  // namespace

const Registry<PlaneMesh>& plane_mesh_registry() {
  static const Registry<PlaneMesh> registry = [] {
    Registry<PlaneMesh> kinds;
    add_plane_kinds(kinds);
    return kinds;
  }();
  return registry;
}

const Registry<MeshOptions>& mesh_registry() {
  static const Registry<MeshOptions> registry = [] {
    Registry<MeshOptions> kinds;
    add_plane_kinds(kinds);
    kinds.add<BrickMesh>("brick", "cuboid with a corner at the origin; sides left, right (x), front, back (y), bottom, top (z)");
    kinds.add<CylinderMesh>("cylinder", "cylinder about the z axis, from z = 0; sides bottom, top, mantle");
    kinds.add<ExtrudedMesh>("extruded", "a mesh of the plane moved along z, from z = 0; sides of the plane mesh, start, end");
    kinds.add<RevolvedMesh>("revolved", "a mesh of the plane x > 0 turned about the y axis; sides of the plane mesh, start, end");
    kinds.add<SphereOctantMesh>("sphere octant", "the octant x, y >= 0, z <= 0 of a ball about the origin; sides x plane, y plane, equator, sphere");
    kinds.add<FileMesh>("file", "a mesh of a file: Exodus II, Gmsh, Abaqus or CalculiX; sides and node sets as the file names them");
    return kinds;
  }();
  return registry;
}

}  // namespace mortise
