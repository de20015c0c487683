// Corners of the slave surface that take the master's normal: nodes in 2D, in 3D nodes on edges and at their ends.
//
// The facets f at a kink j have their own normals n_f (see split_kinks.cpp). The part of the master that they cover gives the node its normal. The
// length, or area, that is seen along that normal gives the facets their weight:
//   m_j = -sum_f int N_j <-n_f.n_m> n_m,   n_j = m_j / |m_j| but for corner_normal(),   w_f = <n_f.n_j> but for steep facets: seen_share().
// Then  D_jk = sum_f w_f int phi_j N_k,   M_jl = sum_f w_f int phi_j N_l,   g_j = n_j . sum_f w_f int phi_j (xhat - x) = sum_f w_f^2 int phi_j g.
// No side is chosen: what is symmetric stays so. A facet that stands off and one that lies on the master both enter smoothly. Weights w_f are needed:
// a steep facet that begins to be covered would change D at once. The normals n_f depend on the facets alone, what is covered on them, m_j on that,
// so all is explicit, and exact derivatives follow.

#include <algorithm>

#include "interface/interface.hpp"
#include "slave/settled_corner.hpp"

namespace mortise {
namespace {

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
    if (settle<dim>(corner, derivatives, moves, slave.stencils[s], normals[s])) settled.push_back(std::move(corner));
  }
  for (const SettledCorner& corner : settled)
    for (std::size_t e = 0; e < corner.sides.size(); ++e)
      if (corner.sides[e].coupling != nullptr) weigh<dim>(corner.sides[e], corner.weight[e], corner.columns, corner.slope_of_weight[e]);
}

template void Interface<2>::settle_corners(bool, std::vector<NodalNormal>&, std::vector<FacetCoupling>&) const;
template void Interface<3>::settle_corners(bool, std::vector<NodalNormal>&, std::vector<FacetCoupling>&) const;

}  // namespace mortise
