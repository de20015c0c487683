#pragma once
// The built-in 3D meshes.

#include "mortise/mesh/generators.hpp"

namespace mortise {

/// Cuboid [0, width] x [0, depth] x [0, height]. Sides: left, right (x), front, back (y), bottom, top (z).
struct BrickMesh : VolumeMesh {
  double width = 1.0, depth = 1.0, height = 1.0;  ///< in x, y, z
  int cells_x = 0, cells_y = 0, cells_z = 0;
  GradingOptions grading_x, grading_y, grading_z;
  void describe_shape(Parameters& parameters) override;
  BodyComplex build(CellShape cell, const Place& place) const override;
  ShellComplex build_surface(const Place& place) const override;
};

/// Cylinder about the z axis between z = 0 and its height. Sides: bottom, top, mantle; of a rigid one mantle alone.
struct CylinderMesh : VolumeMesh {
  FullDiskMesh disk;
  double height = 1.0;
  int cells_z = 0;
  GradingOptions grading_z;
  CylinderMesh() { disk.side = "mantle"; }
  void describe_shape(Parameters& parameters) override;
  BodyComplex build(CellShape cell, const Place& place) const override;
  ShellComplex build_surface(const Place& place) const override;
};

/// The octant x >= 0, y >= 0, z <= 0 of a ball about the origin; its lowest point is where cells can be made small. Sides: x plane (x = 0), y plane
/// (y = 0), equator (z = 0), sphere; of a rigid one sphere alone.
struct SphereOctantMesh : VolumeMesh, PolarCells {
  void describe_shape(Parameters& parameters) override { PolarCells::describe(parameters); }
  BodyComplex build(CellShape cell, const Place& place) const override;
  ShellComplex build_surface(const Place& place) const override;
};

/// A plane mesh, swept. Its sides are those of the plane mesh, and those where the sweep starts and ends: "start" and "end". These two are called
/// "sweep start" and "sweep end" if the plane mesh has a side of such a name. A rigid body has the sides of the plane mesh alone.
struct SweptMesh : VolumeMesh {
  Choice<PlaneMesh> profile;

 protected:
  void describe_profile(Parameters& parameters, const std::string& sentence);
  const PlaneMesh& require_profile(const Place& place) const;
  SweptComplex sweep_body(PatchComplex plane, CellShape cell, const Spacing& layers, const Sweep& sweep) const;
};

/// Moved along z, from z = 0.
struct ExtrudedMesh : SweptMesh {
  double length = 1.0;
  int cells_z = 0;
  GradingOptions grading_z;
  void describe_shape(Parameters& parameters) override;
  BodyComplex build(CellShape cell, const Place& place) const override;
  ShellComplex build_surface(const Place& place) const override;
};

/// Turned about the y axis, from the x axis toward the z axis. Throws InputError for a plane mesh that reaches the axis.
struct RevolvedMesh : SweptMesh {
  double angle = 90.0;  ///< degrees, less than a full turn
  int cells_around = 0;
  GradingOptions grading_around;
  void describe_shape(Parameters& parameters) override;
  BodyComplex build(CellShape cell, const Place& place) const override;
  ShellComplex build_surface(const Place& place) const override;
  std::optional<MeshFile> listed(CellShape cell, const Place& place) const override;
};

}  // namespace mortise
