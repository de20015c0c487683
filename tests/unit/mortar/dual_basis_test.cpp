// Properties of D, M and the gap: sums, biorthogonality, slivers, crosspoints, and integrals by brute force.

#include <gtest/gtest.h>

#include "surface_pair.hpp"

namespace mortise {
namespace {

using namespace test;

/// A flat slave over [0, length] at `height` and a flat master over [low, high] at y = 0.
TwoLines flat(int slave_facets, double length, int master_facets, double low, double high, double height = 0.0) {
  TwoLines lines;
  lines.slave = line(slave_facets, 0.0, length, [&](double) { return height; });
  lines.master = line(
      master_facets, low, high, [](double) { return 0.0; }, true);
  return lines;
}

TwoLines curved() {
  TwoLines lines;
  lines.slave = line(5, 0.0, 5.0, [](double x) { return 0.2 + 0.05 * (x - 2.0) * (x - 2.0); });
  lines.master = line(
      11, -1.3, 6.4, [](double x) { return 0.12 * std::sin(1.3 * x); }, true);
  lines.options.search_reach = 2.0;
  return lines;
}

/// max |sum_k D_jk - sum_l M_jl| / A_j
double row_sum_error(const SurfacePair& pair) {
  const DenseCoupling dense = pair.dense();
  const Eigen::VectorXd error = dense.D.rowwise().sum() - dense.M.rowwise().sum();
  return error.cwiseAbs().cwiseQuotient(pair.weights()).maxCoeff();
}

TEST(MortarSums, RowsOfDAndMAgree) {
  std::vector<TwoLines> cases = {curved(), flat(3, 3.0, 3, 0.0, 3.0), flat(1, 1.0, 7, 0.0, 1.0), flat(7, 1.0, 1, 0.0, 1.0),
                                 flat(4, 4.0, 3, 1.3, 2.9)};
  cases.push_back(curved());
  cases.back().measure.axisymmetric = true;
  cases.push_back(curved());
  cases.back().fixed_x = cases.back().fixed_y = {0, 3};
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const auto pair = evaluated(cases[i]);
    ASSERT_FALSE(pair->failure);
    EXPECT_GT(pair->dense().D.trace(), 0.0) << i;
    EXPECT_LT(row_sum_error(*pair), 1e-12) << i;
  }
}

// int phi_j N_k over a slave surface that lies on its master with the same nodes: M is the mirrored D.
TEST(MortarDualBasis, IsBiorthogonalOnAMatchingMesh) {
  for (const bool axisymmetric : {false, true}) {
    TwoLines lines = flat(4, 3.0, 4, 0.0, 3.0);
    lines.measure.axisymmetric = axisymmetric;
    const auto pair = evaluated(lines);
    const DenseCoupling dense = pair->dense();
    const Eigen::MatrixXd expected = pair->weights().asDiagonal();
    EXPECT_LT((dense.D - expected).cwiseAbs().maxCoeff(), 1e-13 * expected.maxCoeff());
    EXPECT_LT((dense.M.rowwise().reverse() - expected).cwiseAbs().maxCoeff(), 1e-12 * expected.maxCoeff());
  }
}

// A linear field on both sides is transferred exactly: int phi_j (u_slave - u_master) = 0, on any mesh and any cover.
TEST(MortarDualBasis, TransfersLinearFieldsOnAnyCover) {
  for (const auto& [slaves, masters, low, high] : std::vector<std::tuple<int, int, double, double>>{{1, 7, -0.2, 1.3},
                                                                                                    {7, 1, -0.2, 1.3},
                                                                                                    {3, 4, 0.21, 1.4},
                                                                                                    {3, 4, 0.21, 0.83},
                                                                                                    {5, 2, 0.5, 0.55},
                                                                                                    {1, 1, 1.0 - 1e-3, 2.0},
                                                                                                    {1, 1, 1.0 - 1e-6, 2.0}}) {
    const TwoLines lines = flat(slaves, 1.0, masters, low, high);
    const auto pair = evaluated(lines);
    const DenseCoupling dense = pair->dense();
    ASSERT_GT(dense.D.trace(), 0.0) << low << " " << high;
    EXPECT_EQ((dense.D - Eigen::MatrixXd(dense.D.diagonal().asDiagonal())).cwiseAbs().maxCoeff(), 0.0);
    Eigen::VectorXd x_slave(lines.slave.size()), x_master(lines.master.size());
    for (std::size_t n = 0; n < lines.slave.size(); ++n) x_slave[n] = lines.slave[n].x();
    for (std::size_t n = 0; n < lines.master.size(); ++n) x_master[n] = lines.master[n].x();
    const Eigen::VectorXd error = dense.D * x_slave - dense.M * x_master;
    EXPECT_LT(error.cwiseAbs().cwiseQuotient(pair->weights()).maxCoeff(), 1e-12) << low << " " << high;
    EXPECT_LT(row_sum_error(*pair), 1e-12) << low << " " << high;
  }
}

// On a cover [1 - e, 1] of a facet [0, 1]: D_b = e - e^2/2, D_a = e^2/2.
TEST(MortarDualBasis, CarriesASliver) {
  for (const double e : {1e-2, 1e-4, 1e-5}) {
    const auto pair = evaluated(flat(1, 1.0, 1, 1.0 - e, 2.0));
    const DenseCoupling dense = pair->dense();
    EXPECT_NEAR(dense.D(1, 1), e - 0.5 * e * e, 1e-14) << e;
    EXPECT_NEAR(dense.D(0, 0), 0.5 * e * e, 1e-14) << e;
  }
  // below 1e-12 of its full weight a node gets nothing from this facet; the other keeps its exact weight
  const auto pair = evaluated(flat(1, 1.0, 1, 1.0 - 1e-7, 2.0));
  EXPECT_EQ(pair->dense().D(0, 0), 0.0);
  EXPECT_EQ(pair->dense().gap[0], 0.0);
  EXPECT_NEAR(pair->dense().D(1, 1), 1e-7, 2e-14);
}

TEST(MortarCrosspoint, GivesItsShareToTheNeighbours) {
  TwoLines lines = curved();
  const DenseCoupling all = evaluated(lines)->dense();
  lines.fixed_x = lines.fixed_y = {2};
  const auto pair = evaluated(lines);
  const DenseCoupling dense = pair->dense();
  EXPECT_FALSE(pair->interface->slave_nodes()[2].carries_multiplier);
  EXPECT_EQ(dense.D.row(2).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_EQ(dense.M.row(2).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_EQ(dense.gap[2], 0.0);
  EXPECT_GT(dense.D(1, 2), 0.0);
  EXPECT_GT(dense.D(3, 2), 0.0);
  // sum phi = 1: nothing is lost of the weights, of the forces on the master, of the gap
  EXPECT_NEAR(dense.D.sum(), all.D.sum(), 1e-12);
  EXPECT_LT((dense.M.colwise().sum() - all.M.colwise().sum()).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_NEAR(dense.gap.sum(), all.gap.sum(), 1e-12);
}

TEST(MortarPartlyFixed, TurnsTheNormalIntoTheFreeDirection) {
  TwoLines lines = flat(4, 4.0, 5, 0.0, 4.0);
  for (Eigen::Vector2d& x : lines.slave) x.y() += 0.02 * x.x() * x.x();  // smooth beyond a plane of symmetry at x = 0
  lines.fixed_x = {0};
  const auto pair = evaluated(lines, true);
  EXPECT_TRUE(pair->interface->slave_nodes()[0].carries_multiplier);
  EXPECT_NEAR(pair->normals[0].normal.x(), 0.0, 0.0);
  EXPECT_NEAR(pair->normals[0].normal.y(), -1.0, 1e-15);
  EXPECT_LT(pair->normals[0].derivative.cwiseAbs().maxCoeff(), 1e-15);
  // held in the only direction in which it could be pushed
  TwoLines held = flat(3, 3.0, 3, 0.0, 3.0);
  held.fixed_y = {1};
  EXPECT_FALSE(evaluated(held)->interface->slave_nodes()[1].carries_multiplier);
}

// The same integrals from the definition: 40000 points on each slave facet, the ray along the normal searched through all master facets. The dual
// basis comes from the 2 x 2 system of the sums. The masters' nodes are kinks of the integrand and fall between points. So the rule's error is (jump
// of the slope) (2/40000)^2 / 8 < 1e-9 per kink.
TEST(MortarIntegrals, MatchBruteForce) {
  for (const bool axisymmetric : {false, true})
    for (const auto weighting : {GapWeighting::dual, GapWeighting::standard}) {
      TwoLines lines = curved();
      lines.measure.axisymmetric = axisymmetric;
      lines.options.gap_weighting = weighting;
      lines.options.gauss_points = 20;
      const auto pair = evaluated(lines);
      const DenseCoupling dense = pair->dense();
      Eigen::MatrixXd D = Eigen::MatrixXd::Zero(dense.D.rows(), dense.D.cols()), M = Eigen::MatrixXd::Zero(dense.M.rows(), dense.M.cols());
      Eigen::VectorXd gap = Eigen::VectorXd::Zero(dense.gap.size());
      for (std::size_t e = 0; e + 1 < lines.slave.size(); ++e) {
        const int points = 40000;
        Eigen::Matrix2d mass = Eigen::Matrix2d::Zero();
        Eigen::MatrixXd coupling = Eigen::MatrixXd::Zero(2, M.cols());
        Eigen::Vector2d weighted_gap = Eigen::Vector2d::Zero();
        for (int p = 0; p < points; ++p) {
          const double xi = -1.0 + (2.0 * p + 1.0) / points;
          const Eigen::Vector2d N(0.5 * (1.0 - xi), 0.5 * (1.0 + xi));
          const Eigen::Vector2d x = N[0] * lines.slave[e] + N[1] * lines.slave[e + 1];
          const Eigen::Vector2d n = (N[0] * pair->normals[e].normal + N[1] * pair->normals[e + 1].normal).normalized();
          double weight = (lines.slave[e + 1] - lines.slave[e]).norm() / points;
          if (axisymmetric) weight *= 2.0 * M_PI * x.x();
          for (std::size_t l = 0; l + 1 < lines.master.size(); ++l) {
            Eigen::Matrix2d system;  // y_0 + s (y_1 - y_0) = x + g n
            system << lines.master[l + 1] - lines.master[l], -n;
            const Eigen::Vector2d solution = system.inverse() * (x - lines.master[l]);
            if (solution[0] < 0.0 || solution[0] >= 1.0) continue;
            mass += weight * N * N.transpose();
            coupling.col(l) += weight * (1.0 - solution[0]) * N;
            coupling.col(l + 1) += weight * solution[0] * N;
            weighted_gap += weight * solution[1] * N;
          }
        }
        const Eigen::Vector2d integral = mass.rowwise().sum();
        const Eigen::Matrix2d A = Eigen::Matrix2d(integral.asDiagonal()) * mass.inverse();
        for (int j = 0; j < 2; ++j) {
          const auto row = static_cast<Eigen::Index>(e) + j;
          D(row, row) += integral[j];
          M.row(row) += A.row(j) * coupling;
          gap[row] += weighting == GapWeighting::dual ? A.row(j).dot(weighted_gap) : weighted_gap[j];
        }
      }
      const double scale = D.maxCoeff();
      EXPECT_LT((D - dense.D).cwiseAbs().maxCoeff(), 1e-8 * scale);
      EXPECT_LT((M - dense.M).cwiseAbs().maxCoeff(), 1e-8 * scale);
      EXPECT_LT((gap - dense.gap).cwiseAbs().maxCoeff(), 1e-8 * scale);
    }
}

TEST(MortarIntegrals, DoNotFeelARigidMotion) {
  TwoLines lines = curved();
  const DenseCoupling still = evaluated(lines)->dense();
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(1.1).toRotationMatrix();
  for (Points* points : {&lines.slave, &lines.master})
    for (auto& x : *points) x = turn * x + Eigen::Vector2d(3.0, -7.0);
  const DenseCoupling moved = evaluated(lines)->dense();
  EXPECT_LT((moved.D - still.D).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((moved.M - still.M).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((moved.gap - still.gap).cwiseAbs().maxCoeff(), 1e-12);
}

// Two flat lines a height apart: the weighted gap is the height times the weight, with its sign.
TEST(MortarIntegrals, MeasureTheGap) {
  for (const double height : {0.2, -0.2}) {
    const auto pair = evaluated(flat(3, 3.0, 5, -0.5, 3.5, height));
    const DenseCoupling dense = pair->dense();
    EXPECT_LT((dense.gap - height * pair->weights()).cwiseAbs().maxCoeff(), 1e-14);
  }
}

}  // namespace
}  // namespace mortise
