#include "mortise/contact/field_transfer.hpp"

#include <Eigen/Core>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <algorithm>
#include <stdexcept>
#include <unordered_set>

#include "evaluation/arguments.hpp"
#include "evaluation/evaluated_contact.hpp"
#include "mortise/core/trilinos_versions.hpp"

namespace mortise {
namespace {

using detail::NodeMultiplier;
using detail::NodeRow;
using detail::NodeSlip;
using detail::PairEvaluation;
using Row = Eigen::RowVectorXd;
using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 2>;

/// A vector along the tangents of a node, with its derivatives.
struct TangentQuantity {
  TangentVector value;
  Rows of_multiplier;  ///< [tangents x dim]
  Rows of_positions;   ///< [tangents x dim nodes]; without columns: no derivatives
};

NodeQuantity quantity(double value, const Row& of_multiplier, const Row& of_positions) {
  NodeQuantity result;
  result.value = value;
  std::copy(of_multiplier.begin(), of_multiplier.end(), result.of_multiplier.begin());
  result.of_positions.assign(of_positions.begin(), of_positions.end());
  return result;
}

Row row_of(const std::vector<double>& values) { return Eigen::Map<const Row>(values.data(), static_cast<Eigen::Index>(values.size())); }

}  // namespace

struct FieldTransfer::Content {
  Content(ContactLaws of_laws, std::size_t of_pair, bool with_derivatives) : laws(std::move(of_laws)), pair(of_pair), derivatives(with_derivatives) {
    detail::require_pair(*at().contact->model, pair);
    const PairEvaluation& evaluation = of();
    std::unordered_set<GlobalOrdinal> ids;
    for (const SurfaceFacet& facet : evaluation.pair().definition().slave) ids.insert(facet.begin(), facet.end());
    for (const GlobalOrdinal id : local_ids(evaluation.local_nodes())) of_slave.push_back(ids.count(id) > 0 ? 1 : 0);
    if (!derivatives) return;
    facets_of.resize(evaluation.slave_nodes().size());
    for (const FacetCoupling& facet : evaluation.couplings())
      for (std::size_t j = 0; j < facet.slave.size(); ++j)
        if (const auto s = static_cast<std::size_t>(facet.slave[j]); s < facets_of.size())
          facets_of[s].push_back({&facet, static_cast<Eigen::Index>(j)});
  }

  const detail::EvaluatedLaws& at() const { return detail::evaluated(laws); }
  const PairEvaluation& of() const { return at().contact->pairs[pair]; }
  Eigen::MatrixXd slopes(std::size_t s) const;
  TangentQuantity traction(std::size_t s) const;
  TangentQuantity slip_in_contact(std::size_t s, const TangentQuantity& t, const Row& of_weight) const;

  ContactLaws laws;
  std::size_t pair;
  bool derivatives;
  std::vector<char> of_slave;                                                         ///< [local nodes]
  std::vector<std::vector<std::pair<const FacetCoupling*, Eigen::Index>>> facets_of;  ///< [slave nodes] and which of its nodes it is
};

// dc_jk = sum over facets of dD_jk,  dc_jl = -dM_jl. With frozen geometry there is no facet here, and c is constant.
Eigen::MatrixXd FieldTransfer::Content::slopes(std::size_t s) const {
  const std::vector<LocalOrdinal>& coupled = of().coupled_nodes(s);
  const int dimension = of().dimension();
  const auto place = [&](LocalOrdinal node) { return std::lower_bound(coupled.begin(), coupled.end(), node) - coupled.begin(); };
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(coupled.size()), dimension * static_cast<Eigen::Index>(coupled.size()));
  for (const auto& [facet, j] : facets_of[s]) {
    const auto nodes = static_cast<Eigen::Index>(facet->slave.size()), masters = static_cast<Eigen::Index>(facet->master.size());
    const auto add = [&](LocalOrdinal node, const auto& gradient, double sign) {
      const auto row = place(node);
      for (std::size_t c = 0; c < facet->columns.size(); ++c)
        result.row(row).segment(dimension * place(facet->columns[c]), dimension) +=
            sign * gradient.segment(dimension * static_cast<Eigen::Index>(c), dimension);
    };
    for (Eigen::Index k = 0; k < nodes; ++k)
      if (k == j || facet->D(j, k) != 0.0) add(facet->slave[static_cast<std::size_t>(k)], facet->dD.row(nodes * j + k), 1.0);
    for (Eigen::Index l = 0; l < masters; ++l) add(facet->master[static_cast<std::size_t>(l)], facet->dM.row(j * masters + l), -1.0);
  }
  return result;
}

// t = T z,  dt_a = tau_a . dz + (turn_a^T z) . dn.
TangentQuantity FieldTransfer::Content::traction(std::size_t s) const {
  const Frame frame = of().frame(s);
  const SpatialVector& z = at().multipliers[pair][s].z;
  TangentQuantity t{frame.tangents * z, frame.tangents, {}};
  if (!derivatives) return t;
  const auto& dnormal = of().row(s).dnormal;
  t.of_positions.resize(t.value.size(), dnormal.cols());
  for (Eigen::Index a = 0; a < t.value.size(); ++a) t.of_positions.row(a) = (z.transpose() * frame.turn[a]) * dnormal;
  return t;
}

// A node that closed a gap g0 in the step has of it the share q after first contact (Landing). Its law compares y = q (t + c u) with the bound, so
//   s = (y - t) / c,   y = q (t + c u),   q of the depth p = z . n - c g and of c g0,
// which is 0 where it sticks, and u without a gap.
TangentQuantity FieldTransfer::Content::slip_in_contact(std::size_t s, const TangentQuantity& t, const Row& of_weight) const {
  const PairEvaluation& evaluation = of();
  const NodeRow& row = evaluation.row(s);
  const NodeSlip& measured = evaluation.geometry()->slips[s];
  const Eigen::Index tangents = t.value.size(), dimension = row.normal.size();
  TangentQuantity u{measured.slip, Rows::Zero(tangents, dimension), {}};
  if (derivatives) u.of_positions = measured.dslip;
  for (Eigen::Index a = 0; a < tangents; ++a)
    if (measured.rests[static_cast<std::size_t>(a)]) {
      u.value[a] = 0.0;
      if (derivatives) u.of_positions.row(a).setZero();
    }
  const double start = evaluation.start_gap(s);
  if (!(start > 0.0) || !evaluation.pair().enforcement().holds_exactly()) return u;
  const SpatialVector& z = at().multipliers[pair][s].z;
  const detail::Pair& of_pair = evaluation.pair();
  const double c = std::min(evaluation.constant(s), of_pair.definition().youngs_modulus / of_pair.size() / evaluation.slave_nodes()[s].weight);
  const Landing landing(z.dot(row.normal) - c * evaluation.own_gap(s), c * start);
  const TangentVector trial = t.value + c * u.value;
  TangentQuantity result;
  result.value = (landing.share * trial - t.value) / c;
  result.of_multiplier = ((landing.share - 1.0) * t.of_multiplier + landing.of_depth * trial * row.normal.transpose()) / c;
  if (!derivatives) return result;
  Row depth = z.transpose() * row.dnormal;
  depth -= c * (row_of(row.dgap) + evaluation.offset(s) * of_weight);
  Row of_start = Row::Zero(depth.size());
  if (!measured.dstart_gap.empty()) of_start = row_of(measured.dstart_gap) + evaluation.clearance(s) * of_weight;
  result.of_positions = ((landing.share - 1.0) * t.of_positions + landing.share * c * u.of_positions +
                         trial * (landing.of_depth * depth + landing.of_start * c * of_start)) /
                        c;
  return result;
}

FieldTransfer::FieldTransfer(const ContactLaws& laws, std::size_t pair) : content_(std::make_shared<const Content>(laws, pair, false)) {}
FieldTransfer::FieldTransfer(const ContactLinearisation& at, std::size_t pair) : content_(std::make_shared<const Content>(at.laws(), pair, true)) {}

const RCP<const Map>& FieldTransfer::nodes() const { return content_->of().geometry()->pattern->local_nodes; }

RCP<MultiVector> FieldTransfer::on_nodes(const MultiVector& of_owned_nodes) const {
  const auto result = rcp(new MultiVector(nodes(), of_owned_nodes.getNumVectors()));
  result->doImport(of_owned_nodes, *content_->of().geometry()->pattern->import, Tpetra::REPLACE);
  return result;
}

bool FieldTransfer::is_slave(LocalOrdinal node) const { return content_->of_slave[static_cast<std::size_t>(node)] != 0; }

GlobalOrdinal FieldTransfer::displacement_id(LocalOrdinal node, int component) const {
  return content_->at().contact->id(content_->pair, node, component);
}

std::size_t FieldTransfer::size() const { return content_->of().slave_nodes().size(); }
bool FieldTransfer::is_covered(std::size_t slave) const { return content_->of().covered(slave) && content_->of().row(slave).covered > 0.0; }

NodeTransfer FieldTransfer::operator[](std::size_t s) const {
  if (!is_covered(s)) throw std::logic_error("contact: the couplings of a slave node that is not covered: ask is_covered() before");
  const Content& self = *content_;
  const PairEvaluation& evaluation = self.of();
  const NodeRow& row = evaluation.row(s);
  const SpatialVector& z = self.at().multipliers[self.pair][s].z;
  const detail::ContactModel& model = *self.at().contact->model;
  const int dimension = model.dimension;

  NodeTransfer node;
  node.node = evaluation.slave_nodes()[s].id;
  node.owned_node = evaluation.slave_nodes()[s].owned_node;
  node.multiplier = model.multipliers->getGlobalElement(model.multiplier_of[self.pair][s]);
  node.state = self.at().state(self.pair, s);
  node.nodes = evaluation.coupled_nodes(s);
  const std::vector<LocalOrdinal>& loaded = evaluation.loaded_nodes(s);
  for (std::size_t c = 0; c < node.nodes.size(); ++c) {
    node.coefficients.push_back(evaluation.coefficient(s, c));
    node.loaded.push_back(std::binary_search(loaded.begin(), loaded.end(), node.nodes[c]) ? 1 : 0);
  }
  const Row none = Row::Zero(dimension);
  Row of_weight, of_pressure, of_gap;
  const double mean_gap = evaluation.geometry()->gaps[s] / row.covered;
  if (self.derivatives) {
    const Eigen::MatrixXd slopes = self.slopes(s);
    of_weight = Row::Zero(slopes.cols());
    for (std::size_t c = 0; c < node.nodes.size(); ++c)
      if (is_slave(node.nodes[c])) of_weight += slopes.row(static_cast<Eigen::Index>(c));
    of_pressure = z.transpose() * row.dnormal;
    of_gap = (row_of(row.dgap) - mean_gap * of_weight) / row.covered;
    node.coefficient_slopes.resize(static_cast<std::size_t>(slopes.size()));
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(node.coefficient_slopes.data(), slopes.rows(), slopes.cols()) =
        slopes;
  }
  node.weight = quantity(row.covered, none, of_weight);
  node.pressure = quantity(z.dot(row.normal), row.normal.transpose(), of_pressure);
  node.gap = quantity(mean_gap + evaluation.clearance(s), none, of_gap);
  node.slip = node.friction_work = quantity(0.0, none, Row::Zero(of_weight.size()));
  if (node.state != ContactState::slip || evaluation.history().slip == nullptr) return node;

  const TangentQuantity t = self.traction(s), slip = self.slip_in_contact(s, t, of_weight);
  const double length = slip.value.norm();
  const TangentVector along = length > 0.0 ? TangentVector(slip.value / length) : TangentVector(TangentVector::Zero(slip.value.size()));
  const auto of_products = [](const TangentVector& a, const Rows& db, const TangentVector& b, const Rows& da) {
    return Row(a.transpose() * db + b.transpose() * da);
  };
  Row slip_of_positions, work_of_positions;
  if (self.derivatives) {
    slip_of_positions = (Row(along.transpose() * slip.of_positions) - length / row.covered * of_weight) / row.covered;
    work_of_positions = of_products(t.value, slip.of_positions, slip.value, t.of_positions);
  }
  node.slip = quantity(length / row.covered, Row(along.transpose() * slip.of_multiplier) / row.covered, slip_of_positions);
  node.friction_work = quantity(t.value.dot(slip.value), of_products(t.value, slip.of_multiplier, slip.value, t.of_multiplier), work_of_positions);
  return node;
}

}  // namespace mortise
