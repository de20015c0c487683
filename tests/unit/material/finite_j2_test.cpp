// J2 plasticity at finite strain: tangents, objectivity, histories.

#include "mortise/material/finite_j2.hpp"

#include "law_fixture.hpp"
#include "plasticity_fixture.hpp"

namespace mortise {
namespace {

using State = FiniteJ2::State;

/// Flows first one way, then another, in one plane, so that the history has no axes in common with what comes.
State strained(const FiniteJ2& law, const Matrix3& tilt = Matrix3::Identity()) {
  Matrix3 first = Matrix3::Identity(), second;
  first(0, 1) = 0.2;
  second << 1.15, 0.1, 0.0, -0.05, 0.9, 0.0, 0.0, 0.0, 1.05;
  State state;
  for (const Matrix3& F : {first, second}) state = law.updated(tilt * F * tilt.transpose(), state);
  EXPECT_GT(state.equivalent_plastic_strain, 0.1);
  return state;
}

const Matrix3 tilt = rotation(0.7, {1.0, 2.0, -1.0});

TEST(FiniteJ2, IsHenckysLawBelowTheYieldStress) {
  const FiniteJ2 law(soft, PerfectPlasticity{1e5});
  const Hencky hencky(soft);
  for (const auto& [name, F] : solid_states()) {
    EXPECT_LE((law.stress(F, {}) - hencky.stress(F)).norm(), 1e-12 * 1000.0) << name;
    EXPECT_DOUBLE_EQ(law.energy(F, {}), hencky.energy(F)) << name;
    EXPECT_EQ(law.equivalent_plastic_strain(F, {}), 0.0) << name;
    EXPECT_EQ(law.updated(F, {}).inverse_plastic_metric, State().inverse_plastic_metric) << name;
  }
}

TEST(FiniteJ2, StressStaysOnOrWithinTheYieldSurfaceAndPressureIsElastic) {
  for (const auto& [hardening_name, hardening] : every_hardening()) {
    const FiniteJ2 law(soft, hardening);
    const State history = strained(law, tilt);
    for (const auto& [name, F] : solid_states()) {
      const Matrix3 stress = law.stress(F, history);
      const double alpha = law.equivalent_plastic_strain(F, history), yield = yield_stress(hardening, alpha);
      EXPECT_LE(von_mises(stress), yield * (1.0 + 1e-10)) << hardening_name << " " << name;
      if (alpha > history.equivalent_plastic_strain) EXPECT_GE(von_mises(stress), yield * (1.0 - 1e-10)) << hardening_name << " " << name;
      EXPECT_NEAR(stress.trace(), 3.0 * soft.bulk_modulus() * std::log(F.determinant()), 1e-9 * 1000.0) << hardening_name << " " << name;
    }
  }
}

TEST(FiniteJ2, TangentIsTheDerivativeOfTheStress) {
  for (const auto& [hardening_name, hardening] : every_hardening()) {
    const Unconstrained<FiniteJ2> law{FiniteJ2(soft, hardening)};
    int plastic = 0;
    for (const State& history : {State(), strained(law.law)})
      for (const auto& [name, F] : plane_states()) {
        plastic += law.law.equivalent_plastic_strain(F, history) > history.equivalent_plastic_strain;
        EXPECT_LE(tangent_error<PlaneComponents>(law, F, history), bound) << hardening_name << " " << name;
        EXPECT_LE(tangent_error<AxisymmetricComponents>(law, F, history), bound) << hardening_name << " " << name;
      }
    for (const State& history : {State(), strained(law.law, tilt)})
      for (const auto& [name, F] : solid_states()) EXPECT_LE(tangent_error<SolidComponents>(law, F, history), bound) << hardening_name << " " << name;
    EXPECT_GE(plastic, 30) << hardening_name;  // of 42; with the undeformed and the hydrostatic states the rest is elastic
  }
}

TEST(FiniteJ2, TangentOfUnloadingIsThatOfElasticity) {
  for (const auto& [hardening_name, hardening] : every_hardening()) {
    const Unconstrained<FiniteJ2> law{FiniteJ2(soft, hardening)};
    const State history = strained(law.law);
    // From the state of the history half the way to where the elastic strain is gone.
    const Matrix3 F = (Matrix3() << 1.15, 0.1, 0.0, -0.05, 0.9, 0.0, 0.0, 0.0, 1.05).finished();
    const Matrix3 deviator = law.stress(F, history) - law.stress(F, history).trace() / 3.0 * Matrix3::Identity();
    const Matrix3 back = (Matrix3::Identity() - 0.5 / (2.0 * soft.shear_modulus()) * deviator) * F;
    EXPECT_EQ(law.law.equivalent_plastic_strain(back, history), history.equivalent_plastic_strain) << hardening_name;
    EXPECT_LT(von_mises(law.stress(back, history)), 0.7 * von_mises(law.stress(F, history))) << hardening_name;
    EXPECT_LE(tangent_error<PlaneComponents>(law, back, history), bound) << hardening_name;
    EXPECT_LE(tangent_error<AxisymmetricComponents>(law, back, history), bound) << hardening_name;
    EXPECT_LE(tangent_error<SolidComponents>(law, back, history), bound) << hardening_name;
    // The same as a law that never flows, with the same C_p.
    const Unconstrained<FiniteJ2> never{FiniteJ2(soft, PerfectPlasticity{1e6})};
    EXPECT_EQ(law.stress_and_tangent<SolidComponents>(back, history).tangent, never.stress_and_tangent<SolidComponents>(back, history).tangent);
  }
}

TEST(FiniteJ2, IsObjective) {
  const Matrix3 Q = rotation(2.0, {1.0, -1.0, 0.5});
  for (const auto& [hardening_name, hardening] : every_hardening()) {
    const FiniteJ2 law(soft, hardening);
    for (const auto& [name, F] : solid_states()) {
      // The observer turns while the material flows: C_p does not see it.
      State still, turned;
      const Matrix3 half = Matrix3::Identity() + 0.5 * (F - Matrix3::Identity());
      still = law.updated(half, still);
      turned = law.updated(rotation(-0.8, {0.3, 1.0, 0.2}) * half, turned);
      for (int c = 0; c < 6; ++c) EXPECT_NEAR(still.inverse_plastic_metric[c], turned.inverse_plastic_metric[c], 1e-12) << name;
      EXPECT_LE((law.stress(Q * F, turned) - Q * law.stress(F, still) * Q.transpose()).norm(), 1e-11 * 1000.0) << hardening_name << " " << name;
    }
  }
}

TEST(FiniteJ2, IsIsotropic) {
  // A reference configuration turned by Q: F Q^T, and C_p^-1 turned.
  const Matrix3 Q = rotation(2.0, {1.0, -1.0, 0.5});
  for (const auto& [hardening_name, hardening] : every_hardening()) {
    const FiniteJ2 law(soft, hardening);
    const State history = strained(law);
    const auto& c = history.inverse_plastic_metric;
    const Matrix3 metric = (Matrix3() << c[0], c[3], c[5], c[3], c[1], c[4], c[5], c[4], c[2]).finished(), turned = Q * metric * Q.transpose();
    const State turned_history{{turned(0, 0), turned(1, 1), turned(2, 2), turned(0, 1), turned(1, 2), turned(0, 2)},
                               history.equivalent_plastic_strain};
    for (const auto& [name, F] : solid_states()) {
      EXPECT_LE((law.stress(F * Q.transpose(), turned_history) - law.stress(F, history)).norm(), 1e-11 * 1000.0) << hardening_name << " " << name;
    }
  }
}

TEST(FiniteJ2, PlasticFlowKeepsTheVolume) {
  for (const auto& [name, hardening] : every_hardening()) {
    const auto& c = strained(FiniteJ2(soft, hardening), tilt).inverse_plastic_metric;
    const Matrix3 metric = (Matrix3() << c[0], c[3], c[5], c[3], c[1], c[4], c[5], c[4], c[2]).finished();
    EXPECT_NEAR(metric.determinant(), 1.0, 1e-13) << name;
  }
}

TEST(FiniteJ2, CommittingTwiceChangesNothing) {
  for (const auto& [hardening_name, hardening] : every_hardening()) {
    const FiniteJ2 law(soft, hardening);
    for (const auto& [name, F] : solid_states()) {
      const State history = strained(law, tilt), once = law.updated(F, history), twice = law.updated(F, once);
      EXPECT_LE((law.stress(F, once) - law.stress(F, history)).norm(), 1e-12 * 1000.0) << hardening_name << " " << name;
      EXPECT_EQ(once.equivalent_plastic_strain, law.equivalent_plastic_strain(F, history)) << hardening_name << " " << name;
      EXPECT_EQ(twice.equivalent_plastic_strain, once.equivalent_plastic_strain) << hardening_name << " " << name;
      EXPECT_EQ(twice.inverse_plastic_metric, once.inverse_plastic_metric) << hardening_name << " " << name;
    }
  }
}

TEST(FiniteJ2, FirstPlasticIncrementOfLudwikOverTwelveDecades) {
  // Isochoric tension that stretches r beyond the strain at yield, from alpha = 0. A state within 1e-12 of yield counts as elastic.
  for (const auto& [elastic, hardening] : {std::pair{steel, steel_hardening}, {aluminium, aluminium_hardening}}) {
    const FiniteJ2 law(elastic, hardening);
    const double yield_strain = hardening.initial_yield_stress / (3.0 * elastic.shear_modulus());
    double last = 0.0;
    for (double r = 1e-11; r < 20.0; r *= std::pow(10.0, 0.25)) {
      const double strain = yield_strain * (1.0 + r);
      const Matrix3 F = Eigen::Vector3d(std::exp(strain), std::exp(-0.5 * strain), std::exp(-0.5 * strain)).asDiagonal();
      const double alpha = law.equivalent_plastic_strain(F, {}), yield = hardening.yield_stress(alpha);
      const auto result = law.stress_and_tangent<SolidComponents>(F, {});
      EXPECT_GT(alpha, last) << "beyond yield by " << r;
      EXPECT_NEAR(von_mises(result.stress), yield, 1e-12 * yield) << "beyond yield by " << r;
      EXPECT_TRUE(result.tangent.allFinite()) << "beyond yield by " << r;
      last = alpha;
    }
  }
}

TEST(FiniteJ2, GivesNoNumberForAnInvertedOrEndlessDeformation) {
  const FiniteJ2 law(soft, LudwikHardening{10.0, 8.0, 0.21});
  EXPECT_FALSE(law.stress(Matrix3::Zero(), {}).allFinite());
  EXPECT_FALSE(law.stress(Matrix3::Constant(std::numeric_limits<double>::infinity()), {}).allFinite());
}

}  // namespace
}  // namespace mortise
