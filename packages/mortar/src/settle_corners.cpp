// Corners of the slave surface that take the master's normal: nodes in 2D, in 3D nodes on edges and at their ends.
//
// The facets f at a kink j have their own normals n_f (see split_kinks.cpp). What they cover of the master gives the node its normal. The length, or
// area, that is seen along that normal gives the facets their weight.
//   m_j = -sum_f int N_j <-n_f.n_m> n_m,   n_j = m_j / |m_j| but for corner_normal(),   w_f = <n_f.n_j>,
//   D_jk = sum_f w_f int phi_j N_k,   M_jl = sum_f w_f int phi_j N_l,   g_j = n_j . sum_f w_f int phi_j (xhat - x) = sum_f w_f^2 int phi_j g.
// No side is chosen: what is symmetric stays so. A facet that stands off and one that lies on the master both enter smoothly. Weights w_f are needed:
// a steep facet that begins to be covered would change D at once. The normals n_f depend on the facets alone, what is covered on them, m_j on that,
// so all is explicit, and exact derivatives follow.

#include <algorithm>

#include "corner_normal.hpp"
#include "interface.hpp"

namespace mortise {
namespace {

// A facet at the corner: where the corner stands on it, its own normal there.
struct CornerSide {
  FacetCoupling* coupling = nullptr;  ///< null: not covered
  Eigen::Index place = 0;
  const NodalNormal* normal = nullptr;
};

// Adds the part of a derivative in `from` to that in `columns`, which holds them all.
template <int dim, class Slope, class Part>
void add_columns(const std::vector<LocalOrdinal>& columns, const std::vector<LocalOrdinal>& from, const Part& part, Slope& slope) {
  for (std::size_t c = 0; c < from.size(); ++c) {
    const auto place = std::find(columns.begin(), columns.end(), from[c]) - columns.begin();
    slope.template middleCols<dim>(dim * place) += part.template middleCols<dim>(dim * static_cast<Eigen::Index>(c));
  }
}

// What a corner makes of its own row: taken from the couplings of all corners before any of these is changed.
struct SettledCorner {
  std::vector<CornerSide> sides;
  std::vector<double> weight;
  std::vector<Eigen::RowVectorXd> slope_of_weight;  // in `columns`; empty without derivatives
  std::vector<LocalOrdinal> columns;
};

// Row j of a facet's coupling times the weight w, of the gap times w^2. `columns` of dw become part of those of the coupling.
template <int dim>
void weigh(const CornerSide& side, double w, const std::vector<LocalOrdinal>& columns, const Eigen::RowVectorXd& dw) {
  FacetCoupling& coupling = *side.coupling;
  const Eigen::Index j = side.place, nodes = coupling.D.rows(), masters = coupling.M.cols();
  if (dw.size() > 0) {
    for (const LocalOrdinal node : columns) place_of(coupling.columns, node);
    const auto size = dim * static_cast<Eigen::Index>(coupling.columns.size());
    for (Eigen::MatrixXd* slope : {&coupling.dD, &coupling.dM, &coupling.dgap, &coupling.dcover, &coupling.dalignment})
      slope->conservativeResizeLike(Eigen::MatrixXd::Zero(slope->rows(), size));
    Eigen::RowVectorXd change = Eigen::RowVectorXd::Zero(size);
    add_columns<dim>(coupling.columns, columns, dw, change);
    for (Eigen::Index k = 0; k < nodes; ++k) coupling.dD.row(nodes * j + k) = w * coupling.dD.row(nodes * j + k) + coupling.D(j, k) * change;
    for (Eigen::Index l = 0; l < masters; ++l) coupling.dM.row(masters * j + l) = w * coupling.dM.row(masters * j + l) + coupling.M(j, l) * change;
    coupling.dgap.row(j) = w * w * coupling.dgap.row(j) + 2.0 * w * coupling.gap[j] * change;
  }
  coupling.D.row(j) *= w;
  coupling.M.row(j) *= w;
  coupling.gap[j] *= w * w;
}

// The weights of the facets as seen along the corner's normal, with its derivative in the corner's columns (empty without derivatives).
template <int dim>
void measure_weights(SettledCorner& corner, const SpatialVector& normal, const Eigen::MatrixXd& slope, bool moves) {
  for (const CornerSide& side : corner.sides) {
    const NodalNormal& own = *side.normal;
    const double weight = std::max(0.0, own.normal.dot(normal));
    corner.weight.push_back(weight);
    corner.slope_of_weight.emplace_back(Eigen::RowVectorXd::Zero(slope.cols()));
    if (!moves || !(weight > 0.0)) continue;
    corner.slope_of_weight.back() = own.normal.transpose() * slope;
    add_columns<dim>(corner.columns, own.columns, Eigen::RowVectorXd(normal.transpose() * own.derivative), corner.slope_of_weight.back());
  }
}

// n_j of m_j and the facets' normals: the surface turns from the first to the second.
CornerNormal<2> direction_of(const SettledCorner& corner, const Eigen::Vector2d& facing, const NormalStencil&) {
  return corner_normal(facing, corner.sides[0].normal->normal, corner.sides[1].normal->normal);
}

// The same in 3D, where a corner may stand on planes of symmetry. Let P leave out the components across these planes. The half that is seen and its
// images have the sum P m_j, and the part of their cone in all these planes is the cone of P n_f. So P m_j and P n_f take the place of m_j and n_f.
CornerNormal<3> direction_of(const SettledCorner& corner, const Eigen::Vector3d& facing, const NormalStencil& stencil) {
  const Eigen::Matrix3d P = Eigen::Vector3d(!stencil.projected[0], !stencil.projected[1], !stencil.projected[2]).asDiagonal();
  constexpr double none = 1e-6;  // of a facet across these planes, which adds nothing to the cone
  std::vector<Eigen::Vector3d> seen;
  std::vector<Eigen::Matrix3d> of_facet(corner.sides.size(), Eigen::Matrix3d::Zero());
  std::vector<std::size_t> from;
  for (std::size_t e = 0; e < corner.sides.size(); ++e) {
    const Eigen::Vector3d along = P * corner.sides[e].normal->normal;
    const double length = along.norm();
    if (!(length > none)) continue;
    seen.push_back(along / length);
    of_facet[e] = (P - seen.back() * seen.back().transpose()) / length;
    from.push_back(e);
  }
  CornerNormal<3> result = corner_normal(Eigen::Vector3d(P * facing), seen);
  result.of_facing *= P;
  for (std::size_t g = 0; g < from.size(); ++g) of_facet[from[g]] = result.of_facets[g] * of_facet[from[g]];
  result.of_facets = std::move(of_facet);
  return result;
}

template <int dim>
bool has_direction(const Eigen::Matrix<double, dim, 1>& facing, const NormalStencil& stencil) {
  double square = 0.0;
  for (int i = 0; i < dim; ++i)
    if (!stencil.projected[i]) square += facing[i] * facing[i];
  return square > 0.0;
}

// On a line of symmetry in 2D: the corner's normal lies along it.
void settle_half(SettledCorner& corner, bool derivatives, bool moves, const NodalNormal& normal) {
  for (const CornerSide& side : corner.sides) corner.columns = side.normal->columns;
  measure_weights<2>(corner, normal.normal, Eigen::MatrixXd::Zero(2, derivatives ? 2 * static_cast<Eigen::Index>(corner.columns.size()) : 0), moves);
}

// Sets the normal of the corner. False where nothing is covered: it keeps the average.
template <int dim>
bool settle(SettledCorner& corner, bool derivatives, bool moves, const NormalStencil& stencil, NodalNormal& normal) {
  Eigen::Matrix<double, dim, 1> facing = Eigen::Matrix<double, dim, 1>::Zero();
  for (const CornerSide& side : corner.sides) {
    for (const LocalOrdinal node : side.normal->columns) place_of(corner.columns, node);
    if (side.coupling == nullptr) continue;
    facing += side.coupling->facing.row(side.place).transpose();
    for (const LocalOrdinal node : side.coupling->columns) place_of(corner.columns, node);
  }
  if (!has_direction<dim>(facing, stencil)) return false;
  const CornerNormal<dim> found = direction_of(corner, facing, stencil);
  Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(dim, derivatives ? dim * static_cast<Eigen::Index>(corner.columns.size()) : 0);
  if (moves)
    for (std::size_t e = 0; e < corner.sides.size(); ++e) {
      const CornerSide& side = corner.sides[e];
      if (side.coupling != nullptr)
        add_columns<dim>(corner.columns, side.coupling->columns,
                         Eigen::MatrixXd(found.of_facing * side.coupling->dfacing.template middleRows<dim>(dim * side.place)), slope);
      add_columns<dim>(corner.columns, side.normal->columns, Eigen::MatrixXd(found.of_facets[e] * side.normal->derivative), slope);
    }
  normal.normal = found.normal;
  normal.columns = corner.columns;
  normal.derivative = slope;
  measure_weights<dim>(corner, normal.normal, slope, moves);
  return true;
}

}  // namespace

template <int dim>
void Interface<dim>::settle_corners(bool derivatives, std::vector<NodalNormal>& normals, std::vector<FacetCoupling>& couplings) const {
  std::vector<SettledCorner> settled;
  const bool moves = derivatives && options_.linearisation == Linearisation::exact;
  for (std::size_t s = 0; s < slave.owned.size(); ++s) {
    if (kinks_.is_kink[s] == 0 || !slave.carries[s]) continue;
    SettledCorner corner;
    for (const std::size_t f : slave.facets_of[s]) {
      const Facet<LocalOrdinal>& facet = slave.facets[f];
      const auto place = std::find(facet.begin(), facet.end(), slave.owned[s].local_node) - facet.begin();
      const CornerSide side = {segments_of_facet_[f] > 0 ? &couplings[f] : nullptr, place, &normals[slave.normals[f][place]]};
      corner.sides.insert(dim == 2 && place == 1 ? corner.sides.begin() : corner.sides.end(), side);  // the one that ends here first
    }
    if (dim == 2 && is_projected(slave.stencils[s]))
      settle_half(corner, derivatives, moves, normals[s]);
    else if (!settle<dim>(corner, derivatives, moves, slave.stencils[s], normals[s]))
      continue;
    settled.push_back(std::move(corner));
  }
  for (const SettledCorner& corner : settled)
    for (std::size_t e = 0; e < corner.sides.size(); ++e)
      if (corner.sides[e].coupling != nullptr) weigh<dim>(corner.sides[e], corner.weight[e], corner.columns, corner.slope_of_weight[e]);
}

template void Interface<2>::settle_corners(bool, std::vector<NodalNormal>&, std::vector<FacetCoupling>&) const;
template void Interface<3>::settle_corners(bool, std::vector<NodalNormal>&, std::vector<FacetCoupling>&) const;

}  // namespace mortise
