// The interface in 3D on any number of ranks: the same values as on one, searches that change nothing, failures that are reported.

#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>

#include "space_pair.hpp"

namespace mortise {
namespace {

using namespace test;

std::vector<std::pair<std::string, SurfacePair::Owner>> distributions(const Surfaces& surfaces, int ranks) {
  const std::size_t slaves = surfaces.slaves, all = surfaces.points.size();
  return {{"in blocks", [=](std::size_t n) { return static_cast<int>(n * ranks / all); }},
          {"every other", [=](std::size_t n) { return static_cast<int>(n) % ranks; }},
          {"slave first, master last", [=](std::size_t n) { return n < slaves ? 0 : ranks - 1; }}};
}

double largest_difference(const DenseCoupling& a, const DenseCoupling& b) { return (a.stacked() - b.stacked()).cwiseAbs().maxCoeff(); }

TEST(MortarRanksInSpace, GiveTheValuesOfOneRank) {
  const auto comm = Tpetra::getDefaultComm();
  for (const auto& [kind, is_quadratic] : {std::pair(FacetKind::quadrilaterals, false),
                                           {FacetKind::triangles, false},
                                           {FacetKind::mixed, false},
                                           {FacetKind::quadrilaterals, true},
                                           {FacetKind::triangles, true},
                                           {FacetKind::mixed, true}})
    for (const bool crosspoint : {false, true}) {
      Surfaces surfaces = is_quadratic ? quadratic(waves(3, 4, 0.05, kind), true, true, 0.05) : waves(5, 6, 0.05, kind);
      if (crosspoint) fix(surfaces, 14, {0, 1, 2});
      fix(surfaces, 0, {0, 1});
      const auto serial = evaluated(surfaces);
      const DenseCoupling expected = serial->dense();
      ASSERT_GT(expected.D.trace(), 0.0);
      for (const auto& [name, owner] : distributions(surfaces, comm->getSize())) {
        SCOPED_TRACE(name);
        SurfacePair pair(surfaces, comm, owner);
        pair.search(surfaces.points);
        pair.evaluate(surfaces.points, true);
        EXPECT_FALSE(pair.failure);
        EXPECT_LT(largest_difference(pair.dense(), expected), 1e-13 * expected.D.maxCoeff());
        EXPECT_EQ(pair.interface->shortest_facet(), serial->interface->shortest_facet());
        EXPECT_EQ(pair.interface->longest_facet(), serial->interface->longest_facet());
        const Eigen::VectorXd mine = pair.weights();
        Eigen::VectorXd weights = mine;
        Teuchos::reduceAll(*comm, Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), weights.data());
        EXPECT_LT((weights - serial->weights()).cwiseAbs().maxCoeff(), 1e-13 * weights.maxCoeff());
        for (const SlaveNode& node : pair.interface->slave_nodes()) {
          EXPECT_EQ(pair.interface->local_nodes()->getGlobalElement(node.local_node), node.id);
          EXPECT_EQ(pair.nodes->getGlobalElement(node.owned_node), node.id);
        }
      }
    }
}

// The slave slides over the master, turns and leaves it, in steps below and above what a search allows for. A long-lived interface finds the
// couplings that a new one finds.
TEST(MortarSearchInSpace, DoesNotDependOnItsHistory) {
  const auto comm = Tpetra::getDefaultComm();
  const Surfaces surfaces = waves(4, 7, 0.1, FacetKind::quadrilaterals, FacetKind::triangles);
  SurfacePair pair(surfaces, comm, distributions(surfaces, comm->getSize())[0].second);
  int changes = 0, steps = 0, coupled = 0, uncoupled = 0;
  for (double shift = -4.5; shift < 4.5; ++steps) {
    shift += steps % 5 == 4 ? 0.41 : 0.023 + 0.02 * disorder(static_cast<std::size_t>(steps));
    auto points = surfaces.points;
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.5 * std::sin(shift), Eigen::Vector3d(0.1, 0.2, 1.0).normalized()).toRotationMatrix();
    for (std::size_t n = 0; n < surfaces.slaves; ++n) points[n] = turn * points[n] + Eigen::Vector3d(shift, 0.3 * shift, 0.1 * std::sin(3.0 * shift));
    const auto map = pair.interface->local_nodes();
    const bool changed = pair.search(points);
    if (!changed) EXPECT_EQ(map.get(), pair.interface->local_nodes().get());
    changes += changed;
    pair.evaluate(points, false);
    EXPECT_FALSE(pair.failure);
    const DenseCoupling found = pair.dense();
    SurfacePair fresh(surfaces, alone());
    fresh.search(points);
    fresh.evaluate(points, false);
    EXPECT_LT(largest_difference(found, fresh.dense()), 1e-13) << "shift " << shift;
    ++(found.D.trace() > 0.0 ? coupled : uncoupled);
  }
  EXPECT_LT(changes, steps / 2);
  EXPECT_GT(coupled, 0);
  EXPECT_GT(uncoupled, 0);
}

TEST(MortarSearchInSpace, ReachesAsFarAsItIsTold) {
  const auto comm = Tpetra::getDefaultComm();
  Patch slave{3, 3};
  slave.z = [](double, double) { return 0.5; };
  Surfaces surfaces = two_patches(slave, Patch{4, 4, -0.2, 1.3, -0.1, 1.2});
  for (const double reach : {0.49, 0.51}) {
    surfaces.options.search_reach = reach;
    SurfacePair pair(surfaces, comm, distributions(surfaces, comm->getSize())[1].second);
    pair.search(surfaces.points);
    pair.evaluate(surfaces.points, false);
    EXPECT_EQ(pair.dense().D.trace() > 0.0, reach > 0.5);
  }
}

TEST(MortarFailuresInSpace, AreReported) {
  const auto comm = Tpetra::getDefaultComm();
  Surfaces surfaces = waves(3, 4, 0.0);
  surfaces.options.balance = 1e9;  // every facet stays with the owner of its nodes
  SurfacePair pair(surfaces, comm, [](std::size_t) { return 0; });
  pair.search(surfaces.points);
  auto points = surfaces.points;
  points[5] = points[6];
  pair.evaluate(points, false);
  EXPECT_EQ(pair.failure.has_value(), comm->getRank() == 0);
  if (pair.failure) EXPECT_EQ(pair.failure->kind(), FailureKind::inverted_facet);
  points = surfaces.points;
  points[0] = 0.2 * points[0] + 0.8 * points[5];  // the corner facet is not convex any more
  points[0] += 0.3 * (points[5] - surfaces.points[0]);
  pair.evaluate(points, false);
  EXPECT_EQ(pair.failure.has_value(), comm->getRank() == 0);
  points = surfaces.points;
  points[surfaces.slaves + 11][0] = std::nan("");
  EXPECT_FALSE(pair.search(points));
  pair.evaluate(points, false);
  EXPECT_EQ(pair.failure.has_value(), comm->getRank() == 0);
  if (pair.failure) EXPECT_EQ(pair.failure->kind(), FailureKind::not_finite);
}

}  // namespace
}  // namespace mortise
