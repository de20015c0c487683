// Two fields in one system: displacements of two bodies in contact, and a temperature that lives in one of them and makes it swell.

#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>
#include <Tpetra_CrsGraph.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <set>

#include "../nonlinear/spring_grid.hpp"
#include "mortise/core/trilinos_versions.hpp"
#include "mortise/nonlinear/newton_solver.hpp"

namespace mortise {
namespace {

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
    std::vector<GlobalOrdinal> local(local_ids(*table.dofs).begin(), local_ids(*table.dofs).end());
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
      for (const GlobalOrdinal id : local_ids(*grid_->local_dofs))
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
    for (const GlobalOrdinal id : local_ids(*system.map())) {
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
