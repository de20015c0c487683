// Residual, matrix, heat and stresses of bodies with a temperature are the same on several ranks.

#include <gtest/gtest.h>

#include "mortise/core/trilinos_versions.hpp"
#include "mortise/mesh/volume_generators.hpp"
#include "thermal_test_support.hpp"

namespace mortise {
namespace {

RCP<const Mesh> make_distributed_mesh(const RCP<const Communicator>& comm, const ThermalSetup& setup) {
  if (dimension(setup.kinematics) == 2) {
    BodySetup plane;
    plane.element = setup.element;
    plane.kinematics = setup.kinematics;
    plane.cells_x = 8;
    plane.cells_y = 5;
    return make_test_mesh(comm, plane);
  }
  auto brick = std::make_shared<BrickMesh>();
  brick->cells_x = 4;
  brick->cells_y = 3;
  brick->cells_z = 2;
  brick->translation = {2.0, 0.0, 0.0};
  return build_mesh(comm, {{"body", {}, brick, cell_shape(setup.element)}}, {});
}

struct Assembled {
  std::shared_ptr<Bodies> bodies;
  std::vector<Eigen::VectorXd> columns;  ///< on the owned dofs: residual, J v
  double heat = 0.0, energy = 0.0, work = 0.0;
};

Assembled assemble(const RCP<const Communicator>& comm, const ThermalSetup& setup) {
  Assembled result;
  const auto bodies = result.bodies = make_thermal_bodies(thermal_space(make_distributed_mesh(comm, setup)), setup);
  bodies->commit(thermal_state(*bodies, stretched(0.6), warm(320.0)));
  const Vector x = thermal_state(*bodies, stretched(1.0), warm(350.0));
  Vector residual(bodies->space().dofs()), product(bodies->space().dofs()), owned(bodies->space().dofs());
  Matrix matrix(bodies->space().graph());
  std::optional<StepFailure> failure;
  bodies->add_internal_force_and_stiffness(x, residual, matrix, failure, 1.0, step_length);
  EXPECT_FALSE(failure);
  matrix.fillComplete(bodies->space().dofs(), bodies->space().dofs());
  {
    const auto from = x.getLocalViewHost(Tpetra::Access::ReadOnly);
    auto to = owned.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (std::size_t n = 0; n < to.extent(0); ++n) to(n, 0) = from(n, 0);
  }
  matrix.apply(owned, product);
  result.columns = {to_eigen(residual), to_eigen(product)};
  result.heat = bodies->heat_powers(x, step_length)[0];
  result.energy = bodies->stored_energies(x)[0];
  result.work = bodies->plastic_works(x)[0];
  return result;
}

class ThermalAssembly : public testing::TestWithParam<ThermalSetup> {};
INSTANTIATE_TEST_SUITE_P(Ranks, ThermalAssembly,
                         testing::Values(ThermalSetup{ElementType::h8_f_bar, "j2 plasticity", Kinematics::three_dimensional, true, 0.5},
                                         ThermalSetup{ElementType::tet4, "hencky", Kinematics::three_dimensional},
                                         ThermalSetup{ElementType::q4_f_bar, "j2 plasticity", Kinematics::axisymmetric},
                                         ThermalSetup{ElementType::t3, "neo hooke", Kinematics::plane_stress, true, 0.5}));

TEST_P(ThermalAssembly, AgreesWithOneRank) {
  const Assembled one = assemble(self(), GetParam()), shared = assemble(world(), GetParam());
  const Map &whole = *one.bodies->space().dofs(), &part = *shared.bodies->space().dofs();
  for (std::size_t c = 0; c < one.columns.size(); ++c)
    for (std::size_t field = 0; field < 2; ++field) {
      const auto in_field = [&](const Assembled& of, LocalOrdinal dof) { return of.bodies->space().place(dof).field == field; };
      double scale = 0.0;
      for (LocalOrdinal dof = 0; dof < static_cast<LocalOrdinal>(local_id_count(whole)); ++dof)
        if (in_field(one, dof)) scale = std::max(scale, std::abs(one.columns[c](dof)));
      EXPECT_GT(scale, 0.0);
      for (LocalOrdinal dof = 0; dof < static_cast<LocalOrdinal>(local_id_count(part)); ++dof)
        if (in_field(shared, dof))
          EXPECT_NEAR(shared.columns[c](dof), one.columns[c](whole.getLocalElement(part.getGlobalElement(dof))), 1e-11 * scale) << "column " << c;
    }
  EXPECT_NEAR(shared.heat, one.heat, 1e-12 * std::abs(one.heat));
  EXPECT_NEAR(shared.energy, one.energy, 1e-12 * one.energy);
  EXPECT_NEAR(shared.work, one.work, 1e-12 * one.work);
  EXPECT_EQ(shared.bodies->heat(), one.bodies->heat());
}

}  // namespace
}  // namespace mortise
