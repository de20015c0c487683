// Every law: stress against the derivative of its energy, tangent against the derivative of its stress.

#include <gtest/gtest.h>

#include <string>

#include "law_fixture.hpp"
#include "mortise/material/materials.hpp"

namespace mortise {
namespace {

template <class Kind>
class EveryLaw : public testing::Test {};
using Kinds = testing::Types<Hencky, NeoHooke, CiarletNeoHooke, StVenantKirchhoff, SmallStrainLinear>;
TYPED_TEST_SUITE(EveryLaw, Kinds);

TYPED_TEST(EveryLaw, StressIsTheDerivativeOfTheEnergy) {
  for (double nu : {-0.5, 0.0, 0.3, 0.49}) {
    const TypeParam law(ElasticConstants{1000.0, nu});
    for (const Deformation& state : solid_states()) {
      Matrix3 P;
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l) {
          Matrix3 direction = Matrix3::Zero();
          direction(k, l) = 1.0;
          P(k, l) = difference([&](double t) { return law.energy(Matrix3(state.F + t * direction)); });
        }
      const Matrix3 stress = TypeParam::small_strain ? P : Matrix3(P * state.F.transpose());
      EXPECT_LE((law.stress(state.F) - stress).norm(), bound * (law.stress(state.F).norm() + 1000.0)) << state.name << " nu " << nu;
    }
  }
}

TYPED_TEST(EveryLaw, TangentIsTheDerivativeOfTheStress) {
  for (double nu : {-0.5, 0.0, 0.3, 0.49}) {
    const Unconstrained<TypeParam> law{TypeParam(ElasticConstants{1000.0, nu})};
    for (const Deformation& state : plane_states()) {
      EXPECT_LE(tangent_error<PlaneComponents>(law, state.F), bound) << state.name << " nu " << nu;
      EXPECT_LE(tangent_error<AxisymmetricComponents>(law, state.F), bound) << state.name << " nu " << nu;
    }
    for (const Deformation& state : solid_states()) EXPECT_LE(tangent_error<SolidComponents>(law, state.F), bound) << state.name << " nu " << nu;
  }
}

TYPED_TEST(EveryLaw, ObeysHookesLawAtTheReferenceState) {
  const ElasticConstants constants{210.0, 0.3};
  const TypeParam law(constants);
  const auto tangent = law.template stress_and_tangent<SolidComponents>(Matrix3::Identity()).tangent;
  for (int q = 0; q < 9; ++q)
    for (int p = 0; p < 9; ++p) {
      const int i = p / 3, j = p % 3, k = q / 3, l = q % 3;
      const double hooke = constants.lame_lambda() * (i == j && k == l) + constants.shear_modulus() * ((i == k && j == l) + (i == l && j == k));
      EXPECT_NEAR(tangent(p, q), hooke, 1e-12 * 210.0);
    }
  EXPECT_LE(law.stress(Matrix3::Identity()).norm(), 1e-13 * 210.0);
}

template <class Kind>
class FiniteStrainLaw : public testing::Test {};
using FiniteStrainKinds = testing::Types<Hencky, NeoHooke, CiarletNeoHooke, StVenantKirchhoff>;
TYPED_TEST_SUITE(FiniteStrainLaw, FiniteStrainKinds);

TYPED_TEST(FiniteStrainLaw, IsObjective) {
  const TypeParam law(ElasticConstants{1000.0, 0.3});
  for (const Deformation& state : solid_states()) {
    const Matrix3 Q = Eigen::AngleAxisd(2.0, Eigen::Vector3d(1.0, -1.0, 0.5).normalized()).toRotationMatrix();
    EXPECT_LE((law.stress(Q * state.F) - Q * law.stress(state.F) * Q.transpose()).norm(), 1e-11 * 1000.0) << state.name;
    EXPECT_LE(law.stress(Q).norm(), 1e-12 * 1000.0);
  }
}

TYPED_TEST(EveryLaw, HasAPlaneStressForm) {
  for (double nu : {-0.5, 0.0, 0.3, 0.49}) {
    const PlaneStress<TypeParam> law{TypeParam(ElasticConstants{1000.0, nu})};
    for (const Deformation& state : plane_states()) {
      const Matrix3 F = law.deformation(state.F);
      if (std::is_same_v<TypeParam, StVenantKirchhoff> && nu == 0.49 && F(2, 2) == 0.0) continue;  // it leaves no thickness
      const Matrix3 stress = law.stress(state.F, {});
      EXPECT_LE(std::abs(stress(2, 2)), 1e-11 * 1000.0) << state.name << " nu " << nu;
      EXPECT_LE(tangent_error<PlaneComponents>(law, state.F), bound) << state.name << " nu " << nu;
      // As W is least in F_33, the derivatives of that least value are the in-plane stresses.
      Matrix3 P = Matrix3::Zero();
      for (int k = 0; k < 2; ++k)
        for (int l = 0; l < 2; ++l) {
          Matrix3 direction = Matrix3::Zero();
          direction(k, l) = 1.0;
          P(k, l) = difference([&](double t) { return law.energy(Matrix3(state.F + t * direction)); });
        }
      const Matrix3 expected = TypeParam::small_strain ? P : Matrix3(P * F.transpose());
      EXPECT_LE((stress - expected).norm(), bound * (stress.norm() + 1000.0)) << state.name << " nu " << nu;
    }
  }
}

/// Those whose plane stress form is the law itself with another lambda.
template <class Kind>
class ReducedLaw : public testing::Test {};
using ReducedKinds = testing::Types<StVenantKirchhoff, SmallStrainLinear>;
TYPED_TEST_SUITE(ReducedLaw, ReducedKinds);

TYPED_TEST(ReducedLaw, IsTheLawWithLambdaOfPlaneStress) {
  const ElasticConstants constants{1000.0, 0.3};
  const PlaneStress<TypeParam> law{TypeParam(constants)};
  for (const Deformation& state : plane_states()) {
    const Matrix3 stress = law.stress(state.F, {});
    // The in-plane law with lambda* = 2 lambda mu / (lambda + 2 mu), written down on its own.
    const Eigen::Matrix2d F = state.F.topLeftCorner<2, 2>(), I = Eigen::Matrix2d::Identity();
    const Eigen::Matrix2d E =
        TypeParam::small_strain ? Eigen::Matrix2d(0.5 * (F + F.transpose()) - I) : Eigen::Matrix2d(0.5 * (F.transpose() * F - I));
    const Eigen::Matrix2d S = constants.plane_stress_lambda() * E.trace() * I + 2.0 * constants.shear_modulus() * E;
    const Eigen::Matrix2d expected = TypeParam::small_strain ? S : Eigen::Matrix2d(F * S * F.transpose());
    EXPECT_LE((stress.topLeftCorner<2, 2>() - expected).norm(), 1e-11 * 1000.0) << state.name;
  }
}

TEST(NeoHooke, IsContinuousInPoissonsRatioAtZero) {
  const Matrix3 F = plane_states()[0].F;
  const NeoHooke at(ElasticConstants{1000.0, 0.0}), near(ElasticConstants{1000.0, 1e-9});
  EXPECT_NEAR(at.energy(F), near.energy(F), 1e-8 * 1000.0);
  EXPECT_LE((at.stress(F) - near.stress(F)).norm(), 1e-8 * 1000.0);
}

TEST(Hencky, UniaxialStressIsYoungsModulusTimesLogarithmicStrain) {
  // tau = E ln(stretch) with lateral stretches stretch^-nu: the defining property of the law.
  const double stretch = 1.7, nu = 0.3, lateral = std::pow(stretch, -nu);
  const Hencky law(ElasticConstants{1000.0, nu});
  const Matrix3 stress = law.stress(Eigen::Vector3d(stretch, lateral, lateral).asDiagonal());
  EXPECT_NEAR(stress(0, 0), 1000.0 * std::log(stretch), 1e-10);
  EXPECT_NEAR(stress(1, 1), 0.0, 1e-10);
}

TEST(MaterialRegistry, NamesEveryLawAndMakesIt) {
  ASSERT_EQ(material_registry().entries().size(), std::variant_size_v<Law>);
  for (std::size_t n = 0; n < material_registry().entries().size(); ++n) {
    const auto& entry = material_registry().entries()[n];
    const auto options = entry.make();
    EXPECT_EQ(options->law().index(), n);
    EXPECT_EQ(entry.name, std::visit([](const auto& law) { return std::string(law.name); }, options->law()));
  }
}

}  // namespace
}  // namespace mortise
