// Properties of D, M, gaps and their derivatives on quadratic facets.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "exact_derivatives.hpp"
#include "mortise/mortar/coupling/node_to_segment.hpp"
#include "mortise/mortar/coupling/standard_mortar.hpp"
#include "mortise/mortar/coupling/variational_mortar.hpp"
#include "mortise/mortar/quadratic_facet.hpp"
#include "mortise/shape/line3.hpp"
#include "mortise/shape/quadrilateral8.hpp"
#include "mortise/shape/triangle6.hpp"
#include "space_pair.hpp"

namespace mortise {
namespace {

using namespace test;

constexpr auto quads = FacetKind::quadrilaterals, triangles = FacetKind::triangles, mixed = FacetKind::mixed;

struct Case {
  std::string name;
  Surfaces surfaces;
};

/// Slave: facets of an arch over [0.13, 4.9]; master: facets over [low, high].
Surfaces arch(int slaves, int masters, bool quadratic_slave, bool quadratic_master, double low = -0.4, double high = 5.6) {
  TwoLines lines;
  lines.slave = line(slaves, 0.13, 4.9, [](double x) { return 0.03 * (x - 2.2) * (x - 2.2); });
  lines.master = line(
      masters, low, high, [](double x) { return 0.06 * std::sin(1.7 * x); }, true);
  lines.options.search_reach = 1.5;
  for (std::size_t n = 0; n < lines.slave.size(); ++n) lines.slave[n] += Eigen::Vector2d(0.02 * disorder(2 * n), 0.01 * disorder(2 * n + 1));
  return quadratic(lines, quadratic_slave, quadratic_master, 0.04);
}

std::vector<Case> cases() {
  std::vector<Case> all = {{"line3 on line3", arch(4, 5, true, true)},
                           {"line3 on line2", arch(4, 6, true, false)},
                           {"line2 on line3", arch(5, 4, false, true)},
                           {"line3, running off", arch(4, 4, true, true, 1.61, 4.37)},
                           {"line3, one small master", arch(3, 1, true, true, 1.5, 2.1)},
                           {"line3, axisymmetric", arch(4, 5, true, true)},
                           {"line3, symmetry", arch(4, 5, true, true)},
                           {"line3, corner fixed", arch(4, 5, true, true)}};
  all[5].surfaces.measure.axisymmetric = true;
  fix(all[6].surfaces, 0, {0});
  fix(all[7].surfaces, 2, {0, 1});
  all.push_back({"triangle6 on triangle6", quadratic(waves(2, 2, 0.0, triangles, triangles), true, true, 0.05)});
  all.push_back({"quadrilateral8 on quadrilateral8", quadratic(waves(2, 2, 0.0), true, true, 0.05)});
  all.push_back({"triangle6 on quadrilateral4", quadratic(waves(2, 3, 0.0, triangles, quads), true, false, 0.05)});
  all.push_back({"quadrilateral4 on triangle6", quadratic(waves(2, 2, 0.0, quads, triangles), false, true, 0.05)});
  all.push_back({"quadrilateral8 on triangle3", quadratic(waves(2, 3, 0.0, quads, triangles), true, false, 0.05)});
  all.push_back({"quadrilateral8, running off", quadratic(waves(2, 2, 0.0, quads, quads, 0.9, 2.2), true, true, 0.05)});
  all.push_back({"triangle6, running off", quadratic(waves(2, 2, 0.0, triangles, triangles, 0.9, 2.2), true, true, 0.05)});
  all.push_back({"quadrilateral8, corner fixed", quadratic(waves(2, 2, 0.0), true, true, 0.05)});
  fix(all.back().surfaces, 4, {0, 1, 2});
  all.push_back({"triangle6, middle fixed", quadratic(waves(2, 2, 0.0, triangles), true, false, 0.05)});
  fix(all.back().surfaces, 10, {0, 1, 2});
  all.push_back({"quadrilateral8, symmetry", quadratic(waves(2, 2, 0.0), true, false, 0.05)});
  for (const std::size_t n : {0, 3, 6}) fix(all.back().surfaces, n, {0});
  all.push_back({"triangle6 and quadrilateral8 on both", quadratic(waves(2, 2, 0.0, mixed, mixed), true, true, 0.05)});
  const std::size_t count = all.size();
  for (const std::size_t i : {std::size_t{0}, std::size_t{3}, std::size_t{8}, count - 2}) {
    all.push_back(all[i]);
    all.back().name += ", standard multipliers";
    all.back().surfaces.options.coupling = coupling_of<StandardMortarCoupling>();
    all.push_back(all[i]);
    all.back().name += ", standard weighting";
    all.back().surfaces.options.gap_weighting = GapWeighting::standard;
  }
  return all;
}

class QuadraticFacets : public ::testing::TestWithParam<std::size_t> {};

TEST_P(QuadraticFacets, DerivativesAgreeWithCentralDifferences) { expect_exact_derivatives(cases()[GetParam()].surfaces); }

TEST_P(QuadraticFacets, SecondDerivativesAgreeWithDifferencesOfFirstOnes) {
  Surfaces surfaces = cases()[GetParam()].surfaces;
  if (surfaces.dim > 2 || !surfaces.options.coupling->has_dual_multipliers()) return;
  surfaces.options.coupling = coupling_of<VariationalMortarCoupling>();
  expect_exact_curvatures(surfaces, evaluated(surfaces, true).get());
}

// Also: a middle acts on corners, nothing else off the diagonal but nodes without multiplier.
TEST_P(QuadraticFacets, RowsOfDAndMAgree) {
  const Surfaces surfaces = cases()[GetParam()].surfaces;
  const auto pair = evaluated(surfaces);
  const DenseCoupling dense = pair->dense();
  const Eigen::VectorXd error = dense.D.rowwise().sum() - dense.M.rowwise().sum();
  EXPECT_LT(error.cwiseAbs().cwiseQuotient(pair->weights()).maxCoeff(), 1e-12);
  if (surfaces.options.coupling == coupling_of<StandardMortarCoupling>()) return;
  const auto& nodes = pair->interface->slave_nodes();
  for (const SlaveNode& j : nodes)
    for (const SlaveNode& k : nodes)
      if (j.id != k.id && k.carries_multiplier && (!j.middle || k.middle))
        EXPECT_LT(std::abs(dense.D(j.id, k.id)), 1e-14 * j.weight) << j.id << " " << k.id;
}

INSTANTIATE_TEST_SUITE_P(Cases, QuadraticFacets, ::testing::Range(std::size_t{0}, cases().size()), [](const auto& info) {
  std::string name = cases()[info.param].name;
  for (char& letter : name)
    if (!std::isalnum(static_cast<unsigned char>(letter))) letter = '_';
  return name;
});

template <class Shape, class Point>
void expect_least_non_negative(int dimension, const std::vector<Point>& points, double share) {
  const NonNegativeBasis& basis = *non_negative_basis(dimension, Shape::nodes);
  const auto corners = facet_corners(dimension, Shape::nodes);
  double least = 1.0, least_with_less = 1.0;
  for (const Point& xi : points) {
    const auto N = Shape::values(xi);
    const Eigen::VectorXd of_shape = Eigen::Map<const Eigen::Matrix<double, Shape::nodes, 1>>(N.data()), values = basis.of_shape * of_shape;
    EXPECT_NEAR(values.sum(), 1.0, 1e-14);
    least = std::min(least, values.minCoeff());
    // The corners' functions with a smaller share.
    const Eigen::VectorXd with_less = of_shape + (share - 0.01) / share * (values - of_shape);
    least_with_less = std::min(least_with_less, with_less.head(static_cast<Eigen::Index>(corners)).minCoeff());
  }
  EXPECT_GE(least, -1e-15);
  EXPECT_LT(least_with_less, -1e-6);
  EXPECT_LT((basis.of_shape * basis.to_shape - FacetMatrix::Identity(Shape::nodes, Shape::nodes)).norm(), 1e-14);
}

TEST(NonNegativeBasis, IsTheLeastOne) {
  std::vector<double> line;
  std::vector<std::array<double, 2>> square, triangle;
  for (int i = 0; i <= 40; ++i) {
    line.push_back(-1.0 + 0.05 * i);
    for (int j = 0; j <= 40; ++j) {
      square.push_back({-1.0 + 0.05 * i, -1.0 + 0.05 * j});
      if (i + j <= 40) triangle.push_back({0.025 * i, 0.025 * j});
    }
  }
  expect_least_non_negative<Line3>(2, line, 0.25);
  expect_least_non_negative<Triangle6>(3, triangle, 0.25);
  expect_least_non_negative<Quadrilateral8>(3, square, 0.375);
}

/// Flat, with mid-side nodes at the midpoints of straight edges.
Surfaces flat_plane(int slaves, int masters, double low, double high, bool quadratic_master) {
  TwoLines lines;
  lines.slave = line(slaves, 0.0, 1.0, [](double) { return 0.0; });
  lines.master = line(
      masters, low, high, [](double) { return 0.0; }, true);
  return quadratic(lines, true, quadratic_master, 0.0);
}

Surfaces flat_space(int slaves, int masters, double low, double high, FacetKind slave, FacetKind master, bool quadratic_master) {
  return quadratic(two_patches({slaves, slaves, 0.0, 1.0, 0.0, 1.0, slave}, {masters, masters, low, high, -0.3, 1.2, master}), true, quadratic_master,
                   0.0);
}

/// max |int phi_j (u_slave - u_master)| / A_j
double transfer_error(const SurfacePair& pair, const Surfaces& surfaces, const std::function<double(const SpatialVector&)>& field) {
  Eigen::VectorXd slave(surfaces.slaves), master(surfaces.masters());
  for (std::size_t n = 0; n < surfaces.points.size(); ++n) (n < surfaces.slaves ? slave[n] : master[n - surfaces.slaves]) = field(surfaces.points[n]);
  const DenseCoupling dense = pair.dense();
  return (dense.D * slave - dense.M * master).cwiseAbs().cwiseQuotient(pair.weights()).maxCoeff();
}

// On any meshes and any cover, slivers too; quadratic fields where both sides have them.
TEST(QuadraticFacetsFlat, TransferFieldsOnAnyCover) {
  std::vector<Surfaces> all;
  for (const bool quadratic_master : {false, true})
    for (const auto& [slaves, masters, low, high] : std::vector<std::tuple<int, int, double, double>>{
             {1, 5, -0.2, 1.3}, {5, 1, -0.2, 1.3}, {3, 4, 0.21, 1.4}, {3, 4, 0.21, 0.83}, {1, 1, 0.6, 2.0}, {1, 1, 1.0 - 1e-3, 2.0}}) {
      all.push_back(flat_plane(slaves, masters, low, high, quadratic_master));
      for (const auto slave : {quads, triangles})
        for (const auto master : {quads, triangles}) all.push_back(flat_space(slaves, masters, low, high, slave, master, quadratic_master));
    }
  for (const Surfaces& surfaces : all) {
    const auto pair = evaluated(surfaces);
    ASSERT_FALSE(pair->failure);
    double end = 0.0, start = 1.0;
    for (std::size_t n = surfaces.slaves; n < surfaces.points.size(); ++n) {
      end = std::max(end, surfaces.points[n][0]);
      start = std::min(start, surfaces.points[n][0]);
    }
    EXPECT_NEAR(pair->dense().D.sum(), std::min(end, 1.0) - std::max(start, 0.0), 1e-12);
    EXPECT_LT(transfer_error(*pair, surfaces, [](const SpatialVector& x) { return 0.3 - x[0]; }), 1e-12);
    if (surfaces.master.front().size() > (surfaces.dim == 2 ? 2u : 4u))
      EXPECT_LT(transfer_error(*pair, surfaces, [](const SpatialVector& x) { return x[0] * x[0] - 0.7 * x[0] * x[x.size() - 2]; }), 1e-12);
    // No node's share of a part that is covered is negative.
    for (const FacetCoupling& coupling : pair->couplings) EXPECT_GE(coupling.D.rowwise().sum().minCoeff(), 0.0);
  }
}

// phi_j has int phi_j Ñ_k = delta_jk int Ñ_k: with N = B^-1 Ñ, the rows of D are those of diag(A_j) B^-T on meshes that cover one another.
TEST(QuadraticFacetsFlat, AreBiorthogonal) {
  for (const bool space : {false, true})
    for (const auto kind : {quads, triangles}) {
      Surfaces surfaces = space ? quadratic(two_patches({1, 1, 0.0, 2.0, 0.0, 3.0, kind}, {1, 1, 0.0, 2.0, 0.0, 3.0, kind}), true, true, 0.0)
                                : flat_plane(1, 1, 0.0, 1.0, true);
      const auto pair = evaluated(surfaces);
      const DenseCoupling dense = pair->dense();
      Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(dense.D.rows(), dense.D.cols());
      for (const FacetCoupling& coupling : pair->couplings) {
        const auto n = coupling.slave.size();
        const FacetMatrix& to_shape = non_negative_basis(surfaces.dim, n)->to_shape;
        const Eigen::VectorXd weights = coupling.D.rowwise().sum();
        for (std::size_t j = 0; j < n; ++j)
          for (std::size_t k = 0; k < n; ++k)
            expected(pair->interface->local_nodes()->getGlobalElement(coupling.slave[j]),
                     pair->interface->local_nodes()->getGlobalElement(coupling.slave[k])) +=
                weights[static_cast<Eigen::Index>(j)] * to_shape(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(j));
      }
      EXPECT_LT((dense.D - expected).cwiseAbs().maxCoeff(), 1e-12 * pair->weights().maxCoeff());
      EXPECT_LT((dense.D.rowwise().sum() - pair->weights()).cwiseAbs().maxCoeff(), 1e-12 * pair->weights().maxCoeff());
      // Every slave node has its opposite: M is D.
      for (std::size_t n = 0; n < surfaces.slaves; ++n)
        for (std::size_t l = 0; l < surfaces.masters(); ++l)
          if ((surfaces.points[n] - surfaces.points[surfaces.slaves + l]).norm() < 1e-12)
            EXPECT_LT((dense.D.col(static_cast<Eigen::Index>(n)) - dense.M.col(static_cast<Eigen::Index>(l))).cwiseAbs().maxCoeff(), 1e-12);
    }
}

// Sum phi = 1 whichever nodes have no multiplier: the force of a uniform pressure on every node is int N_k.
TEST(QuadraticFacetsFlat, ShareTheFunctionsOfNodesWithoutMultiplier) {
  for (const auto kind : {quads, triangles}) {
    const Surfaces free = flat_space(2, 3, 0.2, 0.9, kind, quads, false);
    const Eigen::VectorXd force = evaluated(free)->dense().D.colwise().sum();
    for (const std::vector<std::size_t>& nodes : {std::vector<std::size_t>{4}, {0}, {11}, {12, 4}, {10, 11}}) {
      Surfaces held = free;
      for (const std::size_t n : nodes) fix(held, n, {0, 1, 2});
      const DenseCoupling dense = evaluated(held)->dense();
      for (const std::size_t n : nodes) EXPECT_EQ(dense.D.row(static_cast<Eigen::Index>(n)).cwiseAbs().maxCoeff(), 0.0);
      EXPECT_LT((dense.D.colwise().sum().transpose() - force).cwiseAbs().maxCoeff(), 1e-13);
    }
  }
}

// Two coaxial arcs of radii 1 and 1.1, of quadratic facets. The distance is that of the circles up to the error of facets and normals, which falls
// with the third power of the facets' size at least.
TEST(QuadraticFacetsCurved, MeasureTheGapOfArcs) {
  const auto error = [](int count) {
    const auto arc = [](int facets, double radius, bool reverse) {
      Points points;
      for (int i = 0; i <= facets; ++i) {
        const double angle = -2.2 + 1.3 * (reverse ? facets - i : i) / facets;
        points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
      }
      return points;
    };
    TwoLines lines;
    lines.slave = arc(count, 1.0, false);
    lines.master = arc(count + 1, 1.1, true);
    Surfaces surfaces = quadratic(lines, true, true, 0.0);
    for (std::size_t n = 0; n < surfaces.points.size(); ++n) surfaces.points[n] *= (n < surfaces.slaves ? 1.0 : 1.1) / surfaces.points[n].norm();
    const auto pair = evaluated(surfaces);
    const DenseCoupling dense = pair->dense();
    return (dense.gap.cwiseQuotient(dense.D.rowwise().sum()).array() - 0.1).abs().maxCoeff();
  };
  EXPECT_GT(error(4) / error(8), 8.0);
}

// Through corners, mid-side nodes and edges of parts alike, far beyond the reach.
TEST(QuadraticFacetsFlat, AreFoundHoweverFar) {
  for (const bool space : {false, true})
    for (const auto kind : {quads, triangles}) {
      Surfaces surfaces = space ? flat_space(2, 2, -0.5, 1.5, kind, kind, true) : flat_plane(3, 2, -0.5, 1.5, true);
      const int across = surfaces.dim - 1;
      for (std::size_t n = 0; n < surfaces.slaves; ++n) surfaces.points[n][across] += 40.0;
      const auto pair = evaluated(surfaces);
      EXPECT_TRUE(pair->couplings.empty());
      std::vector<std::size_t> nodes;
      std::vector<SpatialVector> normals;
      for (std::size_t s = 0; s < pair->interface->slave_nodes().size(); ++s) {
        nodes.push_back(s);
        normals.push_back(pair->normals[s].normal);
      }
      for (const auto& distance : pair->interface->distances_to_master(*pair->owned(surfaces.points), nodes, normals)) {
        ASSERT_TRUE(distance);
        EXPECT_NEAR(*distance, 40.0, 1e-12);
      }
    }
}

std::string refusal(const Surfaces& surfaces) {
  try {
    SurfacePair(surfaces, alone());
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(QuadraticFacets, AreRefusedWhereTheyCannotBe) {
  Surfaces surfaces = arch(2, 3, true, true);
  surfaces.options.coupling = coupling_of<NodeToSegmentCoupling>();
  EXPECT_THAT(refusal(surfaces), ::testing::HasSubstr("contact/pair: node to segment needs linear facets"));
  Surfaces held = arch(2, 3, true, true);
  fix(held, 3, {0, 1});  // the middle of the first facet
  EXPECT_THAT(refusal(held), ::testing::HasSubstr("as the displacements of all mid-side nodes are prescribed"));
}

}  // namespace
}  // namespace mortise
