#pragma once
// The interface's derivatives against central differences.

#include <gtest/gtest.h>

#include "surface_pair.hpp"

namespace mortise::test {

/// D, M, gaps and normals, each in its own size; and that the pattern holds what derivatives and forces touch. Of a pair evaluated on one rank with
/// derivatives.
inline void expect_exact_derivatives(const Surfaces& surfaces, SurfacePair* pair) {
  ASSERT_FALSE(pair->failure);
  const Eigen::MatrixXd exact = pair->dense_derivative();
  ASSERT_GT(pair->dense().D.trace(), 0.0);

  const auto slaves = static_cast<Eigen::Index>(surfaces.slaves), masters = static_cast<Eigen::Index>(surfaces.masters());
  const double h = 1e-6;
  Eigen::MatrixXd difference(exact.rows(), exact.cols());
  auto points = surfaces.points;
  for (Eigen::Index c = 0; c < exact.cols(); ++c) {
    double& coordinate = points[static_cast<std::size_t>(c / surfaces.dim)][c % surfaces.dim];
    const double at = coordinate;
    coordinate = at + h;
    pair->evaluate(points, false);
    const Eigen::VectorXd up = pair->dense().stacked();
    coordinate = at - h;
    pair->evaluate(points, false);
    difference.col(c) = (up - pair->dense().stacked()) / (2.0 * h);
    coordinate = at;
  }
  const std::pair<const char*, std::pair<Eigen::Index, Eigen::Index>> parts[] = {
      {"D", {0, slaves * slaves}},
      {"M", {slaves * slaves, slaves * masters}},
      {"gap", {slaves * (slaves + masters), slaves}},
      {"normal", {slaves * (slaves + masters + 1), surfaces.dim * slaves}}};
  for (const auto& [part, rows] : parts) {
    const Eigen::MatrixXd a = exact.middleRows(rows.first, rows.second), b = difference.middleRows(rows.first, rows.second);
    const double scale = a.cwiseAbs().maxCoeff();
    EXPECT_GT(scale, 0.0) << part;
    EXPECT_LT((a - b).cwiseAbs().maxCoeff(), 1e-6 * scale) << part;
  }
  for (const FacetCoupling& coupling : pair->couplings)
    for (std::size_t j = 0; j < coupling.slave.size(); ++j) {
      const auto s = static_cast<std::size_t>(coupling.slave[j]);
      const auto& coupled = pair->interface->coupled_nodes(s);
      const auto& loaded = pair->interface->loaded_nodes(s);
      for (const LocalOrdinal node : coupling.columns) EXPECT_TRUE(std::binary_search(coupled.begin(), coupled.end(), node));
      for (const LocalOrdinal node : coupling.master) EXPECT_TRUE(std::binary_search(loaded.begin(), loaded.end(), node));
      for (std::size_t k = 0; k < coupling.slave.size(); ++k)
        if (coupling.D(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(k)) != 0.0)
          EXPECT_TRUE(std::binary_search(loaded.begin(), loaded.end(), coupling.slave[k]));
    }
}

inline void expect_exact_derivatives(const Surfaces& surfaces) { expect_exact_derivatives(surfaces, evaluated(surfaces, true).get()); }

}  // namespace mortise::test
