#pragma once
// Motion by which a facet carries vectors along while it moves, turns and stretches within a step.

#include <vector>

#include "mortise/core/spatial.hpp"

namespace mortise::detail {

/// Vectors from a step's start as they lie along and across a facet now. With the frame B = (a_1, a_2, nu) of the corners' positions, a_i along the
/// facet and nu its unit normal, a vector W becomes  B B_0^-1 W.  In a rigid motion that is its rotation, exactly. A stretch of the facet is one of
/// the vector's part along it.
class FacetMotion {
 public:
  /// Of a line of 2 corners in 2D, of a triangle or a quadrilateral in 3D.
  /// @param start, now  positions of the corners
  FacetMotion(const std::vector<SpatialVector>& start, const std::vector<SpatialVector>& now);

  /// B B_0^-1.
  const SpatialMatrix& carried() const { return carried_; }
  /// Derivative of carried() W with respect to the position of a corner now.
  SpatialMatrix slope(std::size_t corner, const SpatialVector& W) const;

 private:
  SpatialMatrix inverse_start_, carried_;
  std::vector<SpatialMatrix> turn_;  ///< d nu / d a_i
  std::size_t corners_;
};

}  // namespace mortise::detail
