// J2 plasticity by other routes: the whole backward Euler step as one nonlinear system in the components of b_e, with general matrix functions;
// the rate form in principal logarithmic strains.

#include <Eigen/LU>
#include <boost/numeric/odeint.hpp>
#include <unsupported/Eigen/MatrixFunctions>
#include <unsupported/Eigen/NonLinearOptimization>

#include "law_fixture.hpp"
#include "mortise/material/finite_j2.hpp"
#include "plasticity_fixture.hpp"

namespace mortise {
namespace {

using Unknowns = Eigen::Matrix<double, Eigen::Dynamic, 1>;

/// State and law in matrices, without any spectral decomposition.
struct MatrixRoute {
  ElasticConstants elastic;
  Hardening hardening;
  Matrix3 metric = Matrix3::Identity();  ///< C_p^-1
  double alpha = 0.0;

  Matrix3 stress_of(const Matrix3& b) const {
    const Matrix3 e = 0.5 * b.log();
    return elastic.lame_lambda() * e.trace() * Matrix3::Identity() + 2.0 * elastic.shear_modulus() * e;
  }

  static Matrix3 symmetric(const Unknowns& x) { return (Matrix3() << x(0), x(3), x(5), x(3), x(1), x(4), x(5), x(4), x(2)).finished(); }

  /// Of the unknowns b_e and ln x, x the increment of alpha:
  ///   b_e - exp(-x N) b_e^tr exp(-x N) = 0,  N = 3/2 dev tau(b_e) / q(b_e);   (q(b_e) - sigma_y(alpha + x)) / E = 0.
  struct Residual {
    const MatrixRoute& route;
    Matrix3 trial;
    using Scalar = double;
    int operator()(const Unknowns& x, Unknowns& r) const {
      const Matrix3 b = symmetric(x), stress = route.stress_of(b), deviator = stress - stress.trace() / 3.0 * Matrix3::Identity();
      const double q = von_mises(stress), increment = std::exp(x(6));
      const Matrix3 flow = (-1.5 * increment / q * deviator).exp(), difference = b - flow * trial * flow.transpose();
      r.resize(7);
      r << difference(0, 0), difference(1, 1), difference(2, 2), difference(0, 1), difference(1, 2), difference(0, 2),
          (q - yield_stress(route.hardening, route.alpha + increment)) / route.elastic.youngs_modulus;
      return 0;
    }
  };

  /// Takes a step to F and returns the Kirchhoff stress.
  Matrix3 step(const Matrix3& F) {
    const Matrix3 trial = F * metric * F.transpose(), trial_stress = stress_of(trial);
    const double excess = von_mises(trial_stress) - yield_stress(hardening, alpha);
    if (excess <= 0.0) return trial_stress;
    Unknowns x(7), r;
    x << trial(0, 0), trial(1, 1), trial(2, 2), trial(0, 1), trial(1, 2), trial(0, 2), std::log(0.5 * excess / (3.0 * elastic.shear_modulus()));
    Residual residual{*this, trial};
    Eigen::HybridNonLinearSolver<Residual> solver(residual);
    solver.parameters.xtol = 1e-14;
    solver.parameters.maxfev = 4000;
    solver.solveNumericalDiff(x);
    residual(x, r);
    EXPECT_LE(r.norm(), 1e-12) << "the other route did not get there";
    const Matrix3 b = symmetric(x), inverse = F.inverse();
    metric = inverse * b * inverse.transpose();
    alpha += std::exp(x(6));
    return stress_of(b);
  }
};

/// Shear, stretch and turn at once, there and back, out of every plane.
std::vector<Matrix3> general_path() {
  std::vector<Matrix3> path;
  for (int n = 1; n <= 12; ++n) {
    const double t = n / 12.0, wave = std::sin(2.0 * 3.14159265358979 * t);
    Matrix3 L;
    L << 0.25 * t, 0.3 * wave, -0.1 * t, -0.05 * wave, -0.1 * t, 0.15 * wave, 0.2 * t * t, 0.1 * wave, 0.05 * wave - 0.12 * t;
    path.push_back(rotation(1.5 * t, {1.0, 0.5, -0.7}) * L.exp());
  }
  return path;
}

TEST(IndependentPath, WholeSystemSolvedWithMatrixFunctionsGivesTheSame) {
  for (const auto& [name, hardening] : every_hardening()) {
    const FiniteJ2 law(soft, hardening);
    FiniteJ2::State state;
    MatrixRoute route{soft, hardening};
    int step = 0;
    for (const Matrix3& F : general_path()) {
      const Matrix3 stress = law.stress(F, state), expected = route.step(F);
      state = law.updated(F, state);
      EXPECT_LE((stress - expected).norm(), 1e-8 * expected.norm()) << name << " step " << ++step;
      EXPECT_NEAR(state.equivalent_plastic_strain, route.alpha, 1e-8 * (1.0 + route.alpha)) << name << " step " << step;
      const auto& c = state.inverse_plastic_metric;
      const Matrix3 metric = (Matrix3() << c[0], c[3], c[5], c[3], c[1], c[4], c[5], c[4], c[2]).finished();
      EXPECT_LE((metric - route.metric).norm(), 1e-8) << name << " step " << step;
    }
    EXPECT_GT(state.equivalent_plastic_strain, 0.5) << name;
  }
}

/// Principal logarithmic strains E(t) along fixed axes that no coordinate has.
const Matrix3 axes = rotation(0.9, {1.0, -2.0, 0.5});
Matrix3 stretched(const Eigen::Vector3d& E) { return axes * E.array().exp().matrix().asDiagonal() * axes.transpose(); }
Eigen::Vector3d principal(const Matrix3& tensor) { return (axes.transpose() * tensor * axes).diagonal(); }

/// Isochoric and radial up to the strain `begin`; there the path bends away and gains volume.
struct BentPath {
  Eigen::Vector3d begin{0.05, -0.02, -0.03};
  Eigen::Vector3d operator()(double t) const { return begin + Eigen::Vector3d(0.02 * t, 0.12 * t + 0.06 * t * t, -0.01 * t - 0.04 * std::sin(t)); }
  Eigen::Vector3d rate(double t) const { return {0.02, 0.12 + 0.12 * t, -0.01 - 0.04 * std::cos(t)}; }
};

/// Deviator of the Kirchhoff stress and alpha at the end of a radial path to E: q = 3 G (|E| sqrt(2/3) - alpha) = sigma_y(alpha).
std::array<double, 4> radial(const Hardening& hardening, const Eigen::Vector3d& E) {
  const double G3 = 3.0 * soft.shear_modulus(), strain = std::sqrt(2.0 / 3.0) * E.norm();
  double low = 0.0, high = strain;
  for (int n = 0; n < 200; ++n) {
    const double middle = 0.5 * (low + high);
    (G3 * (strain - middle) > yield_stress(hardening, middle) ? low : high) = middle;
  }
  const Eigen::Vector3d deviator = G3 * (strain - low) * std::sqrt(2.0 / 3.0) * E.normalized();
  return {deviator(0), deviator(1), deviator(2), low};
}

TEST(IndependentPath, RadialPathsAreExactInAnyNumberOfSteps) {
  const Eigen::Vector3d end(0.4, -0.1, -0.3);
  for (const auto& [name, hardening] : every_hardening()) {
    const FiniteJ2 law(soft, hardening);
    const auto exact = radial(hardening, end);
    for (const int steps : {1, 3, 50}) {
      FiniteJ2::State state;
      for (int n = 1; n < steps; ++n) state = law.updated(stretched(end * n / steps), state);
      const Eigen::Vector3d stress = principal(law.stress(stretched(end), state));
      EXPECT_NEAR(law.equivalent_plastic_strain(stretched(end), state), exact[3], 1e-8 * exact[3]) << name << " in " << steps;
      EXPECT_LE((stress - Eigen::Vector3d(exact[0], exact[1], exact[2])).norm(), 1e-8 * stress.norm()) << name << " in " << steps;
    }
  }
}

TEST(IndependentPath, BackwardEulerConvergesToTheRateFormWithOrderOne) {
  using Rates = std::array<double, 4>;
  const BentPath path;
  for (const auto& [name, hardening] : every_hardening()) {
    // d s = 2 G (dev dE - dalpha 3/2 s / q),   (3 G + sigma_y') dalpha = 3 G s : dE / q.
    const auto rate = [&hardening = hardening, &path](const Rates& state, Rates& rates, double t) {
      const Eigen::Vector3d s(state[0], state[1], state[2]), E = path.rate(t);
      const double G = soft.shear_modulus(), q = std::sqrt(1.5) * s.norm();
      const double slope = std::visit([&](const auto&law) { return law.slope(state[3]); }, hardening), loading = 3.0 * G * s.dot(E) / q;
      EXPECT_GT(loading, 0.0) << "the path unloads";
      rates[3] = loading / (3.0 * G + slope);
      for (int a = 0; a < 3; ++a) rates[a] = 2.0 * G * (E(a) - E.sum() / 3.0 - rates[3] * 1.5 * s(a) / q);
    };
    Rates exact = radial(hardening, path.begin);
    namespace odeint = boost::numeric::odeint;
    odeint::integrate_adaptive(odeint::make_controlled<odeint::runge_kutta_dopri5<Rates>>(1e-12, 1e-12), rate, exact, 0.0, 1.0, 1e-3);

    const FiniteJ2 law(soft, hardening);
    std::vector<double> errors;
    for (const int steps : {80, 160, 320, 640}) {
      FiniteJ2::State state = law.updated(stretched(path.begin), {});
      for (int n = 1; n <= steps; ++n) state = law.updated(stretched(path(double(n) / steps)), state);
      const Eigen::Vector3d stress = principal(law.stress(stretched(path(1.0)), state)), deviator = stress.array() - stress.mean();
      const Eigen::Vector4d difference(deviator(0) - exact[0], deviator(1) - exact[1], deviator(2) - exact[2],
                                       2.0 * soft.shear_modulus() * (state.equivalent_plastic_strain - exact[3]));
      errors.push_back(difference.norm());
    }
    // The error is c h + O(h^2): orders between neighbours tend to 1 as 1 + O(h).
    for (std::size_t n = 1; n < errors.size(); ++n) EXPECT_NEAR(std::log2(errors[n - 1] / errors[n]), 1.0, 0.1) << name;
  }
}

}  // namespace
}  // namespace mortise
