#pragma once
// Options from which a body's mesh is described; the kinds of built-in meshes are told apart by "type" (mesh_registry).

#include "mortise/core/parameters.hpp"
#include "mortise/mesh/curve_complex.hpp"
#include "mortise/mesh/patch_complex.hpp"

namespace mortise {

/// Options of one body's mesh. A new kind derives from it, declares its parameters and is added to mesh_registry().
struct MeshOptions : Described {
  double rotation = 0.0;  ///< degrees about the origin, applied first
  std::vector<double> translation{0.0, 0.0};

  /// The kind's own parameters, then the placement.
  void describe(Parameters& parameters) final;
  virtual void describe_shape(Parameters& parameters) = 0;

  /// The pure description of the mesh, of triangles or quadrilaterals. Throws InputError at `place` for shapes without meaning.
  virtual PatchComplex build(CellShape cell, const Place& place) const = 0;

  /// The surface alone, of lines, for a rigid body. Throws InputError at `place` for shapes without meaning.
  virtual CurveComplex build_surface(const Place& place) const { return build(CellShape::quadrilateral4, place).surface(); }

 protected:
  Placement placement() const { return {rotation, {translation.at(0), translation.at(1)}}; }
};

/// All built-in kinds: block, wedge, ring sector, quarter disk, half disk, profile.
const Registry<MeshOptions>& mesh_registry();

}  // namespace mortise
