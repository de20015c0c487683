#include "model/motion/inertia.hpp"

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <TpetraExt_MatrixMatrix.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <set>

#include "model/edges/widened_graph.hpp"
#include "mortise/core/over_ranks.hpp"
#include "mortise/core/trilinos_versions.hpp"
#include "mortise/material/materials.hpp"
#include "mortise/solid/rigid_mass.hpp"

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
    : CountedContribution("stiffness damping", timers), damping_(rcp(new Matrix(bodies.space().graph()))) {
  damping_->setAllToScalar(0.0);
  std::optional<StepFailure> failure;
  bodies.add_stiffness(Vector(bodies.space().local_dofs()), *damping_, failure, damping);
  damping_->fillComplete(bodies.space().dofs(), bodies.space().dofs());
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
  for (LocalOrdinal row = 0; row < static_cast<LocalOrdinal>(local_row_count(*damping_)); ++row) {
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

void refuse_without_density(const Scene& scene, const Bodies& bodies) {
  const auto is_massless = [&](const std::string& name) {
    return std::any_of(scene.bodies.begin(), scene.bodies.end(), [&](const auto& body) { return body.name == name && body.value.massless; });
  };
  std::vector<Diagnostic> diagnostics;
  std::set<std::string> named;
  for (const BodyProperties& body : bodies.properties())
    if (!body.is_rigid() && !(body.material->density > 0.0) && !is_massless(body.name) && named.insert(body.name).second)
      diagnostics.push_back(
          {body.place,
           fmt::format("body \"{}\" has the density {}; with inertia it needs one above 0, in the list of its material, or \"massless\" (bool, true)",
                       body.name, body.material->density)});
  throw_if_any(*bodies.mesh()->comm, diagnostics);
}

/// Number of dofs of a node that are not prescribed, over all ranks; 0 for no node. Collective.
int free_dofs(const FieldSpace& space, LocalOrdinal node, const std::vector<LocalOrdinal>& prescribed) {
  const Mesh& mesh = *space.mesh();
  int mine = 0;
  for (int i = 0; i < mesh.dimension && node >= 0 && node < mesh.owned_count(); ++i)
    if (space.row(node, i) >= 0 && !std::binary_search(prescribed.begin(), prescribed.end(), space.row(node, i))) ++mine;
  return mortise::sum_over_ranks(*mesh.comm, mine);
}

/// Whether all dofs of a rigid body's reference point are prescribed. Collective.
bool is_led(const FieldSpace& space, const ReferencePoint& point, const std::vector<LocalOrdinal>& prescribed) {
  return free_dofs(space, point.node, prescribed) + free_dofs(space, point.rotation_node, prescribed) == 0;
}

// Forces that keep nodes of a body that turns at their distances obey f_(n+1) = -rho f_n + ..., rho the spectral radius at infinite frequency. Those
// of a body that does not turn are eliminated by linear constraints.
void refuse_ringing(const Scene& scene, const FieldSpace& space, const std::vector<LocalOrdinal>& prescribed) {
  if (scene.inertia.radius_at_infinity() < 1.0) return;
  for (const ReferencePoint& point : space.mesh()->reference_points)
    if (free_dofs(space, point.rotation_node, prescribed) > 0)
      throw InputError(
          scene.inertia.place,
          fmt::format("time integration with a spectral radius of 1 at infinite frequency lets the forces of \"{}\" ring without end, as of "
                      "any rigid body and reference point that turns; please take \"generalised alpha\" with a \"spectral radius\" below "
                      "1, or for Newmark's method a \"gamma\" above 0.5 and \"beta\" of (gamma + 0.5)^2 / 4",
                      point.name));
}

RigidMass mass_of(const Scene& scene, const Bodies& bodies, const Named<BodyOptions>& body, const ReferencePoint& point) {
  const BodyOptions& options = body.value;
  const int dimension = bodies.dimension();
  if (options.density) return mass_within(bodies, {body.name + "/surface", body.place}, *options.density);
  const std::size_t needed = scene.kinematics == Kinematics::axisymmetric || point.rotation_node < 0 ? 0 : dimension == 2 ? 1 : 3;
  if (options.moments_of_inertia.size() != needed)
    throw InputError(body.place, fmt::format("\"moments of inertia\" of the rigid body \"{}\" has {} numbers; {} are needed", body.name,
                                             options.moments_of_inertia.size(), needed));
  Eigen::Vector3d centre(bodies.mesh()->coordinates[point.node].data()), moments = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < options.centre_of_mass.size(); ++i) centre[static_cast<Eigen::Index>(i)] = options.centre_of_mass[i];
  if (needed == 1) moments[2] = options.moments_of_inertia[0];
  if (needed == 3) moments = Eigen::Map<const Eigen::Vector3d>(options.moments_of_inertia.data());
  const Eigen::Vector3d others = Eigen::Vector3d::Constant(moments.sum()) - 2.0 * moments;
  if (needed == 3 && !(moments.minCoeff() > 0.0 && others.minCoeff() >= -1e-12 * moments.sum()))
    throw InputError(body.place,
                     fmt::format("\"moments of inertia\" of the rigid body \"{}\" are ({}, {}, {}); each has to be above 0 and not larger "
                                 "than the sum of the other two",
                                 body.name, moments[0], moments[1], moments[2]));
  if (needed == 1 && !(moments[2] > 0.0)) throw InputError(body.place, "\"moments of inertia\" has to be above 0");
  return rigid_mass(*options.mass, centre, moments);
}

bool has_point_mass(const Scene& scene, const std::string& set) {
  return std::any_of(scene.point_masses.begin(), scene.point_masses.end(), [&](const auto& mass) { return mass.value.set.value == set; });
}

/// Null without rigid bodies that have mass. Collective.
RCP<const Matrix> mass_of_rigid_bodies(const Scene& scene, const Bodies& bodies, const std::vector<LocalOrdinal>& prescribed) {
  const Mesh& mesh = *bodies.mesh();
  MassRows rows(static_cast<std::size_t>(mesh.owned_count()));
  bool any = false;
  for (const auto& body : scene.bodies) {
    if (!body.value.rigid.value) continue;
    const auto point = std::find_if(mesh.reference_points.begin(), mesh.reference_points.end(), [&](const ReferencePoint& one) {
      return mesh.bodies[mesh.body_of_node[one.node]].name == body.name && mesh.bodies[mesh.body_of_node[one.node]].is_surface;
    });
    if (point == mesh.reference_points.end()) continue;
    if (!body.value.density && !body.value.mass) {
      if (!is_led(bodies.space(), *point, prescribed) && !has_point_mass(scene, point->name))
        throw InputError(body.place, fmt::format("the rigid body \"{}\" moves and has no mass; please give it a \"density\", or a \"mass\" and "
                                                 "\"moments of inertia\"",
                                                 body.name));
      continue;
    }
    std::vector<LocalOrdinal> nodes;
    for (const LocalOrdinal node : point->followers)
      if (node < mesh.owned_count()) nodes.push_back(node);
    const auto found = mass_on_nodes(mesh, nodes, mass_of(scene, bodies, body, *point));
    if (!found)
      throw InputError(body.place, fmt::format("the nodes of the rigid body \"{}\" do not span the space, so that they cannot carry its moments of "
                                               "inertia; please give it a mesh with some depth",
                                               body.name));
    add_block(mesh, *found, rows);
    any = true;
  }
  return any ? mass_of_rows(mesh.owned_nodes, rows) : Teuchos::null;
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

/// [mesh.bodies] whether contact nodes of a body keep their mass.
std::vector<char> bodies_that_keep(const Scene& scene, const Bodies& bodies) {
  const Mesh& mesh = *bodies.mesh();
  std::vector<char> keeps(mesh.bodies.size(), false);
  if (scene.inertia.contact_mass == InertiaOptions::ContactMass::removed) return keeps;
  for (std::size_t block = 0; block < mesh.blocks.size(); ++block) {
    const BodyProperties& body = bodies.properties()[block];
    if (!body.is_rigid() && std::visit([](const auto& law) { return has_history<std::decay_t<decltype(law)>>; }, body.material->law()))
      keeps[static_cast<std::size_t>(mesh.blocks[block].body)] = true;
  }
  return keeps;
}

}  // namespace

InertiaOfModel add_inertia(const Scene& scene, const std::shared_ptr<const Bodies>& bodies, const std::vector<LocalOrdinal>& prescribed,
                           const Timers& timers, SystemParts& parts) {
  InertiaOfModel result;
  if (!scene.inertia.acts()) return result;
  refuse_without_density(scene, *bodies);
  refuse_ringing(scene, bodies->space(), prescribed);
  const Mesh& mesh = *bodies->mesh();
  RCP<const Matrix> mass =
      scene.inertia.mass == InertiaOptions::Mass::lumped ? mass_of_nodes(mesh.owned_nodes, bodies->nodal_masses()) : consistent_mass(*bodies);
  if (const auto rigid = mass_of_rigid_bodies(scene, *bodies, prescribed); !rigid.is_null())
    mass = Tpetra::MatrixMatrix::add(1.0, false, *mass, 1.0, false, *rigid, mass->getDomainMap(), mass->getRangeMap());
  if (!scene.point_masses.empty())
    mass = Tpetra::MatrixMatrix::add(1.0, false, *mass, 1.0, false, *matrix_of_point_masses(*bodies, scene.point_masses), mass->getDomainMap(),
                                     mass->getRangeMap());
  const auto integration = std::make_shared<TimeIntegration>();
  integration->scheme = scene.inertia.time_scheme();
  if (scene.inertia.contact_mass != InertiaOptions::ContactMass::kept && !scene.contact.empty()) {
    std::vector<Located<std::string>> surfaces;
    for (const auto& pair : scene.contact)
      for (const auto* side : {&pair.value.slave, &pair.value.master}) surfaces.push_back(*side);
    result.massless = massless_nodes(mesh, surfaces, bodies_that_keep(scene, *bodies));
    result.without_mass = count_over_ranks(*mesh.comm, result.massless.nodes.size());
    result.kept = count_over_ranks(*mesh.comm, result.massless.kept.size());
    if (result.without_mass > 0) {
      const auto before = centres_of_mass(mesh, *mass);
      mass = mass_of_extension(*mass, *result.massless.extension);
      result.centre_shift = largest_shift(before, centres_of_mass(mesh, *mass));
      for (const LocalOrdinal node : result.massless.nodes)
        for (int i = 0; i < mesh.dimension; ++i) integration->massless.push_back(bodies->space().row(node, i));
      integration->extension = for_each_component(*result.massless.extension, bodies->space());
    }
  }
  result.mass = std::make_shared<const NodalMass>(mass, bodies->shared_space());
  parts.time = integration;
  parts.contributions.push_back(std::make_shared<InertiaContribution>(result.mass, scene.inertia.mass_damping, timers));
  if (scene.inertia.stiffness_damping > 0.0) {
    const auto damping = std::make_shared<StiffnessDamping>(*bodies, scene.inertia.stiffness_damping, timers);
    result.stiffness_damping = damping->matrix();
    parts.contributions.push_back(damping);
  }
  parts.bulk_graph = [inner = parts.bulk_graph, mass, space = bodies->shared_space()] { return with_entries_of(inner(), *mass, *space); };
  return result;
}

}  // namespace mortise
