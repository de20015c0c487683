// Loads that pressures and friction can bear: blocks on a floor, whose answers are in every textbook.

#include "mortise/simulation/run/diagnosis/contact_statics.hpp"

#include <gtest/gtest.h>

#include <Teuchos_DefaultComm.hpp>
#include <cmath>
#include <limits>

namespace mortise {
namespace {

constexpr double round_off = 1e-13;

/// Motions of a block of the plane: along x, along y, turned about its middle, which is `high` above the floor. Places at -1 ... 1 of the floor, each
/// on one rank.
std::vector<BearingCone> on_floor(const Communicator& comm, double friction, double high, int places = 5) {
  std::vector<BearingCone> cones;
  for (int i = comm.getRank(); i < places; i += comm.getSize()) {
    const double x = -1.0 + 2.0 * i / (places - 1);
    BearingCone cone{Eigen::Vector3d(0.0, 1.0, x), Eigen::MatrixXd(3, 1), friction};
    cone.along.col(0) = Eigen::Vector3d(1.0, 0.0, high);
    cones.push_back(cone);
  }
  return cones;
}

Bearing bearing(double friction, double high, const Eigen::Vector3d& load) {
  const auto comm = Teuchos::DefaultComm<int>::getComm();
  return bear(*comm, on_floor(*comm, friction, high), load, round_off).bearing;
}

TEST(ContactStatics, ABlockSlidesBeyondItsFriction) {
  for (const double mu : {0.01, 0.3, 1.0}) {
    EXPECT_EQ(bearing(mu, 0.0, {(1.0 - 1e-9) * mu, -1.0, 0.0}), Bearing::borne) << mu;
    EXPECT_EQ(bearing(mu, 0.0, {(1.0 + 1e-9) * mu, -1.0, 0.0}), Bearing::not_borne) << mu;
    EXPECT_EQ(bearing(mu, 0.0, {-(1.0 + 1e-9) * mu, -1.0, 0.0}), Bearing::not_borne) << mu;
  }
}

// Pushed at its middle by H, under the weight 1: moments about the edge, H high = 1.
TEST(ContactStatics, ATallBlockTipsOver) {
  EXPECT_EQ(bearing(2.0, 2.0, {0.5 - 1e-9, -1.0, 0.0}), Bearing::borne);
  EXPECT_EQ(bearing(2.0, 2.0, {0.5 + 1e-9, -1.0, 0.0}), Bearing::not_borne);
  EXPECT_EQ(bearing(std::numeric_limits<double>::infinity(), 2.0, {0.5 + 1e-9, -1.0, 0.0}), Bearing::not_borne);

  const auto comm = Teuchos::DefaultComm<int>::getComm();
  const BorneLoad tips = bear(*comm, on_floor(*comm, 2.0, 2.0), Eigen::Vector3d(0.6, -1.0, 0.0), round_off);
  ASSERT_EQ(tips.bearing, Bearing::not_borne);
  // At the edge (1, -2) from the middle nothing moves: v = t + w x r = (t_x + 2 w, t_y + w).
  EXPECT_NEAR(tips.missing[0] + 2.0 * tips.missing[2], 0.0, 1e-12);
  EXPECT_NEAR(tips.missing[1] + tips.missing[2], 0.0, 1e-12);
  EXPECT_LT(tips.missing[2], 0.0);  // clockwise
}

TEST(ContactStatics, ABlockIsLiftedOff) {
  const auto comm = Teuchos::DefaultComm<int>::getComm();
  const BorneLoad lifted = bear(*comm, on_floor(*comm, 0.5, 1.0), Eigen::Vector3d(0.0, 2.0, 0.0), round_off);
  EXPECT_EQ(lifted.bearing, Bearing::not_borne);
  EXPECT_NEAR((lifted.missing - Eigen::Vector3d(0.0, 2.0, 0.0)).norm(), 0.0, 1e-15);
  for (const BearingCone& cone : on_floor(*comm, 0.5, 1.0)) EXPECT_LT(resistance(cone, lifted.missing), -0.1);
}

// The rest of a load is a motion on which the load works and no force works against it, the certificate of Farkas' lemma.
TEST(ContactStatics, TheMotionIsACertificate) {
  const auto comm = Teuchos::DefaultComm<int>::getComm();
  for (const Eigen::Vector3d& load : {Eigen::Vector3d(0.9, -1.0, 0.2), Eigen::Vector3d(0.1, -1.0, 1.4), Eigen::Vector3d(-0.4, 0.3, 0.2)}) {
    const std::vector<BearingCone> cones = on_floor(*comm, 0.4, 0.5);
    const BorneLoad borne = bear(*comm, cones, load, round_off);
    ASSERT_EQ(borne.bearing, Bearing::not_borne);
    EXPECT_NEAR(load.dot(borne.missing), borne.missing.squaredNorm(), 1e-12);
    for (const BearingCone& cone : cones) EXPECT_LE(resistance(cone, borne.missing), 1e-9);
  }
}

// In 3D the bound of friction is a circle: a block on three places, pulled in any direction through the middle of its foot.
TEST(ContactStatics, FrictionIsRoundInSpace) {
  const auto comm = Teuchos::DefaultComm<int>::getComm();
  const double mu = 0.3;
  std::vector<BearingCone> cones;
  for (int i = comm->getRank(); i < 3; i += comm->getSize()) {
    const double a = 2.0 * M_PI * i / 3.0, x = std::cos(a), y = std::sin(a);
    BearingCone cone{Eigen::VectorXd::Zero(6), Eigen::MatrixXd::Zero(6, 2), mu};
    cone.push << 0.0, 0.0, 1.0, y, -x, 0.0;
    cone.along.col(0) << 1.0, 0.0, 0.0, 0.0, 0.0, -y;
    cone.along.col(1) << 0.0, 1.0, 0.0, 0.0, 0.0, x;
    cones.push_back(cone);
  }
  for (const double angle : {0.0, 0.4, 1.1, 2.5, 4.0}) {
    const auto pulled = [&](double share) {
      Eigen::VectorXd load(6);
      load << share * mu * std::cos(angle), share * mu * std::sin(angle), -1.0, 0.0, 0.0, 0.0;
      return bear(*comm, cones, load, 1e-11).bearing;
    };
    EXPECT_EQ(pulled(1.0 - 1e-6), Bearing::borne) << angle;
    EXPECT_EQ(pulled(1.0 + 1e-6), Bearing::not_borne) << angle;
  }
}

}  // namespace
}  // namespace mortise
