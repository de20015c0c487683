#pragma once
// A grid of springs in 2D with large displacements, distributed over the ranks: a small nonlinear solid for tests.

#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_DefaultMpiComm.hpp>
#include <Tpetra_CrsGraph.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <array>
#include <cmath>
#include <functional>
#include <set>

#include "mortise/nonlinear/linear_solver_factory.hpp"
#include "mortise/nonlinear/semi_smooth_system.hpp"

namespace mortise::test {

inline RCP<const Communicator> this_rank_only() { return rcp(new Teuchos::MpiComm<int>(MPI_COMM_SELF)); }

/// Distribution of nodes over ranks, and their numbering.
enum class Numbering { blocks, scattered, with_gaps };

/// nx x ny nodes at unit distance; springs to all eight neighbours. With a cut, the rows from `cut` on are a body of their own: narrower, so
/// that nodes do not match, and just above the rows below.
class SpringGrid {
 public:
  SpringGrid(const RCP<const Communicator>& comm, int nx, int ny, Numbering numbering = Numbering::scattered, int cut = 0)
      : nx_(nx), ny_(ny), cut_(cut), stride_(numbering == Numbering::with_gaps ? 3 : 1) {
    std::vector<GlobalOrdinal> owned;
    const int ranks = comm->getSize(), count = nx * ny;
    for (int node = 0; node < count; ++node) {
      const int owner = numbering == Numbering::blocks ? node * ranks / count : node % ranks;
      if (owner == comm->getRank()) nodes_.push_back(node), owned.push_back(stride_ * node);
    }
    std::set<int> ghosts;
    for (const int node : nodes_)
      for (const int other : neighbours(node))
        if (!std::binary_search(nodes_.begin(), nodes_.end(), other)) ghosts.insert(other);
    node_map = map(comm, nodes_, 1);
    dofs = map(comm, nodes_, 2);
    std::vector<int> local = nodes_;
    local.insert(local.end(), ghosts.begin(), ghosts.end());
    local_dofs = map(comm, local, 2);

    const auto built = rcp(new Graph(dofs, 18));
    for (const int node : nodes_) {
      std::vector<GlobalOrdinal> columns = {dof(node, 0), dof(node, 1)};
      for (const int other : neighbours(node)) columns.insert(columns.end(), {dof(other, 0), dof(other, 1)});
      for (int i = 0; i < 2; ++i) built->insertGlobalIndices(dof(node, i), static_cast<LocalOrdinal>(columns.size()), columns.data());
    }
    built->fillComplete(dofs, dofs);
    graph = built;
  }

  GlobalOrdinal dof(int node, int component) const { return 2 * stride_ * node + component; }
  const std::vector<int>& owned_nodes() const { return nodes_; }
  int nx() const { return nx_; }
  int ny() const { return ny_; }
  int cut() const { return cut_; }
  std::array<double, 2> position(int node) const {
    const double x = node % nx_, y = node / nx_;
    if (cut_ == 0 || node / nx_ < cut_) return {x, y};
    return {0.77 + 0.8 * x, y - 1.0 + 0.05};
  }

  std::vector<int> neighbours(int node) const {
    std::vector<int> result;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const int x = node % nx_ + dx, y = node / nx_ + dy;
        const bool inside = x >= 0 && x < nx_ && y >= 0 && y < ny_, same_body = (y >= cut_) == (node / nx_ >= cut_);
        if ((dx != 0 || dy != 0) && inside && same_body) result.push_back(y * nx_ + x);
      }
    return result;
  }

  NearNullSpace near_null_space() const {
    const auto modes = rcp(new MultiVector(dofs, 3));
    const auto coordinates = rcp(new MultiVector(node_map, 2));
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      const auto x = position(nodes_[n]);
      const auto row = static_cast<LocalOrdinal>(2 * n);
      modes->replaceLocalValue(row, 0, 1.0);
      modes->replaceLocalValue(row + 1, 1, 1.0);
      modes->replaceLocalValue(row, 2, -x[1]);
      modes->replaceLocalValue(row + 1, 2, x[0]);
      for (int i = 0; i < 2; ++i) coordinates->replaceLocalValue(static_cast<LocalOrdinal>(n), i, x[i]);
    }
    return {modes, coordinates};
  }

  RCP<const Map> node_map, dofs, local_dofs;
  RCP<const Graph> graph;

 private:
  RCP<const Map> map(const RCP<const Communicator>& comm, const std::vector<int>& nodes, int components) const {
    std::vector<GlobalOrdinal> ids;
    for (const int node : nodes)
      for (int i = 0; i < components; ++i) ids.push_back(components * stride_ * node + i);
    const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
    return rcp(new Map(invalid, ids.data(), static_cast<LocalOrdinal>(ids.size()), 0, comm));
  }

  int nx_, ny_, cut_, stride_;
  std::vector<int> nodes_;
};

/// Springs of energy 1/2 k L^2 e^2 with e = (l^2 - L^2) / (2 L^2). The force is k e D on the end that D = x_b - x_a points to, its derivative k (e I
/// + D D^T / L^2). Fails (inverted element) when a spring has lost nine tenths of its length.
class Springs : public Contribution {
 public:
  Springs(std::shared_ptr<const SpringGrid> grid, double stiffness) : grid_(std::move(grid)), stiffness_(stiffness) {}
  std::string name() const override { return "springs"; }
  Kind kind() const override { return Kind::internal; }

  void add_residual(const Configuration& at, Vector& residual, std::optional<StepFailure>& failure) override {
    for_each(at, failure, [&](int a, int, const auto& D, double e, double) {
      for (int i = 0; i < 2; ++i) residual.sumIntoGlobalValue(grid_->dof(a, i), -stiffness_ * e * D[i]);
    });
  }

  void add_jacobian(const Configuration& at, const JacobianWeights& weights, Matrix& jacobian, std::optional<StepFailure>& failure) override {
    for_each(at, failure, [&](int a, int b, const auto& D, double e, double L2) {
      for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) {
          const double value = weights.unknowns * stiffness_ * ((i == j ? e : 0.0) + D[i] * D[j] / L2), minus = -value;
          const GlobalOrdinal own = grid_->dof(a, j), other = grid_->dof(b, j);
          jacobian.sumIntoGlobalValues(grid_->dof(a, i), 1, &value, &own);
          jacobian.sumIntoGlobalValues(grid_->dof(a, i), 1, &minus, &other);
        }
    });
  }

 private:
  template <class Visit>
  void for_each(const Configuration& at, std::optional<StepFailure>& failure, const Visit& visit) const {
    const auto u = at.local_unknowns.getLocalViewHost(Tpetra::Access::ReadOnly);
    const auto position = [&](int node) {
      auto x = grid_->position(node);
      for (int i = 0; i < 2; ++i) x[i] += u(grid_->local_dofs->getLocalElement(grid_->dof(node, i)), 0);
      return x;
    };
    for (const int a : grid_->owned_nodes())
      for (const int b : grid_->neighbours(a)) {
        const auto A = grid_->position(a), B = grid_->position(b), xa = position(a), xb = position(b);
        const std::array<double, 2> D = {xb[0] - xa[0], xb[1] - xa[1]};
        const double L2 = std::pow(B[0] - A[0], 2) + std::pow(B[1] - A[1], 2), l2 = D[0] * D[0] + D[1] * D[1];
        if (l2 < 0.01 * L2 && !failure) failure = StepFailure(FailureKind::inverted_element, "spring " + std::to_string(a));
        visit(a, b, D, 0.5 * (l2 - L2) / L2, L2);
      }
  }

  std::shared_ptr<const SpringGrid> grid_;
  double stiffness_;
};

/// Factor of a load or a motion, as a function of time.
using Course = std::function<double(double time)>;
inline double steadily(double time) { return time; }

/// A dead load on each node of the upper edge.
class EdgeLoad : public Contribution {
 public:
  EdgeLoad(std::shared_ptr<const SpringGrid> grid, std::array<double, 2> force, Course course = steadily)
      : grid_(std::move(grid)), force_(force), course_(std::move(course)) {}
  std::string name() const override { return "edge load"; }
  Kind kind() const override { return Kind::external; }
  void add_residual(const Configuration& at, Vector& residual, std::optional<StepFailure>&) override {
    for (const int node : grid_->owned_nodes())
      if (node / grid_->nx() == grid_->ny() - 1)
        for (int i = 0; i < 2; ++i) residual.sumIntoGlobalValue(grid_->dof(node, i), -course_(at.time) * force_[i]);
  }
  void add_jacobian(const Configuration&, const JacobianWeights&, Matrix&, std::optional<StepFailure>&) override {}

 private:
  std::shared_ptr<const SpringGrid> grid_;
  std::array<double, 2> force_;
  Course course_;
};

/// Adds no force, but fails on the rank that owns a displacement that went further than `reach` since the last commit, or beyond `limit` in all.
class Brittle : public Contribution {
 public:
  Brittle(const SpringGrid& grid, double reach, double limit) : committed(grid.dofs), reach_(reach), limit_(limit) {}
  std::string name() const override { return "brittle"; }
  Kind kind() const override { return Kind::internal; }
  void add_residual(const Configuration& at, Vector&, std::optional<StepFailure>& failure) override {
    const auto now = at.unknowns.getLocalViewHost(Tpetra::Access::ReadOnly);
    const auto then = committed.getLocalViewHost(Tpetra::Access::ReadOnly);
    for (std::size_t i = 0; i < now.extent(0); ++i)
      if ((std::abs(now(i, 0) - then(i, 0)) > reach_ || std::abs(now(i, 0)) > limit_) && !failure)
        failure = StepFailure(FailureKind::material, "too far at once");
  }
  void add_jacobian(const Configuration&, const JacobianWeights&, Matrix&, std::optional<StepFailure>&) override {}
  void commit(const Configuration& at) override {
    Tpetra::deep_copy(committed, at.unknowns);
    times.push_back(at.time);
  }

  Vector committed;
  std::vector<double> times;

 private:
  double reach_, limit_;
};

/// The lower edge is fixed; the upper one, if `motion` is given, moves by course(time) * motion.
/// @param dofs  those of the system
inline std::vector<AffineConstraints::Line> edge_lines(const SpringGrid& grid, const Map& dofs, std::optional<std::array<double, 2>> motion) {
  std::vector<AffineConstraints::Line> lines;
  for (const int node : grid.owned_nodes()) {
    const bool lower = node < grid.nx(), upper = node / grid.nx() == grid.ny() - 1;
    if (!lower && !(upper && motion)) continue;
    for (int i = 0; i < 2; ++i) lines.push_back({dofs.getLocalElement(grid.dof(node, i)), {}, {{0, lower ? 0.0 : (*motion)[i]}}});
  }
  return lines;
}

inline std::shared_ptr<const AffineConstraints> edges(const SpringGrid& grid, std::optional<std::array<double, 2>> motion, Course course = steadily) {
  return std::make_shared<const AffineConstraints>(grid.dofs, edge_lines(grid, *grid.dofs, motion),
                                                   [course](double time, std::optional<StepFailure>&) { return std::vector<double>{course(time)}; });
}

/// A grid with its lower edge fixed, pulled at its upper edge by forces or by a motion.
struct Problem {
  std::shared_ptr<SpringGrid> grid;
  std::shared_ptr<Brittle> brittle;
  std::unique_ptr<SemiSmoothSystem> system;
  RCP<Vector> x;

  /// F at x from rest, at a time.
  SystemEvaluation evaluate(double time) const { return system->evaluate(*x, context(time)); }
  /// Context of a step from rest.
  StepContext context(double time) const { return system->step_from(system->initial_state(Vector(system->map())), time); }

  struct Choices {
    int nx = 6, ny = 5;
    std::optional<std::array<double, 2>> force, motion;
    Course course = steadily;  ///< of both
    double stiffness = 1.0;
    double reach = 1e30, limit = 1e30;
    LinearSolverOptions linear_solver;
    Numbering numbering = Numbering::scattered;
    int cut = 0;                               ///< with contact between the two bodies
    std::shared_ptr<Formulation> formulation;  ///< of contact; null: the default
    Linearisation linearisation = Linearisation::exact;
  };

  /// The lower edge of the upper body (slave) on the upper edge of the lower one.
  static std::shared_ptr<ContactSystem> contact(const SpringGrid& grid, const AffineConstraints& constraints, double stiffness,
                                                const std::shared_ptr<Formulation>& formulation, Linearisation linearisation) {
    const auto reference = rcp(new MultiVector(grid.node_map, 2)), fixed = rcp(new MultiVector(grid.node_map, 2));
    for (std::size_t n = 0; n < grid.owned_nodes().size(); ++n)
      for (int i = 0; i < 2; ++i) reference->replaceLocalValue(static_cast<LocalOrdinal>(n), i, grid.position(grid.owned_nodes()[n])[i]);
    for (const LocalOrdinal dof : constraints.prescribed()) fixed->replaceLocalValue(dof / 2, dof % 2, 1.0);
    ContactPair pair;
    pair.name = "pair";
    pair.youngs_modulus = stiffness;
    pair.options.mortar.linearisation = linearisation;
    if (formulation) pair.options.formulation.options = formulation;
    const auto mine = [&](int node) { return std::binary_search(grid.owned_nodes().begin(), grid.owned_nodes().end(), node); };
    for (int i = 0; i + 1 < grid.nx(); ++i) {
      const int slave = grid.cut() * grid.nx() + i, master = slave - grid.nx();
      if (mine(slave) || mine(slave + 1)) pair.slave.push_back({slave, slave + 1});
      if (mine(master)) pair.master.push_back({master + 1, master});
    }
    return std::make_shared<ContactSystem>(grid.node_map, grid.dofs, reference, fixed, InterfaceMeasure{}, std::vector<ContactPair>{pair}, Timers());
  }

  Problem(const RCP<const Communicator>& comm, const Choices& choices) {
    grid = std::make_shared<SpringGrid>(comm, choices.nx, choices.ny, choices.numbering, choices.cut);
    brittle = std::make_shared<Brittle>(*grid, choices.reach, choices.limit);
    SystemParts parts;
    parts.dofs = grid->dofs;
    parts.local_dofs = grid->local_dofs;
    parts.bulk_graph = [graph = grid->graph] { return graph; };
    parts.contributions = {std::make_shared<Springs>(grid, choices.stiffness), brittle};
    if (choices.force) parts.contributions.push_back(std::make_shared<EdgeLoad>(grid, *choices.force, choices.course));
    parts.constraints = edges(*grid, choices.motion, choices.course);
    if (choices.cut > 0) parts.contact = contact(*grid, *parts.constraints, choices.stiffness, choices.formulation, choices.linearisation);
    parts.linear_solver = make_linear_solver(choices.linear_solver, comm, Timers());
    parts.near_null_space = [grid = grid](const Vector&) { return grid->near_null_space(); };
    parts.length = choices.ny;
    system = std::make_unique<SemiSmoothSystem>(std::move(parts), Timers());
    x = rcp(new Vector(system->map()));
  }
};

}  // namespace mortise::test
