// Bodies that are swept: brick, cylinder, extruded, revolved.

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/constants/constants.hpp>

#include "generators/collapsed_sweep.hpp"
#include "generators/describe_cells.hpp"
#include "mortise/mesh/volume_generators.hpp"

namespace mortise {
namespace {

/// Shape of the plane elements below cells of a shape. Throws InputError for cells that no sweep makes.
CellShape profile_shape(CellShape cell, const Place& place) {
  const auto shape = SweptComplex::profile_shape(cell);
  if (!shape)
    throw InputError(place, "a swept mesh cannot be made of pyramids; please choose an element of hexahedra, wedges or tetrahedra, as \"H8\"");
  return *shape;
}

}  // namespace

void BrickMesh::describe_shape(Parameters& parameters) {
  parameters.add("width", width, Says("extent in x, from the origin").unit("length").above(0.0));
  parameters.add("depth", depth, Says("extent in y, from the origin").unit("length").above(0.0));
  parameters.add("height", height, Says("extent in z, from the origin").unit("length").above(0.0));
  describe_cells(parameters, cells_x, grading_x, "cells x", "grading x", "from left to right");
  describe_cells(parameters, cells_y, grading_y, "cells y", "grading y", "from front to back");
  describe_cells(parameters, cells_z, grading_z, "cells z", "grading z", "from bottom to top");
}

BodyComplex BrickMesh::build(CellShape cell, const Place& place) const {
  const Spacing x = grading_x.spacing(width, cells_x, place), y = grading_y.spacing(depth, cells_y, place);
  PatchComplex base(profile_shape(cell, place), {{0.0, 0.0}, {width, 0.0}, {width, depth}, {0.0, depth}},
                    {{0, 1, x}, {1, 2, y}, {3, 2, x}, {0, 3, y}}, {{{0, 1, 2, 3}, {"front", "right", "back", "left"}}}, {});
  return SweptComplex(cell, std::move(base), grading_z.spacing(height, cells_z, place), Extrusion{height}, {"bottom", "top"}, placement());
}

// Corner i + 2 j + 4 k of the cuboid is at the start (0) or end (1) in each direction.
ShellComplex BrickMesh::build_surface(const Place& place) const {
  const std::array<Spacing, 3> spacings{grading_x.spacing(width, cells_x, place), grading_y.spacing(depth, cells_y, place),
                                        grading_z.spacing(height, cells_z, place)};
  const std::array<double, 3> lengths{width, depth, height};
  const std::array<std::string, 6> names{"left", "right", "front", "back", "bottom", "top"};
  std::vector<ShellComplex::Patch> patches;
  for (int side = 0; side < 6; ++side) {  // i and j run in the next two directions at the end of one, in the opposite order at its start
    const int end = side % 2, normal = side / 2, a = (normal + (end ? 1 : 2)) % 3, b = (normal + (end ? 2 : 1)) % 3, first = end << normal;
    patches.push_back(
        {{first, first + (1 << a), first + (1 << a) + (1 << b), first + (1 << b)}, {spacings[a].cells(), spacings[b].cells()}, names[side]});
  }
  const auto position = [=](const ShellComplex::GridPoint& point) {
    const int end = point.patch % 2, normal = point.patch / 2, a = (normal + (end ? 1 : 2)) % 3, b = (normal + (end ? 2 : 1)) % 3;
    SpatialPoint x{};
    x[normal] = end * lengths[normal];
    x[a] = lengths[a] * spacings[a].position(point.at[0]);
    x[b] = lengths[b] * spacings[b].position(point.at[1]);
    return x;
  };
  return ShellComplex(std::move(patches), position, placement());
}

void CylinderMesh::describe_shape(Parameters& parameters) {
  disk.describe_shape(parameters);
  parameters.add("height", height, Says("extent in z, from the origin").unit("length").above(0.0));
  describe_cells(parameters, cells_z, grading_z, "cells z", "grading z", "from bottom to top");
}

BodyComplex CylinderMesh::build(CellShape cell, const Place& place) const {
  return SweptComplex(cell, disk.build(profile_shape(cell, place), place), grading_z.spacing(height, cells_z, place), Extrusion{height},
                      {"bottom", "top"}, placement());
}

ShellComplex CylinderMesh::build_surface(const Place& place) const {
  return sweep_surface(disk.build_surface(place), grading_z.spacing(height, cells_z, place), Extrusion{height}, placement());
}

namespace {

/// The list "profile".
struct ProfileList {
  Choice<PlaneMesh>& mesh;
  void describe(Parameters& parameters) { parameters.choose(mesh, plane_mesh_registry(), "shape of this mesh"); }
};

}  // namespace

void SweptMesh::describe_profile(Parameters& parameters, const std::string& sentence) {
  ProfileList list{profile};
  parameters.list("profile", list, sentence);
}

const PlaneMesh& SweptMesh::require_profile(const Place& place) const {
  if (!profile.options) throw InputError(place, "the swept mesh has no \"profile\"");
  return *profile.options;
}

SweptComplex SweptMesh::sweep_body(PatchComplex plane, CellShape cell, const Spacing& layers, const Sweep& sweep) const {
  const auto& names = plane.side_names();
  const bool is_taken = std::any_of(names.begin(), names.end(), [](const std::string& name) { return name == "start" || name == "end"; });
  const std::string prefix = is_taken ? "sweep " : "";
  return SweptComplex(cell, std::move(plane), layers, sweep, {prefix + "start", prefix + "end"}, placement());
}

void ExtrudedMesh::describe_shape(Parameters& parameters) {
  describe_profile(parameters, "the mesh of the plane z = 0 that is moved along z; its sides keep their names");
  parameters.add("height", length, Says("extent in z, from \"start\" at z = 0 to \"end\"").unit("length").above(0.0).formerly("length"));
  describe_cells(parameters, cells_z, grading_z, "cells z", "grading z", "from start to end");
}

BodyComplex ExtrudedMesh::build(CellShape cell, const Place& place) const {
  return sweep_body(require_profile(place).build(profile_shape(cell, place), place), cell, grading_z.spacing(length, cells_z, place),
                    Extrusion{length});
}

ShellComplex ExtrudedMesh::build_surface(const Place& place) const {
  return sweep_surface(require_profile(place).build_surface(place), grading_z.spacing(length, cells_z, place), Extrusion{length}, placement());
}

void RevolvedMesh::describe_shape(Parameters& parameters) {
  describe_profile(parameters, "the mesh of the half plane z = 0, x >= 0 that is turned about the y axis; its sides keep their names");
  parameters.add("angle", angle,
                 Says("angle by which it is turned, from the x axis (\"start\") toward the z axis").unit("degrees").above(0.0).below(360.0));
  describe_cells(parameters, cells_around, grading_around, "cells around", "grading around", "from start to end (sizes where the radius is largest)");
}

namespace {

constexpr double at_axis = 1e-9;  ///< over the largest radius

struct Turn {
  Spacing layers;
  Revolution sweep;
};

/// The smallest and largest x of a profile. Throws InputError for one beyond the axis.
template <class PlaneComplex>
std::array<double, 2> reach_of(const PlaneComplex& plane, const Place& place) {
  double least = plane.coordinate(0)[0], most = least;
  for (GlobalOrdinal node = 1; node < plane.node_count(); ++node) {
    const double x = plane.coordinate(node)[0];
    least = std::min(least, x);
    most = std::max(most, x);
  }
  if (!(least >= -at_axis * most))
    throw InputError(place, fmt::format("the profile of a revolved mesh reaches x = {:g}; allowed: x >= 0, one side of the axis", least));
  return {least, most};
}

/// Angle and layers by which a profile is turned, by its largest x.
Turn turn_of(const RevolvedMesh& mesh, double most, const Place& place) {
  const double angle = mesh.angle * boost::math::constants::pi<double>() / 180.0;
  return {mesh.grading_around.spacing(most * angle, mesh.cells_around, place), {angle}};
}

}  // namespace

BodyComplex RevolvedMesh::build(CellShape cell, const Place& place) const {
  PatchComplex plane = require_profile(place).build(profile_shape(cell, place), place);
  const Turn turn = turn_of(*this, reach_of(plane, place)[1], place);
  return sweep_body(std::move(plane), cell, turn.layers, turn.sweep);
}

std::optional<MeshFile> RevolvedMesh::listed(CellShape cell, const Place& place) const {
  if (cell == CellShape::quadrilateral4) {  // the surface of a rigid body
    const CurveComplex curve = require_profile(place).build_surface(place);
    const auto [least, most] = reach_of(curve, place);
    if (least > at_axis * most) return std::nullopt;
    const Turn turn = turn_of(*this, most, place);
    return collapse_onto_axis(sweep_surface(curve, turn.layers, turn.sweep, {}), sweep_surface(curve, turn.layers, turn.sweep, placement()),
                              at_axis * most);
  }
  if (topology(cell).dimension != 3) return std::nullopt;
  const auto [least, most] = reach_of(require_profile(place).build(profile_shape(cell, place), place), place);
  if (least > at_axis * most) return std::nullopt;
  return collapse_onto_axis(std::get<SweptComplex>(build(cell, place)), place);
}

ShellComplex RevolvedMesh::build_surface(const Place& place) const {
  const CurveComplex curve = require_profile(place).build_surface(place);
  const auto [least, most] = reach_of(curve, place);
  if (!(least > at_axis * most))
    throw InputError(
        place,
        fmt::format("the profile of a rigid revolved mesh reaches x = {:g}, where its facets would be triangles; please leave a small hole about the "
                    "axis, or take a ball or an extruded disk",
                    least));
  const Turn turn = turn_of(*this, most, place);
  return sweep_surface(curve, turn.layers, turn.sweep, placement());
}

}  // namespace mortise
