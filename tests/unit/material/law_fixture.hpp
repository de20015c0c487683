#pragma once
// Deformations to try laws at, and their tangents against differences of the stress.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "mortise/material/plane_stress.hpp"

namespace mortise {

constexpr double bound = 1e-6;  ///< on derivatives, relative

struct Deformation {
  std::string name;
  Matrix3 F;
};

inline Matrix3 rotation(double angle, const Eigen::Vector3d& axis = Eigen::Vector3d::UnitZ()) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

/// Plane states with a hoop stretch: random, (nearly) equal principal stretches, large rotations.
inline std::vector<Deformation> plane_states() {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> uniform(-0.3, 0.3);
  std::vector<Deformation> states;
  for (int n = 0; n < 5; ++n) {
    Matrix3 F = Matrix3::Identity();
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) F(i, j) += uniform(generator);
    F(2, 2) += uniform(generator);
    states.push_back({"random " + std::to_string(n), F});
    states.push_back({"rotated " + std::to_string(n), rotation(2.5) * F});
  }
  states.push_back({"undeformed", Matrix3::Identity()});
  for (double difference : {0.0, 1e-14, 1e-10, 1e-7, 1e-4}) {
    const Eigen::Vector3d two(1.2, 1.2 + difference, 0.8), three(1.2, 1.2 + difference, 1.2 - 2.0 * difference);
    states.push_back({"two stretches apart by " + std::to_string(difference), rotation(0.4) * Matrix3(two.asDiagonal()) * rotation(1.1)});
    states.push_back({"three stretches apart by " + std::to_string(difference), rotation(0.4) * Matrix3(three.asDiagonal()) * rotation(1.1)});
  }
  return states;
}

/// The states of plane_states(), tilted out of the plane.
inline std::vector<Deformation> solid_states() {
  std::vector<Deformation> states = plane_states();
  const Matrix3 tilt = rotation(0.7, {1.0, 2.0, -1.0});
  for (Deformation& state : states) state.F = tilt * state.F * tilt.transpose();
  return states;
}

/// d f / dt at t = 0 by central differences of fourth order: truncation step^4, round-off 1e-16 / step.
template <class Function>
auto difference(const Function& f) {
  constexpr double step = 1e-4;
  return decltype(f(0.0))((8.0 * (f(step) - f(-step)) - (f(2.0 * step) - f(-2.0 * step))) / (12.0 * step));
}

/// Largest deviation of the tangent A (see StressAndTangent) at a history from the difference of the stress, relative to the largest entry.
template <class Components, class AnyLaw>
double tangent_error(const AnyLaw& law, const Matrix3& F, const typename AnyLaw::State& history = {}) {
  const auto result = law.template stress_and_tangent<Components>(F, history);
  EXPECT_LE((result.stress - law.stress(F, history)).norm(), 1e-13 * (1.0 + result.stress.norm()));
  double error = 0.0, largest = 0.0;
  for (int q = 0; q < Components::size; ++q) {
    const int k = Components::row[q], l = Components::column[q];
    const Matrix3 slope = difference([&](double t) {
      // Direction dF = (e_k e_l^T) F, or e_k e_l^T where the geometry is frozen.
      Matrix3 L = Matrix3::Zero();
      L(k, l) = t;
      return Matrix3(law.stress(AnyLaw::small_strain ? Matrix3(F + L) : Matrix3(F + L * F), history));
    });
    for (int p = 0; p < Components::size; ++p) {
      const int i = Components::row[p], j = Components::column[p];
      const double geometric = AnyLaw::small_strain || j != k ? 0.0 : result.stress(i, l);
      error = std::max(error, std::abs(result.tangent(p, q) - (slope(i, j) - geometric)));
      largest = std::max(largest, std::abs(result.tangent(p, q)));
    }
  }
  return error / largest;
}

}  // namespace mortise
