#include "mortise/mortar/coupling/node_to_segment.hpp"

#include <Sacado.hpp>
#include <algorithm>
#include <array>
#include <cmath>

#include "mortise/mortar/mortar_interface.hpp"
#include "mortise/mortar/segment_2d.hpp"
#include "slave/settled_corner.hpp"
#include "slave/slave_facet.hpp"
#include "slave/slave_node.hpp"

namespace mortise {
namespace {

constexpr double two_pi = 6.283185307179586476925286766559;

/// A line that misses the end of a facet by this share of half its length still hits it: nodes that lie opposite one another.
constexpr double end_tolerance = 1e-10;

/// The surface goes on straight beyond its ends by this share of half a facet. Otherwise nodes at corners that lie opposite one another would come
/// and go with every iteration.
constexpr double extension = 0.01;

using Dual = Sacado::Fad::SFad<double, 8>;  // of x, n, y_0, y_1

template <class S>
struct Values {
  S distance, first, second;  // s, N_0(eta), N_1(eta)
};

template <class S>
Values<S> project(const Point2<S>& x, const Point2<S>& normal, const MasterLine<S>& master) {
  const MasterProjection<S> projection = project_onto(master, x, normal);
  return {projection.distance, S(0.5 * (1.0 - projection.eta)), S(0.5 * (1.0 + projection.eta))};
}

Point2<double> point(const Eigen::Vector2d& x) { return {x.x(), x.y()}; }

// The nearest facet that the line hits within |eta| <= limit; masters.size(): none.
std::size_t facet_hit(const SlaveNodeData& slave, const std::vector<Facet<LocalOrdinal>>& masters, double reach, const Positions<2>& x,
                      double limit) {
  const Point2<double> start = point(x[slave.node]), normal = point(slave.normal->normal);
  std::size_t nearest = masters.size();
  double least = reach;
  for (std::size_t m = 0; m < masters.size(); ++m) {
    const MasterLine<double> line = {{point(x[masters[m][0]]), point(x[masters[m][1]])}};
    if (!faces({line.y[0], line.y[1]}, normal)) continue;
    const auto projection = project_onto(line, start, normal);
    if (!(std::abs(projection.eta) <= limit)) continue;
    const double distance = std::abs(projection.distance);
    // Neighbours that meet the line at their common node are equally far: the first one stays.
    if (distance > reach || (nearest < masters.size() && distance >= least - end_tolerance * reach)) continue;
    nearest = m;
    least = distance;
  }
  return nearest;
}

// Part of a facet at the node that counts: at a corner the part seen along its normal. Its derivative is in the corner's columns.
struct Seen {
  double share = 1.0;
  const Eigen::RowVectorXd* slope = nullptr;

  Seen(const SlaveNodeData& slave, const NodeTangents& facet) {
    if (slave.corner == nullptr) return;
    const std::size_t side = slave.corner->sides.size() == 2 && facet.nodes[0] == slave.node ? 1 : 0;  // the one that ends there comes first
    share = slave.corner->weight[side];
    slope = &slave.corner->slope_of_weight[side];
  }
};

// w = sum over the node's facets of w_f t L / 2, or w_f 2 pi L (r_j / 3 + r_k / 6); its derivative in `columns`. w_f is 1 but at a corner.
double share_of_surface(const SlaveNodeData& slave, const Positions<2>& x, const InterfaceMeasure& measure, const std::vector<LocalOrdinal>& columns,
                        Eigen::RowVectorXd* slope) {
  double weight = 0.0;
  for (const NodeTangents& facet : slave.stencil->facets) {
    const Seen seen(slave, facet);
    const LocalOrdinal other = facet.nodes[0] == slave.node ? facet.nodes[1] : facet.nodes[0];
    const Eigen::Vector2d travel = x[slave.node] - x[other];
    const double length = travel.norm();
    const double height = measure.axisymmetric ? two_pi * (x[slave.node].x() / 3.0 + x[other].x() / 6.0) : 0.5 * measure.thickness;
    weight += seen.share * length * height;
    if (slope == nullptr) continue;
    const auto place = [&](LocalOrdinal node) { return 2 * (std::find(columns.begin(), columns.end(), node) - columns.begin()); };
    slope->middleCols<2>(place(slave.node)) += seen.share * height * travel.transpose() / length;
    slope->middleCols<2>(place(other)) -= seen.share * height * travel.transpose() / length;
    if (seen.slope != nullptr) add_columns<2>(columns, slave.corner->columns, Eigen::RowVectorXd(length * height * *seen.slope), *slope);
    if (!measure.axisymmetric) continue;
    (*slope)[place(slave.node)] += seen.share * two_pi * length / 3.0;
    (*slope)[place(other)] += seen.share * two_pi * length / 6.0;
  }
  return weight;
}

}  // namespace

// The node meets the master facet that the line along its normal n hits nearest, at most `reach` away. There
//   x + s n = y(eta),   D_jj = w,   M_jl = w N_l(eta),   g_j = w s.
// The node's share of the current surface is w = share sum_facets w_f int N_j; w_f is 1 but at corners, which couple_nodes.cpp settles. The surface
// goes on straight for 1/200 of a facet beyond its ends.
bool NodeToSegmentCoupling::couple_node(const SlaveNodeData& slave, const std::vector<Facet<LocalOrdinal>>& masters, double reach,
                                        const Positions<2>& x, const InterfaceMeasure& measure, double share, bool derivatives,
                                        FacetCoupling& coupling) const {
  std::size_t hit = facet_hit(slave, masters, reach, x, 1.0 + end_tolerance);
  if (hit == masters.size()) hit = facet_hit(slave, masters, reach, x, 1.0 + extension);
  if (hit == masters.size()) return false;
  coupling.slave = {slave.node};
  coupling.master.assign(masters[hit].begin(), masters[hit].end());
  // A corner's normal depends on masters too.
  coupling.columns = slave.stencil->columns;
  for (const LocalOrdinal node : slave.normal->columns) place_of(coupling.columns, node);
  if (slave.corner != nullptr)
    for (const LocalOrdinal node : slave.corner->columns) place_of(coupling.columns, node);
  const std::array<Eigen::Index, 2> first_of_master = {2 * place_of(coupling.columns, coupling.master[0]),
                                                       2 * place_of(coupling.columns, coupling.master[1])};
  const auto columns = static_cast<Eigen::Index>(2 * coupling.columns.size());

  Eigen::RowVectorXd weight_slope = Eigen::RowVectorXd::Zero(derivatives ? columns : 0);
  const double weight = share * share_of_surface(slave, x, measure, coupling.columns, derivatives ? &weight_slope : nullptr);
  weight_slope *= share;
  const Point2<double> start = point(x[slave.node]), normal = point(slave.normal->normal);
  const MasterLine<double> line = {{point(x[masters[hit][0]]), point(x[masters[hit][1]])}};
  const Values<double> value = project(start, normal, line);
  coupling.D.setConstant(1, 1, weight);
  coupling.M.resize(1, 2);
  coupling.M << weight * value.first, weight * value.second;
  coupling.gap.setConstant(1, weight * value.distance);
  coupling.dD.setZero(1, derivatives ? columns : 0);
  coupling.dM.setZero(derivatives ? 2 : 0, derivatives ? columns : 0);
  coupling.dgap.setZero(1, derivatives ? columns : 0);
  if (!derivatives) return true;

  Point2<Dual> dual_start, dual_normal;
  MasterLine<Dual> dual_line;
  for (int i = 0; i < 2; ++i) {
    dual_start[i] = Dual(8, i, start[i]);
    dual_normal[i] = Dual(8, 2 + i, normal[i]);
    for (int l = 0; l < 2; ++l) dual_line.y[l][i] = Dual(8, 4 + 2 * l + i, line.y[l][i]);
  }
  const Values<Dual> slopes = project(dual_start, dual_normal, dual_line);
  const auto own = 2 * (std::find(coupling.columns.begin(), coupling.columns.end(), slave.node) - coupling.columns.begin());
  const auto chain = [&](const Dual& scalar) {
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(columns);
    const Eigen::RowVector2d along(scalar.fastAccessDx(2), scalar.fastAccessDx(3));
    add_columns<2>(coupling.columns, slave.normal->columns, Eigen::RowVectorXd(along * slave.normal->derivative), row);
    row[own] += scalar.fastAccessDx(0);
    row[own + 1] += scalar.fastAccessDx(1);
    for (int k = 0; k < 4; ++k) row[first_of_master[static_cast<std::size_t>(k / 2)] + k % 2] += scalar.fastAccessDx(4 + k);
    return row;
  };
  coupling.dD.row(0) = weight_slope;
  coupling.dM.row(0) = weight_slope * value.first + weight * chain(slopes.first);
  coupling.dM.row(1) = weight_slope * value.second + weight * chain(slopes.second);
  coupling.dgap.row(0) = weight_slope * value.distance + weight * chain(slopes.distance);
  return true;
}

}  // namespace mortise
