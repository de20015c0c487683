// Bodies that are swept: brick, cylinder, extruded, revolved.

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/constants/constants.hpp>

#include "describe_cells.hpp"
#include "mortise/mesh/volume_generators.hpp"

namespace mortise {

void BrickMesh::describe_shape(Parameters& parameters) {
  parameters.add("width", width, Says("extent in x, from the origin").unit("length").above(0.0));
  parameters.add("depth", depth, Says("extent in y, from the origin").unit("length").above(0.0));
  parameters.add("height", height, Says("extent in z, from the origin").unit("length").above(0.0));
  describe_cells(parameters, cells_x, grading_x, "cells x", "grading x", "from left to right");
  describe_cells(parameters, cells_y, grading_y, "cells y", "grading y", "from front to back");
  describe_cells(parameters, cells_z, grading_z, "cells z", "grading z", "from bottom to top");
}

BodyComplex BrickMesh::complex(CellShape cell, const Place& place) const {
  const Spacing x = grading_x.spacing(width, cells_x, place), y = grading_y.spacing(depth, cells_y, place);
  PatchComplex base(SweptComplex::profile_shape(cell), {{0.0, 0.0}, {width, 0.0}, {width, depth}, {0.0, depth}},
                    {{0, 1, x}, {1, 2, y}, {3, 2, x}, {0, 3, y}}, {{{0, 1, 2, 3}, {"front", "right", "back", "left"}}}, {});
  return SweptComplex(cell, std::move(base), grading_z.spacing(height, cells_z, place), Extrusion{height}, {"bottom", "top"}, placement());
}

void CylinderMesh::describe_shape(Parameters& parameters) {
  disk.describe_shape(parameters);
  parameters.add("height", height, Says("extent in z, from the origin").unit("length").above(0.0));
  describe_cells(parameters, cells_z, grading_z, "cells z", "grading z", "from bottom to top");
}

BodyComplex CylinderMesh::complex(CellShape cell, const Place& place) const {
  return SweptComplex(cell, disk.build(SweptComplex::profile_shape(cell), place), grading_z.spacing(height, cells_z, place), Extrusion{height},
                      {"bottom", "top"}, placement());
}

namespace {

/// The list "profile".
struct ProfileList {
  Choice<PlaneMesh>& mesh;
  void describe(Parameters& parameters) { parameters.choose(mesh, plane_mesh_registry(), "its shape in the plane"); }
};

}  // namespace

void SweptMesh::describe_profile(Parameters& parameters, const std::string& sentence) {
  ProfileList list{profile};
  parameters.list("profile", list, sentence);
}

PatchComplex SweptMesh::build_profile(CellShape cell, const Place& place) const {
  if (!profile.options) throw InputError(place, "the swept mesh has no \"profile\"");
  return profile.options->build(SweptComplex::profile_shape(cell), place);
}

SweptComplex SweptMesh::sweep(CellShape cell, const Place& place, const Spacing& layers, const SweptComplex::Sweep& sweep) const {
  PatchComplex plane = build_profile(cell, place);
  const auto& names = plane.side_names();
  const bool is_taken = std::any_of(names.begin(), names.end(), [](const std::string& name) { return name == "start" || name == "end"; });
  const std::string prefix = is_taken ? "sweep " : "";
  return SweptComplex(cell, std::move(plane), layers, sweep, {prefix + "start", prefix + "end"}, placement());
}

void ExtrudedMesh::describe_shape(Parameters& parameters) {
  describe_profile(parameters, "the mesh of the plane z = 0 that is moved along z; its sides keep their names");
  parameters.add("length", length, Says("extent in z, from \"start\" at z = 0 to \"end\"").unit("length").above(0.0));
  describe_cells(parameters, cells_z, grading_z, "cells z", "grading z", "from start to end");
}

BodyComplex ExtrudedMesh::complex(CellShape cell, const Place& place) const {
  return sweep(cell, place, grading_z.spacing(length, cells_z, place), Extrusion{length});
}

void RevolvedMesh::describe_shape(Parameters& parameters) {
  describe_profile(parameters, "the mesh of the half plane z = 0, x > 0 that is turned about the y axis; its sides keep their names");
  parameters.add("angle", angle, Says("how far it is turned, from the x axis (\"start\") toward the z axis").unit("degrees").above(0.0).below(360.0));
  describe_cells(parameters, cells_around, grading_around, "cells around", "grading around", "from start to end (sizes where the radius is largest)");
}

BodyComplex RevolvedMesh::complex(CellShape cell, const Place& place) const {
  const PatchComplex plane = build_profile(cell, place);
  double least = plane.coordinate(0)[0], most = least;
  for (GlobalOrdinal node = 1; node < plane.node_count(); ++node) {
    const double x = plane.coordinate(node)[0];
    least = std::min(least, x);
    most = std::max(most, x);
  }
  if (!(least > 1e-9 * most))
    throw InputError(place,
                     fmt::format("the profile of a revolved mesh reaches x = {:g}, but has to stay on the side x > 0 of the axis: cells that touch "
                                 "the axis would be wedges; please leave a hole about it, or extrude a disk",
                                 least));
  const double turn = angle * boost::math::constants::pi<double>() / 180.0;
  return sweep(cell, place, grading_around.spacing(most * turn, cells_around, place), Revolution{turn});
}

}  // namespace mortise
