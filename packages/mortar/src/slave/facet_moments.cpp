#include "slave/facet_moments.hpp"

#include <Eigen/LU>
#include <algorithm>

namespace mortise {
namespace {

/// int phi_j below this share of its value for the whole facet is round-off of a facet that is not covered.
constexpr double negligible_cover = 1e-12;
/// A node with this share of its weight is not tied: 1 - w, of second order in what is missing, is round-off.
constexpr double full_cover = 1.0 - 1e-7;

// Let N = T L, and T^T 1 = l, as the sum of all N is 1. The dual basis of the restricted N is
//   phi = A L,   A = D_e T^-T M_L^-1,   M_L = int L L^T,   D_e = diag int N_j,   int N = T M_L l,
//   dA = (dD_e T^-T - A dM_L) M_L^-1.
// M_L is as well conditioned on a sliver as on the whole facet; the large entries of T^-T are the extrapolation that phi really is. Standard
// multipliers: phi = N = T L, constant in this basis, D = T M_L T^T. Where a node has no multiplier, phi -> S phi.
// Quadratic facets: the same with Ñ = B N = B T L in the place of N; then int phi_j N_k = sum_i (int phi_j Ñ_i) (B^-1)_ki.
class Combination {
  static constexpr int most = most_side_nodes;
  using Row = Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, most>;
  using Slopes = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, most, Eigen::Dynamic>;

 public:
  Combination(const FacetMoments& moments, const FacetMultipliers& multipliers, const FacetFunctions& functions)
      : n(moments.T.rows()),
        masses(n * (n + 1) / 2),
        moments_(moments),
        functions_(functions),
        basis_(non_negative_basis(functions.dimension, static_cast<std::size_t>(n))),
        S_(multipliers.share),
        T_(moments.T),
        extrapolation_(moments.extrapolation) {
    if (basis_ != nullptr) {
      T_ = basis_->of_shape * moments.T;
      extrapolation_ = basis_->to_shape.transpose() * moments.extrapolation;
    }
    const Row l = T_.colwise().sum();
    M_L_.resize(n, n);
    mass_of_.setZero(n, masses);
    for (Eigen::Index i = 0, r = 0; i < n; ++i)
      for (Eigen::Index j = i; j < n; ++j, ++r) {
        M_L_(i, j) = M_L_(j, i) = moments.value[r];
        mass_of_.col(r) += T_.col(i) * l[j];
        if (j > i) mass_of_.col(r) += T_.col(j) * l[i];
      }
    inverse_ = M_L_.inverse();
    weight_ = mass_of_ * moments.value.head(masses);
    full_ = S_ * multipliers.weights;
  }

  bool fill(bool derivatives, FacetCoupling& coupling) const {
    const auto masters = static_cast<Eigen::Index>(coupling.master.size());
    const Eigen::Index columns = derivatives ? moments_.slope.cols() : 0, moving = derivatives ? moments_.moving_columns : 0;
    coupling.D.setZero(n, n);
    coupling.M.setZero(n, masters);
    coupling.gap.setZero(n);
    coupling.dD.setZero(derivatives ? n * n : 0, columns);
    coupling.dM.setZero(derivatives ? n * masters : 0, columns);
    coupling.dgap.setZero(derivatives ? n : 0, columns);
    const auto& value = moments_.value;
    const auto& slope = moments_.slope;
    // [masters x n] int L_i N_l, [n] int L_i g
    const Eigen::Map<const Eigen::MatrixXd> coupled(value.data() + masses, masters, n);
    const FacetVector gaps = value.tail(n);
    const FacetMatrix M_N = T_ * M_L_ * T_.transpose();
    Slopes weight_slope;
    if (derivatives) weight_slope.noalias() = mass_of_ * slope.topLeftCorner(masses, moving);
    coupling.cover = weight_.cwiseQuotient(moments_.whole);
    coupling.dcover.resize(0, 0);
    if (derivatives && coupling.cover.minCoeff() < full_cover) differentiate_cover(weight_slope, columns, coupling);

    bool any = false;
    for (Eigen::Index j = 0; j < n; ++j) {
      const Row share = S_.row(j);
      const double own = share.dot(weight_);
      if (!(own > negligible_cover * full_[j])) continue;
      any = true;
      const Row standard = share * T_;
      const Row dual = (share.transpose().cwiseProduct(weight_)).transpose() * extrapolation_ * inverse_;
      const Row &a = functions_.dual_multipliers ? dual : standard, &w = functions_.dual_gap ? dual : standard;
      if (functions_.dual_multipliers)
        coupling.D.row(j) = share.cwiseProduct(weight_.transpose());
      else
        coupling.D.row(j) = share * M_N;
      coupling.M.row(j).noalias() = a * coupled.transpose();
      coupling.gap[j] = w.dot(gaps);
      if (!derivatives) continue;

      auto dM = coupling.dM.block(j * masters, 0, masters, moving);
      for (Eigen::Index i = 0; i < n; ++i) dM += a[i] * slope.block(masses + i * masters, 0, masters, moving);
      coupling.dgap.row(j).noalias() = w * slope.bottomRows(n);
      Slopes da;
      if (functions_.dual_multipliers || functions_.dual_gap) da = dual_slope(share, dual, weight_slope, moving);
      if (functions_.dual_gap) coupling.dgap.row(j).head(moving).noalias() += gaps.transpose() * da;
      if (functions_.dual_multipliers) {
        dM.noalias() += coupled.lazyProduct(da);
        for (Eigen::Index k = 0; k < n; ++k)
          if (share[k] != 0.0) coupling.dD.row(n * j + k).head(moving) = share[k] * weight_slope.row(k);
      } else {
        for (Eigen::Index k = 0; k < n; ++k) {
          const Row of_k = T_.row(k);
          for (Eigen::Index i = 0, r = 0; i < n; ++i)
            for (Eigen::Index m = i; m < n; ++m, ++r) {
              const double coefficient = standard[i] * of_k[m] + (m > i ? standard[m] * of_k[i] : 0.0);
              coupling.dD.row(n * j + k).head(moving) += coefficient * slope.row(r).head(moving);
            }
        }
      }
    }
    if (basis_ != nullptr) to_shape(coupling);
    return any;
  }

 private:
  // c = int_cov N / int N,   dc = (d int_cov N - c d int N) / int N
  void differentiate_cover(const Slopes& weight_slope, Eigen::Index columns, FacetCoupling& coupling) const {
    const Eigen::MatrixXd slope = moments_.whole_slope();
    coupling.dcover.setZero(n, columns);
    coupling.dcover.leftCols(weight_slope.cols()) = weight_slope;
    coupling.dcover.leftCols(slope.cols()) -= coupling.cover.asDiagonal() * slope;
    coupling.dcover = moments_.whole.cwiseInverse().asDiagonal() * Eigen::MatrixXd(coupling.dcover);
  }

  // From int phi_j Ñ_i to int phi_j N_k.
  void to_shape(FacetCoupling& coupling) const {
    coupling.D *= basis_->to_shape.transpose();
    for (Eigen::Index j = 0; j < n && coupling.dD.size() > 0; ++j) {
      const Slopes of_basis = coupling.dD.middleRows(n * j, n);
      coupling.dD.middleRows(n * j, n).noalias() = basis_->to_shape * of_basis;
    }
  }

  // (sum_k S_jk dD_k (T^-T)_k - a dM_L) M_L^-1, transposed
  Slopes dual_slope(const Row& share, const Row& a, const Slopes& weight_slope, Eigen::Index moving) const {
    Slopes right;
    right.noalias() = (share.transpose().asDiagonal() * extrapolation_).transpose().lazyProduct(weight_slope);
    for (Eigen::Index i = 0, r = 0; i < n; ++i)
      for (Eigen::Index m = i; m < n; ++m, ++r) {
        right.row(m) -= a[i] * moments_.slope.row(r).head(moving);
        if (m > i) right.row(i) -= a[m] * moments_.slope.row(r).head(moving);
      }
    return inverse_ * right;
  }

  const Eigen::Index n, masses;  ///< nodes, and masses int L_i L_j (i <= j)
  const FacetMoments& moments_;
  const FacetFunctions& functions_;
  const NonNegativeBasis* basis_;
  FacetMatrix S_, T_, extrapolation_, M_L_, inverse_;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, most, most*(most + 1) / 2> mass_of_;  // int N as a function of the masses
  FacetVector weight_, full_;
};

}  // namespace

FacetMatrix multiplier_shares(const std::vector<char>& carries, std::size_t corners) {
  const std::size_t count = carries.size();
  // Heirs stand on a ring around the facet that starts at node `first`; a corner of a quadratic facet stands between the mid-side nodes k - 1 and k.
  const std::size_t first = count > corners ? corners : 0, ring = count - first;
  const auto on_ring = [&](std::size_t place) { return first + place % ring; };
  const bool any_on_ring = std::find(carries.begin() + static_cast<std::ptrdiff_t>(first), carries.end(), 1) != carries.end();
  FacetMatrix share = FacetMatrix::Zero(static_cast<Eigen::Index>(count), static_cast<Eigen::Index>(count));
  for (std::size_t k = 0; k < count; ++k) {
    std::vector<std::size_t> heirs;
    if (carries[k]) {
      heirs = {k};
    } else {
      const std::size_t next = k < first ? on_ring(k) : on_ring(k - first + 1), previous = on_ring((k < first ? k : k - first) + ring - 1);
      if (carries[next]) heirs.push_back(next);
      if (carries[previous] && previous != next) heirs.push_back(previous);
      if (heirs.empty())
        for (std::size_t j = any_on_ring ? first : 0; j < count; ++j)
          if (carries[j]) heirs.push_back(j);
    }
    for (const std::size_t j : heirs) share(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(k)) = 1.0 / static_cast<double>(heirs.size());
  }
  return share;
}

bool combine(const FacetMoments& moments, const FacetMultipliers& multipliers, const FacetFunctions& functions, bool derivatives,
             FacetCoupling& coupling) {
  return Combination(moments, multipliers, functions).fill(derivatives, coupling);
}

}  // namespace mortise
