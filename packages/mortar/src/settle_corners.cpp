// Corners of the slave surface in 2D that take the master's normal.
//
// The facets f at a kink j have their own normals n_f (see split_kinks.cpp). What they cover of the master gives the node its normal, and the length
// that is seen along it their weight:
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

Eigen::RowVector2d to_the_left_of(const SpatialVector& v) { return {-v[1], v[0]}; }

// A facet at the corner: where the corner stands on it, its own normal there.
struct CornerSide {
  FacetCoupling* coupling = nullptr;  ///< null: not covered
  Eigen::Index place = 0;
  const NodalNormal* normal = nullptr;
};

// Adds the part of a derivative in `from` to that in `columns`, which holds them all.
template <class Slope, class Part>
void add_columns(const std::vector<LocalOrdinal>& columns, const std::vector<LocalOrdinal>& from, const Part& part, Slope& slope) {
  for (std::size_t c = 0; c < from.size(); ++c) {
    const auto place = std::find(columns.begin(), columns.end(), from[c]) - columns.begin();
    slope.template middleCols<2>(2 * place) += part.template middleCols<2>(2 * static_cast<Eigen::Index>(c));
  }
}

// What a corner makes of its own row: taken from the couplings of all corners before any of these is changed.
struct SettledCorner {
  std::array<CornerSide, 2> sides;  // the facet that ends here, the one that starts here
  std::array<double, 2> weight{};
  std::array<Eigen::RowVectorXd, 2> turn_of_weight;  // in `columns`; empty without derivatives
  std::vector<LocalOrdinal> columns;
};

// Row j of a facet's coupling times the weight w, of the gap times w^2. `columns` of dw become part of those of the coupling.
void weigh(const CornerSide& side, double w, const std::vector<LocalOrdinal>& columns, const Eigen::RowVectorXd& dw) {
  FacetCoupling& coupling = *side.coupling;
  const Eigen::Index j = side.place, nodes = coupling.D.rows(), masters = coupling.M.cols();
  if (dw.size() > 0) {
    for (const LocalOrdinal node : columns) place_of(coupling.columns, node);
    const auto size = 2 * static_cast<Eigen::Index>(coupling.columns.size());
    for (Eigen::MatrixXd* slope : {&coupling.dD, &coupling.dM, &coupling.dgap, &coupling.dcover})
      slope->conservativeResizeLike(Eigen::MatrixXd::Zero(slope->rows(), size));
    Eigen::RowVectorXd change = Eigen::RowVectorXd::Zero(size);
    add_columns(coupling.columns, columns, dw, change);
    for (Eigen::Index k = 0; k < nodes; ++k) coupling.dD.row(nodes * j + k) = w * coupling.dD.row(nodes * j + k) + coupling.D(j, k) * change;
    for (Eigen::Index l = 0; l < masters; ++l) coupling.dM.row(masters * j + l) = w * coupling.dM.row(masters * j + l) + coupling.M(j, l) * change;
    coupling.dgap.row(j) = w * w * coupling.dgap.row(j) + 2.0 * w * coupling.gap[j] * change;
  }
  coupling.D.row(j) *= w;
  coupling.M.row(j) *= w;
  coupling.gap[j] *= w * w;
}

// The weights of the facets' lengths as seen along the corner's normal, which turns by `turn` in the corner's columns.
void measure_weights(SettledCorner& corner, const NodalNormal& normal, const Eigen::RowVectorXd& turn, bool moves) {
  const Eigen::RowVector2d left = to_the_left_of(normal.normal);
  for (std::size_t e = 0; e < 2; ++e) {
    if (corner.sides[e].normal == nullptr) continue;
    const NodalNormal& own = *corner.sides[e].normal;
    corner.weight[e] = std::max(0.0, own.normal.dot(normal.normal));
    corner.turn_of_weight[e] = (corner.weight[e] > 0.0 ? left.dot(own.normal.transpose()) : 0.0) * turn;
    if (moves && corner.weight[e] > 0.0)
      add_columns(corner.columns, own.columns, Eigen::RowVectorXd(normal.normal.transpose() * own.derivative), corner.turn_of_weight[e]);
  }
}

// On a line of symmetry: the corner's normal lies along it.
void settle_half(SettledCorner& corner, bool derivatives, bool moves, const NodalNormal& normal) {
  for (const CornerSide& side : corner.sides)
    if (side.normal != nullptr) corner.columns = side.normal->columns;
  measure_weights(corner, normal, Eigen::RowVectorXd::Zero(derivatives ? 2 * static_cast<Eigen::Index>(corner.columns.size()) : 0), moves);
}

// Sets the normal of the corner. False where nothing is covered: it keeps the average.
bool settle(SettledCorner& corner, bool derivatives, bool moves, NodalNormal& normal) {
  Eigen::Vector2d facing = Eigen::Vector2d::Zero();
  for (const CornerSide& side : corner.sides) {
    for (const LocalOrdinal node : side.normal->columns) place_of(corner.columns, node);
    if (side.coupling == nullptr) continue;
    facing += side.coupling->facing.row(side.place).transpose();
    for (const LocalOrdinal node : side.coupling->columns) place_of(corner.columns, node);
  }
  if (!(facing.norm() > 0.0)) return false;
  const CornerNormal found = corner_normal(facing, corner.sides[0].normal->normal, corner.sides[1].normal->normal);
  Eigen::RowVectorXd turn = Eigen::RowVectorXd::Zero(derivatives ? 2 * static_cast<Eigen::Index>(corner.columns.size()) : 0);
  if (moves) {
    const Eigen::RowVector2d of_facing = found.of_master / facing.squaredNorm() * to_the_left_of(facing);
    for (const CornerSide& side : corner.sides)
      if (side.coupling != nullptr)
        add_columns(corner.columns, side.coupling->columns, Eigen::RowVectorXd(of_facing * side.coupling->dfacing.middleRows<2>(2 * side.place)),
                    turn);
    const std::array<double, 2> of_side = {found.of_before, found.of_behind};
    for (std::size_t e = 0; e < 2; ++e) {
      const NodalNormal& own = *corner.sides[e].normal;
      add_columns(corner.columns, own.columns, Eigen::RowVectorXd(of_side[e] * to_the_left_of(own.normal) * own.derivative), turn);
    }
  }
  normal.normal = found.normal;
  normal.columns = corner.columns;
  normal.derivative = to_the_left_of(normal.normal).transpose() * turn;
  measure_weights(corner, normal, turn, moves);
  return true;
}

}  // namespace

template <>
void Interface<2>::settle_corners(bool derivatives, std::vector<NodalNormal>& normals, std::vector<FacetCoupling>& couplings) const {
  std::vector<SettledCorner> settled;
  for (std::size_t s = 0; s < slave.owned.size() && !kinks_.empty(); ++s) {
    if (kinks_[s] == 0 || !slave.carries[s]) continue;
    SettledCorner corner;
    for (const std::size_t f : slave.facets_of[s]) {
      const Facet<LocalOrdinal>& facet = slave.facets[f];
      const auto place = static_cast<std::size_t>(std::find(facet.begin(), facet.end(), slave.owned[s].local_node) - facet.begin());
      corner.sides[place == 1 ? 0 : 1] = {segments_of_facet_[f] > 0 ? &couplings[f] : nullptr, static_cast<Eigen::Index>(place),
                                          &normals[slave.normals[f][place]]};
    }
    const bool moves = derivatives && options_.linearisation == Linearisation::exact;
    const auto& projected = slave.stencils[s].projected;
    if (projected[0] || projected[1])
      settle_half(corner, derivatives, moves, normals[s]);
    else if (!settle(corner, derivatives, moves, normals[s]))
      continue;
    settled.push_back(std::move(corner));
  }
  for (const SettledCorner& corner : settled)
    for (std::size_t e = 0; e < 2; ++e)
      if (corner.sides[e].coupling != nullptr) weigh(corner.sides[e], corner.weight[e], corner.columns, corner.turn_of_weight[e]);
}

}  // namespace mortise
