// Forces and stiffness of one pass over the elements are those of two passes.

#include <gtest/gtest.h>

#include "solid_test_support.hpp"

namespace mortise {
namespace {

/// Forces of both passes, and whether the stiffness of both has the same bits.
struct Passes {
  Eigen::VectorXd of_two, of_one;
  bool equal_stiffness = false;
};

Passes passes(const Bodies& bodies, const Vector& u) {
  Passes result;
  std::optional<StepFailure> failure;
  Vector force(bodies.space().dofs()), force_with_stiffness(bodies.space().dofs());
  Matrix stiffness(bodies.space().graph()), stiffness_with_force(bodies.space().graph());
  bodies.add_internal_force(u, force, failure);
  bodies.add_stiffness(u, stiffness, failure, 0.75);
  bodies.add_internal_force_and_stiffness(u, force_with_stiffness, stiffness_with_force, failure, 0.75);
  EXPECT_FALSE(failure);
  result.of_two = to_eigen(force);
  result.of_one = to_eigen(force_with_stiffness);
  result.equal_stiffness = to_dense(stiffness) == to_dense(stiffness_with_force);
  return result;
}

void expect_one_force(const Bodies& bodies, const Vector& u, const std::string& where) {
  const Passes found = passes(bodies, u);
  EXPECT_TRUE(found.equal_stiffness) << where;
  // A law may sum the stress alone in another order than the stress with its tangent.
  EXPECT_LE((found.of_one - found.of_two).lpNorm<Eigen::Infinity>(), 1e-14 * found.of_two.lpNorm<Eigen::Infinity>()) << where;
}

TEST(OnePass, HasTheForceAndTheStiffnessOfTwo) {
  for (const auto& [element_name, element] : element_names())
    for (const auto& material : material_registry().entries())
      for (const auto& [kinematics_name, kinematics] : kinematics_names()) {
        if (!check_combination({"body", {}, make_material(material.name), element}, kinematics).empty()) continue;
        const std::string where = element_name + ", " + material.name + ", " + kinematics_name;
        if (dimension(kinematics) == 3) {
          BrickSetup setup;
          setup.element = element;
          setup.law = material.name;
          const auto bodies = make_brick(setup);
          const Vector u = to_local(*bodies, space_field(*bodies, [](const Point3& X) -> Point3 {
            return {0.2 * X[0] + 0.05 * std::sin(2.0 * X[1]), -0.1 * X[1] + 0.03 * X[2], 0.04 * std::cos(X[0] - X[2])};
          }));
          expect_one_force(*bodies, u, where);
          bodies->commit(u);
          expect_one_force(*bodies, u, where + ", committed");
        } else {
          BodySetup setup;
          setup.element = element;
          setup.law = material.name;
          setup.kinematics = kinematics;
          const auto bodies = make_test_bodies(self(), setup);
          const Vector u = local_field(*bodies, [](double X, double Y) -> std::array<double, 2> {
            return {0.2 * (X - 2.0) + 0.05 * std::sin(2.0 * X + Y), -0.1 * Y + 0.03 * std::cos(X - 3.0 * Y)};
          });
          expect_one_force(*bodies, u, where);
        }
      }
}

}  // namespace
}  // namespace mortise
