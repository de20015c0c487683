#include "slave/facet_alignment.hpp"

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <cmath>

namespace mortise {
namespace {

/// Angle up to which a facet lies along the master, and over which it then ceases to.
constexpr double lies_along = 10.0 * boost::math::double_constants::degree;

// a = 1 - S(theta / 10 degrees - 1), S(t) = t^2 (3 - 2 t) on [0, 1]. Here theta is the angle at which the facet rises from the master in the mean.
// With the covered area A
//   cos theta = |m| / A,   m = sum_j m_j,   A = sum_j c_j int N_j,
//   dcos theta = (m / |m|) . dm / A - cos theta dA / A.
void measure_alignment(const FacetMoments& moments, int dimension, bool derivatives, FacetCoupling& coupling) {
  const Eigen::RowVectorXd m = coupling.facing.colwise().sum();
  const double area = coupling.cover.dot(moments.whole), cosine = std::min(1.0, m.norm() / area), t = std::acos(cosine) / lies_along - 1.0;
  coupling.alignment = t <= 0.0 ? 1.0 : (t < 1.0 ? 1.0 - t * t * (3.0 - 2.0 * t) : 0.0);
  if (!derivatives) return;
  coupling.dalignment.setZero(1, coupling.dD.cols());
  if (t <= 0.0 || t >= 1.0) return;
  Eigen::RowVectorXd of_area = Eigen::RowVectorXd::Zero(coupling.dD.cols());
  if (coupling.dcover.size() > 0) of_area += moments.whole.transpose() * coupling.dcover;  // none: covered as a whole
  const Eigen::MatrixXd slope = moments.whole_slope();
  of_area.head(slope.cols()) += coupling.cover.transpose() * slope;
  Eigen::RowVectorXd of_cosine = -cosine * of_area;
  for (Eigen::Index j = 0; j < coupling.facing.rows(); ++j) of_cosine += m.normalized() * coupling.dfacing.middleRows(dimension * j, dimension);
  coupling.dalignment = 6.0 * t * (1.0 - t) / (lies_along * std::sqrt(1.0 - cosine * cosine) * area) * of_cosine;
}

// Rows of own functions become those of phi; whether one is left.
bool inherit(const FacetMatrix& share, bool derivatives, FacetCoupling& coupling) {
  const Eigen::Index n = share.rows(), masters = coupling.M.cols();
  FacetMatrix left = share;
  left.diagonal().setZero();
  const FacetMatrix S = FacetMatrix(share.diagonal().asDiagonal()) + coupling.alignment * left;
  if (derivatives) {
    const Eigen::MatrixXd dD = coupling.dD, dM = coupling.dM;
    coupling.dD.setZero();
    coupling.dM.setZero();
    for (Eigen::Index j = 0; j < n; ++j) {
      for (Eigen::Index k = 0; k < n; ++k) {
        coupling.dD.middleRows(n * j, n) += S(j, k) * dD.middleRows(n * k, n);
        coupling.dM.middleRows(masters * j, masters) += S(j, k) * dM.middleRows(masters * k, masters);
      }
      coupling.dD.middleRows(n * j, n) += (left.row(j) * coupling.D).transpose() * coupling.dalignment;
      coupling.dM.middleRows(masters * j, masters) += (left.row(j) * coupling.M).transpose() * coupling.dalignment;
    }
    coupling.dgap = Eigen::MatrixXd(S * coupling.dgap + left * coupling.gap * coupling.dalignment);
  }
  coupling.D = FacetMatrix(S * coupling.D);
  coupling.M = Eigen::MatrixXd(S * coupling.M);
  coupling.gap = FacetVector(S * coupling.gap);
  return !coupling.D.isZero(0.0);
}

}  // namespace

bool combine_aligned(const FacetMoments& moments, const FacetMultipliers& multipliers, const FacetFunctions& functions, bool derivatives,
                     FacetCoupling& coupling) {
  coupling.alignment = 1.0;
  coupling.dalignment.resize(0, 0);
  if (coupling.facing.rows() == 0) return combine(moments, multipliers, functions, derivatives, coupling);
  const Eigen::Index n = multipliers.share.rows();
  const bool own = multipliers.share.isIdentity(0.0);
  const bool any =
      combine(moments, own ? multipliers : FacetMultipliers{FacetMatrix::Identity(n, n), multipliers.weights}, functions, derivatives, coupling);
  measure_alignment(moments, functions.dimension, derivatives, coupling);
  return own ? any : any && inherit(multipliers.share, derivatives, coupling);
}

}  // namespace mortise
