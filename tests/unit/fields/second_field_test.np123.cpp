// A second field from public headers alone: a temperature that conducts in two bodies, and across contact through D and M of the pair. Then two
// fields in one system: displacements of two bodies in contact, and a temperature that lives in one of them and makes it swell.

#include <gtest/gtest.h>

#include <TpetraExt_MatrixMatrix.hpp>
#include <Tpetra_Core.hpp>
#include <Tpetra_CrsGraph.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <set>

#include "../nonlinear/spring_grid.hpp"
#include "mortise/core/column_map.hpp"
#include "mortise/mesh/build_mesh.hpp"
#include "mortise/mesh/field_space.hpp"
#include "mortise/mesh/generators.hpp"
#include "mortise/nonlinear/newton_solver.hpp"
#include "mortise/shape/cell.hpp"
#include "mortise/solid/element_loop.hpp"

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

/// r_a = integral of k grad N_a . grad theta. An integrand, see ElementLoop.
template <class OfCells>
struct FourierConduction {
  using Geometry = OfCells;
  static constexpr int nodes = Geometry::nodes, dimension = Geometry::dimension, components = 1, point_count = Geometry::stiffness_points;
  using Reads = std::tuple<FieldGradient<1, dimension>>;
  using Residual = std::array<double, nodes>;
  using Tangent = NodalPairs<nodes>;

  double conductivity;  ///< k

  template <class Points, class Sums>
  void add(const Points& points, Sums& sums) const {
    for (int q = 0; q < point_count; ++q) {
      const auto at = points[q];
      const auto& gradient = std::get<0>(at.fields).gradient[0];
      for (int a = 0; a < nodes; ++a)
        for (int i = 0; i < dimension; ++i) {
          const double flux = conductivity * at.weight * at.gradient[a][i];
          if constexpr (Sums::with_residual) sums.residual[a] += flux * gradient[i];
          if constexpr (Sums::with_tangent)
            for (int b = 0; b < nodes; ++b) sums.tangent(a, b) += flux * at.gradient[b][i];
        }
    }
  }
};

/// Conduction in all blocks of a mesh.
class Conduction : public Contribution {
 public:
  /// @param conductivity  [blocks]
  Conduction(std::shared_ptr<const FieldSpace> space, const std::vector<double>& conductivity) : space_(std::move(space)) {
    for (std::size_t n = 0; n < conductivity.size(); ++n) {
      const Block& block = space_->mesh()->blocks[n];
      visit_cell(block.shape, [&](auto cell) {
        using Cell = decltype(cell);
        if constexpr (Cell::dimension == 2) blocks_.push_back(make_block<Cell>(block, conductivity[n]));
      });
    }
  }
  std::string name() const override { return "conduction"; }
  Kind kind() const override { return Kind::internal; }
  FieldUse uses() const override { return {{"temperature"}, {"temperature"}, 0}; }
  void add_residual(const Configuration& at, Vector& residual, std::optional<StepFailure>&) override { add(at, {of(residual)}); }
  void add_jacobian(const Configuration& at, const JacobianWeights& weights, Matrix& jacobian, std::optional<StepFailure>&) override {
    const NodalSparsity::Values values = space_->sparsity().open(jacobian);
    add(at, {{}, &values, weights.unknowns});
    values.close();
  }

 private:
  using AddBlock = std::function<void(const FieldView<const double>& theta, const AssemblyTarget& target)>;

  template <class Cell>
  AddBlock make_block(const Block& block, double conductivity) const {
    using Element = FourierConduction<ElementGeometry<Cell>>;
    return [loop = ElementLoop<Cell>(*space_, block), integral = BlockIntegral<Element>(Element{conductivity}, block, 1.0)](
               const FieldView<const double>& theta, const AssemblyTarget& target) {
      if (target.matrix != nullptr)
        loop.template add<true, true>(integral, typename ElementLoop<Cell>::template Fields<1>{theta}, target);
      else
        loop.template add<true, false>(integral, typename ElementLoop<Cell>::template Fields<1>{theta}, target);
    };
  }

  FieldView<double> of(Vector& vector) const { return {vector.getLocalViewHost(Tpetra::Access::ReadWrite).data(), space_->rows(0)}; }
  void add(const Configuration& at, const AssemblyTarget& target) const {
    const auto theta = at.local_unknowns.getLocalViewHost(Tpetra::Access::ReadOnly);
    for (const AddBlock& block : blocks_) block({theta.data(), space_->rows(0)}, target);
  }

  std::shared_ptr<const FieldSpace> space_;
  std::vector<AddBlock> blocks_;
};

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
    for (LocalOrdinal row = 0; row < static_cast<LocalOrdinal>(operator_->getNodeNumRows()); ++row) {
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
    const auto conduction = std::make_shared<Conduction>(space, std::vector<double>{k_upper, k_lower});
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
    for (LocalOrdinal row = 0; row < static_cast<LocalOrdinal>(bulk->getNodeNumRows()); ++row)
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

/// Between neighbours of the upper body of a grid: k (theta_a - theta_b).
class GridConduction : public Contribution {
 public:
  GridConduction(std::shared_ptr<const test::SpringGrid> grid, const NodalField& field, double k)
      : grid_(std::move(grid)), id_([first = first_of(field, *grid_)](int node) { return first + node; }), k_(k) {}
  std::string name() const override { return "grid conduction"; }
  Kind kind() const override { return Kind::internal; }
  FieldUse uses() const override { return {{"temperature"}, {"temperature"}, 0}; }
  void add_residual(const Configuration& at, Vector& residual, std::optional<StepFailure>&) override {
    const auto x = at.local_unknowns.getLocalViewHost(Tpetra::Access::ReadOnly);
    const auto value = [&](int node) { return x(at.local_unknowns.getMap()->getLocalElement(id_(node)), 0); };
    visit([&](int a, int b) { residual.sumIntoGlobalValue(id_(a), k_ * (value(a) - value(b))); });
  }
  void add_jacobian(const Configuration&, const JacobianWeights& weights, Matrix& jacobian, std::optional<StepFailure>&) override {
    visit([&](int a, int b) {
      const double plus = weights.unknowns * k_, minus = -plus;
      const GlobalOrdinal own = id_(a), other = id_(b);
      jacobian.sumIntoGlobalValues(own, 1, &plus, &own);
      jacobian.sumIntoGlobalValues(own, 1, &minus, &other);
    });
  }
  GlobalOrdinal id(int node) const { return id_(node); }

 private:
  static GlobalOrdinal first_of(const NodalField& field, const test::SpringGrid& grid) {
    GlobalOrdinal mine = 0, first = 0;
    for (std::size_t n = 0; n < grid.owned_nodes().size(); ++n)
      if (const GlobalOrdinal id = field.id(static_cast<LocalOrdinal>(n), 0); id != NodalField::none) mine = id - grid.owned_nodes()[n];
    Teuchos::reduceAll(*grid.dofs->getComm(), Teuchos::REDUCE_MAX, mine, Teuchos::outArg(first));
    return first;
  }
  template <class Visit>
  void visit(const Visit& visit) const {
    for (const int a : grid_->owned_nodes())
      if (a / grid_->nx() >= grid_->cut())
        for (const int b : grid_->neighbours(a)) visit(a, b);
  }
  std::shared_ptr<const test::SpringGrid> grid_;
  std::function<GlobalOrdinal(int)> id_;
  double k_;
};

/// Each spring of the upper body presses on its ends with k alpha (theta_a + theta_b) / 2 along its undeformed direction.
class Swelling : public Contribution {
 public:
  Swelling(std::shared_ptr<const test::SpringGrid> grid, std::function<GlobalOrdinal(int)> id, double pressure)
      : grid_(std::move(grid)), id_(std::move(id)), pressure_(pressure) {}
  std::string name() const override { return "swelling"; }
  Kind kind() const override { return Kind::internal; }
  FieldUse uses() const override { return {{"temperature"}, {"displacement"}, 0}; }
  void add_residual(const Configuration& at, Vector& residual, std::optional<StepFailure>&) override {
    const auto x = at.local_unknowns.getLocalViewHost(Tpetra::Access::ReadOnly);
    const auto value = [&](int node) { return x(at.local_unknowns.getMap()->getLocalElement(id_(node)), 0); };
    visit([&](int a, int b, int i, double D) { residual.sumIntoGlobalValue(grid_->dof(a, i), 0.5 * pressure_ * D * (value(a) + value(b))); });
  }
  void add_jacobian(const Configuration&, const JacobianWeights& weights, Matrix& jacobian, std::optional<StepFailure>&) override {
    visit([&](int a, int b, int i, double D) {
      const double slope = weights.unknowns * 0.5 * pressure_ * D;
      for (const GlobalOrdinal column : {id_(a), id_(b)}) jacobian.sumIntoGlobalValues(grid_->dof(a, i), 1, &slope, &column);
    });
  }

 private:
  template <class Visit>
  void visit(const Visit& visit) const {
    for (const int a : grid_->owned_nodes())
      if (a / grid_->nx() >= grid_->cut())
        for (const int b : grid_->neighbours(a)) {
          const auto A = grid_->position(a), B = grid_->position(b);
          for (int i = 0; i < 2; ++i) visit(a, b, i, B[i] - A[i]);
        }
  }
  std::shared_ptr<const test::SpringGrid> grid_;
  std::function<GlobalOrdinal(int)> id_;
  double pressure_;
};

/// The edges of the grid, and theta on the upper body's upper and lower edge.
std::shared_ptr<const AffineConstraints> heated_edges(const test::SpringGrid& grid, const RCP<const Map>& dofs,
                                                      const std::function<GlobalOrdinal(int)>& id, std::array<double, 2> motion, double hot) {
  std::vector<AffineConstraints::Line> lines = test::edge_lines(grid, *dofs, motion);
  for (const int node : grid.owned_nodes()) {
    const int row = node / grid.nx();
    if (row != grid.cut() && row != grid.ny() - 1) continue;
    lines.push_back({dofs->getLocalElement(id(node)), {}, {{1, row == grid.cut() ? 0.2 * hot : hot}}});
  }
  return std::make_shared<const AffineConstraints>(dofs, std::move(lines), [](double time, std::optional<StepFailure>&) {
    return std::vector<double>{test::steadily(time), time};
  });
}

/// Springs in contact whose upper body is hot. Temperatures have values of `hot`, in whatever unit.
struct HotGrid {
  std::unique_ptr<SemiSmoothSystem> system;
  std::function<GlobalOrdinal(int)> temperature;
  std::shared_ptr<test::SpringGrid> grid;

  HotGrid(const RCP<const Communicator>& comm, double hot) {
    grid = std::make_shared<test::SpringGrid>(comm, 8, 8, test::Numbering::scattered, 4);
    std::vector<char> upper;
    for (const int node : grid->owned_nodes()) upper.push_back(node / grid->nx() >= grid->cut());
    const FieldTable table = make_field_table(grid->node_map, {{"displacement", 2}, {"temperature", 1, upper}});
    const auto conduction = std::make_shared<GridConduction>(grid, table.fields[1], 3.0 / hot);
    temperature = [conduction](int node) { return conduction->id(node); };
    const auto swelling = std::make_shared<Swelling>(grid, temperature, 0.05 / hot);

    const auto graph = rcp(new Graph(table.dofs, 40));
    std::set<GlobalOrdinal> ghosts;
    for (const int a : grid->owned_nodes()) {
      std::vector<GlobalOrdinal> columns;
      std::vector<int> nodes = grid->neighbours(a);
      nodes.push_back(a);
      const bool hot_node = a / grid->nx() >= grid->cut();
      for (const int b : nodes) {
        for (int i = 0; i < 2; ++i) columns.push_back(grid->dof(b, i));
        if (hot_node) columns.push_back(temperature(b));
      }
      for (int i = 0; i < 2; ++i) graph->insertGlobalIndices(grid->dof(a, i), static_cast<LocalOrdinal>(columns.size()), columns.data());
      if (hot_node) graph->insertGlobalIndices(temperature(a), static_cast<LocalOrdinal>(columns.size()), columns.data());
      for (const GlobalOrdinal column : columns)
        if (!table.dofs->isNodeGlobalElement(column)) ghosts.insert(column);
    }
    graph->fillComplete(table.dofs, table.dofs);
    std::vector<GlobalOrdinal> local(table.dofs->getNodeElementList().begin(), table.dofs->getNodeElementList().end());
    local.insert(local.end(), ghosts.begin(), ghosts.end());
    const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();

    SystemParts parts;
    parts.dofs = table.dofs;
    parts.local_dofs = rcp(new Map(invalid, local.data(), static_cast<LocalOrdinal>(local.size()), 0, comm));
    parts.bulk_graph = [graph] { return graph; };
    parts.contributions = {std::make_shared<GlobalSprings>(grid), conduction, swelling};
    parts.constraints = heated_edges(*grid, table.dofs, temperature, {0.1, -0.2}, hot);
    parts.linear_solver = make_linear_solver({}, comm, Timers());
    parts.length = grid->ny();
    parts.fields = {{table.fields[0], 8.0}, {table.fields[1], hot}};

    const auto reference = rcp(new MultiVector(grid->node_map, 2)), fixed = rcp(new MultiVector(grid->node_map, 2));
    for (std::size_t n = 0; n < grid->owned_nodes().size(); ++n)
      for (int i = 0; i < 2; ++i) {
        const int row = grid->owned_nodes()[n] / grid->nx();
        reference->replaceLocalValue(static_cast<LocalOrdinal>(n), i, grid->position(grid->owned_nodes()[n])[i]);
        fixed->replaceLocalValue(static_cast<LocalOrdinal>(n), i, row == 0 || row == grid->ny() - 1 ? 1.0 : 0.0);
      }
    ContactPair pair;
    pair.name = "pair";
    pair.youngs_modulus = 1.0;
    const auto mine = [&](int node) { return std::binary_search(grid->owned_nodes().begin(), grid->owned_nodes().end(), node); };
    for (int i = 0; i + 1 < grid->nx(); ++i) {
      const int slave = grid->cut() * grid->nx() + i, master = slave - grid->nx();
      if (mine(slave) || mine(slave + 1)) pair.slave.push_back({slave, slave + 1});
      if (mine(master)) pair.master.push_back({master + 1, master});
    }
    parts.contact =
        std::make_shared<ContactSystem>(table.fields[0], table.dofs, reference, fixed, InterfaceMeasure{}, std::vector<ContactPair>{pair}, Timers());
    system = std::make_unique<SemiSmoothSystem>(std::move(parts), Timers());
  }

  /// Springs that look for displacements by their ids: with a second field they do not stand where a grid alone has them.
  class GlobalSprings : public test::Springs {
   public:
    explicit GlobalSprings(std::shared_ptr<const test::SpringGrid> grid) : Springs(grid, 1.0), grid_(std::move(grid)) {}
    void add_residual(const Configuration& at, Vector& residual, std::optional<StepFailure>& failure) override {
      const Vector own = displacements(at);
      Springs::add_residual({at.time, at.unknowns, own}, residual, failure);
    }
    void add_jacobian(const Configuration& at, const JacobianWeights& weights, Matrix& jacobian, std::optional<StepFailure>& failure) override {
      const Vector own = displacements(at);
      Springs::add_jacobian({at.time, at.unknowns, own}, weights, jacobian, failure);
    }

   private:
    Vector displacements(const Configuration& at) const {
      Vector own(grid_->local_dofs);
      const auto view = at.local_unknowns.getLocalViewHost(Tpetra::Access::ReadOnly);
      for (const GlobalOrdinal id : grid_->local_dofs->getNodeElementList())
        own.replaceGlobalValue(id, view(at.local_unknowns.getMap()->getLocalElement(id), 0));
      return own;
    }
    std::shared_ptr<const test::SpringGrid> grid_;
  };
};

// Whatever the unit of temperature is, Newton's method goes the same way, quadratically; and the Jacobian is that of differences.
TEST(SecondField, StandsBesideDisplacementsInContact) {
  std::vector<std::vector<double>> paths;
  for (const double hot : {1.0, 1e-4, 1e6}) {
    HotGrid problem(Tpetra::getDefaultComm(), hot);
    const SemiSmoothSystem& system = *problem.system;
    const AcceptedState rest = system.initial_state(Vector(system.map()));
    const StepContext context = system.step_from(rest, 1.0);
    NewtonReport report;
    const SystemEvaluation solution = solve_newton(system, system.evaluate(*rest.x, context), {}, report, {});
    EXPECT_GT(solution.norms().active, 0);
    paths.emplace_back();
    for (const auto& iteration : report.iterations) paths.back().push_back(iteration.norms.momentum);

    Vector v(system.map()), J_v(system.map()), difference(system.map());
    for (const GlobalOrdinal id : system.map()->getNodeElementList()) {
      const bool is_temperature = id >= problem.temperature(0) && id < problem.temperature(64);
      v.replaceGlobalValue(id, (is_temperature ? hot : 1.0) * std::sin(0.91 * static_cast<double>(id)));
    }
    const double h = 1e-6;
    for (const double sign : {1.0, -1.0}) {
      Vector x(solution.x(), Teuchos::Copy);
      x.update(sign * h, v, 1.0);
      difference.update(sign / (2.0 * h), system.evaluate(x, context).residual(), 1.0);
    }
    system.linearise(solution).apply(v, J_v);
    const double size = J_v.norm2();
    difference.update(-1.0, J_v, 1.0);
    EXPECT_LE(difference.norm2(), 1e-6 * size);
  }
  for (const auto& path : paths) {
    ASSERT_EQ(path.size(), paths[0].size());
    for (std::size_t k = 0; k < path.size(); ++k) EXPECT_NEAR(path[k], paths[0][k], 1e-6 * paths[0][k] + 1e-12);
  }
}

TEST(SecondField, AgreesWithOneRank) {
  HotGrid problem(Tpetra::getDefaultComm(), 1.0), alone(test::this_rank_only(), 1.0);
  const auto solve = [](const HotGrid& at) {
    const AcceptedState rest = at.system->initial_state(Vector(at.system->map()));
    NewtonReport report;
    return solve_newton(*at.system, at.system->evaluate(*rest.x, at.system->step_from(rest, 1.0)), {}, report, {});
  };
  const SystemEvaluation mine = solve(problem), whole = solve(alone);
  const auto x = problem.system->unknowns(mine.x()), y = alone.system->unknowns(whole.x());
  for (std::size_t k = 0; k < x->getLocalLength(); ++k) {
    const GlobalOrdinal id = x->getMap()->getGlobalElement(static_cast<LocalOrdinal>(k));
    EXPECT_NEAR(x->getData()[k], y->getData()[y->getMap()->getLocalElement(id)], 1e-10);
  }
}

// Derivatives that a system does not have are refused by name.
TEST(SecondField, ContributionsThatKnowMoreThanTheSystemAreRefused) {
  class Inertia : public Contribution {
   public:
    std::string name() const override { return "inertia"; }
    Kind kind() const override { return Kind::internal; }
    FieldUse uses() const override { return {{"displacement"}, {"displacement"}, 2}; }
    void add_residual(const Configuration&, Vector&, std::optional<StepFailure>&) override {}
    void add_jacobian(const Configuration&, const JacobianWeights&, Matrix&, std::optional<StepFailure>&) override {}
  };
  class Pressure : public Inertia {
   public:
    FieldUse uses() const override { return {{"pore pressure"}, {"displacement"}, 0}; }
  };
  const auto refused = [](const std::shared_ptr<Contribution>& more) {
    test::Problem problem(Tpetra::getDefaultComm(), {});
    SystemParts parts = problem.system->parts();
    parts.contributions.push_back(more);
    try {
      SemiSmoothSystem(std::move(parts), Timers());
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(refused(std::make_shared<Inertia>()).find("contribution \"inertia\" reads time derivatives of order 2"), std::string::npos);
  EXPECT_NE(refused(std::make_shared<Pressure>()).find("knows a field 'pore pressure'"), std::string::npos);
}

}  // namespace
}  // namespace mortise
