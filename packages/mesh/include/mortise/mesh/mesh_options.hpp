#pragma once
// Options from which a body's mesh is described; "type" selects the kind of built-in mesh (mesh_registry).

#include <optional>
#include <variant>

#include "mortise/core/parameters.hpp"
#include "mortise/mesh/curve_complex.hpp"
#include "mortise/mesh/listed_complex.hpp"
#include "mortise/mesh/mesh_file.hpp"
#include "mortise/mesh/patch_complex.hpp"
#include "mortise/mesh/shell_complex.hpp"
#include "mortise/mesh/swept_complex.hpp"
#include "mortise/mesh/volume_complex.hpp"

namespace mortise {

/// The pure description of a body; all kinds have the same members.
using BodyComplex = std::variant<PatchComplex, CurveComplex, SweptComplex, VolumeComplex, ShellComplex, ListedComplex>;

/// Options of one body's mesh. A new kind derives from PlaneMesh or VolumeMesh, declares its parameters and is added to mesh_registry().
struct MeshOptions : Described {
  double rotation = 0.0;            ///< degrees, applied first
  std::vector<double> translation;  ///< as many numbers as the mesh has dimensions

  int dimension() const { return dimension_; }

  /// The kind's own parameters, then the placement.
  void describe(Parameters& parameters) final;
  virtual void describe_shape(Parameters& parameters) = 0;

  /// The pure description of the body in elements of a shape. Throws InputError at `place` for shapes without meaning.
  virtual BodyComplex complex(CellShape cell, const Place& place) const = 0;

  /// The body as a list, where complex() has no cells for it. None: complex() has. Throws InputError at `place`.
  virtual std::optional<MeshFile> listed(CellShape /*cell*/, const Place& /*place*/) const { return std::nullopt; }

 protected:
  explicit MeshOptions(int dimension) : translation(dimension, 0.0), dimension_(dimension) {}
  virtual void describe_rotation(Parameters& parameters) = 0;
  /// "rotation" and "rotation axis".
  void describe_spatial_rotation(Parameters& parameters, std::vector<double>& axis);

 private:
  int dimension_;
};

/// Options of a 2D mesh.
struct PlaneMesh : MeshOptions {
  PlaneMesh() : MeshOptions(2) {}

  /// The body in triangles or quadrilaterals. Throws InputError at `place` for shapes without meaning.
  virtual PatchComplex build(CellShape cell, const Place& place) const = 0;

  /// The surface alone, of lines, for a rigid body. Throws InputError at `place` for shapes without meaning.
  virtual CurveComplex build_surface(const Place& place) const { return build(CellShape::quadrilateral4, place).surface(); }

  BodyComplex complex(CellShape cell, const Place& place) const final;

 protected:
  void describe_rotation(Parameters& parameters) final;
  Placement placement() const { return {rotation, {translation.at(0), translation.at(1)}}; }
};

/// Options of a 3D mesh.
struct VolumeMesh : MeshOptions {
  std::vector<double> rotation_axis{0.0, 0.0, 1.0};  ///< through the origin
  VolumeMesh() : MeshOptions(3) {}

  /// The body in tetrahedra, wedges or hexahedra. Throws InputError at `place` for shapes without meaning and cells that it cannot be made of.
  virtual BodyComplex build(CellShape cell, const Place& place) const = 0;

  /// The surface alone, of quadrilaterals, for a rigid body. Throws InputError at `place` for shapes without meaning.
  virtual ShellComplex build_surface(const Place& place) const = 0;

  BodyComplex complex(CellShape cell, const Place& place) const final;

 protected:
  void describe_rotation(Parameters& parameters) final;
  SpatialPlacement placement() const {
    return {{rotation_axis.at(0), rotation_axis.at(1), rotation_axis.at(2)}, rotation, {translation.at(0), translation.at(1), translation.at(2)}};
  }
};

/// The built-in 2D kinds: block, wedge, ring sector, disk, quarter disk, half disk and, for rigid bodies, profile.
const Registry<PlaneMesh>& plane_mesh_registry();

/// All kinds: the built-in 2D ones, the 3D ones (brick, cylinder, extruded, revolved, sphere octant), and meshes of files.
const Registry<MeshOptions>& mesh_registry();

}  // namespace mortise
