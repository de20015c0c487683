// One node on a spring: Newton's way through the states of a regularised condition with friction.

#include "mortise/contact/regularised.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <optional>

namespace mortise {
namespace {

constexpr double bound = 0.3, pressure = 1.0;

/// A node that moves along the other side by u, held by a spring k and drawn by f:   k u + z_tau = f,   C(z, u) = 0.
struct NodeOnSpring {
  double k = 1.0, f = 0.0;
  RegularisedNode node;

  NodeOnSpring(double k, double f, double body_stiffness, double tangential_stiffness, double traction) : k(k), f(f) {
    node.normal_stiffness = tangential_stiffness;
    node.tangential_stiffness = tangential_stiffness;
    node.body_stiffness = body_stiffness;
    node.multiplier = Eigen::Vector2d(pressure, traction);
  }

  Complementarity law(double u, const SpatialVector& z) const {
    const auto tresca = [](double) { return FrictionBound{bound, 0.0}; };
    return regularised(node, 0.0, TangentVector::Constant(1, u), 1.0, frame, z, &tresca);
  }

  /// Where z_tau = Pi_rho(lambda_tau + eps u) and the spring are in balance: in stick, or else at the bound.
  double traction() const {
    const double eps = node.tangential_stiffness;
    return std::clamp((k * node.multiplier[1] + eps * f) / (k + eps), -bound, bound);
  }

  /// Newton steps from u and z_tau until the solution is reached; none if 30 do not.
  std::optional<int> steps(double u, double z_tau) const {
    SpatialVector z = pressure * frame.normal + z_tau * frame.tangents.row(0).transpose();
    for (int step = 1; step <= 30; ++step) {
      const Complementarity at = law(u, z);
      const SpatialMatrix inverse = at.C_z.inverse();
      SpatialVector C_u = SpatialVector::Zero(2);
      C_u[1] = at.slip_factor(0, 0);
      const SpatialVector constant = z - inverse * at.C, slope = -inverse * C_u;  // z^{k+1} = constant + slope du
      const double du = (f - k * u - frame.tangents.row(0).dot(constant)) / (k + frame.tangents.row(0).dot(slope));
      z = constant + slope * du;
      u += du;
      const bool there = std::abs(frame.tangents.row(0).dot(z) - traction()) <= 1e-9 && std::abs(k * u + traction() - f) <= 1e-9;
      if (there) return step;
    }
    return std::nullopt;
  }

  Frame frame = make_frame(Eigen::Vector2d(0.0, -1.0), -1);
};

// From slip one way (u = (f - rho) / k, z = rho) the node is taken to slip the other way where y <= -rho, and back for y >= rho. Both happen only
// for k <= c eps / (c + 2 eps), which is below c / 2. Otherwise each of the three states is passed once at most.
TEST(RegularisedNode, FindsItsStateInThreeStepsOnASpringOfHalfTheBodysStiffnessOrMore) {
  const double c = 1.0;
  for (const double eps : {0.1, 1.0, 10.0, 1e3, 1e5})
    for (const double k : {0.5, 1.0, 20.0, 1e3})
      for (const double before : {-0.2, 0.0, 0.3})
        for (int i = -12; i <= 12; ++i)
          for (const double u : {-5.0, -0.1, 0.0, 0.1, 5.0})
            for (const double z_tau : {-0.3, 0.0, 0.2}) {
              const NodeOnSpring node(k, 0.11 * i, c, eps, before);
              const auto steps = node.steps(u, z_tau);
              ASSERT_TRUE(steps) << "eps " << eps << ", k " << k << ", lambda " << before << ", f " << node.f << ", u " << u << ", z " << z_tau;
              EXPECT_LE(*steps, 3) << "eps " << eps << ", k " << k << ", lambda " << before << ", f " << node.f << ", u " << u << ", z " << z_tau;
            }
}

// The threshold itself, for a node without load that starts from slip.
TEST(RegularisedNode, SwingsAcrossTheConeOnASofterSpring) {
  for (const double c : {1.0, 1e6})  // 1e6: as good as the state told by the trial traction alone
    for (const double eps : {1.0, 10.0}) {
      const double softest = c * eps / (c + 2.0 * eps), far = 10.0 * bound / softest;
      EXPECT_TRUE(NodeOnSpring(1.01 * softest, 0.0, c, eps, 0.0).steps(far, bound));
      EXPECT_FALSE(NodeOnSpring(0.99 * softest, 0.0, c, eps, 0.0).steps(far, bound));
    }
}

// As the exact conditions: round-off of a traction at the bound does not choose the derivative, and nothing changes C = z_tau - Pi_rho(y).
TEST(RegularisedNode, SlipsAtTheBoundUpToRoundOff) {
  const NodeOnSpring node(1.0, 0.0, 1.0, 10.0, bound);
  const auto at = [&](double off) {
    const SpatialVector z = pressure * node.frame.normal + bound * (1.0 + 11.0 * off) * node.frame.tangents.row(0).transpose();
    return node.law(0.0, z);  // y = 10/11 z_tau + 1/11 lambda_tau = rho (1 + 10 off)
  };
  for (const double off : {-1e-11, -1e-15, 0.0, 1e-15}) {
    EXPECT_EQ(at(off).state, ContactState::slip) << off;
    EXPECT_NEAR(at(off).C[1], bound * std::max(off, 11.0 * off), 1e-15) << off;
  }
  EXPECT_EQ(at(-1e-8).state, ContactState::stick);
}

}  // namespace
}  // namespace mortise
