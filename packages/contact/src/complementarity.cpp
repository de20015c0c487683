#include "mortise/contact/complementarity.hpp"

namespace mortise {

Complementarity open_node(const SpatialVector& z) {
  const Eigen::Index dimension = z.size();
  Complementarity result;
  result.C = z;
  result.C_z = SpatialMatrix::Identity(dimension, dimension);
  result.gap_factor = result.weight_factor = SpatialVector::Zero(dimension);
  result.normal_factor = SpatialMatrix::Zero(dimension, dimension);
  return result;
}

Complementarity closed_node(double c_n, double gap, const Frame& frame, const SpatialVector& z) {
  const Eigen::Index tangents = frame.tangents.rows();
  Complementarity result = open_node(z);
  result.state = ContactState::slip;
  result.C[0] = c_n * gap;
  result.C.tail(tangents) = frame.tangents * z;
  result.C_z.row(0).setZero();
  result.C_z.bottomRows(tangents) = frame.tangents;
  result.gap_factor[0] = c_n;
  for (Eigen::Index a = 0; a < tangents; ++a) result.normal_factor.row(1 + a) = z.transpose() * frame.turn[a];
  return result;
}

SlipDirection::SlipDirection(const TangentVector& y, double bound)
    : along(TangentVector::Zero(y.size())), turning(TangentMatrix::Zero(y.size(), y.size())) {
  const double norm = y.norm();
  length = norm < bound ? norm : bound;
  if (!(norm > 0.0)) return;
  along = y / norm;
  if (y.size() > 1) turning = bound / norm * (TangentMatrix::Identity(2, 2) - along * along.transpose());
}

bool sticks(const TangentVector& t, const TangentVector& cu, double bound) {
  if ((t + cu).norm() < at_the_bound * bound) return true;
  const double length = t.norm();
  return t.size() > 1 && length > bound && cu.norm() < bound && length * (length - bound) < -against_the_traction * t.dot(cu);
}

Complementarity with_friction(double c_n, double c_t, double gap, const TangentVector& slip, const Frame& frame, const SpatialVector& z,
                              const FrictionBound& bound) {
  const Eigen::Index tangents = slip.size();
  Complementarity result = closed_node(c_n, gap, frame, z);
  const TangentVector t = result.C.tail(tangents), cu = c_t * slip;
  if (sticks(t, cu, bound.value)) {
    result.state = ContactState::stick;
    result.C.tail(tangents) = -cu;
    result.C_z.bottomRows(tangents).setZero();
    result.normal_factor.bottomRows(tangents).setZero();
    result.slip_factor = -c_t * TangentMatrix::Identity(tangents, tangents);
    return result;
  }
  const SlipDirection direction(t + cu, bound.value);
  const TangentVector slope = bound.slope * direction.along;
  result.C.tail(tangents) -= direction.length * direction.along;
  if (tangents > 1) {
    result.C_z.bottomRows(tangents) -= direction.turning * frame.tangents;
    result.normal_factor.bottomRows(tangents) -= direction.turning * SpatialMatrix(result.normal_factor.bottomRows(tangents));
    result.slip_factor = -c_t * direction.turning;
  }
  result.C_z.bottomRows(tangents) -= slope * frame.normal.transpose();
  result.normal_factor.bottomRows(tangents) -= slope * z.transpose();
  result.gap_factor.tail(tangents) = c_n * slope;
  return result;
}

void hold_tangent(Complementarity& law, const Frame& frame, const SpatialVector& z, Eigen::Index a) {
  law.C[1 + a] = frame.tangents.row(a).dot(z);
  law.C_z.row(1 + a) = frame.tangents.row(a);
  law.normal_factor.row(1 + a) = z.transpose() * frame.turn[a];
  law.gap_factor[1 + a] = law.weight_factor[1 + a] = 0.0;
  if (law.slip_factor.size() == 0) return;
  law.slip_factor.row(a).setZero();
  law.slip_factor.col(a).setZero();
}

}  // namespace mortise
