// Slave facets handed to other ranks: work is balanced, every facet is integrated once, values are those of before to the last bit.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>

#include "mortise/mortar/coupling/node_to_segment.hpp"
#include "mortise/mortar/facet_partition.hpp"
#include "space_pair.hpp"

namespace mortise {
namespace {

using namespace test;

constexpr double never = 1e9;

Surfaces with_balance(Surfaces surfaces, double balance) {
  surfaces.options.balance = balance;
  return surfaces;
}

Surfaces curved_lines() {
  TwoLines lines;
  lines.slave = line(90, 0.05, 2.9, [](double x) { return 0.05 + 0.03 * (x - 1.2) * (x - 1.2); });
  lines.master = line(
      77, -0.2, 3.1, [](double x) { return 0.02 * std::sin(2.0 * x); }, true);
  Surfaces surfaces = lines;
  surfaces.options.search_reach = 1.0;
  return surfaces;
}

Surfaces curved_surfaces() { return waves(12, 13, 0.05); }

double sum_over_ranks(double mine, Teuchos::EReductionType how = Teuchos::REDUCE_SUM) {
  double all = 0.0;
  Teuchos::reduceAll(*Tpetra::getDefaultComm(), how, mine, Teuchos::outArg(all));
  return all;
}

double imbalance(const SurfacePair& pair) {
  const auto mine = static_cast<double>(pair.interface->load().segments);
  return sum_over_ranks(mine, Teuchos::REDUCE_MAX) * Tpetra::getDefaultComm()->getSize() / sum_over_ranks(mine);
}

/// Far enough for a real search.
std::vector<SpatialVector> shifted(const Surfaces& surfaces) {
  auto points = surfaces.points;
  for (std::size_t n = 0; n < surfaces.slaves; ++n) points[n][0] += 0.05;
  return points;
}

void expect_same_couplings(const SurfacePair& a, const SurfacePair& b) {
  const auto ids = [](const SurfacePair& pair, const auto& nodes) {
    std::vector<GlobalOrdinal> result;
    for (const LocalOrdinal node : nodes) result.push_back(pair.interface->local_nodes()->getGlobalElement(node));
    return result;
  };
  ASSERT_EQ(a.couplings.size(), b.couplings.size());
  for (std::size_t c = 0; c < a.couplings.size(); ++c) {
    const FacetCoupling &one = a.couplings[c], &other = b.couplings[c];
    ASSERT_EQ(ids(a, one.slave), ids(b, other.slave));
    ASSERT_EQ(ids(a, one.master), ids(b, other.master));
    ASSERT_EQ(ids(a, one.columns), ids(b, other.columns));
    EXPECT_TRUE(one.D == other.D && one.M == other.M && one.gap == other.gap);
    EXPECT_TRUE(one.dD == other.dD && one.dM == other.dM && one.dgap == other.dgap);
  }
}

TEST(MortarBalance, ChangesTheRankAndNothingElse) {
  const auto comm = Tpetra::getDefaultComm();
  constexpr double bound = 1.2;
  for (const Surfaces& surfaces :
       {curved_lines(), curved_surfaces(), quadratic(curved_lines(), true, true, 0.02), quadratic(curved_surfaces(), true, false, 0.02)}) {
    SCOPED_TRACE(fmt::format("{} dimensions, {} nodes of a facet", surfaces.dim, surfaces.slave.front().size()));
    const auto slave_first = [&](std::size_t n) { return n < surfaces.slaves ? 0 : comm->getSize() - 1; };
    SurfacePair owned(with_balance(surfaces, never), comm, slave_first), balanced(with_balance(surfaces, bound), comm, slave_first);
    SurfacePair serial(surfaces, alone());
    for (const auto& points : {surfaces.points, shifted(surfaces)}) {
      for (SurfacePair* pair : {&owned, &balanced, &serial}) {
        pair->search(points);
        pair->evaluate(points, true);
        EXPECT_FALSE(pair->failure);
      }
      expect_same_couplings(owned, balanced);
      const InterfaceLoad mine = balanced.interface->load(), alone = serial.interface->load();
      EXPECT_EQ(sum_over_ranks(static_cast<double>(mine.facets)), static_cast<double>(alone.facets));
      EXPECT_EQ(sum_over_ranks(static_cast<double>(mine.segments)), static_cast<double>(alone.segments));
      EXPECT_EQ(owned.interface->load().segments, comm->getRank() == 0 ? alone.segments : 0);
      EXPECT_DOUBLE_EQ(balanced.interface->load().imbalance_as_owned, comm->getSize());
    }
    EXPECT_EQ(owned.interface->load().redistributions, 0);
    EXPECT_EQ(balanced.interface->load().redistributions > 0, comm->getSize() > 1);
    EXPECT_DOUBLE_EQ(imbalance(owned), comm->getSize());
    EXPECT_LE(imbalance(balanced), bound);
  }
}

// Facets where the nodes of several ranks meet are integrated once as well.
TEST(MortarBalance, LeavesWhatIsBalancedAlone) {
  const auto comm = Tpetra::getDefaultComm();
  const Surfaces surfaces = curved_surfaces();
  const std::size_t masters = surfaces.masters();
  SurfacePair pair(surfaces, comm, [&](std::size_t n) {
    const std::size_t ranks = static_cast<std::size_t>(comm->getSize());
    return static_cast<int>(n < surfaces.slaves ? n * ranks / surfaces.slaves : (n - surfaces.slaves) * ranks / masters);
  });
  pair.search(surfaces.points);
  pair.evaluate(surfaces.points, true);
  EXPECT_LE(pair.interface->load().imbalance_as_owned, surfaces.options.balance);
  EXPECT_EQ(pair.interface->load().redistributions, 0);
  const auto serial = evaluated(surfaces);
  EXPECT_EQ(sum_over_ranks(static_cast<double>(pair.interface->load().segments)), static_cast<double>(serial->interface->load().segments));
}

TEST(MortarBalance, LetsEveryRankKnowOfAFailure) {
  const auto comm = Tpetra::getDefaultComm();
  const Surfaces surfaces = with_balance(curved_surfaces(), 1.1);
  SurfacePair pair(surfaces, comm, [](std::size_t) { return 0; });
  pair.search(surfaces.points);
  const auto message = [&](const std::vector<SpatialVector>& points) {
    pair.evaluate(points, true);
    try {
      throw_if_any(*comm, pair.failure);
    } catch (const StepFailure& failure) {
      EXPECT_EQ(failure.kind(), FailureKind::inverted_facet);
      return std::string(failure.what());
    }
    return std::string();
  };
  auto points = surfaces.points;
  points[5] = points[6];
  EXPECT_NE(message(points).find("node 5"), std::string::npos);
  points = surfaces.points;
  points[0] += 0.7 * (points[14] - points[0]);  // the corner facet is not convex any more
  EXPECT_NE(message(points).find("slave facet of nodes"), std::string::npos);
  EXPECT_EQ(message(surfaces.points), "");
}

TEST(MortarBalance, IsNotForNodeToSegment) {
  const auto comm = Tpetra::getDefaultComm();
  Surfaces surfaces = curved_lines();
  surfaces.options.coupling = coupling_of<NodeToSegmentCoupling>();
  SurfacePair pair(surfaces, comm, [](std::size_t) { return 0; });
  pair.search(surfaces.points);
  pair.evaluate(surfaces.points, true);
  EXPECT_EQ(pair.interface->load().redistributions, 0);
  EXPECT_EQ(pair.couplings.empty(), comm->getRank() != 0);
}

// Work of 1 to 4 on a plane grid. A part can exceed the mean by what one facet more weighs, and by the tolerance of the cuts.
TEST(FacetPartition, SharesWorkOut) {
  const auto comm = Tpetra::getDefaultComm();
  constexpr int edge = 60;
  for (const int parts : {1, 7, 36}) {
    std::vector<PartitionedFacet> facets;
    for (int f = comm->getRank(); f < edge * edge; f += comm->getSize())
      facets.push_back({{0.1 * (f % edge), 0.1 * (f / edge), 0.3}, 1.0 + static_cast<double>((f * 7) % 4)});
    const std::vector<int> part = partition_facets(comm, facets, parts);
    ASSERT_EQ(part.size(), facets.size());
    std::vector<double> mine(static_cast<std::size_t>(parts), 0.0), work = mine;
    for (std::size_t f = 0; f < part.size(); ++f) {
      ASSERT_GE(part[f], 0);
      ASSERT_LT(part[f], parts);
      mine[part[f]] += facets[f].work;
    }
    Teuchos::reduceAll(*comm, Teuchos::REDUCE_SUM, parts, mine.data(), work.data());
    double sum = 0.0;
    for (const double one : work) sum += one;
    const double mean = sum / parts;
    for (const double one : work) EXPECT_LE(one, 1.1 * mean + 4.0);
  }
}

// Two facets of a tie on three ranks: some have none, and all stand on one rank or lie at one place.
TEST(Balance, FewFacetsHaveAPartition) {
  const auto comm = Tpetra::getDefaultComm();
  for (int number = 0; number <= 12; ++number)
    for (int home = 0; home < comm->getSize(); ++home)
      for (const bool apart : {false, true})
        for (const double work : {0.0, 1.0}) {
          std::vector<PartitionedFacet> facets;
          if (comm->getRank() == home)
            for (int f = 0; f < number; ++f) facets.push_back({{apart ? 0.1 * f : 0.5, 0.3, 0.0}, work});
          const std::vector<int> part = partition_facets(comm, facets, comm->getSize());
          ASSERT_EQ(part.size(), facets.size());
          for (const int one : part) EXPECT_TRUE(one >= 0 && one < comm->getSize()) << number << " facets on rank " << home;
        }
}

}  // namespace
}  // namespace mortise
