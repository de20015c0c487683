// Elements that are one another's nearest across contact.

#include "distribution/facing_elements.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "distribution/partition.hpp"
#include "mortise/mesh/generators.hpp"
#include "mortise/mesh/volume_generators.hpp"

namespace mortise {
namespace {

using Pair = std::array<GlobalOrdinal, 2>;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::shared_ptr<BlockMesh> row(int cells, double y) {
  auto block = std::make_shared<BlockMesh>();
  block->width = 12.0;
  block->height = 1.0;
  block->cells_x = cells;
  block->cells_y = 1;
  block->translation = {0.0, y};
  return block;
}

std::vector<Pair> facing(const std::vector<BodyDescription>& bodies, const std::vector<std::string>& sides) {
  return facing_elements(BodySet(bodies), contact_flags(BodySet(bodies), bodies, sides));
}

// Midpoints below 1, 3, 5, 7, 9, 11, above 2, 6, 10: those above are as far from two below, and take one of them each. With a gap between them too.
TEST(FacingElements, AreOneAnothersNearest) {
  for (const double gap : {0.0, 0.5}) {
    const auto pairs = facing({{"lower", {}, row(6, 0.0), CellShape::quadrilateral4}, {"upper", {}, row(3, 1.0 + gap), CellShape::quadrilateral4}},
                              {"lower/top", "upper/bottom"});
    ASSERT_EQ(pairs.size(), 3u);
    for (const auto& [below, above] : pairs) EXPECT_EQ(below / 2, above - 6);
  }
}

TEST(FacingElements, StandOnSidesInContactOfTwoBodies) {
  const BodyDescription lower{"lower", {}, row(2, 0.0), CellShape::quadrilateral4}, middle{"middle", {}, row(2, 1.0), CellShape::quadrilateral4},
      upper{"upper", {}, row(2, 2.0), CellShape::quadrilateral4};
  EXPECT_THAT(facing({lower, middle, upper}, {"lower/top", "middle/bottom", "middle/top", "upper/bottom"}),
              ElementsAre(Pair{0, 2}, Pair{1, 3}, Pair{2, 4}, Pair{3, 5}));
  EXPECT_THAT(facing({lower, middle, upper}, {"lower/top", "middle/bottom"}), ElementsAre(Pair{0, 2}, Pair{1, 3}));
  EXPECT_THAT(facing({lower, middle}, {"middle/bottom", "middle/top"}), IsEmpty());
}

// A rigid tool's facets are their own sides.
TEST(FacingElements, InSpaceAndOfRigidSurfaces) {
  auto base = std::make_shared<BrickMesh>(), tool = std::make_shared<BrickMesh>();
  for (auto* brick : {base.get(), tool.get()}) {
    brick->width = brick->depth = brick->height = 2.0;
    brick->cells_x = brick->cells_y = 2;
    brick->cells_z = 1;
  }
  tool->translation = {0.0, 0.0, 2.1};
  const auto pairs = facing({{"base", {}, base, CellShape::hexahedron8}, {"tool", {}, tool, rigid_shape(3)}}, {"base/top", "tool/bottom"});
  ASSERT_EQ(pairs.size(), 4u);
  for (std::size_t i = 0; i < pairs.size(); ++i) EXPECT_EQ(pairs[i][0], static_cast<GlobalOrdinal>(i));
}

}  // namespace
}  // namespace mortise
