// The change of unknowns and of equations that multigrid is given, on flat surfaces that keep their normals and a symmetric bulk. The rest of the
// condensed system has no part in the eliminated directions and is symmetric, whatever slips.

#include <gtest/gtest.h>

#include "mortise/core/trilinos_versions.hpp"
#include "two_surfaces.hpp"

namespace mortise {
namespace {

using test::Fixture;
using test::TwoSurfaces;

/// Grids that do not match, with all points at z = 0, with friction whose bound is the same at all pressures.
TwoSurfaces flat(double largest_shear) {
  TwoSurfaces surfaces = test::dome_on_waves();
  for (auto* points : {&surfaces.slave, &surfaces.master})
    for (test::Point& x : *points) x[2] = 0.0;
  auto tresca = std::make_shared<TrescaFriction>();
  tresca->traction = largest_shear;
  surfaces.options.friction.options = tresca;
  surfaces.options.geometry = ContactGeometry::reference;  // normals do not turn
  surfaces.options.full_cover = 0.0;                       // ties mix conditions with momentum
  return surfaces;
}

/// K of springs, symmetric, Dirichlet's rows and columns those of the identity, on the condensed system's graph.
RCP<Matrix> symmetric_springs(const TwoSurfaces& surfaces, const RCP<const Graph>& bulk, const RCP<const Graph>& graph) {
  const auto K = rcp(new Matrix(graph));
  const auto is_fixed = [&](GlobalOrdinal dof) { return surfaces.fixed[static_cast<std::size_t>(dof / 3)][dof % 3]; };
  for (const GlobalOrdinal row : local_ids(*bulk->getRowMap())) {
    Teuchos::Array<GlobalOrdinal> columns(bulk->getNumEntriesInGlobalRow(row));
    std::size_t count = 0;
    Graph::nonconst_global_inds_host_view_type view("columns", columns.size());
    bulk->getGlobalRowCopy(row, view, count);
    for (std::size_t k = 0; k < count; ++k) {
      const GlobalOrdinal column = view(k);
      double value = row == column ? 900.0 + 7.0 * static_cast<double>(row) : -60.0 * std::cos(0.3 * static_cast<double>(row + column));
      if (is_fixed(row) || is_fixed(column)) value = row == column ? 1.0 : 0.0;
      K->sumIntoGlobalValues(row, 1, &value, &column);
    }
  }
  return K;
}

struct Decoupled {
  Eigen::MatrixXd eliminated, rest;  ///< N A S (I - N), (I - N) L A S (I - N), without rows and columns of prescribed dofs
  int slipping = 0, sticking = 0, active = 0;
};

/// @param shear  of a node, of its pressure, which differs from node to node; so does the direction
Decoupled decoupled(const TwoSurfaces& surfaces, const std::function<double(double)>& shear) {
  Fixture fixture(surfaces, Tpetra::getDefaultComm());
  const ContactSystem& contact = *fixture.contact;
  Vector d(fixture.dofs), z(contact.multiplier_map()), rhs(fixture.dofs);
  const ContactHistory history = fixture.first_step(d, z);
  const DifferentiatedContact at = contact.differentiate(d, history);
  const GlobalOrdinal offset = fixture.dofs->getMaxAllGlobalIndex() + 1;
  Tpetra::deep_copy(z, *Fixture::vector(contact.multiplier_map(), [&](GlobalOrdinal id) {
                      const auto node = static_cast<double>((id - offset) / 3);
                      const double pressure = 1.0 + std::sin(1.9 * node), angle = 0.4 * node;
                      const std::array<double, 3> traction = {shear(pressure) * std::cos(angle), shear(pressure) * std::sin(angle), -pressure};
                      // Friction along what is prescribed has no momentum to be symmetric with.
                      const bool held = surfaces.fixed[static_cast<std::size_t>(node)][0];
                      return held && (id - offset) % 3 == 0 ? 0.0 : traction[(id - offset) % 3];
                    }));
  const ContactLaws laws = at.laws(z);
  const ContactNorms norms = laws.norms(history->states);

  const RCP<const Graph> graph = contact.graph(at, [&] { return fixture.bulk; });
  const RCP<Matrix> A = symmetric_springs(surfaces, fixture.bulk, graph);
  const NodeElimination condensed = at.linearise(laws).condense(*A, rhs);
  A->fillComplete(fixture.dofs, fixture.dofs);
  const Decoupling decoupling = condensed.decoupling();

  const std::vector<GlobalOrdinal> ids = Fixture::all_ids(*fixture.dofs);
  const auto whole = [&](const Matrix& matrix) { return Fixture::dense(matrix, ids, ids); };
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(static_cast<Eigen::Index>(ids.size()), static_cast<Eigen::Index>(ids.size()));
  const Eigen::MatrixXd by_trial = whole(*A) * (one + whole(*decoupling.trial));
  std::vector<Eigen::Index> free;
  for (std::size_t k = 0; k < ids.size(); ++k)
    if (!surfaces.fixed[static_cast<std::size_t>(ids[k] / 3)][ids[k] % 3]) free.push_back(static_cast<Eigen::Index>(k));
  Decoupled result;
  result.eliminated = (whole(*decoupling.eliminated) * by_trial)(free, free);
  result.rest = ((one + whole(*decoupling.test).transpose()) * by_trial)(free, free);
  result.active = norms.active;
  result.sticking = norms.sticking;
  result.slipping = norms.active - norms.sticking;
  return result;
}

constexpr double bound = 0.1;

double across_the_bound(double pressure) { return 1.5 * bound * pressure; }

double asymmetry(const Eigen::MatrixXd& matrix) { return (matrix - matrix.transpose()).cwiseAbs().maxCoeff() / matrix.cwiseAbs().maxCoeff(); }

void expect_decoupled(const Decoupled& system) {
  EXPECT_LE(system.eliminated.cwiseAbs().maxCoeff(), 1e-12 * system.rest.cwiseAbs().maxCoeff());
  EXPECT_LE(asymmetry(system.rest), 1e-12);
}

// Across the direction of slip, friction holds nodes like a spring.
TEST(Decoupling, LeavesASymmetricSystem) {
  const Decoupled system = decoupled(flat(bound), across_the_bound);
  EXPECT_GT(system.slipping, 2);
  EXPECT_GT(system.sticking, 2);
  expect_decoupled(system);
}

TEST(Decoupling, LeavesASymmetricSystemWithoutFriction) {
  TwoSurfaces surfaces = flat(bound);
  surfaces.options.friction.options = std::make_shared<NoFriction>();
  const Decoupled system = decoupled(surfaces, [](double) { return 0.0; });
  EXPECT_GT(system.active, 2);
  expect_decoupled(system);
}

TEST(Decoupling, LeavesOutWhatIsPrescribed) {
  TwoSurfaces surfaces = flat(bound);
  surfaces.fixed[5] = surfaces.fixed[20] = {true, false, false};
  surfaces.fixed[22] = {true, true, true};
  expect_decoupled(decoupled(surfaces, across_the_bound));
}

// Nodes that have just begun to slip are held across it as if they stuck: their conditions hold nothing of the momentum yet.
TEST(Decoupling, JoinsAcrossTheSlipAtTheBound) {
  const Decoupled system = decoupled(flat(bound), [](double) { return bound; });
  EXPECT_GT(system.slipping, 0);
  expect_decoupled(system);
}

}  // namespace
}  // namespace mortise
