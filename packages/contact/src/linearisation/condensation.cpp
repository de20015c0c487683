// The linearised contact: C~, condensation of the multipliers.

#include "linearisation/condensation.hpp"

#include <Eigen/LU>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "evaluation/arguments.hpp"
#include "linearisation/assembled_rows.hpp"

namespace mortise {
namespace {

using detail::EliminatedNode;
using detail::NodePositions;
using detail::NodeRow;
using detail::PairEvaluation;

// A local row of a filled matrix, copied.
void copy_row(const Matrix& matrix, LocalOrdinal row, std::vector<LocalOrdinal>& columns, std::vector<double>& values) {
  Matrix::local_inds_host_view_type column_view;
  Matrix::values_host_view_type value_view;
  matrix.getLocalRowView(row, column_view, value_view);
  columns.assign(column_view.data(), column_view.data() + column_view.extent(0));
  values.assign(value_view.data(), value_view.data() + value_view.extent(0));
}

// The sign and the weight that turn condition a, a traction, into a force.
double own_row_scale(int a, const SlaveNode& slave, const NodeRow& node) { return a == 0 ? -slave.weight : -node.D; }

// True if a condition does not replace the momentum of a fixed component.
bool in_own_rows(const EliminatedNode& kept, int a) { return std::find(kept.condition.begin(), kept.condition.end(), a) == kept.condition.end(); }

void replace_row(Matrix& matrix, LocalOrdinal row, const std::vector<LocalOrdinal>& columns, const std::vector<double>& values) {
  matrix.replaceLocalValues(row, static_cast<LocalOrdinal>(columns.size()), values.data(), columns.data());
}

// Local columns of the displacements of some nodes, in their order.
std::vector<LocalOrdinal> columns_of(const NodePositions& positions, const std::vector<LocalOrdinal>& nodes, int dimension) {
  std::vector<LocalOrdinal> columns;
  for (const LocalOrdinal node : nodes)
    for (int i = 0; i < dimension; ++i)
      if (const LocalOrdinal column = positions.column[dimension * node + i]; column >= 0) columns.push_back(column);
  return columns;
}

// The scatter into `system`, which has to be on its graph and open.
std::shared_ptr<detail::SystemScatter> scatter_into(const detail::EvaluatedContact& contact, const Matrix& system) {
  const auto& scatter = contact.model->scatter;
  if (!scatter || !scatter->fits(contact.pairs) || system.getCrsGraph() != scatter->graph())  // entries are found by their positions in it
    throw std::logic_error(
        "contact: the matrix is not on the graph of this evaluation: ask ContactSystem::graph() for it, and rebuild the matrix where it is another "
        "one than before");
  if (!system.isFillActive())
    throw std::logic_error(
        "contact: the matrix is complete: call resumeFill() before, fillComplete() after condense() and the rows of prescribed dofs");
  return scatter;
}

}  // namespace

// C~ = d(f_c)/dd at fixed z: rows of slave k: z_j dD_jk, rows of master l: -z_j dM_jl. All slave nodes with z != 0, just opened ones too. z_j is the
// part of it that acts through D and M.
void ContactLinearisation::add_stiffness(Matrix& system) const {
  const detail::EvaluatedLaws& laws = detail::evaluated(laws_);
  const detail::ContactModel& self = *laws.contact->model;
  const auto scatter = scatter_into(*laws.contact, system);
  const int dimension = self.dimension;
  const auto scope = self.timers.scope("condensation");
  std::vector<LocalOrdinal> columns;
  std::vector<double> values;
  for (std::size_t p = 0; p < self.pairs.size(); ++p) {
    const PairEvaluation& pair = laws.contact->pairs[p];
    const NodePositions& positions = scatter->positions(p);
    for (const FacetCoupling& facet : pair.couplings()) {
      columns.clear();
      for (const LocalOrdinal node : facet.columns)
        for (int i = 0; i < dimension; ++i) columns.push_back(positions.column[dimension * node + i]);
      values.resize(columns.size());
      const auto nodes = static_cast<Eigen::Index>(facet.slave.size()), masters = static_cast<Eigen::Index>(facet.master.size());
      for (Eigen::Index j = 0; j < nodes; ++j) {
        if (static_cast<std::size_t>(facet.slave[j]) >= self.multiplier_of[p].size()) continue;
        const auto s = static_cast<std::size_t>(facet.slave[j]);
        const SpatialVector zj = pair.coupled_part(s, laws.multipliers[p][s].z);
        if (zj.isZero(0.0)) continue;
        const auto add = [&](LocalOrdinal node, const auto& gradient, double sign) {
          for (int i = 0; i < dimension; ++i) {
            for (std::size_t c = 0; c < columns.size(); ++c) values[c] = sign * zj[i] * gradient(static_cast<Eigen::Index>(c));
            scatter->add(system, positions, node, i, columns, values);
          }
        };
        for (Eigen::Index k = 0; k < nodes; ++k)
          if (k == j || facet.D(j, k) != 0.0) add(facet.slave[k], facet.dD.row(nodes * j + k), 1.0);
        for (Eigen::Index l = 0; l < masters; ++l) add(facet.master[l], facet.dM.row(j * masters + l), -1.0);
      }
    }
    if (pair.pair().has_forces_of_gaps()) detail::add_gap_stiffness(laws, p, *scatter, system);
  }
  scatter->finish(system);
}

// Conditions that give z as a function of d, of a node j:  z^{k+1} = b + S dd,  b = z - C_z^-1 C,  S = -C_z^-1 C_d.
// Its rows and those of the nodes m it is coupled to:  A_m += c_jm S,  rhs_m -= c_jm b.
void detail::Condensation::eliminate_by_law(std::size_t p, std::size_t s, Matrix& system) {
  const PairEvaluation& pair = this->pair(p);
  const int dimension = model().dimension;
  const Complementarity& law = at().laws[p][s];
  if (law.state == ContactState::open) return;
  const NodeMultiplier& multiplier = at().multipliers[p][s];
  const NodePositions& positions = scatter->positions(p);
  const NodeRow& node = pair.row(s);
  const std::vector<LocalOrdinal>& coupled = pair.coupled_nodes(s);

  EliminatedNode row;
  row.multiplier = model().multiplier_of[p][s];
  row.pair = p;
  row.node = s;
  row.by_law = true;
  row.columns = columns_of(positions, coupled, dimension);
  row.inverse = law.C_z.inverse();
  for (std::size_t c = 0; c < dimension * coupled.size(); ++c) {
    if (positions.column[dimension * coupled[c / dimension] + c % dimension] < 0) continue;
    const SpatialVector slope = -row.inverse * pair.constraint_gradient(law, s, c, multiplier);
    for (int i = 0; i < dimension; ++i) row.S[i].push_back(slope[i]);
  }
  std::vector<double> values;
  const auto add = [&](LocalOrdinal m, double coefficient) {
    if (coefficient == 0.0) return;
    for (int i = 0; i < dimension; ++i) {
      values = row.S[i];
      for (double& value : values) value *= coefficient;
      scatter->add(system, positions, m, i, row.columns, values);
    }
  };
  add(pair.slave_nodes()[s].local_node, node.D);
  for (std::size_t c = 0; c < coupled.size(); ++c) add(coupled[c], node.coefficients[c]);
  nodes.push_back(std::move(row));
}

// For a closed node j take the linearised momentum rows  D z = rhs_j - K~_j dd  (rhs = -r without f_c, free components) and the linearised C_tau = 0
// (fixed components). They give
//   z^{k+1} = b + S dd.
// Rows of the nodes m it is coupled to:  A_m += c_jm S,  rhs_m -= c_jm b.   Its own rows, in the frame (n, tau), turned back to x, y:
//   normal       -A_j c_n dg dd = A_j c_n g
//   tangential   without friction (tau . K~_j - D z . dtau) dd = tau . rhs_j,   sticking D_jj c_t du dd = -D_jj c_t u.
// A node with a fixed component f: the tangent along f gives z_f, row f stays Dirichlet's, and the free rows hold the other conditions.
// Open nodes: z^{k+1} = 0, their rows stay momentum rows.
// The rows of a corner hold the multipliers of its mid-side nodes too,  D_cc z_c + sum_m D_mc z_m = rhs_c - K~_c dd. Those of a mid-side node hold
// its own only. So mid-side nodes are condensed first, which adds their D_mc (b_m + S_m dd) to rows of corners. Then the corners' rows are as above.
void detail::Condensation::condense_node(std::size_t p, std::size_t s, Matrix& system) {
  const PairEvaluation& pair = this->pair(p);
  const int dimension = model().dimension;
  const Complementarity& law = at().laws[p][s];
  if (law.state == ContactState::open) return;
  const NodeMultiplier& multiplier = at().multipliers[p][s];
  const NodePositions& positions = scatter->positions(p);
  std::array<std::vector<double>, 3> momentum, constraint, row_values;
  const SlaveNode& slave = pair.slave_nodes()[s];
  const NodeRow& node = pair.row(s);
  const std::vector<LocalOrdinal>& coupled = pair.coupled_nodes(s);
  const LocalOrdinal* own_rows = own_rows_of(slave);

  EliminatedNode kept;
  kept.multiplier = model().multiplier_of[p][s];
  kept.pair = p;
  kept.node = s;
  for (int i = 0; i < dimension; ++i)
    if (own_rows[i] >= 0) copy_row(system, own_rows[i], kept.columns, momentum[i]);  // the same columns: see SystemScatter
  if (kept.columns.empty()) {                                                        // nothing of the node is an unknown
    kept.columns = columns_of(positions, coupled, dimension);
    std::sort(kept.columns.begin(), kept.columns.end());
  }
  const std::vector<LocalOrdinal>& columns = kept.columns;

  // Linearised complementarity: constraint . dd + (C - C_z z) + C_z z^{k+1} = 0
  for (int a = 0; a < dimension; ++a) constraint[a].assign(columns.size(), 0.0);
  for (std::size_t c = 0; c < coupled.size(); ++c)
    for (int i = 0; i < dimension; ++i) {
      const LocalOrdinal column = positions.column[dimension * coupled[c] + i];
      if (column < 0) continue;
      const auto found = std::lower_bound(columns.begin(), columns.end(), column);
      const SpatialVector gradient = pair.constraint_gradient(law, s, dimension * c + i, multiplier);
      for (int a = 0; a < dimension; ++a) constraint[a][found - columns.begin()] += gradient[a];
    }
  kept.C_z = law.C_z;

  // E z^{k+1} = e - L dd, one row for each component: momentum where free, where fixed the condition along the tangent that is this component.
  const Frame frame = pair.frame(s);
  kept.axes.resize(dimension, dimension);
  kept.axes << frame.normal.transpose(), frame.tangents;
  SpatialMatrix E = SpatialMatrix::Zero(dimension, dimension);
  std::array<const std::vector<double>*, 3> L{};
  kept.condition.fill(-1);
  for (int i = 0; i < dimension; ++i) {
    if (slave.fixed[i]) {
      Eigen::Index tangent = 0;
      frame.tangents.col(i).cwiseAbs().maxCoeff(&tangent);
      const auto a = static_cast<int>(1 + tangent);
      kept.condition[i] = a;
      E.row(i) = law.C_z.row(a);
      L[i] = &constraint[a];
    } else {
      E(i, i) = node.D;
      L[i] = &momentum[i];
    }
  }
  kept.inverse = E.inverse();
  for (int i = 0; i < dimension; ++i) {
    kept.S[i].assign(columns.size(), 0.0);
    for (int k = 0; k < dimension; ++k)
      if (kept.inverse(i, k) != 0.0)
        for (std::size_t c = 0; c < columns.size(); ++c) kept.S[i][c] -= kept.inverse(i, k) * (*L[k])[c];
  }

  for (std::size_t c = 0; c < coupled.size(); ++c) {
    const double coefficient = node.coefficients[c];
    if (coefficient == 0.0) continue;
    for (int i = 0; i < dimension; ++i) {
      row_values[i].resize(columns.size());
      for (std::size_t k = 0; k < columns.size(); ++k) row_values[i][k] = coefficient * kept.S[i][k];
      scatter->add(system, positions, coupled[c], i, columns, row_values[i]);
    }
  }

  // Own rows. Equation a: constraint_a dd + constant_a + C_z,a (b + S dd) = 0, scaled to forces.
  for (int a = 0; a < dimension; ++a) {
    const double scale = own_row_scale(a, slave, node);
    row_values[a].resize(columns.size());
    for (std::size_t k = 0; k < columns.size(); ++k) {
      double value = constraint[a][k];
      for (int i = 0; i < dimension; ++i) value += law.C_z(a, i) * kept.S[i][k];
      row_values[a][k] = scale * value;
    }
  }
  for (int i = 0; i < dimension; ++i) {
    if (slave.fixed[i]) continue;
    std::vector<double>& values = momentum[i];
    values.assign(columns.size(), 0.0);
    for (int a = 0; a < dimension; ++a) {
      if (!in_own_rows(kept, a)) continue;
      for (std::size_t k = 0; k < columns.size(); ++k) values[k] += kept.axes(a, i) * row_values[a][k];
    }
    replace_row(system, own_rows[i], columns, values);
  }
  nodes.push_back(std::move(kept));
}

// Does to the right-hand side what the two functions above do, in the same order.
SpatialVector detail::Condensation::condense_right_hand_side(const EliminatedNode& kept, const SpatialVector& z, const SpatialVector& C,
                                                             Vector& rhs) const {
  const PairEvaluation& pair = this->pair(kept.pair);
  const int dimension = model().dimension;
  const NodePositions& positions = scatter->positions(kept.pair);
  const SlaveNode& slave = pair.slave_nodes()[kept.node];
  const NodeRow& node = pair.row(kept.node);
  const std::vector<LocalOrdinal>& coupled = pair.coupled_nodes(kept.node);
  const LocalOrdinal* own_rows = own_rows_of(slave);
  const auto add_to_coupled = [&](const SpatialVector& b) {
    for (std::size_t c = 0; c < coupled.size(); ++c)
      for (int i = 0; i < dimension && node.coefficients[c] != 0.0; ++i) scatter->add(rhs, positions, coupled[c], i, -node.coefficients[c] * b[i]);
  };
  if (kept.by_law) {
    const SpatialVector b = z - kept.inverse * C;
    for (int i = 0; i < dimension && node.D != 0.0; ++i) scatter->add(rhs, positions, slave.local_node, i, -node.D * b[i]);
    add_to_coupled(b);
    return b;
  }
  const SpatialVector constant = C - kept.C_z * z;
  SpatialVector e(dimension), right(dimension);
  {
    const auto view = rhs.getLocalViewHost(Tpetra::Access::ReadOnly);
    for (int i = 0; i < dimension; ++i) e[i] = kept.condition[i] < 0 ? view(own_rows[i], 0) : -constant[kept.condition[i]];
  }
  const SpatialVector b = kept.inverse * e;
  add_to_coupled(b);
  for (int a = 0; a < dimension; ++a) right[a] = -own_row_scale(a, slave, node) * (constant[a] + kept.C_z.row(a).dot(b));
  const auto out = rhs.getLocalViewHost(Tpetra::Access::ReadWrite);
  for (int i = 0; i < dimension; ++i) {
    if (slave.fixed[i]) continue;
    double value = 0.0;
    for (int a = 0; a < dimension; ++a)
      if (in_own_rows(kept, a)) value += kept.axes(a, i) * right[a];
    out(own_rows[i], 0) = value;
  }
  return b;
}

// Open nodes have z^{k+1} = 0. Their rows of any other C are  dz = -C,  as of a law with C_z = I.
std::vector<EliminatedNode> detail::Condensation::open_nodes(const Vector& C) const {
  const auto view = C.getLocalViewHost(Tpetra::Access::ReadOnly);
  std::vector<EliminatedNode> result;
  for (std::size_t p = 0; p < model().pairs.size(); ++p)
    for (std::size_t s = 0; s < model().multiplier_of[p].size(); ++s) {
      const LocalOrdinal multiplier = model().multiplier_of[p][s];
      if (multiplier < 0 || at().state(p, s) != ContactState::open || model().z_of(view, p, s).isZero(0.0)) continue;
      EliminatedNode& node = result.emplace_back();
      node.multiplier = multiplier;
      node.pair = p;
      node.node = s;
      node.by_law = true;
      node.inverse = SpatialMatrix::Identity(model().dimension, model().dimension);
    }
  return result;
}

RCP<Vector> detail::Condensation::condense_right_hand_side(const Vector* C, Vector& rhs) const {
  const SpatialVector none = SpatialVector::Zero(model().dimension);
  const std::vector<EliminatedNode> open = C == nullptr ? std::vector<EliminatedNode>{} : open_nodes(*C);
  const auto b = rcp(new Vector(model().multipliers));
  const auto b_of_nodes = b->getLocalViewHost(Tpetra::Access::ReadWrite);
  const auto condense = [&](const EliminatedNode& node) {
    const SpatialVector& z = C == nullptr ? at().multipliers[node.pair][node.node].z : none;
    const SpatialVector C_j =
        C == nullptr ? at().laws[node.pair][node.node].C : model().z_of(C->getLocalViewHost(Tpetra::Access::ReadOnly), node.pair, node.node);
    const SpatialVector b_j = condense_right_hand_side(node, z, C_j, rhs);
    for (int i = 0; i < model().dimension; ++i) b_of_nodes(node.multiplier + i, 0) = b_j[i];
  };
  for (const bool middles : {true, false}) {
    if (middles && !model().middles_first) continue;
    for (const auto* some : {&nodes, &open})
      for (const EliminatedNode& node : *some)
        if (pair(node.pair).pair().before_corners(node.node) == middles) condense(node);
    scatter->finish(rhs);
  }
  return b;
}

NodeElimination ContactLinearisation::condense(Matrix& system, Vector& rhs) const {
  const detail::EvaluatedLaws& laws = detail::evaluated(laws_);
  const detail::ContactModel& model = *laws.contact->model;
  if (model.keeps_multipliers())
    throw std::logic_error("contact: condense() where a formulation keeps its multipliers as unknowns: solve with saddle_point_blocks()");
  const auto condensation = std::make_shared<detail::Condensation>(detail::Condensation{laws_, scatter_into(*laws.contact, system), {}, {}});
  detail::Arguments(model, "condense").on_dofs(rhs, "rhs").agree();
  const auto scope = model.timers.scope("condensation");
  detail::refuse_condensed(model, system);
  for (const bool middles : {true, false}) {
    if (middles && !model.middles_first) continue;
    for (std::size_t p = 0; p < model.pairs.size(); ++p) {
      const PairEvaluation& pair = laws.contact->pairs[p];
      for (std::size_t s = 0; s < pair.slave_nodes().size(); ++s) {
        if (pair.pair().before_corners(s) != middles) continue;
        if (pair.is_eliminated_by_law(s))
          condensation->eliminate_by_law(p, s, system);
        else
          condensation->condense_node(p, s, system);
      }
    }
    condensation->scatter->finish(system);
  }
  const auto replaces_rows = [&](const EliminatedNode& node) { return !node.by_law && condensation->free_row(node) >= 0; };
  const auto replaced = std::find_if(condensation->nodes.begin(), condensation->nodes.end(), replaces_rows);
  detail::keep_condensed_row(model, system, replaced == condensation->nodes.end() ? -1 : condensation->free_row(*replaced));
  const RCP<const Vector> b = condensation->condense_right_hand_side(nullptr, rhs);
  condensation->left_out = detail::tied_conditions(laws);
  return NodeElimination(condensation, b, laws.z);
}

ContactLinearisation DifferentiatedContact::linearise(const ContactLaws& laws) const {
  if (detail::evaluated(laws).contact != evaluated_)
    throw std::logic_error("contact: linearise() with laws of another evaluation: take laws(z) of this one");
  // A law of friction without bound leaves conditions that are no numbers.
  const auto& pairs = evaluated_->model->pairs;
  if (std::none_of(pairs.begin(), pairs.end(), [](const auto& pair) { return pair->friction() != nullptr; })) return ContactLinearisation(laws);
  const auto& all = detail::evaluated(laws).laws;
  const bool finite = std::all_of(all.begin(), all.end(), [](const auto& of_pair) {
    return std::all_of(of_pair.begin(), of_pair.end(), [](const Complementarity& law) { return law.C.allFinite(); });
  });
  throw_if_any(evaluated_->model->comm(), finite ? std::nullopt : laws.friction_failure());
  return ContactLinearisation(laws);
}

}  // namespace mortise
