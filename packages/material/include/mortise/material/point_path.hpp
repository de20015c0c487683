#pragma once
// Deformation of one material point in the course of pseudo-time. A new kind of path: a struct here, and its line in point_path_registry().

#include <array>
#include <vector>

#include "mortise/core/parameters.hpp"
#include "mortise/material/tensor_components.hpp"

namespace mortise {

/// Values that a path prescribes at one time.
struct PathPoint {
  double time = 0.0;
  Matrix3 F = Matrix3::Identity();  ///< deformation gradient; 1 in the place of free stretches
  std::vector<int> free;            ///< a of the stretches F_aa that are free instead, with tau_aa = 0
};

/// A path by its parameters.
struct PointPath : Described {
  int steps = 100;
  double end_time = 1.0;

  /// Declares "steps" and "end time".
  void describe(Parameters& parameters) override;

  /// Throws InputError at the place of a function that has no value, or none that is a deformation (a stretch <= 0, det F <= 0).
  virtual PathPoint at(double time) const = 0;

  /// Row and column, from 0, of the component of stress and strain that the path is about.
  virtual std::array<int, 2> component() const { return {0, 0}; }
};

/// A stretch along direction 1.
struct StretchPath : PointPath {
  std::optional<ScalarFunction> stretch;  ///< F_11(t)
  std::optional<double> final_stretch;    ///< or F_11 at the end, reached linearly

  void describe(Parameters& parameters) override;

 protected:
  double stretch_at(double time) const;
};

/// F = diag(stretch, free, free).
struct UniaxialPath : StretchPath {
  PathPoint at(double time) const override;
};

/// F = diag(stretch, free, 1).
struct PlaneStrainPath : StretchPath {
  PathPoint at(double time) const override;
};

/// F = I + shear e_1 x e_2.
struct SimpleShearPath : PointPath {
  ScalarFunction shear;

  void describe(Parameters& parameters) override;
  PathPoint at(double time) const override;
  std::array<int, 2> component() const override { return {0, 1}; }
};

/// All nine components of F.
struct DeformationGradientPath : PointPath {
  std::array<ScalarFunction, 9> components;  ///< F_ij(t) at 3 i + j
  std::array<int, 2> shown{0, 0};

  DeformationGradientPath();
  void describe(Parameters& parameters) override;
  PathPoint at(double time) const override;
  std::array<int, 2> component() const override { return shown; }
};

/// All kinds of paths by name.
const Registry<PointPath>& point_path_registry();

/// The points of a path: one at time 0 and one for each step. Throws as PointPath::at.
std::vector<PathPoint> points_of(const PointPath& path);

}  // namespace mortise
