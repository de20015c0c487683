#pragma once
// The built-in meshes of the plane.

#include "mortise/mesh/mesh_options.hpp"

namespace mortise {

/// Rectangle or general quadrilateral. Sides: bottom, right, top, left.
struct BlockMesh : PlaneMesh {
  double width = 1.0, height = 1.0;
  double bottom_radius = 0.0;   ///< of the arc that the bottom side is, bulging outward; 0: straight
  std::vector<double> corners;  ///< x1, y1, ... counterclockwise from bottom left; empty: the rectangle [0, width] x [0, height]
  int cells_x = 0, cells_y = 0;
  GradingOptions grading_x, grading_y;
  void describe_shape(Parameters& parameters) override;
  PatchComplex build(CellShape cell, const Place& place) const override;
};

/// Trapezoid on y = 0 with upright ends of different heights, so that its top is inclined. Sides: bottom, right, top, left.
struct WedgeMesh : PlaneMesh {
  double width = 1.0, left_height = 1.0, right_height = 0.5;
  int cells_x = 0, cells_y = 0;
  GradingOptions grading_x, grading_y;
  void describe_shape(Parameters& parameters) override;
  PatchComplex build(CellShape cell, const Place& place) const override;
};

/// Part of a ring about the origin between two angles. Sides: inner, outer, start, end.
struct RingSectorMesh : PlaneMesh {
  double inner_radius = 1.0, outer_radius = 2.0;
  double start_angle = 0.0, end_angle = 90.0;  ///< degrees, counterclockwise from the x axis
  int cells_radial = 0, cells_around = 0;
  GradingOptions grading_radial, grading_around;
  void describe_shape(Parameters& parameters) override;
  PatchComplex build(CellShape cell, const Place& place) const override;
};

/// Disk about the origin: an inner patch and four around it. Side: arc.
struct FullDiskMesh : PlaneMesh {
  double radius = 1.0;
  int cells_around = 0;  ///< on each quarter of the circle
  int cells_across = 0;  ///< between the circle and the inner patch
  GradingOptions grading_across;
  std::string side = "arc";  ///< its name
  void describe_shape(Parameters& parameters) override;
  PatchComplex build(CellShape cell, const Place& place) const override;
};

/// Cells of round bodies about the origin whose lowest point is where cells can be made small. There is an inner patch or block. Others lie between
/// it and the surface; one of them has the lowest point.
struct PolarCells {
  static constexpr double inner = 0.5;  ///< where the inner patch or block ends on an axis, as a share of the radius
  double radius = 1.0;
  int cells_along = 0;                           ///< on the arc between the lowest point and 45 degrees
  int cells_beyond = 0;                          ///< on the arc from there to the diameter; 0: as fits the other cells
  int cells_across = 0;                          ///< between the arc and the inner patch
  GradingOptions grading_along, grading_across;  ///< both toward the lowest point
  void describe(Parameters& parameters);

  struct Spacings {
    Spacing along, across, beyond;
  };
  Spacings spacings(const Place& place) const;
};

/// Common part of quarter and half disks. Each quarter has an inner patch, one between the lowest (or highest) point and 45 degrees, and one from
/// there to the horizontal diameter.
struct DiskMesh : PlaneMesh, PolarCells {
  void describe_shape(Parameters& parameters) override { PolarCells::describe(parameters); }

 protected:
  PatchComplex build_quarters(CellShape cell, const Place& place, bool lower_left, bool upper_right) const;
};

/// x >= 0, y <= 0. Sides: diameter (y = 0), axis (x = 0), arc.
struct QuarterDiskMesh : DiskMesh {
  PatchComplex build(CellShape cell, const Place& place) const override;
};

/// Half of a disk: y <= 0 or x >= 0.
enum class DiskHalf { lower, right };

/// Sides: diameter (y = 0) and arc for the lower half; axis (x = 0) and arc for the right half.
struct HalfDiskMesh : DiskMesh {
  DiskHalf half = DiskHalf::lower;
  void describe_shape(Parameters& parameters) override;
  PatchComplex build(CellShape cell, const Place& place) const override;
};

/// A polyline whose corners are rounded by arcs, or an arc's polygon: the surface of a rigid body, without an inside. Side: profile.
struct ProfileMesh : PlaneMesh {
  std::vector<double> points;  ///< x1, y1, ...; the body lies to the left of the way along them
  std::vector<double> radii;   ///< of the arcs at the points between the first and the last; empty: sharp corners
  double cell_size = 0.0;      ///< largest length of a line
  void describe_shape(Parameters& parameters) override;
  /// Throws InputError: a profile has no inside.
  PatchComplex build(CellShape cell, const Place& place) const override;
  CurveComplex build_surface(const Place& place) const override;
};

}  // namespace mortise
