#pragma once
// Two bodies of a host that has displacements and temperatures, one on the other, with elements that are linear in each direction.

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "../contact/two_surfaces.hpp"
#include "mortise/thermal_contact/thermal_contact.hpp"

namespace mortise::test {

/// A body: a grid of cells, its nodes where `place` puts those of the unit square or cube. The last direction goes from one body to the other.
struct GridBody {
  std::array<int, 3> cells{1, 1, 1};
  std::function<Point(const Point& of_unit)> place;
  double conductivity = 1.0;
  double capacity = 0.0;   ///< rho c
  double modulus = 0.0;    ///< E; Poisson's ratio 0
  double expansion = 0.0;  ///< alpha
};

/// Body 0 below and body 1 above. Node n belongs to rank n mod size. Displacements come first, then temperatures.
class TwoBodies {
 public:
  /// @param slave  which body's face is the slave
  TwoBodies(int dimension, std::array<GridBody, 2> bodies, int slave, const ContactOptions& options, double youngs_modulus,
            const std::function<bool(int body, const Point& of_unit)>& held = {})
      : dimension(dimension), slave(slave), bodies(std::move(bodies)), comm(Tpetra::getDefaultComm()) {
    for (int body = 0; body < 2; ++body) {
      first[body] = static_cast<GlobalOrdinal>(units.size());
      for_each_place(node_counts(body), [&](const std::array<int, 3>& at) {
        Point unit{};
        for (int i = 0; i < dimension; ++i) unit[i] = static_cast<double>(at[i]) / this->bodies[body].cells[i];
        units.push_back(unit);
        points.push_back(this->bodies[body].place(unit));
        body_of.push_back(body);
      });
    }
    std::vector<GlobalOrdinal> mine;
    for (std::size_t n = 0; n < points.size(); ++n)
      if (is_mine(static_cast<GlobalOrdinal>(n))) mine.push_back(static_cast<GlobalOrdinal>(n));
    nodes = rcp(new Map(points.size(), mine.data(), static_cast<LocalOrdinal>(mine.size()), 0, comm));
    table = std::make_unique<FieldTable>(make_field_table(nodes, {{"displacement", dimension}, {"temperature", 1}}));
    const auto reference = rcp(new MultiVector(nodes, dimension)), fixed = rcp(new MultiVector(nodes, dimension));
    for (const GlobalOrdinal id : mine)
      for (int i = 0; i < dimension; ++i) {
        reference->replaceGlobalValue(id, i, points[id][i]);
        fixed->replaceGlobalValue(id, i, held && held(body_of[id], units[id]) ? 1.0 : 0.0);
      }
    pair.name = "joint";
    pair.youngs_modulus = youngs_modulus;
    pair.options = options;
    pair.slave = face(slave, true);
    pair.master = face(1 - slave, false);
    contact = std::make_unique<ContactSystem>(table->fields[0], table->dofs, reference, fixed, InterfaceMeasure{}, std::vector<ContactPair>{pair},
                                              Timers(), std::vector<NodalField>{table->fields[1]});
  }

  GlobalOrdinal displacement(GlobalOrdinal node, int i) const { return dimension * node + i; }
  GlobalOrdinal temperature(GlobalOrdinal node) const { return static_cast<GlobalOrdinal>(dimension * points.size()) + node; }
  bool is_mine(GlobalOrdinal node) const { return node % comm->getSize() == comm->getRank(); }
  /// True for a node of the face of a body that may touch the other one.
  bool is_on_face(GlobalOrdinal node) const { return units[node][dimension - 1] == (body_of[node] == 0 ? 1.0 : 0.0); }
  bool is_far(GlobalOrdinal node) const { return units[node][dimension - 1] == (body_of[node] == 0 ? 0.0 : 1.0); }
  std::size_t size() const { return (dimension + 1) * points.size(); }
  std::vector<GlobalOrdinal> all_ids() const { return Fixture::all_ids(*table->dofs); }

  /// Entries of owned rows: what is conducted, what is stored over `time_step`, stresses sigma = E (sym grad u - alpha theta I). All are linear.
  void visit(double time_step, const std::function<void(GlobalOrdinal row, GlobalOrdinal column, double value)>& take) const {
    for (int body = 0; body < 2; ++body)
      for_each_place(bodies[body].cells, [&](const std::array<int, 3>& cell) {
        const std::vector<GlobalOrdinal> corners = corners_of(body, cell, dimension);
        if (std::any_of(corners.begin(), corners.end(), [&](GlobalOrdinal node) { return is_mine(node); }))
          visit_element(bodies[body], corners, time_step, take);
      });
  }
  RCP<const Graph> graph() const {
    const auto graph = rcp(new Graph(table->dofs, (dimension + 1) * (dimension == 2 ? 9 : 27)));
    visit(1.0, [&](GlobalOrdinal row, GlobalOrdinal column, double) { graph->insertGlobalIndices(row, 1, &column); });
    graph->fillComplete(table->dofs, table->dofs);
    return graph;
  }
  void assemble(double time_step, Matrix& matrix) const {
    visit(time_step, [&](GlobalOrdinal row, GlobalOrdinal column, double value) { matrix.sumIntoGlobalValues(row, 1, &value, &column); });
  }

  const int dimension, slave;
  const std::array<GridBody, 2> bodies;
  RCP<const Communicator> comm;
  std::array<GlobalOrdinal, 2> first{};
  std::vector<Point> units, points;
  std::vector<int> body_of;
  RCP<const Map> nodes;
  std::unique_ptr<FieldTable> table;
  ContactPair pair;
  std::unique_ptr<ContactSystem> contact;

 private:
  template <class Take>
  void for_each_place(const std::array<int, 3>& counts, const Take& take) const {
    for (int k = 0; k < (dimension == 3 ? counts[2] : 1); ++k)
      for (int j = 0; j < counts[1]; ++j)
        for (int i = 0; i < counts[0]; ++i) take(std::array<int, 3>{i, j, k});
  }
  std::array<int, 3> node_counts(int body) const { return {bodies[body].cells[0] + 1, bodies[body].cells[1] + 1, bodies[body].cells[2] + 1}; }
  std::vector<GlobalOrdinal> corners_of(int body, const std::array<int, 3>& cell, int directions) const {
    const std::array<int, 3> counts = node_counts(body);
    std::vector<GlobalOrdinal> result;
    for (int corner = 0; corner < 1 << directions; ++corner) {
      const int i = cell[0] + (corner & 1), j = cell[1] + (corner >> 1 & 1), k = cell[2] + (corner >> 2 & 1);
      result.push_back(first[body] + i + counts[0] * (j + (dimension == 3 ? counts[1] * k : 0)));
    }
    return result;
  }
  /// As MortarInterface wants them: bodies on the left of the way, nodes round the outward normal.
  SurfaceFacets face(int body, bool is_slave) const {
    SurfaceFacets facets;
    std::array<int, 3> cells = bodies[body].cells;
    const int up = dimension - 1, level = body == 0 ? cells[up] : 0;
    cells[up] = 1;
    for_each_place(cells, [&](std::array<int, 3> at) {
      at[up] = level;
      std::vector<GlobalOrdinal> around = corners_of(body, at, dimension - 1);
      if (dimension == 3) std::swap(around[2], around[3]);
      if ((dimension == 3) == (body == 1)) std::reverse(around.begin(), around.end());
      const SurfaceFacet facet(around.begin(), around.end());
      const bool any = std::any_of(facet.begin(), facet.end(), [&](GlobalOrdinal node) { return is_mine(node); });
      if (is_slave ? any : is_mine(facet[0])) facets.push_back(facet);
    });
    return facets;
  }
  template <class Take>
  void visit_element(const GridBody& body, const std::vector<GlobalOrdinal>& corners, double time_step, const Take& take) const {
    const auto count = static_cast<Eigen::Index>(corners.size());
    const double at = 1.0 / std::sqrt(3.0);
    Eigen::MatrixXd x(dimension, count);
    for (Eigen::Index a = 0; a < count; ++a)
      for (int i = 0; i < dimension; ++i) x(i, a) = points[corners[a]][i];
    for (int q = 0; q < count; ++q) {
      Eigen::VectorXd N = Eigen::VectorXd::Ones(count);
      Eigen::MatrixXd slopes = Eigen::MatrixXd::Ones(dimension, count);
      for (Eigen::Index a = 0; a < count; ++a)
        for (int i = 0; i < dimension; ++i) {
          const double sign = (a >> i & 1) != 0 ? 1.0 : -1.0, value = 0.5 * (1.0 + sign * ((q >> i & 1) != 0 ? at : -at));
          N[a] *= value;
          for (int k = 0; k < dimension; ++k) slopes(k, a) *= k == i ? 0.5 * sign : value;
        }
      const Eigen::MatrixXd jacobian = x * slopes.transpose();
      const Eigen::MatrixXd gradients = jacobian.transpose().inverse() * slopes;
      const double weight = std::abs(jacobian.determinant());
      for (Eigen::Index a = 0; a < count; ++a) {
        if (!is_mine(corners[a])) continue;
        for (Eigen::Index b = 0; b < count; ++b) {
          const double product = weight * gradients.col(a).dot(gradients.col(b));
          take(temperature(corners[a]), temperature(corners[b]), body.conductivity * product + weight * body.capacity / time_step * N[a] * N[b]);
          for (int i = 0; i < dimension; ++i) {
            take(displacement(corners[a], i), temperature(corners[b]), -weight * body.modulus * body.expansion * gradients(i, a) * N[b]);
            for (int j = 0; j < dimension; ++j)
              take(displacement(corners[a], i), displacement(corners[b], j),
                   0.5 * body.modulus * ((i == j ? product : 0.0) + weight * gradients(j, a) * gradients(i, b)));
          }
        }
      }
    }
  }
};

/// The temperatures of two bodies at rest, with tractions that are given, by a dense solver. Linear laws.
struct SteadyHeat {
  std::vector<double> temperatures;  ///< [nodes] on every rank
  std::vector<NodeHeat> nodes;       ///< of this rank
  HeatFlow flow;
};

/// @param prescribed  [nodes] temperatures; NaN: free
/// @param load        [nodes] heat that flows in from outside
/// @param traction    z of all nodes: presses the slave
inline SteadyHeat solve_steady_heat(const TwoBodies& bodies, const ThermalPair& pair, const std::vector<double>& prescribed,
                                    const std::vector<double>& load, const Point& traction) {
  const ContactSystem& contact = *bodies.contact;
  const ThermalContact thermal(contact, bodies.table->fields[1], bodies.table->dofs, {pair});
  Vector x(bodies.table->dofs), z(contact.multiplier_map());
  const ContactHistory history = contact.initial_history(x);
  {
    const auto view = z.getLocalViewHost(Tpetra::Access::ReadWrite);
    for (std::size_t row = 0; row < view.extent(0); ++row) view(row, 0) = traction[row % static_cast<std::size_t>(bodies.dimension)];
  }
  const DifferentiatedContact at = contact.differentiate(x, history);
  const ContactLinearisation linearised = at.linearise(at.laws(z));
  const DifferentiatedHeat heat = thermal.differentiate(linearised, x, 1.0);
  Matrix A(contact.graph(at, [&] { return bodies.graph(); }));
  bodies.assemble(1.0, A);
  A.fillComplete(bodies.table->dofs, bodies.table->dofs);
  std::vector<GlobalOrdinal> ids;
  for (std::size_t n = 0; n < bodies.points.size(); ++n) ids.push_back(bodies.temperature(static_cast<GlobalOrdinal>(n)));
  const std::vector<GlobalOrdinal> all = bodies.all_ids();
  const Eigen::MatrixXd rows = Fixture::dense(A, ids, all) + Fixture::dense(*heat.of_dofs(), ids, all);
  Eigen::MatrixXd K(rows.rows(), rows.rows());
  for (std::size_t n = 0; n < ids.size(); ++n)
    K.col(static_cast<Eigen::Index>(n)) = rows.col(std::lower_bound(all.begin(), all.end(), ids[n]) - all.begin());
  Eigen::VectorXd b = Eigen::Map<const Eigen::VectorXd>(load.data(), static_cast<Eigen::Index>(load.size()));
  for (std::size_t n = 0; n < ids.size(); ++n) {
    if (std::isnan(prescribed[n])) continue;
    const auto row = static_cast<Eigen::Index>(n);
    K.row(row).setZero();
    K(row, row) = 1.0;
    b[row] = prescribed[n];
  }
  const Eigen::VectorXd theta = K.partialPivLu().solve(b);
  for (const GlobalOrdinal node : local_ids(*bodies.nodes)) x.replaceGlobalValue(bodies.temperature(node), theta[node]);
  const ContactHeat solved = thermal.evaluate(contact.evaluate(x, history).laws(z), x, 1.0);
  return {{theta.data(), theta.data() + theta.size()}, solved.nodes(0), solved.flow(0)};
}

}  // namespace mortise::test
