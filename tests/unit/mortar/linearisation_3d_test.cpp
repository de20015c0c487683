// Derivatives of D, M, the weighted gap and the nodal normals in 3D against central differences.

#include <gtest/gtest.h>

#include "exact_derivatives.hpp"
#include "mortise/mortar/coupling/standard_mortar.hpp"
#include "space_pair.hpp"

namespace mortise {
namespace {

using namespace test;

struct Case {
  std::string name;
  Surfaces surfaces;
};

std::vector<Case> cases() {
  constexpr auto quads = FacetKind::quadrilaterals, triangles = FacetKind::triangles, mixed = FacetKind::mixed;
  std::vector<Case> all;
  all.push_back({"open", waves(3, 4, 0.3)});
  all.push_back({"closed", waves(3, 4, -0.3)});
  all.push_back({"triangles on triangles", waves(2, 3, 0.0, triangles, triangles)});
  all.push_back({"triangles on quadrilaterals", waves(2, 3, 0.0, triangles, quads)});
  all.push_back({"quadrilaterals on triangles", waves(3, 2, 0.0, quads, triangles)});
  all.push_back({"running off", waves(3, 4, 0.0, quads, quads, 0.9, 2.2)});
  all.push_back({"running off triangles", waves(3, 3, 0.0, triangles, triangles, 0.9, 2.2)});
  all.push_back({"many masters for a slave facet", waves(1, 4, 0.0)});
  all.push_back({"many slave facets for a master", waves(4, 1, 0.0)});
  all.push_back({"symmetry plane", waves(3, 3, 0.0)});
  for (const std::size_t n : {0, 4, 8, 12}) fix(all.back().surfaces, n, {0});
  all.push_back({"symmetry edge", waves(2, 2, 0.0)});
  fix(all.back().surfaces, 0, {0, 1});
  fix(all.back().surfaces, 1, {1});
  fix(all.back().surfaces, 2, {1});
  all.push_back({"crosspoint inside", waves(2, 3, 0.0)});
  fix(all.back().surfaces, 4, {0, 1, 2});
  all.push_back({"fixed edge", waves(2, 3, 0.0, triangles)});
  for (const std::size_t n : {0, 1, 2}) fix(all.back().surfaces, n, {0, 1, 2});
  Case sliding{"sliding", waves(2, 12, 0.0, quads, quads, -3.0, 9.0)};
  for (std::size_t n = 0; n < sliding.surfaces.slaves; ++n) sliding.surfaces.points[n][0] += 3.37;
  all.push_back(sliding);
  Case turned{"turned in space", waves(2, 2, 0.0)};
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.3, Eigen::Vector3d(1.0, 2.0, -0.7).normalized()).toRotationMatrix();
  for (auto& x : turned.surfaces.points) x = turn * x;
  all.push_back(turned);
  all.push_back({"both kinds on both kinds", waves(2, 3, 0.0, mixed, mixed)});
  all.push_back({"both kinds, running off", waves(3, 3, 0.0, mixed, mixed, 0.9, 2.2)});
  const std::size_t count = all.size();
  for (std::size_t i = 0; i < count; ++i) {
    all.push_back(all[i]);
    all.back().name += ", standard weighting";
    all.back().surfaces.options.gap_weighting = GapWeighting::standard;
  }
  for (const std::size_t i : {1, 3, 11}) {
    all.push_back(all[i]);
    all.back().name += ", standard multipliers";
    all.back().surfaces.options.coupling = coupling_of<StandardMortarCoupling>();
  }
  return all;
}

class MortarLinearisationInSpace : public ::testing::TestWithParam<std::size_t> {};

TEST_P(MortarLinearisationInSpace, AgreesWithCentralDifferences) {
  const auto [name, surfaces] = cases()[GetParam()];
  SCOPED_TRACE(name);
  expect_exact_derivatives(surfaces);
}

INSTANTIATE_TEST_SUITE_P(Cases, MortarLinearisationInSpace, ::testing::Range(std::size_t{0}, cases().size()), [](const auto& info) {
  std::string name = cases()[info.param].name;
  for (char& letter : name)
    if (!std::isalnum(static_cast<unsigned char>(letter))) letter = '_';
  return name;
});

// Matching surfaces whose nodes moved apart by t along some directions. Edges cross at angles of the size of t, and the vertices between them move
// 1/t times as far as the nodes. The integrals are smooth along the way for t > 0, so their derivatives tend to a limit, linearly with t. On the way
// the derivatives at 1e-3 and below are those of the exact integrals. These differ from the rule's by its error over that angle.
TEST(MortarLinearisationInSpaceNearTies, StaysThatOfTheWay) {
  for (const auto kind : {FacetKind::quadrilaterals, FacetKind::triangles}) {
    const Patch patch{2, 2, 0.0, 2.0, 0.0, 2.0, kind, [](double x, double y) { return 0.1 * std::sin(1.7 * x) * std::cos(1.3 * y); }};
    Surfaces matching;
    matching.dim = 3;
    append_patch(patch, false, 0.15, matching, matching.slave);
    matching.slaves = matching.points.size();
    append_patch(patch, true, 0.0, matching, matching.master);
    for (std::size_t n = 0; n < matching.slaves; ++n) matching.points[matching.slaves + n] = matching.points[n];
    const auto derivative_at = [&](double t) {
      Surfaces surfaces = matching;
      for (std::size_t n = 0; n < 3 * matching.slaves; ++n) surfaces.points[n / 3][static_cast<Eigen::Index>(n % 3)] += t * disorder(7 * n);
      return evaluated(surfaces, true)->dense_derivative();
    };
    const Eigen::MatrixXd limit = derivative_at(1e-4);
    for (const double t : {1e-2, 1e-5, 1e-7, 1e-9})
      EXPECT_LT((derivative_at(t) - limit).cwiseAbs().maxCoeff(), 10.0 * std::max(t, 1e-4) * limit.cwiseAbs().maxCoeff()) << t;
  }
}

TEST(MortarLinearisationInSpaceNearTies, TMP) {
  for (const auto kind : {FacetKind::quadrilaterals, FacetKind::triangles}) {
    const auto wave = [](double x, double y) { return 0.1 * std::sin(1.7 * x) * std::cos(1.3 * y); };
    const Patch slave{2, 2, 0.0, 2.0, 0.1, 1.9, kind, wave}, master{8, 6, -1.0, 3.0, -1.0, 3.0, kind, wave};
    Surfaces matching;
    matching.dim = 3;
    append_patch(slave, false, 0.0, matching, matching.slave);
    matching.slaves = matching.points.size();
    append_patch(master, true, 0.0, matching, matching.master);
    const auto derivative_at = [&](double t) {
      Surfaces surfaces = matching;
      for (std::size_t n = 0; n < 3 * matching.points.size(); ++n) surfaces.points[n / 3][static_cast<Eigen::Index>(n % 3)] += t * disorder(7 * n);
      return evaluated(surfaces, true)->dense_derivative();
    };
    const Eigen::MatrixXd limit = derivative_at(1e-4);
    for (const double t : {1e-2, 1e-5, 1e-7, 1e-9, 1e-11, 1e-12, 1e-13, 0.0, -1e-13, -1e-11, -1e-9, -1e-7, -1e-4})
      fprintf(stderr, "%d t %g  %g of %g\n", (int)kind, t, (derivative_at(t) - limit).cwiseAbs().maxCoeff(), limit.cwiseAbs().maxCoeff());
  }
}

// Lines of finer masters along those of the slave, shifted to either side by less and by more than what counts as coincident.
TEST(MortarLinearisationInSpaceNearTies, IsTheSameOnBothSides) {
  for (const auto kind : {FacetKind::quadrilaterals, FacetKind::triangles}) {
    const auto wave = [](double x, double y) { return 0.1 * std::sin(1.7 * x) * std::cos(1.3 * y); };
    const Surfaces tied = two_patches({2, 2, 0.0, 2.0, 0.1, 1.9, kind, wave}, {8, 6, -1.0, 3.0, -1.0, 3.0, kind, wave});
    const auto derivative_at = [&](double t) {
      Surfaces surfaces = tied;
      for (std::size_t n = 0; n < 3 * tied.points.size(); ++n) surfaces.points[n / 3][static_cast<Eigen::Index>(n % 3)] += t * disorder(7 * n);
      return evaluated(surfaces, true)->dense_derivative();
    };
    const Eigen::MatrixXd limit = derivative_at(1e-4);
    for (const double t : {1e-7, 1e-9, 1e-11, 1e-12, 1e-13, 0.0, -1e-13, -1e-12, -1e-11, -1e-9, -1e-7, -1e-4})
      EXPECT_LT((derivative_at(t) - limit).cwiseAbs().maxCoeff(), 10.0 * 1e-4 * limit.cwiseAbs().maxCoeff()) << t;
  }
}

// Grids whose lines coincide in part, as those of bodies meshed with numbers that are multiples of one another do. Whichever way round-off puts the
// lines, the integrals are the same, and move as their derivatives say.
TEST(MortarIntegralsInSpaceAtTies, AreContinuous) {
  const Surfaces tied = two_patches({12, 12, 0.2, 0.8, 0.2, 0.8}, {16, 16, 0.0, 1.0, 0.0, 1.0});
  const auto at = [&](double size, std::size_t seed) {
    Surfaces moved = tied;
    for (std::size_t n = 0; n < 3 * moved.points.size(); ++n)
      moved.points[n / 3][static_cast<Eigen::Index>(n % 3)] += size * disorder(7 * n + 13 * seed);
    return evaluated(moved, false)->dense();
  };
  const DenseCoupling exact = at(0.0, 0);
  // A node's sums belong to 4 facets with edges of 0.05, whose ends move by `size` at most.
  for (const double size : {1e-15, 1e-12, 1e-10, 1e-9, 1e-8, 1e-6})
    for (std::size_t seed = 0; seed < 4; ++seed) {
      const DenseCoupling moved = at(size, seed);
      EXPECT_LT((moved.D - exact.D).cwiseAbs().maxCoeff(), 10.0 * 0.05 * size + 1e-16) << size;
      EXPECT_LT((moved.M - exact.M).cwiseAbs().maxCoeff(), 10.0 * 0.05 * size + 1e-16) << size;
      EXPECT_LT((moved.gap - exact.gap).cwiseAbs().maxCoeff(), 10.0 * 0.0025 * size + 1e-17) << size;
    }
}

}  // namespace
}  // namespace mortise
