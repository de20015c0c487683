#include "model/inertia.hpp"

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <set>

#include "model/widened_graph.hpp"

namespace mortise {

FieldUse InertiaContribution::uses() const {
  FieldUse uses;
  uses.time_derivatives = 2;
  return uses;
}

void InertiaContribution::add_residual(const Configuration& at, Vector& residual, std::optional<StepFailure>&) {
  const auto timer = count("inertia");
  Vector rate(*at.acceleration, Teuchos::Copy);
  if (damping_ != 0.0) rate.update(damping_, *at.velocity, 1.0);
  residual.update(1.0, *mass_->times(rate), 1.0);
}

// Columns of nodes without mass are empty: the shares of the others are 1.
void InertiaContribution::add_jacobian(const Configuration&, const JacobianWeights& weights, Matrix& jacobian, std::optional<StepFailure>&) {
  const auto timer = count("inertia");
  mass_->add_to(jacobian, weights.acceleration + damping_ * weights.velocity);
}

FieldUse StiffnessDamping::uses() const {
  FieldUse uses;
  uses.time_derivatives = 1;
  return uses;
}

StiffnessDamping::StiffnessDamping(const Bodies& bodies, double damping, const Timers& timers)
    : CountedContribution("stiffness damping", timers), damping_(rcp(new Matrix(bodies.graph()))) {
  damping_->setAllToScalar(0.0);
  std::optional<StepFailure> failure;
  bodies.add_stiffness(Vector(bodies.local_dofs()), *damping_, failure, damping);
  damping_->fillComplete(bodies.dofs(), bodies.dofs());
  throw_if_any(*bodies.mesh()->comm, failure);
}

void StiffnessDamping::add_residual(const Configuration& at, Vector& residual, std::optional<StepFailure>&) {
  const auto timer = count("damping");
  damping_->apply(*at.velocity, residual, Teuchos::NO_TRANS, 1.0, 1.0);
}

void StiffnessDamping::add_jacobian(const Configuration&, const JacobianWeights& weights, Matrix& jacobian, std::optional<StepFailure>&) {
  if (weights.velocity == 0.0) return;
  const auto timer = count("damping");
  const auto local = damping_->getLocalMatrixHost();
  std::vector<double> values;
  std::vector<LocalOrdinal> columns;
  const auto shares = weights.local_velocity_shares->getLocalViewHost(Tpetra::Access::ReadOnly);
  for (LocalOrdinal row = 0; row < static_cast<LocalOrdinal>(damping_->getNodeNumRows()); ++row) {
    values.clear();
    columns.clear();
    for (std::size_t k = local.graph.row_map(row); k < local.graph.row_map(row + 1); ++k) {
      columns.push_back(local.graph.entries(k));
      values.push_back(weights.velocity * shares(columns.back(), 0) * local.values(k));
    }
    jacobian.sumIntoLocalValues(row, static_cast<LocalOrdinal>(values.size()), values.data(), columns.data());
  }
}

namespace {

void refuse_without_density(const Bodies& bodies) {
  std::vector<Diagnostic> diagnostics;
  std::set<std::string> named;
  for (const BodyProperties& body : bodies.properties())
    if (!body.is_rigid() && !(body.material->density > 0.0) && named.insert(body.name).second)
      diagnostics.push_back({body.place, fmt::format("body \"{}\" has the density {}; with inertia it needs one above 0, in the list of its material",
                                                     body.name, body.material->density)});
  throw_if_any(*bodies.mesh()->comm, diagnostics);
}

GlobalOrdinal count_over_ranks(const Communicator& comm, std::size_t mine) {
  const auto one = static_cast<GlobalOrdinal>(mine);
  GlobalOrdinal all = 0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, one, Teuchos::outArg(all));
  return all;
}

/// Centres of mass of the bodies. Collective.
std::vector<std::array<double, 3>> centres_of_mass(const Mesh& mesh, const Matrix& mass) {
  Vector ones(mass.getDomainMap()), sums(mass.getRangeMap());
  ones.putScalar(1.0);
  mass.apply(ones, sums);
  std::vector<double> mine(4 * mesh.bodies.size(), 0.0), all(mine.size());
  {
    const auto of_node = sums.getLocalViewHost(Tpetra::Access::ReadOnly);
    for (LocalOrdinal node = 0; node < mesh.owned_body_count(); ++node) {
      double* of_body = &mine[4 * static_cast<std::size_t>(mesh.body_of_node[node])];
      of_body[3] += of_node(node, 0);
      for (int i = 0; i < 3; ++i) of_body[i] += of_node(node, 0) * mesh.coordinates[node][i];
    }
  }
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), all.data());
  std::vector<std::array<double, 3>> centres(mesh.bodies.size());
  for (std::size_t body = 0; body < centres.size(); ++body)
    for (int i = 0; i < 3 && all[4 * body + 3] > 0.0; ++i) centres[body][i] = all[4 * body + i] / all[4 * body + 3];
  return centres;
}

double largest_shift(const std::vector<std::array<double, 3>>& before, const std::vector<std::array<double, 3>>& after) {
  double largest = 0.0;
  for (std::size_t body = 0; body < before.size(); ++body)
    largest = std::max(largest, std::hypot(after[body][0] - before[body][0], after[body][1] - before[body][1], after[body][2] - before[body][2]));
  return largest;
}

}  // namespace

InertiaOfModel add_inertia(const Scene& scene, const std::shared_ptr<const Bodies>& bodies, const Timers& timers, SystemParts& parts) {
  InertiaOfModel result;
  if (!scene.inertia.acts()) return result;
  refuse_without_density(*bodies);
  const Mesh& mesh = *bodies->mesh();
  RCP<const Matrix> mass = bodies->mass(scene.inertia.mass == InertiaOptions::Mass::lumped);
  const auto integration = std::make_shared<TimeIntegration>();
  integration->scheme = scene.inertia.time_scheme();
  if (scene.inertia.contact_mass == InertiaOptions::ContactMass::removed && !scene.contact.empty()) {
    std::vector<Located<std::string>> surfaces;
    for (const auto& pair : scene.contact)
      for (const auto* side : {&pair.value.slave, &pair.value.master}) surfaces.push_back(*side);
    result.massless = massless_nodes(mesh, surfaces);
    result.without_mass = count_over_ranks(*mesh.comm, result.massless.nodes.size());
    result.kept = count_over_ranks(*mesh.comm, result.massless.kept.size());
    if (result.without_mass > 0) {
      const auto before = centres_of_mass(mesh, *mass);
      mass = mass_of_extension(*mass, *result.massless.extension);
      result.centre_shift = largest_shift(before, centres_of_mass(mesh, *mass));
      for (const LocalOrdinal node : result.massless.nodes)
        for (int i = 0; i < mesh.dimension; ++i) integration->massless.push_back(mesh.dimension * node + i);
      integration->extension = for_each_component(*result.massless.extension, bodies->dofs(), mesh.dimension);
    }
  }
  result.mass = std::make_shared<const NodalMass>(mass, mesh.dimension);
  parts.time = integration;
  parts.contributions.push_back(std::make_shared<InertiaContribution>(result.mass, scene.inertia.mass_damping, timers));
  if (scene.inertia.stiffness_damping > 0.0)
    parts.contributions.push_back(std::make_shared<StiffnessDamping>(*bodies, scene.inertia.stiffness_damping, timers));
  if (result.without_mass > 0)
    parts.bulk_graph = [inner = parts.bulk_graph, mass, dimension = mesh.dimension] { return with_entries_of(inner(), *mass, dimension); };
  return result;
}

}  // namespace mortise
