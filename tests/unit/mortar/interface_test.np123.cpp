// The interface on any number of ranks: the same values as on one, searches that change nothing, errors that every rank sees.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>

#include "surface_pair.hpp"

namespace mortise {
namespace {

using namespace test;

TwoLines wavy() {
  TwoLines lines;
  lines.slave = line(13, 0.0, 6.0, [](double x) { return 0.1 + 0.04 * (x - 2.0) * (x - 2.0); });
  lines.master = line(
      40, -8.0, 14.0, [](double x) { return 0.07 * std::sin(1.9 * x); }, true);
  return lines;
}

std::vector<std::pair<std::string, SurfacePair::Owner>> distributions(const TwoLines& lines, int ranks) {
  const std::size_t slaves = lines.slave.size(), all = slaves + lines.master.size();
  return {{"in blocks", [=](std::size_t n) { return static_cast<int>(n * ranks / all); }},
          {"every other", [=](std::size_t n) { return static_cast<int>(n) % ranks; }},
          {"slave first, master last", [=](std::size_t n) { return n < slaves ? 0 : ranks - 1; }}};
}

double largest_difference(const DenseCoupling& a, const DenseCoupling& b) { return (a.stacked() - b.stacked()).cwiseAbs().maxCoeff(); }

TEST(MortarRanks, GiveTheValuesOfOneRank) {
  const auto comm = Tpetra::getDefaultComm();
  for (const bool axisymmetric : {false, true})
    for (const bool crosspoint : {false, true}) {
      TwoLines lines = wavy();
      lines.measure.axisymmetric = axisymmetric;
      if (crosspoint) lines.fixed_x = lines.fixed_y = {6};
      lines.fixed_x.push_back(0);
      const auto serial = evaluated(lines);
      const DenseCoupling expected = serial->dense();
      ASSERT_GT(expected.D.minCoeff(), -1e-300);
      for (const auto& [name, owner] : distributions(lines, comm->getSize())) {
        SCOPED_TRACE(name);
        SurfacePair pair(lines, comm, owner);
        pair.search(lines.points());
        pair.evaluate(lines.points(), true);
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

// The slave slides over the whole master and off both its ends, in steps below and above what a search allows for. A long-lived
// interface finds the couplings that a new one finds.
TEST(MortarSearch, DoesNotDependOnItsHistory) {
  const auto comm = Tpetra::getDefaultComm();
  TwoLines lines = wavy();
  SurfacePair pair(lines, comm, distributions(lines, comm->getSize())[0].second);
  int changes = 0, steps = 0, coupled = 0, uncoupled = 0;
  double shift = -10.0;
  while (shift < 16.0) {
    shift += steps % 5 == 4 ? 0.61 : 0.043 + 0.03 * disorder(static_cast<std::size_t>(steps));
    Points points = lines.points();
    const Eigen::Matrix2d turn = Eigen::Rotation2Dd(0.1 * std::sin(shift)).toRotationMatrix();
    for (std::size_t n = 0; n < lines.slave.size(); ++n)
      points[n] = turn * (points[n] - lines.slave[6]) + lines.slave[6] + Eigen::Vector2d(shift, 0.1 * std::sin(3.0 * shift));
    const auto map = pair.interface->local_nodes();
    const bool changed = pair.search(points);
    if (!changed) EXPECT_EQ(map.get(), pair.interface->local_nodes().get());
    changes += changed;
    ++steps;
    pair.evaluate(points, false);
    EXPECT_FALSE(pair.failure);
    const DenseCoupling found = pair.dense();
    SurfacePair fresh(lines, alone());
    fresh.search(points);
    fresh.evaluate(points, false);
    EXPECT_LT(largest_difference(found, fresh.dense()), 1e-13) << "shift " << shift;
    ++(found.D.trace() > 0.0 ? coupled : uncoupled);
  }
  EXPECT_LT(changes, steps / 2);
  EXPECT_GT(coupled, 0);
  EXPECT_GT(uncoupled, 0);
}

TEST(MortarSearch, ReachesAsFarAsItIsTold) {
  const auto comm = Tpetra::getDefaultComm();
  TwoLines lines;
  lines.slave = line(4, 0.0, 4.0, [](double) { return 0.5; });
  lines.master = line(
      5, -1.0, 5.0, [](double) { return 0.0; }, true);
  for (const double reach : {0.49, 0.51}) {
    lines.options.search_reach = reach;
    SurfacePair pair(lines, comm, distributions(lines, comm->getSize())[1].second);
    pair.search(lines.points());
    pair.evaluate(lines.points(), false);
    EXPECT_EQ(pair.dense().D.trace() > 0.0, reach > 0.5);
  }
}

// A body's far side turns its back to the slave and takes no part.
TEST(MortarSearch, IgnoresFacetsThatFaceTheSameWay) {
  const auto comm = Tpetra::getDefaultComm();
  TwoLines lines;
  lines.slave = line(4, 0.0, 4.0, [](double) { return 0.1; });
  lines.master = line(
      5, -1.0, 5.0, [](double) { return 0.0; }, true);
  const auto owner = distributions(lines, comm->getSize())[1].second;
  SurfacePair thick(lines, comm, owner);
  thick.search(lines.points());
  thick.evaluate(lines.points(), false);
  const DenseCoupling expected = thick.dense();
  // a sheet: round its left end and back to the right below
  for (int i = 0; i <= 5; ++i) lines.master.push_back({-1.0 + 1.2 * i, -0.1});
  SurfacePair sheet(lines, comm, owner);
  sheet.search(lines.points());
  sheet.evaluate(lines.points(), false);
  EXPECT_LT((sheet.dense().gap - expected.gap).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_LT((sheet.dense().D - expected.D).cwiseAbs().maxCoeff(), 1e-14);
}

std::string refusal(const TwoLines& lines) {
  const auto comm = Tpetra::getDefaultComm();
  try {
    SurfacePair pair(lines, comm, distributions(lines, comm->getSize())[1].second);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(MortarErrors, AreSeenByEveryRankAndSayWhatToDo) {
  using ::testing::HasSubstr;
  TwoLines fixed = wavy();
  fixed.fixed_x = fixed.fixed_y = {3, 4};
  EXPECT_THAT(refusal(fixed), HasSubstr("make this side the master"));
  EXPECT_THAT(refusal(fixed), HasSubstr("scene.xml:7"));
  EXPECT_THAT(refusal(fixed), HasSubstr("contact/pair"));

  TwoLines no_slave = wavy();
  no_slave.slave.resize(1);
  EXPECT_THAT(refusal(no_slave), HasSubstr("slave surface is empty"));
  TwoLines no_master = wavy();
  no_master.master.resize(1);
  EXPECT_THAT(refusal(no_master), HasSubstr("master surface is empty"));

  TwoLines short_slave = wavy();
  short_slave.slave[5] = short_slave.slave[4];
  EXPECT_THAT(refusal(short_slave), HasSubstr("without length"));
  TwoLines short_master = wavy();
  short_master.master[5] = short_master.master[4];
  EXPECT_THAT(refusal(short_master), HasSubstr("no length"));
}

TEST(MortarErrors, ANodeOnBothSides) {
  const auto comm = Tpetra::getDefaultComm();
  const std::vector<GlobalOrdinal> ids = comm->getRank() == 0 ? std::vector<GlobalOrdinal>{0, 1, 2} : std::vector<GlobalOrdinal>{};
  const auto nodes = rcp(new Map(3, ids.data(), static_cast<LocalOrdinal>(ids.size()), 0, comm));
  const auto x = rcp(new MultiVector(nodes, 2)), fixed = rcp(new MultiVector(nodes, 2));
  for (const GlobalOrdinal id : ids) x->replaceGlobalValue(id, 0, static_cast<double>(id));
  const SurfaceFacets slave = ids.empty() ? SurfaceFacets{} : SurfaceFacets{{0, 1}}, master = ids.empty() ? SurfaceFacets{} : SurfaceFacets{{1, 2}};
  try {
    MortarInterface interface(nodes, x, fixed, slave, master, {}, {}, {});
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("node 1 lies on the slave and on the master"));
  }
}

TEST(MortarFailures, AreReported) {
  const auto comm = Tpetra::getDefaultComm();
  TwoLines lines = wavy();
  lines.options.balance = 1e9;  // every facet stays with the owner of its nodes
  SurfacePair pair(lines, comm, [](std::size_t) { return 0; });
  pair.search(lines.points());
  Points points = lines.points();
  points[4] = points[3];
  pair.evaluate(points, false);
  EXPECT_EQ(pair.failure.has_value(), comm->getRank() == 0);
  if (pair.failure) EXPECT_EQ(pair.failure->kind(), FailureKind::inverted_facet);
  points = lines.points();
  points[lines.slave.size() + 25].x() = std::nan("");
  EXPECT_FALSE(pair.search(points));
  pair.evaluate(points, false);
  EXPECT_EQ(pair.failure.has_value(), comm->getRank() == 0);
  if (pair.failure) EXPECT_EQ(pair.failure->kind(), FailureKind::not_finite);
}

}  // namespace
}  // namespace mortise
