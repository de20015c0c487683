// Properties of D, M and the gap in 3D: sums, biorthogonality, fields that are transferred exactly, slivers, nodes without multiplier.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mortise/mortar/coupling/node_to_segment.hpp"
#include "mortise/mortar/coupling/standard_mortar.hpp"
#include "space_pair.hpp"

namespace mortise {
namespace {

using namespace test;

/// max |sum_k D_jk - sum_l M_jl| / A_j
double row_sum_error(const SurfacePair& pair) {
  const DenseCoupling dense = pair.dense();
  const Eigen::VectorXd error = dense.D.rowwise().sum() - dense.M.rowwise().sum();
  return error.cwiseAbs().cwiseQuotient(pair.weights()).maxCoeff();
}

Patch flat(int along, int across, double low_x, double high_x, double low_y, double high_y, FacetKind kind = FacetKind::quadrilaterals) {
  return {along, across, low_x, high_x, low_y, high_y, kind};
}

/// Component i of all slave and of all master nodes.
std::pair<Eigen::VectorXd, Eigen::VectorXd> fields(const Surfaces& surfaces, const std::function<double(const SpatialVector&)>& field) {
  Eigen::VectorXd slave(surfaces.slaves), master(surfaces.masters());
  for (std::size_t n = 0; n < surfaces.points.size(); ++n) (n < surfaces.slaves ? slave[n] : master[n - surfaces.slaves]) = field(surfaces.points[n]);
  return {slave, master};
}

TEST(MortarSumsInSpace, RowsOfDAndMAgree) {
  for (const auto slave : {FacetKind::quadrilaterals, FacetKind::triangles, FacetKind::mixed})
    for (const auto master : {FacetKind::quadrilaterals, FacetKind::triangles, FacetKind::mixed})
      for (const bool runs_off : {false, true})
        for (const SharedCoupling& coupling : {coupling_of<DualMortarCoupling>(), coupling_of<StandardMortarCoupling>()}) {
          Surfaces surfaces = runs_off ? waves(4, 5, 0.0, slave, master, 0.9, 2.2) : waves(4, 5, 0.0, slave, master);
          surfaces.options.coupling = coupling;
          fix(surfaces, 6, {0, 1, 2});
          const auto pair = evaluated(surfaces);
          ASSERT_FALSE(pair->failure);
          EXPECT_GT(pair->dense().D.trace(), 0.0);
          EXPECT_LT(row_sum_error(*pair), 1e-12);
        }
}

// Matching flat meshes: D = diag A_j and M = the same between opposite nodes.
TEST(MortarDualBasisInSpace, IsBiorthogonalOnAMatchingMesh) {
  for (const auto kind : {FacetKind::quadrilaterals, FacetKind::triangles, FacetKind::mixed})
    for (const double angle : {0.0, 0.7}) {
      const Patch patch = flat(3, 4, 0.0, 2.0, 0.0, 3.0, kind);
      Surfaces surfaces = two_patches(patch, patch);
      const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, Eigen::Vector3d(1.0, 1.0, 0.4).normalized()).toRotationMatrix();
      for (auto& x : surfaces.points) x = turn * x;
      const auto pair = evaluated(surfaces);
      const DenseCoupling dense = pair->dense();
      const Eigen::MatrixXd expected = pair->weights().asDiagonal();
      EXPECT_LT((dense.D - expected).cwiseAbs().maxCoeff(), 1e-12 * expected.maxCoeff());
      EXPECT_LT((dense.M - expected).cwiseAbs().maxCoeff(), 1e-12 * expected.maxCoeff());
      EXPECT_LT(dense.gap.cwiseAbs().maxCoeff(), 1e-13);
    }
}

// A linear field on both sides is transferred exactly: int phi_j (u_slave - u_master) = 0, on any meshes and any cover.
TEST(MortarDualBasisInSpace, TransfersLinearFieldsOnAnyCover) {
  for (const auto slave_kind : {FacetKind::quadrilaterals, FacetKind::triangles, FacetKind::mixed})
    for (const auto master_kind : {FacetKind::quadrilaterals, FacetKind::triangles, FacetKind::mixed})
      for (const auto& [slaves, masters, low, high] : std::vector<std::tuple<int, int, double, double>>{{1, 5, -0.2, 1.3},
                                                                                                        {5, 1, -0.2, 1.3},
                                                                                                        {3, 4, 0.21, 1.4},
                                                                                                        {3, 4, 0.21, 0.83},
                                                                                                        {5, 2, 0.5, 0.55},
                                                                                                        {1, 1, 1.0 - 1e-3, 2.0},
                                                                                                        {2, 1, 1.0 - 1e-5, 2.0}}) {
        const Surfaces surfaces =
            two_patches(flat(slaves, slaves, 0.0, 1.0, 0.0, 1.0, slave_kind), flat(masters, masters, low, high, -0.3, 1.2, master_kind));
        const auto pair = evaluated(surfaces);
        const DenseCoupling dense = pair->dense();
        SCOPED_TRACE(std::to_string(low) + " " + std::to_string(high));
        ASSERT_GT(dense.D.trace(), 0.0);
        EXPECT_EQ((dense.D - Eigen::MatrixXd(dense.D.diagonal().asDiagonal())).cwiseAbs().maxCoeff(), 0.0);
        const auto [at_slave, at_master] = fields(surfaces, [](const SpatialVector& x) { return 0.3 - x[0] + 2.0 * x[1]; });
        const Eigen::VectorXd error = dense.D * at_slave - dense.M * at_master;
        EXPECT_LT(error.cwiseAbs().cwiseQuotient(pair->weights()).maxCoeff(), 1e-12);
        EXPECT_LT(row_sum_error(*pair), 1e-12);
        const double covered = std::min(high, 1.0) - std::max(low, 0.0);
        EXPECT_NEAR(dense.D.sum(), covered, 1e-12);
      }
}

// int phi_j N_k = delta_jk int N_k over the part of a facet that is covered: phi = A N makes M_dual = A M_standard, and A int N N^T is diagonal.
TEST(MortarDualBasisInSpace, IsDualOnTheCoveredPart) {
  Surfaces surfaces;
  surfaces.dim = 3;
  append_patch(flat(1, 1, 0.0, 1.0, 0.0, 1.0), false, 0.0, surfaces, surfaces.slave);
  surfaces.slaves = surfaces.points.size();
  append_patch(flat(1, 1, 0.37, 2.0, -1.0, 0.81), true, 0.0, surfaces, surfaces.master);
  const DenseCoupling dual = evaluated(surfaces)->dense();
  surfaces.options.coupling = coupling_of<StandardMortarCoupling>();
  const DenseCoupling standard = evaluated(surfaces)->dense();
  const Eigen::MatrixXd A = Eigen::MatrixXd(dual.D) * standard.D.inverse();
  EXPECT_LT((dual.M - A * standard.M).cwiseAbs().maxCoeff(), 1e-12 * dual.D.maxCoeff());
  EXPECT_LT((dual.D.diagonal() - standard.D.rowwise().sum()).cwiseAbs().maxCoeff(), 1e-14);
  // int N_j N_k over [0.37, 1] x [0, 0.81] by products of one-dimensional integrals of (1 - x), x
  const auto line = [](double a, double b) {
    const auto cube = [](double x) { return x * x * x / 3.0; };
    Eigen::Matrix2d m;
    m << cube(1.0 - a) - cube(1.0 - b), 0.5 * (b * b - a * a) - cube(b) + cube(a), 0.0, cube(b) - cube(a);
    m(1, 0) = m(0, 1);
    return m;
  };
  const Eigen::Matrix2d in_x = line(0.37, 1.0), in_y = line(0.0, 0.81);
  for (int j = 0; j < 4; ++j)
    for (int k = 0; k < 4; ++k) EXPECT_NEAR(standard.D(j, k), in_x(j % 2, k % 2) * in_y(j / 2, k / 2), 1e-14);
}

// A cover [1 - e, 1] x [0, 1] of a unit facet: D = e^2 / 4 at x = 0 and (e - e^2 / 2) / 2 at x = 1. Below 1e-12 of its weight a node gets nothing.
TEST(MortarDualBasisInSpace, CarriesASliver) {
  for (const double e : {1e-2, 1e-4, 1e-5, 1e-7}) {
    const auto pair = evaluated(two_patches(flat(1, 1, 0.0, 1.0, 0.0, 1.0), flat(1, 1, 1.0 - e, 2.0, -0.5, 1.5)));
    const DenseCoupling dense = pair->dense();
    for (const int n : {0, 2}) EXPECT_NEAR(dense.D(n, n), e < 1e-6 ? 0.0 : 0.25 * e * e, 1e-15) << e;
    for (const int n : {1, 3}) EXPECT_NEAR(dense.D(n, n), 0.5 * (e - 0.5 * e * e), 1e-14) << e;
    EXPECT_LT(row_sum_error(*pair), 1e-12);
  }
  // a thin strip along a diagonal of the facet, and a corner
  Surfaces surfaces = two_patches(flat(1, 1, 0.0, 1.0, 0.0, 1.0), flat(1, 1, 0.0, 1.0, 0.0, 1.0));
  const double e = 1e-4;
  const std::vector<Eigen::Vector2d> strip = {{-e, 0.0}, {1.0 - e, 1.0}, {0.0, 0.0}, {1.0, 1.0}};
  for (int n = 0; n < 4; ++n) surfaces.points[4 + n].head<2>() = strip[n];
  surfaces.master = {{6, 7, 5, 4}};
  const auto pair = evaluated(surfaces);
  const DenseCoupling dense = pair->dense();
  EXPECT_NEAR(dense.D.sum(), e - 0.5 * e * e, 1e-14);
  const auto [at_slave, at_master] = fields(surfaces, [](const SpatialVector& x) { return 0.3 - x[0] + 2.0 * x[1]; });
  EXPECT_LT((dense.D * at_slave - dense.M * at_master).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(MortarCrosspointInSpace, GivesItsShareToTheNeighbours) {
  for (const auto kind : {FacetKind::quadrilaterals, FacetKind::triangles}) {
    Surfaces surfaces = waves(3, 4, 0.0, kind);
    const DenseCoupling all = evaluated(surfaces)->dense();
    fix(surfaces, 5, {0, 1, 2});
    const auto pair = evaluated(surfaces);
    const DenseCoupling dense = pair->dense();
    EXPECT_FALSE(pair->interface->slave_nodes()[5].carries_multiplier);
    EXPECT_EQ(dense.D.row(5).cwiseAbs().maxCoeff(), 0.0);
    EXPECT_EQ(dense.M.row(5).cwiseAbs().maxCoeff(), 0.0);
    EXPECT_EQ(dense.gap[5], 0.0);
    for (const int neighbour : {1, 4, 6, 9}) EXPECT_GT(dense.D(neighbour, 5), 0.0);
    EXPECT_EQ(dense.D(2, 5), 0.0);  // across a quadrilateral, in no triangle with it
    // sum phi = 1: nothing is lost of the weights, of the forces on the master, of the gap
    EXPECT_NEAR(dense.D.sum(), all.D.sum(), 1e-12);
    EXPECT_LT((dense.M.colwise().sum() - all.M.colwise().sum()).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_NEAR(dense.gap.sum(), all.gap.sum(), 1e-12);
  }
}

TEST(MortarPartlyFixedInSpace, TurnsTheNormalIntoTheFreeDirections) {
  Surfaces surfaces = waves(3, 4, 0.0);
  fix(surfaces, 0, {0, 1});
  fix(surfaces, 1, {1});
  const auto pair = evaluated(surfaces, true);
  EXPECT_TRUE(pair->interface->slave_nodes()[0].carries_multiplier);
  EXPECT_EQ(pair->normals[0].normal, SpatialVector(-Eigen::Vector3d::UnitZ()));
  EXPECT_LT(pair->normals[0].derivative.cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_EQ(pair->normals[1].normal[1], 0.0);
  EXPECT_NEAR(pair->normals[1].normal.norm(), 1.0, 1e-15);
  // held in the only direction in which it could be pushed
  Surfaces held = two_patches(flat(2, 2, 0.0, 1.0, 0.0, 1.0), flat(2, 2, 0.0, 1.0, 0.0, 1.0));
  fix(held, 4, {2});
  EXPECT_FALSE(evaluated(held)->interface->slave_nodes()[4].carries_multiplier);
}

// The same integrals from the definition: a warped slave facet over triangles, 300 x 300 points in its coordinates. Areas are those on the plane
// across its normal at the centre. The line along that normal through each point is searched through all triangles. The integrands are continuous
// with kinks: the sum is off by about (1/300)^2 of the second derivatives.
TEST(MortarIntegralsInSpace, MatchBruteForce) {
  Surfaces surfaces = waves(1, 3, 0.1, FacetKind::quadrilaterals, FacetKind::triangles);
  surfaces.options.coupling = coupling_of<StandardMortarCoupling>();
  surfaces.points[2][2] += 0.3;
  const auto pair = evaluated(surfaces);
  const DenseCoupling dense = pair->dense();
  std::array<Eigen::Vector3d, 4> x, n;
  for (int a = 0; a < 4; ++a) {
    const auto node = static_cast<std::size_t>(surfaces.slave[0][a]);
    x[a] = surfaces.points[node];
    n[a] = pair->normals[node].normal;
  }
  const Eigen::Vector3d p = (x[2] - x[0]).cross(x[3] - x[1]).normalized();
  Eigen::MatrixXd D = Eigen::MatrixXd::Zero(4, 4), M = Eigen::MatrixXd::Zero(4, dense.M.cols());
  Eigen::VectorXd gap = Eigen::VectorXd::Zero(4);
  constexpr int points = 300;
  for (int i = 0; i < points; ++i)
    for (int j = 0; j < points; ++j) {
      const double r = (i + 0.5) / points, s = (j + 0.5) / points;
      const Eigen::Vector4d N((1.0 - r) * (1.0 - s), r * (1.0 - s), r * s, (1.0 - r) * s);
      Eigen::Vector3d at = Eigen::Vector3d::Zero(), normal = at;
      for (int a = 0; a < 4; ++a) {
        at += N[a] * x[a];
        normal += N[a] * n[a];
      }
      const Eigen::Vector3d in_r = (1.0 - s) * (x[1] - x[0]) + s * (x[2] - x[3]), in_s = (1.0 - r) * (x[3] - x[0]) + r * (x[2] - x[1]);
      const double weight = in_r.cross(in_s).dot(p) / (points * points);
      for (const SurfaceFacet& facet : surfaces.master) {
        std::array<Eigen::Vector3d, 3> y;
        for (int l = 0; l < 3; ++l) y[l] = surfaces.points[static_cast<std::size_t>(facet[l])];
        Eigen::Matrix3d system;  // y_0 + a (y_1 - y_0) + b (y_2 - y_0) = at + h p
        system << y[1] - y[0], y[2] - y[0], -p;
        const Eigen::Vector3d solution = system.inverse() * (at - y[0]);
        const Eigen::Vector3d N_m(1.0 - solution[0] - solution[1], solution[0], solution[1]);
        if (N_m.minCoeff() < 0.0) continue;
        const double g = normal.normalized().dot(solution[2] * p);
        for (int a = 0; a < 4; ++a) {
          const auto row = surfaces.slave[0][a];
          for (int k = 0; k < 4; ++k) D(row, surfaces.slave[0][k]) += weight * N[a] * N[k];
          for (int l = 0; l < 3; ++l) M(row, facet[l] - 4) += weight * N[a] * N_m[l];
          gap[row] += weight * N[a] * g;
        }
      }
    }
  const double bound = 1e-4 * D.maxCoeff();
  EXPECT_LT((D - dense.D).cwiseAbs().maxCoeff(), bound);
  EXPECT_LT((M - dense.M).cwiseAbs().maxCoeff(), bound);
  EXPECT_LT((gap - dense.gap).cwiseAbs().maxCoeff(), bound);
}

TEST(MortarIntegralsInSpace, DoNotFeelARigidMotion) {
  Surfaces surfaces = waves(3, 4, 0.1);
  const DenseCoupling still = evaluated(surfaces)->dense();
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(2.1, Eigen::Vector3d(0.3, -1.0, 0.8).normalized()).toRotationMatrix();
  for (auto& x : surfaces.points) x = turn * x + Eigen::Vector3d(3.0, -7.0, 1.0);
  const DenseCoupling moved = evaluated(surfaces)->dense();
  EXPECT_LT((moved.D - still.D).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((moved.M - still.M).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((moved.gap - still.gap).cwiseAbs().maxCoeff(), 1e-12);
}

// Two flat surfaces a height apart: the weighted gap is the height times the weight, with its sign.
TEST(MortarIntegralsInSpace, MeasureTheGap) {
  for (const double height : {0.2, -0.2}) {
    Patch slave = flat(3, 2, 0.0, 3.0, 0.0, 2.0);
    slave.z = [height](double, double) { return height; };
    const auto pair = evaluated(two_patches(slave, flat(5, 4, -0.5, 3.5, -0.6, 2.7, FacetKind::triangles)));
    EXPECT_LT((pair->dense().gap - height * pair->weights()).cwiseAbs().maxCoeff(), 1e-13);
  }
}

TEST(MortarRefusalsInSpace, SayWhatToDo) {
  using ::testing::HasSubstr;
  const auto refusal = [](const Surfaces& surfaces) -> std::string {
    try {
      evaluated(surfaces);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  Surfaces surfaces = waves(2, 2, 0.0);
  surfaces.options.coupling = coupling_of<NodeToSegmentCoupling>();
  EXPECT_THAT(refusal(surfaces), HasSubstr("node to segment is not available in 3D"));
  Surfaces fixed = waves(2, 2, 0.0);
  for (const std::size_t n : {0, 1, 3, 4}) fix(fixed, n, {0, 1, 2});
  EXPECT_THAT(refusal(fixed), HasSubstr("make this side the master"));
  Surfaces unknown = waves(2, 2, 0.0);
  unknown.slave[0] = {0, 1, 3, 4, 5};
  EXPECT_THAT(refusal(unknown), HasSubstr("facets of 5 nodes"));
  Surfaces flattened = waves(1, 1, 0.0);
  flattened.points[5] = flattened.points[4];
  flattened.points[6] = flattened.points[4];
  flattened.points[7] = flattened.points[4];
  EXPECT_THAT(refusal(flattened), HasSubstr("has no area"));
  Surfaces folded = waves(1, 1, 0.0);
  folded.points[3] = 0.2 * folded.points[3] + 0.8 * folded.points[0];
  EXPECT_NE(refusal(folded), "");
}

TEST(MortarDistancesInSpace, FindTheNearestMasterHoweverFar) {
  Patch slave = flat(2, 2, 0.2, 1.1, 0.3, 1.2);
  for (const double height : {7.0, -5.0}) {
    slave.z = [height](double, double) { return height; };
    for (const auto kind : {FacetKind::quadrilaterals, FacetKind::triangles}) {
      const Surfaces surfaces = two_patches(slave, flat(4, 3, -0.5, 0.9, -0.6, 2.7, kind));
      const auto pair = evaluated(surfaces);
      std::vector<std::size_t> nodes;
      std::vector<SpatialVector> normals;
      for (std::size_t s = 0; s < surfaces.slaves; ++s) {
        nodes.push_back(s);
        normals.push_back(-Eigen::Vector3d::UnitZ());
      }
      const auto distances = pair->interface->distances_to_master(*pair->owned(surfaces.points), nodes, normals);
      for (std::size_t s = 0; s < surfaces.slaves; ++s) {
        ASSERT_EQ(distances[s].has_value(), surfaces.points[s][0] < 0.9);
        if (distances[s]) EXPECT_NEAR(*distances[s], height, 1e-12);
      }
    }
  }
}

}  // namespace
}  // namespace mortise
