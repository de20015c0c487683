// The assembled residual, matrix and loads on several ranks are those of one rank.

#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>
#include <Tpetra_CrsGraph.hpp>

#include "mortise/core/trilinos_versions.hpp"
#include "mortise/input/expression.hpp"
#include "mortise/mesh/volume_generators.hpp"
#include "mortise/solid/loads.hpp"
#include "mortise/solid/prescribed_motion.hpp"
#include "solid_test_support.hpp"

namespace mortise {
namespace {

std::array<double, 3> field(const std::array<double, 3>& X) {
  return {0.05 * std::sin(X[0] + 2.0 * X[1] - X[2]), 0.08 * std::cos(3.0 * X[0] - X[1] + X[2]), 0.06 * std::sin(X[0] - 2.0 * X[2])};
}

/// Bodies of `setup`, in 3D a distorted brick of the generator's.
std::shared_ptr<Bodies> make_distributed(const RCP<const Communicator>& comm, const BodySetup& setup) {
  if (setup.kinematics != Kinematics::three_dimensional) return make_test_bodies(comm, setup);
  auto brick = std::make_shared<BrickMesh>();
  brick->cells_x = 4;
  brick->cells_y = 3;
  brick->cells_z = 2;
  const auto mesh = build_mesh(comm, {{"body", {}, brick, cell_shape(setup.element)}}, {});
  for (auto& X : mesh->coordinates) {
    X[0] += 0.02 * std::sin(3.0 * X[1] + X[2]);
    X[2] += 0.03 * std::sin(2.0 * X[0] - X[1]);
  }
  return std::make_shared<Bodies>(displacement_space(mesh), setup.kinematics, 1.0,
                                  std::vector<BodyProperties>{{"body", {}, make_material(setup.law), setup.element}});
}

/// Residual (bulk and all loads), J v, nodal stresses, prescribed values: on the owned dofs, in one vector for each of them.
struct Assembled {
  std::shared_ptr<Bodies> bodies;
  std::vector<Eigen::VectorXd> columns;
  std::vector<std::pair<GlobalOrdinal, double>> prescribed;
  double energy = 0.0;
};

Assembled assemble(const RCP<const Communicator>& comm, const BodySetup& setup) {
  Assembled result;
  const auto bodies = result.bodies = make_distributed(comm, setup);
  const int dimension = bodies->dimension();
  Vector u(bodies->space().dofs()), local(bodies->space().local_dofs());
  {
    auto view = u.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (LocalOrdinal node = 0; node < bodies->mesh()->owned_count(); ++node) {
      const auto value = field(bodies->mesh()->coordinates[node]);
      for (int i = 0; i < dimension; ++i) view(dimension * node + i, 0) = value[i];
    }
  }
  local.doImport(u, *bodies->space().ghost_import(), Tpetra::INSERT);  // what a Newton iteration does

  Vector residual(bodies->space().dofs()), product(bodies->space().dofs());
  Matrix matrix(bodies->space().graph());
  std::optional<StepFailure> failure;
  bodies->add_internal_force(local, residual, failure);
  bodies->add_stiffness(local, matrix, failure);
  Matrix halved(bodies->space().graph());
  bodies->add_stiffness(local, halved, failure, 0.5);

  NodalForceOptions nodal;
  nodal.set.value = "body/top";
  nodal.x = parse_expression("x*t", {});
  DeadTractionOptions traction;
  traction.set.value = "body/right";
  traction.y = parse_expression("1+y", {});
  SurfaceForceOptions spread;
  spread.set.value = "body/right";
  spread.x = parse_expression("2-t", {});
  CentrifugalOptions spin;
  spin.speed = parse_expression("1+t", {});
  if (dimension == 3) spin.axis = {1.0, 2.0, -1.0};
  FollowerPressureOptions pressure;
  pressure.set.value = "body/surface";
  pressure.pressure = parse_expression("3+x*y", {});
  GravityOptions gravity;
  gravity.y = -9.81;
  if (dimension == 3) nodal.z = traction.z = gravity.z = parse_expression("t", {});
  for (const LoadOptions* options : std::initializer_list<const LoadOptions*>{&nodal, &traction, &spread, &spin, &pressure, &gravity}) {
    const auto load = options->make(bodies);
    load->add_residual(0.5, local, residual, failure);
    load->add_jacobian(0.5, local, matrix, failure);
    load->add_jacobian(0.5, local, halved, failure, 0.5);
  }
  EXPECT_FALSE(failure);
  for (Matrix* one : {&halved, &matrix}) one->fillComplete(bodies->space().dofs(), bodies->space().dofs());
  Vector half_product(bodies->space().dofs());
  halved.apply(u, half_product);
  matrix.apply(u, product);
  half_product.update(-0.5, product, 1.0);
  EXPECT_EQ(half_product.normInf(), 0.0);  // a factor of 2 changes no bit
  result.columns = {to_eigen(residual), to_eigen(product)};
  const auto modes = rigid_body_modes(*bodies, u);
  for (std::size_t n = 0; n < modes->getNumVectors(); ++n) result.columns.push_back(to_eigen(*modes->getVector(n)));
  const auto stresses = bodies->nodal_stresses(local);
  for (std::size_t c = 0; c < stresses->getNumVectors(); ++c) {
    const auto view = stresses->getLocalViewHost(Tpetra::Access::ReadOnly);
    Eigen::VectorXd column(dimension * bodies->mesh()->owned_count());  // as many values as there are dofs
    for (LocalOrdinal node = 0; node < bodies->mesh()->owned_count(); ++node)
      for (int i = 0; i < dimension; ++i) column(dimension * node + i) = view(node, c);
    result.columns.push_back(column);
  }
  const Named<BoundaryConditionOptions> left{"left", {}, {{"body/left", {}}, parse_expression("t*y", {}), {}, {}, {}, {}, {}, {}}};
  const PrescribedMotion motion(*bodies, {left});
  const auto values = motion.values(0.3, failure);
  EXPECT_FALSE(failure);
  for (std::size_t n = 0; n < values.size(); ++n)
    result.prescribed.emplace_back(bodies->space().dofs()->getGlobalElement(motion.dofs()[n]), values[n]);
  result.energy = bodies->stored_energies(local)[0];
  return result;
}

class Assembly : public testing::TestWithParam<std::pair<ElementType, Kinematics>> {};

INSTANTIATE_TEST_SUITE_P(Ranks, Assembly,
                         testing::Values(std::pair(ElementType::h8_f_bar, Kinematics::three_dimensional),
                                         std::pair(ElementType::tet4, Kinematics::three_dimensional),
                                         std::pair(ElementType::q4, Kinematics::plane_strain),
                                         std::pair(ElementType::q4_f_bar, Kinematics::axisymmetric),
                                         std::pair(ElementType::t3, Kinematics::plane_stress)));

TEST_P(Assembly, AgreesWithOneRank) {
  BodySetup setup;
  setup.element = GetParam().first;
  setup.kinematics = GetParam().second;
  setup.law = setup.kinematics == Kinematics::plane_stress ? "st venant kirchhoff" : "hencky";
  setup.cells_x = 9;
  setup.cells_y = 7;
  const Assembled one = assemble(self(), setup), shared = assemble(world(), setup);
  const auto& whole = *one.bodies->space().dofs();
  const auto& part = *shared.bodies->space().dofs();
  ASSERT_EQ(one.columns.size(), shared.columns.size());
  for (std::size_t c = 0; c < one.columns.size(); ++c) {
    const double scale = one.columns[c].cwiseAbs().maxCoeff();
    for (LocalOrdinal dof = 0; dof < static_cast<LocalOrdinal>(local_id_count(part)); ++dof)
      EXPECT_NEAR(shared.columns[c](dof), one.columns[c](whole.getLocalElement(part.getGlobalElement(dof))), 1e-12 * scale) << "column " << c;
  }
  EXPECT_NEAR(shared.energy, one.energy, 1e-13 * one.energy);
  // Each prescribed dof is on the one rank that owns it, with the same value.
  int mine = static_cast<int>(shared.prescribed.size()), all = 0;
  Teuchos::reduceAll(*world(), Teuchos::REDUCE_SUM, 1, &mine, &all);
  EXPECT_EQ(all, static_cast<int>(one.prescribed.size()));
  for (const auto& entry : shared.prescribed)
    EXPECT_TRUE(std::any_of(one.prescribed.begin(), one.prescribed.end(),
                            [&](const auto& other) { return other.first == entry.first && std::abs(other.second - entry.second) < 1e-14; }));
  EXPECT_EQ(static_cast<std::size_t>(shared.bodies->space().graph()->getGlobalNumEntries()), one.bodies->space().graph()->getGlobalNumEntries());
}

// As contact widens it: rows of every third node hold one more column, of a dof that this rank's elements do not know on more ranks than one.
TEST(WiderGraph, GetsTheSameStiffness) {
  BodySetup setup;
  setup.element = ElementType::h8_f_bar;
  setup.kinematics = Kinematics::three_dimensional;
  const auto comm = Tpetra::getDefaultComm();
  const auto bodies = make_distributed(comm, setup);
  const RCP<const Graph> narrow = bodies->space().graph();
  const GlobalOrdinal first = bodies->space().dofs()->getMinAllGlobalIndex(), last = bodies->space().dofs()->getMaxAllGlobalIndex();
  const auto known = local_ids(*narrow->getColMap());
  std::vector<GlobalOrdinal> columns(known.begin(), known.end());
  for (const GlobalOrdinal id : {first, last})
    if (!narrow->getColMap()->isNodeGlobalElement(id)) columns.push_back(id);
  const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  const auto wider_columns = rcp(new const Map(invalid, columns.data(), static_cast<LocalOrdinal>(columns.size()), 0, comm));
  const auto wide = rcp(new Graph(bodies->space().dofs(), wider_columns, longest_local_row(*narrow) + 2));
  for (LocalOrdinal row = 0; row < static_cast<LocalOrdinal>(local_id_count(*bodies->space().dofs())); ++row) {
    Graph::local_inds_host_view_type of_row;
    narrow->getLocalRowView(row, of_row);
    wide->insertLocalIndices(row, static_cast<LocalOrdinal>(of_row.extent(0)), of_row.data());
    for (const GlobalOrdinal id : {first, last})
      if (const LocalOrdinal column = wider_columns->getLocalElement(id); row / 3 % 3 == 0) wide->insertLocalIndices(row, 1, &column);
  }
  wide->fillComplete(bodies->space().dofs(), bodies->space().dofs());
  ASSERT_GT(wide->getGlobalNumEntries(), narrow->getGlobalNumEntries());

  Vector u(bodies->space().dofs()), local(bodies->space().local_dofs()), x(bodies->space().dofs());
  for (const GlobalOrdinal id : local_ids(*bodies->space().dofs())) x.replaceGlobalValue(id, std::sin(1.3 * static_cast<double>(id)));
  std::vector<Eigen::VectorXd> products;
  for (const RCP<const Graph>& graph : {narrow, RCP<const Graph>(wide)}) {
    Matrix matrix(graph);
    std::optional<StepFailure> failure;
    bodies->add_stiffness(local, matrix, failure);
    matrix.fillComplete(bodies->space().dofs(), bodies->space().dofs());
    Vector product(bodies->space().dofs());
    matrix.apply(x, product);
    products.push_back(to_eigen(product));
  }
  EXPECT_LE((products[1] - products[0]).lpNorm<Eigen::Infinity>(), 1e-13 * products[0].lpNorm<Eigen::Infinity>());
}

TEST(Failures, OnOneRankSurfaceOnAll) {
  BodySetup setup;
  setup.cells_x = setup.cells_y = 6;
  const auto bodies = make_test_bodies(world(), setup);
  // Only the elements at the right end are inverted.
  const Vector u = local_field(*bodies, [](double X, double) -> std::array<double, 2> { return {X > 2.99 ? -1.5 : 0.0, 0.0}; });
  Vector residual(bodies->space().dofs());
  std::optional<StepFailure> failure;
  bodies->add_internal_force(u, residual, failure);
  EXPECT_THROW(throw_if_any(*world(), failure), StepFailure);
}

TEST(Refusals, OfABodyAreThrownOnEveryRank) {
  const auto mesh = make_test_mesh(world(), {});
  EXPECT_THROW(Bodies(displacement_space(mesh), Kinematics::plane_stress, 1.0, {{"body", {}, make_material("j2 plasticity"), ElementType::q4}}),
               InputError);
  const auto bodies = make_test_bodies(world(), {});
  const Named<BoundaryConditionOptions> missing{"left", {}, {{"body/lefd", {}}, ScalarFunction(0.0), {}, {}, {}, {}, {}, {}}};
  EXPECT_THROW(PrescribedMotion(*bodies, {missing}), InputError);
}

}  // namespace
}  // namespace mortise
