// Derivatives of D, M, the weighted gap and the nodal normals in space against central differences.

#include <gtest/gtest.h>

#include "space_pair.hpp"

namespace mortise {
namespace {

using namespace test;

struct Case {
  std::string name;
  Surfaces surfaces;
};

std::vector<Case> cases() {
  constexpr auto quads = FacetKind::quadrilaterals, triangles = FacetKind::triangles;
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
  const std::size_t count = all.size();
  for (std::size_t i = 0; i < count; ++i) {
    all.push_back(all[i]);
    all.back().name += ", standard weighting";
    all.back().surfaces.options.gap_weighting = GapWeighting::standard;
  }
  for (const std::size_t i : {1, 3, 11}) {
    all.push_back(all[i]);
    all.back().name += ", standard multipliers";
    all.back().surfaces.options.coupling = Coupling::standard_mortar;
  }
  return all;
}

class MortarLinearisationInSpace : public ::testing::TestWithParam<std::size_t> {};

TEST_P(MortarLinearisationInSpace, AgreesWithCentralDifferences) {
  const auto [name, surfaces] = cases()[GetParam()];
  SCOPED_TRACE(name);
  const auto pair = evaluated(surfaces, true);
  ASSERT_FALSE(pair->failure);
  const Eigen::MatrixXd exact = pair->dense_derivative();
  ASSERT_GT(pair->dense().D.trace(), 0.0);

  const auto slaves = static_cast<Eigen::Index>(surfaces.slaves), masters = static_cast<Eigen::Index>(surfaces.masters());
  const double h = 1e-6;
  Eigen::MatrixXd difference(exact.rows(), exact.cols());
  auto points = surfaces.points;
  for (Eigen::Index c = 0; c < exact.cols(); ++c) {
    double& coordinate = points[static_cast<std::size_t>(c / 3)][c % 3];
    const double at = coordinate;
    coordinate = at + h;
    pair->evaluate(points, false);
    const Eigen::VectorXd up = pair->dense().stacked();
    coordinate = at - h;
    pair->evaluate(points, false);
    difference.col(c) = (up - pair->dense().stacked()) / (2.0 * h);
    coordinate = at;
  }
  const std::pair<const char*, std::pair<Eigen::Index, Eigen::Index>> parts[] = {{"D", {0, slaves * slaves}},
                                                                                 {"M", {slaves * slaves, slaves * masters}},
                                                                                 {"gap", {slaves * (slaves + masters), slaves}},
                                                                                 {"normal", {slaves * (slaves + masters + 1), 3 * slaves}}};
  for (const auto& [part, rows] : parts) {
    const Eigen::MatrixXd a = exact.middleRows(rows.first, rows.second), b = difference.middleRows(rows.first, rows.second);
    const double scale = a.cwiseAbs().maxCoeff();
    EXPECT_GT(scale, 0.0) << part;
    EXPECT_LT((a - b).cwiseAbs().maxCoeff(), 1e-6 * scale) << part;
  }
  for (const FacetCoupling& coupling : pair->couplings)
    for (const LocalOrdinal slave : coupling.slave) {
      const auto& coupled = pair->interface->coupled_nodes(static_cast<std::size_t>(slave));
      const auto& loaded = pair->interface->loaded_nodes(static_cast<std::size_t>(slave));
      for (const LocalOrdinal node : coupling.columns) EXPECT_TRUE(std::binary_search(coupled.begin(), coupled.end(), node));
      for (const LocalOrdinal node : coupling.master) EXPECT_TRUE(std::binary_search(loaded.begin(), loaded.end(), node));
    }
}

INSTANTIATE_TEST_SUITE_P(Cases, MortarLinearisationInSpace, ::testing::Range(std::size_t{0}, cases().size()), [](const auto& info) {
  std::string name = cases()[info.param].name;
  for (char& letter : name)
    if (!std::isalnum(static_cast<unsigned char>(letter))) letter = '_';
  return name;
});

}  // namespace
}  // namespace mortise
