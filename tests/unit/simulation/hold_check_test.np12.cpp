#include "mortise/simulation/model/hold_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Core.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <algorithm>
#include <limits>

#include "mortise/mesh/build_mesh.hpp"
#include "mortise/mesh/generators.hpp"
#include "mortise/mesh/sets.hpp"

namespace mortise {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A block of 2 x 1 on one of 3 x 1, the interface at y = 1 and a gap between them.
struct TwoBlocks {
  RCP<Mesh> mesh;
  RCP<MultiVector> fixed;
  SurfaceFacets slave, master;
  std::vector<Place> places{{"scene.xml", 3, "bodies/lower"}, {"scene.xml", 7, "bodies/upper"}};

  explicit TwoBlocks(double gap = 0.0, double rotation = 0.0) {
    const auto block = [&](double width, int cells, double y) {
      auto options = std::make_shared<BlockMesh>();
      options->width = width;
      options->cells_x = cells;
      options->cells_y = 2;
      options->corners = {0.0, y, width, y, width, y + 1.0, 0.0, y + 1.0};
      options->rotation = rotation;
      return options;
    };
    mesh = build_mesh(Tpetra::getDefaultComm(), {{"lower", places[0], block(3.0, 5, 0.0)}, {"upper", places[1], block(2.0, 3, 1.0 + gap)}}, {});
    fixed = rcp(new MultiVector(mesh->owned_nodes, 2));
    slave = facets_at_owned_nodes(*mesh, mesh->side_sets.at("upper/bottom"));
    master = facets_of_owned_elements(*mesh, mesh->side_sets.at("lower/top"));
  }

  void fix(const std::string& set, int component) {
    const auto values = fixed->getLocalViewHost(Tpetra::Access::ReadWrite);
    for (const LocalOrdinal node : mesh->node_sets.at(set))
      if (node < mesh->owned_count()) values(node, component) = 1.0;
  }

  bool friction = false;

  std::vector<char> check(bool with_contact, bool axisymmetric = false) const {
    std::vector<HoldingPair> pairs;
    if (with_contact) pairs.push_back({&slave, &master, 0.0, friction});
    return check_held(*displacement_space(mesh), axisymmetric, {{}, fixed, {}, {}, {}}, pairs, places);
  }

  std::vector<std::string> complaints(bool with_contact, bool axisymmetric = false) const {
    std::vector<std::string> messages;
    try {
      check(with_contact, axisymmetric);
    } catch (const InputError& error) {
      for (const auto& diagnostic : error.diagnostics()) messages.push_back(to_string(diagnostic));
    }
    return messages;
  }
};

TEST(HoldCheck, ClampedBodiesAreHeld) {
  TwoBlocks blocks;
  for (const char* set : {"lower/bottom", "upper/top"})
    for (int i = 0; i < 2; ++i) blocks.fix(set, i);
  EXPECT_THAT(blocks.check(false), ElementsAre(0, 0));
}

TEST(HoldCheck, ContactHoldsAcrossTheInterfaceAndNotAlongIt) {
  TwoBlocks blocks;
  blocks.fix("lower/bottom", 0);
  blocks.fix("lower/bottom", 1);
  EXPECT_THAT(blocks.complaints(true), ElementsAre(HasSubstr("scene.xml:7: error: bodies/upper: body 'upper' can move: translation in x")));
  blocks.fix("upper/left", 0);
  EXPECT_THAT(blocks.check(true), ElementsAre(0, 1));
}

// One facet keeps a body from turning.
TEST(HoldCheck, ContactOfOneFacetHolds) {
  TwoBlocks blocks;
  blocks.fix("lower/bottom", 0);
  blocks.fix("lower/bottom", 1);
  const auto values = blocks.fixed->getLocalViewHost(Tpetra::Access::ReadWrite);
  for (LocalOrdinal node = 0; node < blocks.mesh->owned_count(); ++node)  // one node, which leaves the rotation
    if (blocks.mesh->body_of_node[node] == 1 && blocks.mesh->coordinates[node][0] == 0.0 && blocks.mesh->coordinates[node][1] == 2.0)
      values(node, 0) = 1.0;
  const auto holds_x = [](const SurfaceFacet& facet) { return std::min(facet.front(), facet.back()); };
  GlobalOrdinal mine = std::numeric_limits<GlobalOrdinal>::max(), first = mine;
  for (const SurfaceFacet& facet : blocks.slave) mine = std::min(mine, holds_x(facet));
  Teuchos::reduceAll(*blocks.mesh->comm, Teuchos::REDUCE_MIN, mine, Teuchos::outArg(first));
  blocks.slave.erase(std::remove_if(blocks.slave.begin(), blocks.slave.end(), [&](const SurfaceFacet& facet) { return holds_x(facet) != first; }),
                     blocks.slave.end());
  EXPECT_THAT(blocks.check(true), ElementsAre(0, 1));
}

TEST(HoldCheck, FrictionHoldsAlongTheInterface) {
  TwoBlocks blocks;
  blocks.fix("lower/bottom", 0);
  blocks.fix("lower/bottom", 1);
  EXPECT_EQ(blocks.complaints(true).size(), 1u);
  blocks.friction = true;
  EXPECT_THAT(blocks.check(true), ElementsAre(0, 1));
  TwoBlocks apart(50.0);
  apart.fix("lower/bottom", 0);
  apart.fix("lower/bottom", 1);
  apart.friction = true;
  EXPECT_EQ(apart.complaints(true).size(), 3u);
}

TEST(HoldCheck, WithoutContactEveryFreeModeIsNamed) {
  TwoBlocks blocks;
  blocks.fix("lower/bottom", 0);
  blocks.fix("lower/bottom", 1);
  EXPECT_EQ(blocks.complaints(false).size(), 3u);
  blocks.fix("upper/left", 0);  // holds x and the rotation
  EXPECT_THAT(blocks.complaints(false), ElementsAre(HasSubstr("body 'upper' can move: translation in y")));
}

TEST(HoldCheck, RollersLeaveOneDirection) {
  TwoBlocks blocks;
  blocks.fix("lower/bottom", 1);
  blocks.fix("upper/top", 0);
  blocks.fix("upper/top", 1);
  EXPECT_THAT(blocks.complaints(false), ElementsAre(HasSubstr("body 'lower' can move: translation in x")));
}

TEST(HoldCheck, OnePinLeavesTheRotation) {
  TwoBlocks blocks;
  blocks.fix("upper/top", 0);
  blocks.fix("upper/top", 1);
  const auto values = blocks.fixed->getLocalViewHost(Tpetra::Access::ReadWrite);
  for (LocalOrdinal node = 0; node < blocks.mesh->owned_count(); ++node) {
    const auto& x = blocks.mesh->coordinates[node];
    if (x[0] == 0.0 && x[1] == 0.0) values(node, 0) = values(node, 1) = 1.0;
  }
  EXPECT_EQ(blocks.complaints(false).size(), 1u);
  EXPECT_THAT(blocks.complaints(false), ElementsAre(HasSubstr("body 'lower' can move")));
}

TEST(HoldCheck, ContactOutOfReachHoldsNothing) {
  TwoBlocks blocks(50.0);
  blocks.fix("lower/bottom", 0);
  blocks.fix("lower/bottom", 1);
  blocks.fix("upper/left", 0);
  EXPECT_THAT(blocks.complaints(true), ElementsAre(HasSubstr("body 'upper' can move: translation in y")));
}

TEST(HoldCheck, AnInclinedInterfaceHoldsWithOneComponentElsewhere) {
  TwoBlocks blocks(0.0, 30.0);
  blocks.fix("lower/bottom", 0);
  blocks.fix("lower/bottom", 1);
  EXPECT_EQ(blocks.complaints(true).size(), 1u);
  blocks.fix("upper/top", 0);  // fixes sliding: x is not normal to the interface
  EXPECT_THAT(blocks.check(true), ElementsAre(0, 1));
}

TEST(HoldCheck, AxisymmetricBodiesMoveAlongTheAxisOnly) {
  TwoBlocks blocks;
  blocks.fix("lower/bottom", 1);
  EXPECT_THAT(blocks.complaints(false, true), ElementsAre(HasSubstr("body 'upper' can move: translation along the axis")));
  EXPECT_THAT(blocks.check(true, true), ElementsAre(0, 1));
}

}  // namespace
}  // namespace mortise
