// Derivatives of D, M, the weighted gap and the nodal normals against central differences; the pattern that holds them.

#include <gtest/gtest.h>

#include "exact_derivatives.hpp"
#include "mortise/mortar/coupling/standard_mortar.hpp"
#include "mortise/mortar/coupling/variational_mortar.hpp"

namespace mortise {
namespace {

using namespace test;

/// Slave: a gentle arch of `slave_facets` over [0.13, 4.9]; master: `master_facets` over [low, high]; `height` of the slave over the master.
TwoLines arch(const std::string& name, int slave_facets, int master_facets, double height, double low = -0.4, double high = 5.6) {
  TwoLines lines;
  lines.name = name;
  lines.slave = line(slave_facets, 0.13, 4.9, [&](double x) { return height + 0.03 * (x - 2.2) * (x - 2.2); });
  lines.master = line(
      master_facets, low, high, [](double x) { return 0.06 * std::sin(1.7 * x); }, true);
  lines.options.search_reach = 1.5;
  // off every tie of nodes with normals of nodes
  for (std::size_t n = 0; n < lines.slave.size(); ++n) lines.slave[n] += Eigen::Vector2d(0.02 * disorder(2 * n), 0.01 * disorder(2 * n + 1));
  for (std::size_t n = 0; n < lines.master.size(); ++n) lines.master[n] += Eigen::Vector2d(0.02 * disorder(3 * n + 5), 0.01 * disorder(3 * n + 6));
  return lines;
}

std::vector<TwoLines> cases() {
  std::vector<TwoLines> all;
  all.push_back(arch("open", 5, 7, 0.3));
  all.push_back(arch("closed", 5, 7, -0.4));
  all.push_back(arch("mixed", 5, 7, -0.08));
  all.push_back(arch("running off at the right", 5, 7, 0.0, -0.4, 4.37));
  all.push_back(arch("running off at both sides", 5, 6, 0.0, 1.61, 4.37));
  all.push_back(arch("one master facet, less than a slave facet", 4, 1, 0.0, 1.5, 2.1));
  all.push_back(arch("many masters for a slave facet", 2, 14, 0.0));
  all.push_back(arch("many slave facets for a master", 14, 2, 0.0));
  all.push_back(arch("partly fixed", 5, 7, 0.0));
  all.back().fixed_x = {0};
  all.push_back(arch("crosspoint at the end", 5, 7, 0.0));
  all.back().fixed_x = all.back().fixed_y = {5};
  all.push_back(arch("crosspoint inside", 5, 7, 0.0));
  all.back().fixed_x = all.back().fixed_y = {2};
  all.push_back(arch("axisymmetric", 5, 7, 0.0));
  all.back().measure.axisymmetric = true;
  all.push_back(arch("thick", 5, 7, 0.0));
  all.back().measure.thickness = 3.5;
  TwoLines curved = arch("strongly curved", 0 + 6, 9, 0.0);
  for (std::size_t n = 0; n < curved.slave.size(); ++n) {
    const double angle = -2.5 + 1.9 * static_cast<double>(n) / 6.0;
    curved.slave[n] = {2.0 + 2.0 * std::cos(angle), 2.05 + 2.0 * std::sin(angle)};
  }
  all.push_back(curved);
  // sliding: the master moved along by much more than a facet
  TwoLines sliding = arch("sliding", 5, 20, 0.0, -6.0, 14.0);
  for (auto& x : sliding.slave) x.x() += 5.37;
  all.push_back(sliding);
  const std::size_t count = all.size();
  for (std::size_t i = 0; i < count; ++i) {
    all.push_back(all[i]);
    all.back().name += ", standard weighting";
    all.back().options.gap_weighting = GapWeighting::standard;
  }
  return all;
}

class MortarLinearisation : public ::testing::TestWithParam<std::size_t> {};

TEST_P(MortarLinearisation, AgreesWithCentralDifferences) {
  const TwoLines lines = cases()[GetParam()];
  SCOPED_TRACE(lines.name);
  expect_exact_derivatives(lines);
}

TEST_P(MortarLinearisation, SecondDerivativesAgreeWithDifferencesOfFirstOnes) {
  Surfaces surfaces = cases()[GetParam()];
  if (surfaces.options.gap_weighting == GapWeighting::standard) return;  // variational mortar knows no other
  surfaces.options.coupling = coupling_of<VariationalMortarCoupling>();
  expect_exact_curvatures(surfaces, evaluated(surfaces, true).get());
}

// The overlaps of a master node's two facets change sides of a slave node. The rest of one of them may be too short to count, while the end of the
// other is where it was. First derivatives are continuous there: they change by at most what moves, 1e-10 of a facet, times second ones, of size
// 10.
TEST(MortarLinearisation, IsContinuousWhereAMasterNodePassesASlaveNode) {
  for (const SharedCoupling& coupling : {coupling_of<DualMortarCoupling>(), coupling_of<StandardMortarCoupling>()}) {
    TwoLines lines;
    lines.slave = {{-1.0, 0.1}, {0.0, 0.0}, {1.0, 0.1}};
    lines.master = {{1.7, -0.2}, {0.9, -0.1}, {0.0, -0.3}, {-0.8, -0.1}, {-1.7, 0.0}};  // node 5 on the normal of node 1
    lines.options.search_reach = 1.5;
    lines.options.coupling = coupling;
    const Surfaces surfaces = lines;
    const auto pair = evaluated(surfaces, true);
    const Eigen::MatrixXd at_node = pair->dense_derivative();
    for (const double offset : {-1e-10, -1e-12, -1e-14, -1e-16, 1e-16, 1e-14, 1e-12, 1e-10}) {
      auto points = surfaces.points;
      points[5][0] = offset;
      pair->evaluate(points, true);
      EXPECT_LT((pair->dense_derivative() - at_node).cwiseAbs().maxCoeff(), 1e-9) << offset;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, MortarLinearisation, ::testing::Range(std::size_t{0}, cases().size()), [](const auto& info) {
  std::string name = cases()[info.param].name;
  for (char& letter : name)
    if (!std::isalnum(static_cast<unsigned char>(letter))) letter = '_';
  return name;
});

}  // namespace
}  // namespace mortise
