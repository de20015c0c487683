#pragma once
// Bodies with a temperature, their fields and steady solutions, for the tests of `thermal`.

#include <Eigen/Dense>
#include <Teuchos_DefaultMpiComm.hpp>
#include <Tpetra_Core.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Vector.hpp>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "../solid/lattice_mesh.hpp"
#include "mortise/core/over_ranks.hpp"
#include "mortise/mesh/build_mesh.hpp"
#include "mortise/mesh/volume_generators.hpp"
#include "mortise/nonlinear/linear_solver_factory.hpp"
#include "mortise/nonlinear/load_stepper.hpp"
#include "mortise/nonlinear/newton_solver.hpp"
#include "mortise/nonlinear/semi_smooth_system.hpp"
#include "mortise/thermal/heat_contributions.hpp"
#include "mortise/thermal/prescribed_temperatures.hpp"
#include "mortise/thermal/thermal_bodies.hpp"
#include "mortise/thermal/thermal_loads.hpp"

namespace mortise::test {

using Position = std::array<double, 3>;
using Field = std::function<double(const Position&)>;
using VectorField = std::function<Position(const Position&)>;

inline RCP<const Communicator> world() { return Tpetra::getDefaultComm(); }
inline RCP<const Communicator> self() { return rcp(new Teuchos::MpiComm<int>(MPI_COMM_SELF)); }

/// A function of the arguments of expressions, as of t, x, y, z, temperature.
inline ScalarFunction function_of(std::function<double(const std::vector<double>&)> body, const std::string& source = "f") {
  return ScalarFunction(ScalarFunction::Body(std::move(body)), source);
}
/// f(t, x, y, z) of the place alone.
inline ScalarFunction of_place(const Field& field) {
  return function_of([field](const std::vector<double>& at) { return field({at[1], at[2], at[3]}); });
}
/// f(temperature), the only argument.
inline ScalarFunction of_temperature(const std::function<double(double)>& f, const std::string& source = "f") {
  return function_of([f](const std::vector<double>& at) { return f(at[0]); }, source);
}

/// All shapes of elements of 2D or 3D.
inline std::vector<CellShape> cells_of(int dimension) {
  std::vector<CellShape> shapes;
  visit_each_cell([&](auto cell) {
    if (decltype(cell)::dimension == dimension) shapes.push_back(shape_of<decltype(cell)>);
  });
  return shapes;
}
inline bool is_quadratic(CellShape shape) { return topology(shape).mid_side_nodes() > 0; }

/// [2, 3] x [0, 1] (x [0, 1]) with smoothly displaced nodes, also those of the surface; one rank.
inline RCP<Mesh> distorted_mesh(CellShape shape, int cells, double distortion, bool curved = false) {
  const bool in_space = topology(shape).dimension == 3;
  return make_lattice_mesh(
      self(), shape, {cells, cells, in_space ? cells : 1},
      [&](const Position& s) -> Position {
        const double d = distortion / cells;
        return {2.0 + s[0] + d * std::cos(1.0 + 2.0 * s[1] - 3.0 * s[2]), s[1] + d * std::sin(2.0 * s[0] + 4.0 * s[2]),
                in_space ? s[2] + d * std::sin(1.0 + 3.0 * s[0] - 2.0 * s[1]) : 0.0};
      },
      curved);
}

/// [left, left + width] x [0, 1].
inline RCP<Mesh> strip(int cells_x, int cells_y, double width, CellShape shape = CellShape::quadrilateral4, double left = 0.0,
                       const RCP<const Communicator>& comm = world()) {
  auto block = std::make_shared<BlockMesh>();
  block->width = width;
  block->height = 1.0;
  block->cells_x = cells_x;
  block->cells_y = cells_y;
  block->translation = {left, 0.0};
  return build_mesh(comm, {{"body", {}, block, shape}}, {});
}
/// [0, width] x [0, 1] x [0, 1].
inline RCP<Mesh> bar(int cells_x, double width, CellShape shape = CellShape::hexahedron8, const RCP<const Communicator>& comm = world()) {
  auto brick = std::make_shared<BrickMesh>();
  brick->width = width;
  brick->cells_x = cells_x;
  brick->cells_y = brick->cells_z = 2;
  return build_mesh(comm, {{"body", {}, brick, shape}}, {});
}

struct HeatSetup {
  ThermalProperties properties;
  Kinematics kinematics = Kinematics::plane_strain;
  double density = 1.0, thickness = 0.7;
  bool displacement = false;  ///< the model has displacements too
};

/// One body.
struct HeatModel {
  RCP<const Mesh> mesh;
  std::shared_ptr<const FieldSpace> space;
  std::shared_ptr<const ThermalBodies> bodies;

  HeatModel(RCP<Mesh> of_mesh, const HeatSetup& setup) : mesh(of_mesh) {
    std::vector<FieldDeclaration> fields{{"temperature", 1}};
    if (setup.displacement) fields.insert(fields.begin(), {"displacement", mesh->dimension});
    space = std::make_shared<FieldSpace>(mesh, fields);
    const std::vector<ThermalBody> all(mesh->blocks.size(), {{}, std::make_shared<ThermalProperties>(setup.properties), setup.density});
    bodies = std::make_shared<ThermalBodies>(space, setup.kinematics, setup.thickness, all);
  }

  /// Unknowns on the local dofs.
  Vector unknowns(const Field& theta, const VectorField& u = {}) const {
    Vector values(space->local_dofs());
    const auto view = values.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (LocalOrdinal node = 0; node < mesh->local_count(); ++node) {
      const Position& X = mesh->coordinates[node];
      view(space->row(bodies->temperature(), node, 0), 0) = theta(X);
      if (!bodies->displacement()) continue;
      const Position of_node = u ? u(X) : Position{};
      for (int i = 0; i < mesh->dimension; ++i) view(space->row(*bodies->displacement(), node, i), 0) = of_node[i];
    }
    return values;
  }
  Vector owned(const Vector& local) const {
    Vector result(space->dofs());
    const auto from = local.getLocalViewHost(Tpetra::Access::ReadOnly);
    const auto to = result.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (std::size_t i = 0; i < to.extent(0); ++i) to(i, 0) = from(i, 0);  // owned dofs come first
    return result;
  }
};

/// A load with its parameters set by `set`.
template <class Options>
std::shared_ptr<Contribution> load_on(const HeatModel& model, const std::string& side, const std::function<void(Options&)>& set) {
  Options options;
  options.set = {side, {}};
  set(options);
  return options.make(model.bodies);
}
inline std::shared_ptr<Contribution> convection(const HeatModel& model, const std::string& side, ScalarFunction h, ScalarFunction surroundings) {
  return load_on<ConvectionOptions>(model, side, [&](ConvectionOptions& options) {
    options.coefficient = std::move(h);
    options.surroundings = std::move(surroundings);
  });
}
inline std::shared_ptr<Contribution> heat_flux(const HeatModel& model, const std::string& side, ScalarFunction q) {
  return load_on<SurfaceHeatFluxOptions>(model, side, [&](SurfaceHeatFluxOptions& options) { options.flux = std::move(q); });
}

inline Named<PrescribedTemperatureOptions> prescribe(const std::string& set, ScalarFunction value) {
  return {set, {}, {{set, {}}, std::move(value)}};
}

/// A system of temperatures alone.
inline std::unique_ptr<SemiSmoothSystem> heat_system(const HeatModel& model, const std::vector<std::shared_ptr<Contribution>>& contributions,
                                                     const std::vector<Named<PrescribedTemperatureOptions>>& prescribed, double size,
                                                     std::shared_ptr<const TimeIntegration> time = {}) {
  SystemParts parts;
  parts.dofs = model.space->dofs();
  parts.local_dofs = model.space->local_dofs();
  parts.bulk_graph = [space = model.space] { return space->graph(); };
  parts.contributions = contributions;
  const auto temperatures = std::make_shared<const PrescribedTemperatures>(*model.bodies, prescribed);
  parts.constraints = std::make_shared<const AffineConstraints>(
      model.space->dofs(), temperatures->lines(),
      [temperatures](double t, std::optional<StepFailure>& failure) { return temperatures->values(t, failure); });
  parts.linear_solver = make_linear_solver({}, model.mesh->comm, Timers());
  parts.length = size;
  parts.fields = {{model.space->field(0), size}};
  parts.time = std::move(time);
  return std::make_unique<SemiSmoothSystem>(std::move(parts), Timers());
}

struct SteadyHeat {
  Vector unknowns;  ///< on the local dofs
  Vector forces;    ///< the residual's rows, on the owned dofs: reactions where temperatures are prescribed, as power out of the body
  int newton_steps;
};

/// Temperatures in balance, from `start` on.
inline SteadyHeat solve_steady(const HeatModel& model, const std::vector<std::shared_ptr<Contribution>>& contributions,
                               const std::vector<Named<PrescribedTemperatureOptions>>& prescribed, double size, double start = 0.0) {
  const auto system = heat_system(model, contributions, prescribed, size);
  Vector x(system->map());
  x.putScalar(start);
  const AcceptedState rest = system->initial_state(x);
  NewtonOptions options;
  options.momentum_tolerance = 1e-12;
  NewtonReport report;
  const SystemEvaluation solution = solve_newton(*system, system->evaluate(*rest.x, rest.context), options, report, {});
  SteadyHeat result{Vector(model.space->local_dofs()), Vector(*solution.forces(), Teuchos::Copy), report.newton_steps()};
  result.unknowns.doImport(solution.x(), *model.space->ghost_import(), Tpetra::REPLACE);
  return result;
}

/// Largest difference of temperatures at nodes of all ranks from a function.
inline double largest_error(const HeatModel& model, const Vector& local_unknowns, const Field& exact) {
  const auto values = local_unknowns.getLocalViewHost(Tpetra::Access::ReadOnly);
  double error = 0.0;
  for (LocalOrdinal node = 0; node < model.mesh->owned_count(); ++node)
    error = std::max(error, std::abs(values(model.space->row(model.bodies->temperature(), node, 0), 0) - exact(model.mesh->coordinates[node])));
  return most_over_ranks(*model.mesh->comm, error);
}

/// sums_of_heat() of the first body over all ranks.
inline double heat_of(Contribution& contribution, const HeatModel& model, const Configuration& at) {
  std::optional<StepFailure> failure;
  const double mine = sums_of_heat(contribution, *model.bodies, at, failure).front();
  throw_if_any(*model.mesh->comm, failure);
  return sum_over_ranks(*model.mesh->comm, mine);
}

}  // namespace mortise::test
