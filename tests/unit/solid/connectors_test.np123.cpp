// Springs, dashpots and point masses on meshes: forces, derivatives, energies; the same on any number of ranks.

#include "mortise/solid/connectors.hpp"

#include <gtest/gtest.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_CrsGraph.hpp>

#include "mortise/core/column_map.hpp"
#include "mortise/core/trilinos_versions.hpp"
#include "mortise/mesh/reference_point.hpp"
#include "mortise/solid/point_masses.hpp"
#include "solid_test_support.hpp"

namespace mortise {
namespace {

/// A block of 2 x 1 and a rigid one of 1 x 1 beside it, with a reference point.
std::shared_ptr<const Bodies> two_blocks(Kinematics kinematics = Kinematics::plane_strain) {
  const auto block = [](double width, double left) {
    auto mesh = std::make_shared<BlockMesh>();
    mesh->width = width;
    mesh->cells_x = mesh->cells_y = 3;
    mesh->translation = {left, 0.0};
    return mesh;
  };
  const auto mesh = build_mesh(world(), {{"block", {}, block(2.0, 1.0), CellShape::quadrilateral4}, {"tool", {}, block(1.0, 4.0), rigid_shape(2)}},
                               {}, {{"point", {}, true, std::array<double, 3>{4.5, 0.5, 0.0}}});
  add_followers(*mesh, 0, {"tool", {}}, {true, true, true});
  return std::make_shared<Bodies>(
      displacement_space(mesh), kinematics, 0.5,
      std::vector<BodyProperties>{{"block", {}, make_material("hencky"), ElementType::q4}, {"tool", {}, nullptr, ElementType::q4}});
}

template <class Options>
Named<Options> named(const std::string& set, const std::function<void(Options&)>& fill) {
  Named<Options> result{"one", {}, {}};
  result.value.set.value = set;
  fill(result.value);
  return result;
}

/// One of each kind, and what they have in common with dashpots.
template <class Options>
std::vector<Named<Options>> one_of_each() {
  return {named<Options>("block/left",
                         [](Options& it) {
                           it.components[0] = 4.0;
                           it.components[1] = 3.0;
                         }),
          named<Options>("block",
                         [](Options& it) {
                           it.components[1] = 0.7;
                           it.per = ConnectorOptions::Per::node;
                         }),
          named<Options>("block/right",
                         [](Options& it) {
                           it.to.value = "point";
                           it.axial = 5.0;
                         }),
          named<Options>("block/top",
                         [](Options& it) {
                           it.to.value = "tool/left";
                           it.components[0] = 2.0;
                           it.components[1] = 6.0;
                         }),
          named<Options>("point",
                         [](Options& it) {
                           it.anchor = {4.0, 3.0};
                           it.axial = 1.5;
                         }),
          named<Options>("point", [](Options& it) { it.rotational = 8.0; })};
}

/// On owned dofs and ghosts, by the ids of dofs.
Vector field(const Bodies& bodies, double size, double phase) {
  Vector result(bodies.space().local_dofs());
  for (std::size_t dof = 0; dof < result.getLocalLength(); ++dof) {
    const auto id = static_cast<double>(bodies.space().local_dofs()->getGlobalElement(static_cast<LocalOrdinal>(dof)));
    result.replaceLocalValue(static_cast<LocalOrdinal>(dof), size * std::sin(0.37 * id + phase));
  }
  return result;
}

/// Open, with all couplings there can be.
RCP<Matrix> full_matrix(const Bodies& bodies) {
  const RCP<const Map>& rows = bodies.space().dofs();
  std::vector<GlobalOrdinal> ids(rows->getGlobalNumElements());
  for (std::size_t id = 0; id < ids.size(); ++id) ids[id] = static_cast<GlobalOrdinal>(id);
  const RCP<const Map> columns = with_further_columns(*bodies.space().local_dofs(), ids);
  const auto graph = rcp(new Graph(rows, columns, ids.size()));
  for (const GlobalOrdinal row : local_ids(*rows)) graph->insertGlobalIndices(row, static_cast<LocalOrdinal>(ids.size()), ids.data());
  graph->fillComplete(rows, rows);
  const auto matrix = rcp(new Matrix(graph));
  matrix->setAllToScalar(0.0);
  return matrix;
}

Vector owned(const Bodies& bodies, const Vector& local) { return Vector(*local.offsetView(bodies.space().dofs(), 0), Teuchos::Copy); }

Vector forces(const Connectors& all, const Vector& u, const Vector* v) {
  Vector result(all.bodies()->space().dofs());
  std::optional<StepFailure> failure;
  all.add_forces(u, v, result, failure);
  EXPECT_FALSE(failure);
  return result;
}

constexpr double h = 1e-6;

void expect_derivatives(const Connectors& all, const Vector& u, const Vector* v, bool by_velocity) {
  const Bodies& bodies = *all.bodies();
  const Vector direction = field(bodies, 1.0, 1.1);
  const RCP<Matrix> K = full_matrix(bodies);
  all.add_derivatives(u, v, by_velocity ? 0.0 : 1.0, by_velocity ? 1.0 : 0.0, nullptr, *K);
  K->fillComplete(bodies.space().dofs(), bodies.space().dofs());
  Vector found(bodies.space().dofs()), quotient(bodies.space().dofs());
  K->apply(owned(bodies, direction), found);
  for (const double sign : {1.0, -1.0}) {
    Vector at(by_velocity ? *v : u, Teuchos::Copy);
    at.update(sign * h, direction, 1.0);
    quotient.update(sign / (2.0 * h), by_velocity ? forces(all, u, &at) : forces(all, at, v), 1.0);
  }
  const double size = quotient.norm2();
  quotient.update(-1.0, found, 1.0);
  EXPECT_GT(size, 0.0);
  EXPECT_LE(quotient.norm2(), 1e-8 * size);
}

TEST(Connectors, DerivativesAgreeWithCentralDifferences) {
  for (const Kinematics kinematics : {Kinematics::plane_strain, Kinematics::axisymmetric}) {
    const auto bodies = two_blocks(kinematics);
    const Connectors springs(bodies, one_of_each<SpringOptions>()), dashpots(bodies, one_of_each<DashpotOptions>());
    const Vector u = field(*bodies, 1.5, 0.2), v = field(*bodies, 0.8, 0.7);
    expect_derivatives(springs, u, nullptr, false);
    expect_derivatives(dashpots, u, &v, false);
    expect_derivatives(dashpots, u, &v, true);
  }
}

TEST(Connectors, ForcesOfSpringsAreTheGradientOfTheirEnergy) {
  const auto bodies = two_blocks();
  const Connectors springs(bodies, one_of_each<SpringOptions>());
  const Vector u = field(*bodies, 1.5, 0.2), direction = field(*bodies, 1.0, 1.1);
  Vector forward(u, Teuchos::Copy), back(u, Teuchos::Copy);
  forward.update(h, direction, 1.0);
  back.update(-h, direction, 1.0);
  const double work = forces(springs, u, nullptr).dot(owned(*bodies, direction));
  EXPECT_NEAR((springs.energy(forward) - springs.energy(back)) / (2.0 * h), work, 1e-7 * std::abs(work));
}

TEST(Connectors, ASetHasItsWholeStiffnessWhateverItsMesh) {
  const auto bodies = two_blocks();
  const Connectors springs(bodies, one_of_each<SpringOptions>());
  Vector u(bodies->space().local_dofs());
  u.putScalar(0.1);
  EXPECT_NEAR(springs.state(0, u, nullptr).force[0], -0.4, 1e-14);
  EXPECT_NEAR(springs.state(0, u, nullptr).force[1], -0.3, 1e-14);
  EXPECT_NEAR(springs.state(0, u, nullptr).elongation[0], 0.1, 1e-14);
  EXPECT_NEAR(springs.state(1, u, nullptr).force[1], -16.0 * 0.07, 1e-13) << "16 nodes";
  EXPECT_NEAR(springs.state(2, u, nullptr).along, 0.0, 1e-13) << "a translation of both ends";
  EXPECT_NEAR(springs.state(3, u, nullptr).force[1], 0.0, 1e-13);
  EXPECT_NEAR(springs.state(4, u, nullptr).along, 1.5 * (std::hypot(0.6, 2.4) - std::hypot(0.5, 2.5)), 1e-13);
  const double arm = bodies->mesh()->reference_points[0].arm;
  EXPECT_NEAR(springs.state(5, u, nullptr).moment, -8.0 * 0.1 / arm, 1e-13);
}

TEST(Connectors, DashpotsTakePowerInAnyMotion) {
  const auto bodies = two_blocks();
  const Connectors dashpots(bodies, one_of_each<DashpotOptions>());
  const Vector u = field(*bodies, 1.5, 0.2), v = field(*bodies, 0.8, 0.7);
  double power = 0.0;
  for (std::size_t n = 0; n < 6; ++n) {
    EXPECT_GT(dashpots.state(n, u, &v).power, 0.0) << n;
    power += dashpots.state(n, u, &v).power;
  }
  EXPECT_NEAR(forces(dashpots, u, &v).dot(owned(*bodies, v)), power, 1e-12 * power);
}

TEST(Connectors, ColumnsOfVelocitiesHaveTheirShares) {
  const auto bodies = two_blocks();
  const Connectors dashpots(bodies, one_of_each<DashpotOptions>());
  const Vector u = field(*bodies, 0.5, 0.2), v = field(*bodies, 0.8, 0.7), direction = field(*bodies, 1.0, 1.1);
  Vector shares(bodies->space().local_dofs()), scaled(direction, Teuchos::Copy);
  for (std::size_t dof = 0; dof < shares.getLocalLength(); ++dof) {  // of nodes
    const GlobalOrdinal id = bodies->space().local_dofs()->getGlobalElement(static_cast<LocalOrdinal>(dof)) / 2;
    shares.replaceLocalValue(static_cast<LocalOrdinal>(dof), 1.0 + static_cast<double>(id % 3));
  }
  scaled.elementWiseMultiply(1.0, shares, direction, 0.0);
  Vector with(bodies->space().dofs()), without(bodies->space().dofs());
  const RCP<Matrix> weighted = full_matrix(*bodies), plain = full_matrix(*bodies);
  dashpots.add_derivatives(u, &v, 0.0, 1.0, &shares, *weighted);
  dashpots.add_derivatives(u, &v, 0.0, 1.0, nullptr, *plain);
  weighted->fillComplete(bodies->space().dofs(), bodies->space().dofs());
  plain->fillComplete(bodies->space().dofs(), bodies->space().dofs());
  weighted->apply(owned(*bodies, direction), with);
  plain->apply(owned(*bodies, scaled), without);
  const double size = without.norm2();
  without.update(-1.0, with, 1.0);
  EXPECT_LE(without.norm2(), 1e-13 * size);
}

TEST(PointMasses, HaveTheirSumOnSidesNodesAndPoints) {
  const auto bodies = two_blocks();
  const auto mass = [](const std::string& set, double value, std::vector<double> moments) {
    return named<PointMassOptions>(set, [&](PointMassOptions& it) {
      it.mass = value;
      it.moments_of_inertia = moments;
    });
  };
  const RCP<const Matrix> M = matrix_of_point_masses(*bodies, {mass("block/top", 2.0, {}), mass("block", 3.0, {}), mass("point", 5.0, {0.4})});
  Vector ones(M->getDomainMap()), sums(M->getRangeMap());
  ones.putScalar(1.0);
  M->apply(ones, sums);
  const double arm = bodies->mesh()->reference_points[0].arm;
  EXPECT_NEAR(sums.dot(ones), 10.0 + 0.4 / (arm * arm), 1e-13);
  double mine = 0.0, all = 0.0;
  for (const double one : weighing_masses(*bodies->mesh(), *M)) mine += one;
  Teuchos::reduceAll(*world(), Teuchos::REDUCE_SUM, mine, Teuchos::outArg(all));
  EXPECT_NEAR(all, 10.0, 1e-13);
}

}  // namespace
}  // namespace mortise
