// Conduction of heat in two bodies, and by a contribution of the host, from public headers alone, across contact through D and M of the pair.

#include <gtest/gtest.h>

#include <TpetraExt_MatrixMatrix.hpp>
#include <Tpetra_Core.hpp>
#include <Tpetra_CrsGraph.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <functional>
#include <map>

#include "mortise/core/column_map.hpp"
#include "mortise/core/trilinos_versions.hpp"
#include "mortise/mesh/build_mesh.hpp"
#include "mortise/mesh/field_space.hpp"
#include "mortise/mesh/generators.hpp"
#include "mortise/nonlinear/linear_solver_factory.hpp"
#include "mortise/nonlinear/newton_solver.hpp"
#include "mortise/nonlinear/semi_smooth_system.hpp"
#include "mortise/thermal/heat_contributions.hpp"

namespace mortise {
namespace {

constexpr double lower_height = 2.0, upper_height = 1.5;

RCP<Mesh> two_blocks(CellShape shape) {
  const auto block = [](double width, double height, int nx, int ny, std::vector<double> place) {
    auto result = std::make_shared<BlockMesh>();
    result->width = width;
    result->height = height;
    result->cells_x = nx;
    result->cells_y = ny;
    result->translation = std::move(place);
    return result;
  };
  return build_mesh(
      Tpetra::getDefaultComm(),
      {{"upper", {}, block(3.0, upper_height, 5, 3, {0.0, lower_height}), shape}, {"lower", {}, block(3.0, lower_height, 7, 4, {0.0, 0.0}), shape}},
      {"upper/bottom", "lower/top"});
}

SurfaceFacets facets(const Mesh& mesh, const std::string& side_set, bool of_ghosts) {
  SurfaceFacets result;
  const SideSet& set = mesh.side_sets.at(side_set);
  const std::size_t count = of_ghosts ? set.sides.size() : static_cast<std::size_t>(set.owned);
  for (std::size_t n = 0; n < count; ++n) {
    const std::vector<LocalOrdinal> nodes = mesh.side_nodes(set.sides[n]);
    const bool mine = std::any_of(nodes.begin(), nodes.end(), [&](LocalOrdinal node) { return node < mesh.owned_count(); });
    if (of_ghosts && !mine) continue;
    // Sides run with their normal on the right, facets with the body on the left.
    SurfaceFacet facet;
    for (const LocalOrdinal node : nodes) facet.push_back(mesh.local_nodes->getGlobalElement(node));
    result.push_back(facet);
  }
  return result;
}

/// D and M of the pair of two blocks as they are.
MortarMatrices mortar_matrices(const Mesh& mesh) {
  const auto reference = rcp(new MultiVector(mesh.owned_nodes, 2)), free = rcp(new MultiVector(mesh.owned_nodes, 2));
  for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node)
    for (int i = 0; i < 2; ++i) reference->replaceLocalValue(node, i, mesh.coordinates[node][i]);
  ContactPair pair;
  pair.name = "joint";
  pair.youngs_modulus = 1.0;
  pair.slave = facets(mesh, "upper/bottom", true);
  pair.master = facets(mesh, "lower/top", false);
  const NodalField displacement = numbered_by_nodes("displacement", mesh.owned_nodes, 2);
  const RCP<const Map> dofs = make_field_table(mesh.owned_nodes, {{"displacement", 2}}).dofs;
  const ContactSystem contact(displacement, dofs, reference, free, {}, {pair}, Timers());
  const Vector rest(dofs);
  return contact.evaluate(rest, contact.initial_history(rest)).mortar_matrices(0);
}

/// q_j = h [theta]_j,  [theta]_j = ((D - M) theta)_j / D_jj: flux out of the slave per area, r += (D - M)^T q.
class Conductance : public Contribution {
 public:
  Conductance(const MortarMatrices& mortar, double h) {
    const RCP<const Matrix> jump =
        Tpetra::MatrixMatrix::add(1.0, false, *mortar.D, -1.0, false, *mortar.M, mortar.D->getDomainMap(), mortar.D->getRangeMap());
    Vector diagonal(mortar.D->getRowMap()), share(mortar.D->getRowMap());
    mortar.D->getLocalDiagCopy(diagonal);
    share.reciprocal(diagonal);
    share.scale(h);
    Matrix flux(*jump, Teuchos::Copy);
    flux.leftScale(share);
    operator_ = rcp(new Matrix(mortar.D->getDomainMap(), 0));
    Tpetra::MatrixMatrix::Multiply(*jump, true, flux, false, *operator_);
  }
  /// Gets an entry of an owned row.
  using Entry = std::function<void(GlobalOrdinal row, GlobalOrdinal column, double value)>;
  std::string name() const override { return "contact conductance"; }
  Kind kind() const override { return Kind::internal; }
  FieldUse uses() const override { return {{"temperature"}, {"temperature"}, 0}; }
  void add_residual(const Configuration& at, Vector& residual, std::optional<StepFailure>&) override {
    const auto theta = at.local_unknowns.getLocalViewHost(Tpetra::Access::ReadOnly);
    visit([&](GlobalOrdinal row, GlobalOrdinal column, double value) {
      residual.sumIntoGlobalValue(row, value * theta(at.local_unknowns.getMap()->getLocalElement(column), 0));
    });
  }
  void add_jacobian(const Configuration&, const JacobianWeights& weights, Matrix& jacobian, std::optional<StepFailure>&) override {
    visit([&](GlobalOrdinal row, GlobalOrdinal column, double value) {
      const double weighted = weights.unknowns * value;
      jacobian.sumIntoGlobalValues(row, 1, &weighted, &column);
    });
  }
  void visit(const Entry& visit) const {
    for (LocalOrdinal row = 0; row < static_cast<LocalOrdinal>(local_row_count(*operator_)); ++row) {
      Matrix::local_inds_host_view_type columns;
      Matrix::values_host_view_type values;
      operator_->getLocalRowView(row, columns, values);
      for (std::size_t k = 0; k < columns.extent(0); ++k)
        visit(operator_->getRowMap()->getGlobalElement(row), operator_->getColMap()->getGlobalElement(columns(k)), values(k));
    }
  }

 private:
  RCP<Matrix> operator_;
};

ThermalBody conductor(double conductivity) {
  const auto properties = std::make_shared<ThermalProperties>();
  properties->conductivity = conductivity;
  return {{}, properties};
}

/// The temperatures of the lower edge of the lower body and of the upper edge of the upper one.
std::shared_ptr<const AffineConstraints> edge_temperatures(const FieldSpace& space, double below, double above) {
  std::vector<AffineConstraints::Line> lines;
  for (LocalOrdinal node = 0; node < space.mesh()->owned_count(); ++node) {
    const double y = space.mesh()->coordinates[node][1];
    if (y < 1e-12) lines.push_back({space.row(node, 0), {}, {{0, below}}});
    if (y > lower_height + upper_height - 1e-12) lines.push_back({space.row(node, 0), {}, {{0, above}}});
  }
  return std::make_shared<const AffineConstraints>(space.dofs(), std::move(lines),
                                                   [](double, std::optional<StepFailure>&) { return std::vector<double>{1.0}; });
}

// One-dimensional conduction through two layers and the resistance 1/h between them is linear in each body, so the elements have it exactly. Nodes of
// the two surfaces do not match.
TEST(SecondField, ConductsThroughTwoBodiesAndTheirContact) {
  const double k_lower = 2.0, k_upper = 5.0, h = 0.7, below = 10.0, above = 30.0;
  for (const CellShape shape : {CellShape::quadrilateral4, CellShape::triangle3}) {
    const RCP<const Mesh> mesh = two_blocks(shape);
    const auto space = std::make_shared<FieldSpace>(mesh, std::vector<FieldDeclaration>{{"temperature", 1}});
    const auto conduction = std::make_shared<HeatConduction>(
        std::make_shared<ThermalBodies>(space, Kinematics::plane_strain, 1.0, std::vector<ThermalBody>{conductor(k_upper), conductor(k_lower)}));
    const auto conductance = std::make_shared<Conductance>(mortar_matrices(*mesh), h);

    // The bulk's graph, with what couples across contact behind it.
    std::map<GlobalOrdinal, std::vector<GlobalOrdinal>> entries;
    std::vector<GlobalOrdinal> further;
    conductance->visit([&](GlobalOrdinal row, GlobalOrdinal column, double) {
      entries[row].push_back(column);
      further.push_back(column);
    });
    const RCP<const Graph> bulk = space->graph();
    const RCP<const Map> columns = with_further_columns(*bulk->getColMap(), further);
    const auto graph = rcp(new Graph(space->dofs(), columns, 40));
    const auto narrow = bulk->getLocalGraphHost();
    for (LocalOrdinal row = 0; row < static_cast<LocalOrdinal>(local_row_count(*bulk)); ++row)
      for (std::size_t k = narrow.row_map(row); k < narrow.row_map(row + 1); ++k) graph->insertLocalIndices(row, 1, &narrow.entries(k));
    for (const auto& [row, ids] : entries)
      for (const GlobalOrdinal id : ids) {
        const LocalOrdinal column = columns->getLocalElement(id);
        graph->insertLocalIndices(space->dofs()->getLocalElement(row), 1, &column);
      }
    graph->fillComplete(space->dofs(), space->dofs());

    SystemParts parts;
    parts.dofs = space->dofs();
    parts.local_dofs = columns;
    parts.bulk_graph = [graph] { return graph; };
    parts.contributions = {conduction, conductance};
    parts.constraints = edge_temperatures(*space, below, above);
    parts.linear_solver = make_linear_solver({}, mesh->comm, Timers());
    parts.length = above;
    parts.fields = {{space->field(0), above}};
    const SemiSmoothSystem system(std::move(parts), Timers());

    NewtonReport report;
    const AcceptedState rest = system.initial_state(Vector(system.map()));
    const SystemEvaluation solution = solve_newton(system, system.evaluate(*rest.x, rest.context), {}, report, {});
    EXPECT_LE(report.newton_steps(), 2);
    const double flux = (above - below) / (lower_height / k_lower + 1.0 / h + upper_height / k_upper);
    const auto theta = solution.x().getData();
    double in = 0.0, all = 0.0;
    const auto forces = solution.forces()->getData();
    for (LocalOrdinal node = 0; node < mesh->owned_count(); ++node) {
      const double y = mesh->coordinates[node][1];
      const double exact = mesh->body_of_node[node] == 1 ? below + flux * y / k_lower : above - flux * (lower_height + upper_height - y) / k_upper;
      EXPECT_NEAR(theta[node], exact, 1e-11 * above);
      in += forces[node];
    }
    Teuchos::reduceAll(*mesh->comm, Teuchos::REDUCE_SUM, in, Teuchos::outArg(all));
    EXPECT_NEAR(all, 0.0, 1e-11 * flux * 3.0);  // what flows in flows out
  }
}

}  // namespace
}  // namespace mortise
