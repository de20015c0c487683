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

Landing::Landing(double depth, double start) {
  if (!(start > 0.0)) return;
  if (!(depth > 0.0)) {  // on Newton's way: it has not landed
    share = 0.0;
    return;
  }
  const double sum = depth + start;
  share = depth / sum;
  of_depth = start / (sum * sum);
  of_start = -depth / (sum * sum);
}

// Let t = z_tau, and S = 1 - e for tangents that are held, 1 for others. Then  s = S t + (1 - S) t^old,  y = q (s + c_t u)  have the derivatives
//   dy = q (S dt + c_t du) + (s + c_t u) dq,   dq = of_depth dp + of_start c_t dg0,   dp = dz_n - c_n dg.
// Where the node slips, s + c_t u is along y, which does not turn by it.
Complementarity with_friction(double c_n, double c_t, double gap, const TangentVector& slip, const Frame& frame, const SpatialVector& z,
                              const FrictionBound& bound, double start, const HeldTangents& held) {
  const Eigen::Index tangents = slip.size();
  Complementarity result = closed_node(c_n, gap, frame, z);
  const TangentVector t = result.C.tail(tangents), cu = c_t * slip;
  TangentMatrix own = TangentMatrix::Identity(tangents, tangents);  // S
  TangentVector kept = TangentVector::Zero(tangents);               // (1 - S) t^old
  for (Eigen::Index a = 0; a < held.count; ++a) {
    own(a, a) = 1.0 - held.compliance;
    kept[a] = held.compliance * held.traction[a];
  }
  const TangentVector trial = own * t + kept + cu;
  const Landing landing(z.dot(frame.normal) - c_n * gap, c_t * start);
  const TangentVector y = landing.share * trial;
  if (sticks(t, start > 0.0 || held.count > 0 ? TangentVector(y - t) : cu, bound.value)) {
    const TangentMatrix borne = TangentMatrix::Identity(tangents, tangents) - landing.share * own;
    result.state = ContactState::stick;
    result.C.tail(tangents) = borne * t - landing.share * cu;
    if (held.count > 0) result.C.tail(tangents) -= landing.share * kept;
    result.C_z.bottomRows(tangents) = borne * frame.tangents;
    result.normal_factor.bottomRows(tangents) = borne * SpatialMatrix(result.normal_factor.bottomRows(tangents));
    result.slip_factor = -c_t * landing.share * TangentMatrix::Identity(tangents, tangents);
    if (!(start > 0.0)) return result;
    const TangentVector slope = landing.of_depth * trial;
    result.C_z.bottomRows(tangents) -= slope * frame.normal.transpose();
    result.normal_factor.bottomRows(tangents) -= slope * z.transpose();
    result.gap_factor.tail(tangents) = c_n * slope;
    result.start_factor = -landing.of_start * c_t * trial;
    return result;
  }
  const SlipDirection direction(y, bound.value);
  const TangentVector slope = bound.slope * direction.along;
  result.C.tail(tangents) -= direction.length * direction.along;
  if (tangents > 1) {
    const TangentMatrix turning = landing.share * direction.turning;
    result.C_z.bottomRows(tangents) -= turning * own * frame.tangents;
    result.normal_factor.bottomRows(tangents) -= turning * own * SpatialMatrix(result.normal_factor.bottomRows(tangents));
    result.slip_factor = -c_t * turning;
  }
  result.C_z.bottomRows(tangents) -= slope * frame.normal.transpose();
  result.normal_factor.bottomRows(tangents) -= slope * z.transpose();
  result.gap_factor.tail(tangents) = c_n * slope;
  return result;
}

}  // namespace mortise
