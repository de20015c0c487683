// Nodes whose facets are hardly covered hand their functions over; on any number of ranks the same ones.

#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>

#include "space_pair.hpp"

namespace mortise {
namespace {

using namespace test;

// Slave: 5 x 5 nodes over [0, 4] x [0, 4], node n = i + 5 j; the master ends at x = `edge`.
Surfaces up_to(double edge, FacetKind kind, bool curved) {
  Patch slave{4, 4, 0.0, 4.0, 0.0, 4.0, kind}, master{4, 6, -0.5, edge, -0.5, 4.5};
  if (curved) {
    slave.z = [](double x, double y) { return 0.05 + 0.02 * std::sin(1.3 * x + 0.4 * y); };
    master.z = [](double x, double y) { return 0.02 * std::cos(0.9 * x - 1.1 * y); };
  }
  Surfaces surfaces = two_patches(slave, master);
  surfaces.options.search_reach = 1.0;
  return surfaces;
}

class HandOver {
 public:
  HandOver(const Surfaces& surfaces, const RCP<const Communicator>& comm, const SurfacePair::Owner& owner)
      : surfaces_(surfaces), pair(surfaces, comm, owner) {
    pair.search(surfaces.points);
  }
  DenseCoupling evaluated() {
    pair.evaluate(surfaces_.points, true);
    EXPECT_FALSE(pair.failure);
    return pair.dense();
  }
  // Collective. What is covered, by the weights; other values for some nodes.
  bool choose(const std::vector<std::pair<GlobalOrdinal, double>>& other = {}) {
    std::vector<double> cover(pair.interface->slave_nodes().size(), 0.0);
    for (const FacetCoupling& coupling : pair.couplings) {
      const FacetVector of_facet = covered_weights(3, coupling);
      for (std::size_t k = 0; k < coupling.slave.size(); ++k)
        if (const auto s = static_cast<std::size_t>(coupling.slave[k]); s < cover.size())
          cover[s] += of_facet[static_cast<Eigen::Index>(k)] / pair.interface->slave_nodes()[s].weight;
    }
    for (const auto& [node, value] : other)
      for (std::size_t s = 0; s < cover.size(); ++s)
        if (pair.interface->slave_nodes()[s].id == node) cover[s] = value;
    return pair.interface->hand_over(cover);
  }

 private:
  Surfaces surfaces_;

 public:
  SurfacePair pair;
};

std::vector<GlobalOrdinal> without_row(const DenseCoupling& coupling) {
  std::vector<GlobalOrdinal> nodes;
  for (Eigen::Index j = 0; j < coupling.D.rows(); ++j)
    if (coupling.D.row(j).isZero(0.0) && coupling.M.row(j).isZero(0.0) && coupling.gap[j] == 0.0) nodes.push_back(j);
  return nodes;
}

const std::vector<GlobalOrdinal> fourth_column = {3, 8, 13, 18, 23}, fifth_column = {4, 9, 14, 19, 24};

TEST(HandOver, LeavesForcesAndTheirPlacesAsTheyAre) {
  const auto comm = Tpetra::getDefaultComm();
  for (const FacetKind kind : {FacetKind::quadrilaterals, FacetKind::triangles})
    for (const bool curved : {false, true}) {
      const Surfaces surfaces = up_to(2.2, kind, curved);  // a strip of 0.2 of the third facets: 2 % of the fourth nodes' weight
      HandOver serial(surfaces, alone(), [](std::size_t) { return 0; }),
          ranks(surfaces, comm, [&](std::size_t n) { return static_cast<int>(n) % comm->getSize(); });
      const DenseCoupling before = ranks.evaluated();
      EXPECT_EQ(without_row(before), fifth_column);
      EXPECT_TRUE(ranks.choose());
      const DenseCoupling after = ranks.evaluated();
      std::vector<GlobalOrdinal> both = fourth_column;
      both.insert(both.end(), fifth_column.begin(), fifth_column.end());
      std::sort(both.begin(), both.end());
      EXPECT_EQ(without_row(after), both);
      // phi sums to 1: where forces of constant multipliers act does not change, on either side. Multipliers lose no force.
      EXPECT_LT((after.D.colwise().sum() - before.D.colwise().sum()).cwiseAbs().maxCoeff(), 1e-14);
      EXPECT_LT((after.M.colwise().sum() - before.M.colwise().sum()).cwiseAbs().maxCoeff(), 1e-12);
      EXPECT_LT((after.D.rowwise().sum() - after.M.rowwise().sum()).cwiseAbs().maxCoeff(), 1e-12);
      // Nothing changes where facets are well covered.
      for (Eigen::Index j = 0; j < 25; ++j)
        if (j % 5 < 2) EXPECT_TRUE(after.D.row(j) == before.D.row(j) && after.M.row(j) == before.M.row(j) && after.gap[j] == before.gap[j]);
      for (Eigen::Index j = 0; j < 25; ++j)
        if (j % 5 == 2) EXPECT_GT(after.D(j, j + 1), 0.0);

      EXPECT_FALSE(ranks.choose());
      serial.evaluated();
      EXPECT_TRUE(serial.choose());
      EXPECT_LT((serial.evaluated().stacked() - after.stacked()).cwiseAbs().maxCoeff(), 1e-14);
    }
}

TEST(HandOver, EndsWithTwiceTheCoverThatItBeginsWith) {
  const auto comm = Tpetra::getDefaultComm();
  HandOver one(up_to(2.2, FacetKind::quadrilaterals, false), comm, [&](std::size_t n) { return static_cast<int>(n) % comm->getSize(); });
  const DenseCoupling before = one.evaluated();
  const auto all = [](double cover) {
    std::vector<std::pair<GlobalOrdinal, double>> result;
    for (const GlobalOrdinal node : fourth_column) result.emplace_back(node, cover);
    return result;
  };
  const std::size_t few = fifth_column.size();
  one.choose(all(0.101));
  EXPECT_EQ(without_row(one.evaluated()).size(), few);
  EXPECT_TRUE(one.choose(all(0.099)));
  EXPECT_EQ(without_row(one.evaluated()).size(), few + 5);
  EXPECT_FALSE(one.choose(all(0.199)));
  EXPECT_TRUE(one.choose(all(0.201)));
  const DenseCoupling after = one.evaluated();
  EXPECT_EQ(without_row(after), fifth_column);
  EXPECT_TRUE(after.D == before.D && after.M == before.M);
}

// Where no node of a facet would be left to take the functions, its nodes keep theirs.
TEST(HandOver, NeedsSomebodyToTakeOver) {
  const auto comm = Tpetra::getDefaultComm();
  HandOver one(up_to(3.5, FacetKind::quadrilaterals, false), comm, [&](std::size_t n) { return static_cast<int>(n) % comm->getSize(); });
  one.evaluated();
  std::vector<std::pair<GlobalOrdinal, double>> cover;
  for (GlobalOrdinal node = 0; node < 25; ++node) cover.emplace_back(node, 0.01);
  EXPECT_FALSE(one.choose(cover));  // all alike
  // Around the facet of nodes 6, 7, 11 and 12 all are well covered, its own nodes are not.
  for (GlobalOrdinal node = 0; node < 25; ++node) cover[node].second = node == 6 || node == 7 || node == 11 || node == 12 ? 0.01 : 0.5;
  EXPECT_FALSE(one.choose(cover));
  cover[7].second = 0.0;  // then nothing of that facet is covered: node 7 has nothing to act on, and keeps it
  EXPECT_TRUE(one.choose(cover));
  EXPECT_EQ(without_row(one.evaluated()), (std::vector<GlobalOrdinal>{6, 11, 12}));
  cover[7].second = 0.01;
  cover[6].second = 0.5;
  EXPECT_TRUE(one.choose(cover));
  EXPECT_EQ(without_row(one.evaluated()), (std::vector<GlobalOrdinal>{7, 11, 12}));
}

// The corner of a master's face reaches a little beyond a corner node of quadratic slave facets: beside it there is a facet that is covered next to
// that node and nowhere else. Its middles have nothing to act on, so the node inherits.
TEST(HandOver, LeavesFacetsWithoutMiddleToTheirOnlyCorner) {
  const auto comm = Tpetra::getDefaultComm();
  for (const FacetKind kind : {FacetKind::quadrilaterals, FacetKind::triangles})
    for (const double bend : {0.0, 0.05}) {
      Surfaces surfaces = quadratic(two_patches({4, 4, 0.0, 4.0, 0.0, 4.0, kind}, {4, 3, -0.5, 2.1, -0.5, 2.15}), true, false, bend);
      surfaces.options.search_reach = 1.0;
      HandOver serial(surfaces, alone(), [](std::size_t) { return 0; }),
          ranks(surfaces, comm, [&](std::size_t n) { return static_cast<int>(n) % comm->getSize(); });
      const DenseCoupling before = ranks.evaluated();
      EXPECT_TRUE(ranks.choose());
      const DenseCoupling after = ranks.evaluated();
      const auto carries = [&](GlobalOrdinal node) { return after.D(node, node) != 0.0; };
      int covered = 0, only_a_corner = 0;
      for (const SurfaceFacet& facet : surfaces.slave) {
        const auto corners = facet.begin() + static_cast<std::ptrdiff_t>(facet.size() / 2);
        if (std::find(facet.begin(), corners, 12) == corners) continue;  // node 12 at (2, 2) is the one
        ++covered;
        if (std::any_of(corners, facet.end(), carries)) continue;
        ++only_a_corner;
        EXPECT_EQ(std::count_if(facet.begin(), corners, carries), 1);
        EXPECT_TRUE(carries(12));
      }
      EXPECT_EQ(covered, kind == FacetKind::quadrilaterals ? 4 : 6);
      EXPECT_GE(only_a_corner, 1);
      // No force is lost or moved, and corners act on nodes without multiplier only.
      EXPECT_LT((after.D.colwise().sum() - before.D.colwise().sum()).cwiseAbs().maxCoeff(), 1e-13);
      EXPECT_LT((after.M.colwise().sum() - before.M.colwise().sum()).cwiseAbs().maxCoeff(), 1e-12);
      EXPECT_LT((after.D.rowwise().sum() - after.M.rowwise().sum()).cwiseAbs().maxCoeff(), 1e-12);
      for (GlobalOrdinal corner = 0; corner < 25; ++corner)
        for (GlobalOrdinal node = 0; node < after.D.cols(); ++node)
          if (node != corner && carries(node)) EXPECT_LT(std::abs(after.D(corner, node)), 1e-14) << corner << " " << node;
      EXPECT_GT(after.D.diagonal().minCoeff(), -1e-14);

      EXPECT_FALSE(ranks.choose());
      serial.evaluated();
      EXPECT_TRUE(serial.choose());
      EXPECT_LT((serial.evaluated().stacked() - after.stacked()).cwiseAbs().maxCoeff(), 1e-13);
    }
}

// Where two corners of such a facet carry, a middle between them could not leave them its function without coupling one to the other: middles stay.
TEST(HandOver, NeedsMiddlesWhereMoreThanOneCornerCarries) {
  const auto comm = Tpetra::getDefaultComm();
  for (const FacetKind kind : {FacetKind::quadrilaterals, FacetKind::triangles}) {
    Surfaces surfaces = quadratic(two_patches({4, 4, 0.0, 4.0, 0.0, 4.0, kind}, {4, 3, -0.5, 4.5, -0.5, 4.5}), true, false, 0.0);
    surfaces.options.search_reach = 1.0;
    HandOver one(surfaces, comm, [&](std::size_t n) { return static_cast<int>(n) % comm->getSize(); });
    one.evaluated();
    const auto choose = [&](const std::vector<GlobalOrdinal>& corners) {
      std::vector<std::pair<GlobalOrdinal, double>> cover;
      for (GlobalOrdinal node = 0; node < static_cast<GlobalOrdinal>(surfaces.slaves); ++node)
        cover.emplace_back(node, std::find(corners.begin(), corners.end(), node) != corners.end() ? 0.5 : 0.05);
      EXPECT_TRUE(one.choose(cover));
      const DenseCoupling dense = one.evaluated();
      int middles = 0;
      for (const SurfaceFacet& facet : surfaces.slave) {
        const auto corners_end = facet.begin() + static_cast<std::ptrdiff_t>(facet.size() / 2);
        const auto carries = [&](GlobalOrdinal node) { return dense.D(node, node) != 0.0; };
        const auto own = std::count_if(corners_end, facet.end(), carries);
        if (own == 0) EXPECT_EQ(std::count_if(facet.begin(), corners_end, carries), 1);
        if (std::find(facet.begin(), corners_end, 12) != corners_end && std::find(facet.begin(), corners_end, 18) != corners_end)
          middles = std::max(middles, static_cast<int>(own));
      }
      return middles;
    };
    EXPECT_EQ(choose({12}), 0);
    EXPECT_GT(choose({12, 18}), 0);  // at the ends of a diagonal: of one facet of either kind
  }
}

}  // namespace
}  // namespace mortise
