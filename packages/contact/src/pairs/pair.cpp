#include "pairs/pair.hpp"

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_MultiVector.hpp>
#include <algorithm>
#include <limits>
#include <stdexcept>

#include "mortise/core/trilinos_versions.hpp"

namespace mortise::detail {

Pair::Pair(RCP<const Map> owned_nodes, RCP<const MultiVector> reference, RCP<const MultiVector> fixed, const InterfaceMeasure& measure,
           ContactPair pair)
    : pair_(std::move(pair)),
      owned_nodes_(std::move(owned_nodes)),
      reference_(std::move(reference)),
      fixed_(fixed),
      dimension_(static_cast<int>(reference_->getNumVectors())) {
  interface_ = std::make_unique<MortarInterface>(owned_nodes_, reference_, std::move(fixed), pair_.slave, pair_.master, measure, pair_.options.mortar,
                                                 pair_.place);
  untied_ = MultiplierTies(slave_nodes(), pair_.slave, owned_nodes_->getComm());
  size_ = interface_->shortest_facet();
  refuse_constant_out_of_range();
  for (const SlaveNode& node : slave_nodes()) {
    const auto first_fixed = std::find(node.fixed.begin(), node.fixed.end(), true);
    fixed_axes_.push_back(node.partly_fixed() ? static_cast<int>(first_fixed - node.fixed.begin()) : -1);
  }
  enforcement_ = pair_.options.formulation.options->enforcement();
  refuse_reach_short_of_onset();
  if (!pair_.options.friction.options->acts()) return;
  friction_ = pair_.options.friction.options.get();
  const bool mine = std::any_of(slave_nodes().begin(), slave_nodes().end(), [](const SlaveNode& node) { return node.partly_fixed(); });
  int held = 0;
  Teuchos::reduceAll(*owned_nodes_->getComm(), Teuchos::REDUCE_MAX, mine ? 1 : 0, Teuchos::outArg(held));
  any_held_ = held != 0;
  if (any_held_)
    for (const SurfaceFacet& facet : pair_.slave) slave_ids_.insert(facet.begin(), facet.end());
}

// On its way Newton's method finds gaps to about 1e-8 h and pressures to about 1e-8 E. Pressures of 1e-4 E and gaps of 1e-4 h have to differ from
// 0. With c_n A_j = a E / h an error of the gap weighs 1e-8 a E beside such a pressure: a <= 1e4. An error of the pressure weighs 1e-8 E beside
// 1e-4 a E of such a gap: a >= 1e-4. Beyond, errors of the iteration would choose the active set.
void Pair::refuse_constant_out_of_range() const {
  const auto& constant = pair_.options.complementarity_constant;
  if (!constant) return;
  constexpr double most = 1e4;
  constexpr double written = 1e-5;  // the ends as the message writes them are allowed
  const double facet = pair_.youngs_modulus / size_, least = facet / most, largest = most * facet;
  if (*constant >= (1.0 - written) * least && *constant <= (1.0 + written) * largest) return;
  throw InputError(
      pair_.place,
      fmt::format("\"complementarity constant\" is {:g}; allowed: {:.6g} to {:.6g}, as errors of the iteration would choose the active set "
                  "beyond; please take about Young's modulus over the side of a facet, here {:.6g}, or leave it out",
                  *constant, least, largest, facet));
}

// Nothing is integrated beyond the reach: there pressures would jump from 0 to what they are at that distance.
void Pair::refuse_reach_short_of_onset() const {
  const double distance = -enforcement_->onset(), reach = interface_->reach();
  if (distance <= reach) return;
  throw InputError(
      pair_.place,
      fmt::format("the search reach is {:g}, and surfaces act on one another from a distance of {:g} on: pressures would jump where they "
                  "come within reach; please give a \"search reach\" of {:g} or more",
                  reach, distance, distance));
}

double Pair::complementarity_constant(std::size_t s) const {
  const double facet = pair_.youngs_modulus / size_;
  return pair_.options.complementarity_constant.value_or(enforcement_->relative_constant() * facet) / slave_nodes()[s].weight;
}

double Pair::friction_constant(std::size_t s) const {
  return std::min(complementarity_constant(s), pair_.youngs_modulus / size_ / slave_nodes()[s].weight);
}

bool Pair::covered(std::size_t s, const NodeRow& row) const {
  const bool dual = pair_.options.mortar.coupling->has_dual_multipliers();  // else int phi_j N_j may be negative on a part of a quadratic facet
  return slave_nodes()[s].carries_multiplier && (dual ? row.D : row.covered) > 0.0;
}

CornerRule Pair::corner_rule() const { return uses_reference() ? CornerRule::averaged : pair_.options.mortar.corner_rule(dimension_); }

PairHistory Pair::blank_history() const {
  PairHistory history;
  history.axes = fixed_axes_;
  if (corner_rule() == CornerRule::master_normal) history.kinks = interface_->find_kinks(*reference_, {}, {});
  if (enforcement_->starts_from_multipliers()) history.starts.assign(slave_nodes().size(), {SpatialVector::Zero(dimension_)});
  return history;
}

SurfaceKinks Pair::choose_kinks(const MultiVector& x, const PairHistory& history) const {
  if (corner_rule() == CornerRule::averaged) return history.kinks;
  std::vector<Facet<LocalOrdinal>> nearest(history.nearest_facets.size());
  for (std::size_t s = 0; s < nearest.size(); ++s)
    for (const GlobalOrdinal node : history.nearest_facets[s]) nearest[s].push_back(interface_->local_nodes()->getLocalElement(node));
  return interface_->find_kinks(x, nearest, history.kinks);
}

void Pair::search(const MultiVector& x, const PairHistory& history) const {
  if (frozen_ != nullptr) return;
  if (corner_rule() != CornerRule::averaged) interface_->set_kinks(history.kinks);
  interface_->retain(history.slip == nullptr ? nullptr : std::shared_ptr<const RetainedNodes>(history.slip, &history.slip->nodes));
  interface_->search(uses_reference() ? *reference_ : x);
}

std::shared_ptr<const PairGeometry> Pair::evaluate(const MultiVector& x, const PairHistory& history, bool derivatives,
                                                   std::optional<StepFailure>& failure) const {
  if (frozen_ != nullptr) {
    if (!failure) failure = frozen_failure_;
    return moved(x, history);
  }
  const bool reference = uses_reference(), slopes = derivatives || reference || has_forces_of_gaps();
  const auto geometry = std::make_shared<PairGeometry>();
  geometry->pattern = interface_->pattern();
  const InterfacePattern& pattern = *geometry->pattern;
  const auto positions = rcp(new MultiVector(pattern.local_nodes, static_cast<std::size_t>(dimension_)));
  positions->doImport(reference ? *reference_ : x, *pattern.import, Tpetra::REPLACE);
  geometry->positions = positions;
  std::vector<NodalNormal> normals;
  std::optional<StepFailure> mine;
  interface_->evaluate(*positions, slopes, geometry->couplings, normals, mine);
  if (mine && !failure) failure = mine;
  const auto rows = std::make_shared<std::vector<NodeRow>>(rows_of(pattern, geometry->couplings, normals, slopes, geometry->gaps));
  const auto ties = std::make_shared<MultiplierTies>(untied_);
  if (has_ties())
    ties->measure(
        geometry->couplings, slave_nodes(), [&](std::size_t s) { return covered(s, (*rows)[s]); }, *pattern.local_nodes, pair_.options.full_cover,
        size_ / pair_.youngs_modulus, dimension_, slopes && !reference);
  geometry->ties = ties;
  if (needs_covered() && derivatives && !reference) measure_covered(pattern, geometry->couplings, *rows);
  geometry->rows = rows;
  if (reference) {
    freeze(pattern, *rows);
    geometry->couplings.clear();
    frozen_ = geometry;
    frozen_failure_ = mine;
    return moved(x, history);
  }
  if (friction_ != nullptr && history.slip != nullptr) measure_slip(history, derivatives, *geometry);
  return geometry;
}

std::vector<NodeRow> Pair::rows_of(const InterfacePattern& pattern, const std::vector<FacetCoupling>& couplings,
                                   const std::vector<NodalNormal>& normals, bool derivatives, std::vector<double>& gaps) const {
  const std::size_t slaves = slave_nodes().size();
  std::vector<NodeRow> rows(slaves);
  gaps.assign(slaves, 0.0);
  std::vector<LocalOrdinal> position_in_row(local_id_count(*pattern.local_nodes), -1);
  std::vector<std::vector<std::pair<const FacetCoupling*, int>>> facets_of(slaves);
  for (const FacetCoupling& facet : couplings)
    for (std::size_t j = 0; j < facet.slave.size(); ++j)
      if (static_cast<std::size_t>(facet.slave[j]) < slaves) facets_of[facet.slave[j]].push_back({&facet, static_cast<int>(j)});

  for (std::size_t s = 0; s < slaves; ++s) {
    const std::vector<LocalOrdinal>& coupled = pattern.coupled[s];
    NodeRow& row = rows[s];
    if (has_forces_of_gaps()) row.opening = SpatialVector::Zero(dimension_);
    row.coefficients.assign(coupled.size(), 0.0);
    row.dgap.assign(derivatives ? dimension_ * coupled.size() : 0, 0.0);
    row.dnormal.setZero(dimension_, derivatives ? dimension_ * static_cast<Eigen::Index>(coupled.size()) : 0);
    for (std::size_t c = 0; c < coupled.size(); ++c) position_in_row[coupled[c]] = static_cast<LocalOrdinal>(c);
    const auto place = [&](LocalOrdinal node) {
      const LocalOrdinal found = position_in_row[node];
      if (found < 0) throw std::logic_error("contact: a slave node is coupled with a node that is not in its pattern");
      return found;
    };

    for (const auto& [facet, j] : facets_of[s]) {
      row.D += facet->D(j, j);
      row.covered += facet->D.row(j).sum();
      for (int k = 0; k < static_cast<int>(facet->slave.size()); ++k)
        if (k != j && facet->D(j, k) != 0.0) row.coefficients[place(facet->slave[k])] += facet->D(j, k);
      for (std::size_t l = 0; l < facet->master.size(); ++l) row.coefficients[place(facet->master[l])] -= facet->M(j, l);
      gaps[s] += facet->gap(j);
      if (!derivatives) continue;
      for (std::size_t c = 0; c < facet->columns.size(); ++c)
        for (int i = 0; i < dimension_; ++i)
          row.dgap[dimension_ * place(facet->columns[c]) + i] += facet->dgap(j, dimension_ * static_cast<Eigen::Index>(c) + i);
      if (has_forces_of_gaps())  // master nodes are the last columns
        for (std::size_t c = facet->columns.size() - facet->master.size(); c < facet->columns.size(); ++c)
          row.opening += facet->dgap.block(j, dimension_ * static_cast<Eigen::Index>(c), 1, dimension_).transpose();
    }
    row.normal = normals[s].normal;
    if (derivatives)
      for (std::size_t c = 0; c < normals[s].columns.size(); ++c)
        row.dnormal.middleCols(dimension_ * place(normals[s].columns[c]), dimension_) +=
            normals[s].derivative.middleCols(dimension_ * static_cast<Eigen::Index>(c), dimension_);
    for (const LocalOrdinal node : coupled) position_in_row[node] = -1;
  }
  return rows;
}

void Pair::measure_covered(const InterfacePattern& pattern, const std::vector<FacetCoupling>& couplings, std::vector<NodeRow>& rows) const {
  for (std::size_t s = 0; s < rows.size(); ++s) rows[s].dcovered.assign(dimension_ * pattern.coupled[s].size(), 0.0);
  for (const FacetCoupling& facet : couplings) {
    const auto nodes = static_cast<Eigen::Index>(facet.slave.size());
    for (Eigen::Index j = 0; j < nodes; ++j) {
      const auto s = static_cast<std::size_t>(facet.slave[j]);
      if (s >= rows.size()) continue;
      const std::vector<LocalOrdinal>& coupled = pattern.coupled[s];
      for (std::size_t c = 0; c < facet.columns.size(); ++c) {
        const auto place = std::lower_bound(coupled.begin(), coupled.end(), facet.columns[c]) - coupled.begin();
        for (int i = 0; i < dimension_; ++i)
          rows[s].dcovered[dimension_ * place + i] += facet.dD.col(dimension_ * static_cast<Eigen::Index>(c) + i).segment(nodes * j, nodes).sum();
      }
    }
  }
}

// Small displacements: D, M and n are those of the reference configuration. With the multipliers' own functions as weights the gap is
//   g_j(u) = g_j(0) + n_j . (sum_l M_jl u_l - sum_k D_jk u_k),
// the transpose of the contact force of z_n n_j, so that the condensed operator of a symmetric bulk is symmetric. With standard weights
// it is the linearisation of the weighted gap.
void Pair::freeze(const InterfacePattern& pattern, std::vector<NodeRow>& rows) const {
  const bool transpose = pair_.options.mortar.weighs_gaps_as_multipliers();
  for (std::size_t s = 0; s < rows.size(); ++s) {
    NodeRow& row = rows[s];
    row.dnormal.setZero();
    if (has_forces_of_gaps()) row.opening = row.covered * row.normal;
    if (needs_covered()) row.dcovered.assign(row.dgap.size(), 0.0);
    if (!transpose) continue;
    const std::vector<LocalOrdinal>& coupled = pattern.coupled[s];
    for (std::size_t c = 0; c < coupled.size(); ++c) {
      const double own = coupled[c] == slave_nodes()[s].local_node ? row.D : 0.0;
      for (int i = 0; i < dimension_; ++i) row.dgap[dimension_ * c + i] = -row.normal[i] * (row.coefficients[c] + own);
    }
  }
}

std::shared_ptr<const PairGeometry> Pair::moved(const MultiVector& x, const PairHistory& history) const {
  const auto geometry = std::make_shared<PairGeometry>(*frozen_);
  const InterfacePattern& pattern = *geometry->pattern;
  MultiVector displacement(x, Teuchos::Copy), local(pattern.local_nodes, static_cast<std::size_t>(dimension_));
  displacement.update(-1.0, *reference_, 1.0);
  local.doImport(displacement, *pattern.import, Tpetra::REPLACE);
  const auto u = local.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t s = 0; s < geometry->gaps.size(); ++s) {
    const std::vector<LocalOrdinal>& coupled = pattern.coupled[s];
    double gap = geometry->gaps[s];
    for (std::size_t c = 0; c < coupled.size(); ++c)
      for (int i = 0; i < dimension_; ++i) gap += (*geometry->rows)[s].dgap[dimension_ * c + i] * u(coupled[c], i);
    geometry->gaps[s] = gap;
  }
  if (friction_ == nullptr || history.slip == nullptr) return geometry;
  const auto positions = rcp(new MultiVector(pattern.local_nodes, static_cast<std::size_t>(dimension_)));
  positions->doImport(x, *pattern.import, Tpetra::REPLACE);
  geometry->positions = positions;
  measure_frozen_slip(history, *geometry);
  return geometry;
}

// The interface may have gone on to other candidates since: then its nodes have other numbers.
std::vector<GapCurvature> Pair::gap_curvatures(const MultiVector& x, const PairGeometry& geometry, const PairHistory& history,
                                               const std::vector<double>& pressures) const {
  if (uses_reference()) return {};
  search(x, history);
  const std::shared_ptr<const InterfacePattern> pattern = interface_->pattern();
  MultiVector local(pattern->local_nodes, static_cast<std::size_t>(dimension_));
  local.doImport(x, *pattern->import, Tpetra::REPLACE);
  std::vector<GapCurvature> curvatures = interface_->gap_curvatures(local, pressures);
  if (pattern == geometry.pattern) return curvatures;
  for (GapCurvature& facet : curvatures)
    for (LocalOrdinal& node : facet.columns) node = geometry.pattern->local_nodes->getLocalElement(pattern->local_nodes->getGlobalElement(node));
  return curvatures;
}

}  // namespace mortise::detail
