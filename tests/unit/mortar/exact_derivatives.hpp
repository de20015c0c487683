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

/// Second derivatives of a sum of the gaps, against differences of the first ones. Of a pair of variational mortar evaluated on one rank with
/// derivatives.
inline void expect_exact_curvatures(const Surfaces& surfaces, SurfacePair* pair) {
  ASSERT_FALSE(pair->failure);
  const std::size_t count = surfaces.points.size();
  const auto size = static_cast<Eigen::Index>(2 * count);
  std::vector<double> pressures;
  for (std::size_t s = 0; s < surfaces.slaves; ++s) pressures.push_back(1.0 + 0.7 * disorder(5 * s + 1));
  Eigen::VectorXd of_nodes = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(surfaces.slaves));  // by id
  for (std::size_t s = 0; s < surfaces.slaves; ++s) of_nodes[pair->interface->slave_nodes()[s].id] = pressures[s];
  const Eigen::Index first_gap = static_cast<Eigen::Index>(surfaces.slaves * count);
  const auto gradient = [&] { return Eigen::VectorXd(of_nodes.transpose() * pair->dense_derivative().middleRows(first_gap, of_nodes.size())); };

  MultiVector x(pair->interface->local_nodes(), 2);
  const auto id = [&](LocalOrdinal local) { return static_cast<std::size_t>(x.getMap()->getGlobalElement(local)); };
  for (LocalOrdinal n = 0; n < static_cast<LocalOrdinal>(x.getLocalLength()); ++n)
    for (int i = 0; i < 2; ++i) x.replaceLocalValue(n, static_cast<std::size_t>(i), surfaces.points[id(n)][i]);
  Eigen::MatrixXd exact = Eigen::MatrixXd::Zero(size, size), difference = exact;
  for (const GapCurvature& facet : pair->interface->gap_curvatures(x, pressures))
    for (std::size_t a = 0; a < facet.columns.size(); ++a)
      for (std::size_t b = 0; b < facet.columns.size(); ++b)
        exact.block<2, 2>(2 * static_cast<Eigen::Index>(id(facet.columns[a])), 2 * static_cast<Eigen::Index>(id(facet.columns[b]))) +=
            facet.hessian.block<2, 2>(2 * static_cast<Eigen::Index>(a), 2 * static_cast<Eigen::Index>(b));

  const double h = 1e-6;
  auto points = surfaces.points;
  for (Eigen::Index c = 0; c < size; ++c) {
    double& coordinate = points[static_cast<std::size_t>(c / 2)][c % 2];
    const double at = coordinate;
    coordinate = at + h;
    pair->evaluate(points, true);
    difference.col(c) = gradient() / (2.0 * h);
    coordinate = at - h;
    pair->evaluate(points, true);
    difference.col(c) -= gradient() / (2.0 * h);
    coordinate = at;
  }
  const double scale = exact.cwiseAbs().maxCoeff();
  EXPECT_GT(scale, 0.0);
  EXPECT_LT((exact - difference).cwiseAbs().maxCoeff(), 1e-6 * scale);
  EXPECT_LT((exact - exact.transpose()).cwiseAbs().maxCoeff(), 1e-12 * scale);
}

inline void expect_exact_derivatives(const Surfaces& surfaces) { expect_exact_derivatives(surfaces, evaluated(surfaces, true).get()); }

}  // namespace mortise::test
