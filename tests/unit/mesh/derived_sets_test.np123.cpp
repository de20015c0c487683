// Sets derived from others: unions, intersections, differences, places, normals and the nearest, counted on a brick of 4 x 3 x 2 cells.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Core.hpp>
#include <Tpetra_Map.hpp>
#include <algorithm>

#include "mesh_test_support.hpp"
#include "mortise/mesh/build_mesh.hpp"
#include "mortise/mesh/sets.hpp"
#include "mortise/mesh/surface_patches.hpp"
#include "mortise/mesh/volume_generators.hpp"

namespace mortise {
namespace {

const Place place{"scene.xml", 12, "sets/chosen"};

class DerivedSets : public ::testing::Test {
 protected:
  DerivedSets() {
    auto brick = std::make_shared<BrickMesh>();
    brick->width = 4.0, brick->depth = 3.0, brick->height = 2.0;
    brick->cells_x = 4, brick->cells_y = 3, brick->cells_z = 2;
    mesh_ = build_mesh(Tpetra::getDefaultComm(), {{"brick", {}, brick, CellShape::hexahedron8}}, {});
  }

  GlobalOrdinal total(GlobalOrdinal mine) const {
    GlobalOrdinal all = 0;
    Teuchos::reduceAll(*mesh_->comm, Teuchos::REDUCE_SUM, 1, &mine, &all);
    return all;
  }
  /// Nodes over all ranks; ghosts and owners have to agree.
  GlobalOrdinal nodes(SetOptions options) {
    options.kind = SetKind::nodes;
    const std::string name = add(std::move(options));
    const auto& set = mesh_->node_sets.at(name);
    return total(std::count_if(set.begin(), set.end(), [&](LocalOrdinal node) { return node < mesh_->owned_count(); }));
  }
  GlobalOrdinal sides(SetOptions options) {
    options.kind = SetKind::sides;
    return total(mesh_->side_sets.at(add(std::move(options))).owned);
  }
  std::string error(SetOptions options) {
    return input_error_of([&] { add(std::move(options)); });
  }
  static SetOptions of(const std::vector<std::string>& names) {
    SetOptions options;
    options.of = {names, place};
    return options;
  }

 private:
  std::string add(SetOptions options) {
    const std::string name = "set " + std::to_string(next_++);
    add_set(*mesh_, {name, place, std::move(options)});
    return name;
  }
  RCP<Mesh> mesh_;
  int next_ = 0;
};

TEST_F(DerivedSets, UnitesIntersectsAndLeavesOut) {
  // 3 x 2 sides on the left, 4 x 3 at the bottom; 4 nodes on the edge between the two.
  EXPECT_EQ(sides(of({"brick/left", "brick/bottom"})), 6 + 12);
  EXPECT_EQ(sides(of({"brick/left", "brick/left"})), 6);
  EXPECT_EQ(nodes(of({"brick/left", "brick/bottom"})), 12 + 20 - 4);
  SetOptions edge = of({"brick/left"});
  edge.also_in = {{"brick/bottom"}, place};
  EXPECT_EQ(nodes(edge), 4);
  SetOptions corner = edge;
  corner.also_in.value.push_back("brick/front");
  EXPECT_EQ(nodes(corner), 1);
  SetOptions rest = of({"brick/surface"});
  rest.not_in = {{"brick/left", "brick/bottom"}, place};
  EXPECT_EQ(sides(rest), 2 * (6 + 12 + 8) - 18);
  SetOptions inside = of({"brick"});
  inside.not_in = {{"brick/surface"}, place};
  EXPECT_EQ(nodes(inside), 3 * 2 * 1);
}

TEST_F(DerivedSets, ChoosesByPlace) {
  SetOptions box = of({"brick"});
  box.box = {0.0, 0.0, 0.0, 1.0, 1.0, 1.0};  // its faces count
  EXPECT_EQ(nodes(box), 8);
  SetOptions ball = of({"brick/top"});
  ball.sphere = {2.0, 1.0, 2.0, 1.0};
  EXPECT_EQ(nodes(ball), 5);  // the middle and its neighbours along the axes
  SetOptions middle = of({"brick/top"});
  middle.sphere = {0.5, 0.5, 2.0, 0.9};
  EXPECT_EQ(sides(middle), 1);  // its own middle; those of the neighbours are 1 away
}

TEST_F(DerivedSets, ChoosesSidesByTheirNormal) {
  SetOptions up = of({"brick/surface"});
  up.normal = {0.0, 0.0, 5.0};
  EXPECT_EQ(sides(up), 12);
  SetOptions slanted = up;
  slanted.normal = {1.0, 0.0, 1.0};  // 45 degrees from x and from z
  slanted.angle = 44.0;
  slanted.kind = SetKind::sides;
  EXPECT_THAT(error(slanted), ::testing::HasSubstr("has a normal within 44 degrees of 1, 0, 1"));
  slanted.angle = 46.0;
  EXPECT_EQ(sides(slanted), 12 + 6);
}

TEST_F(DerivedSets, ChoosesTheNearest) {
  SetOptions nearest = of({"brick"});
  nearest.nearest = {4.2, 3.1, 0.9};
  EXPECT_EQ(nodes(nearest), 1);
  nearest.nearest = {0.5, 0.0, 0.0};  // two nodes are as near: one of them
  EXPECT_EQ(nodes(nearest), 1);
  SetOptions side = of({"brick/surface"});
  side.nearest = {4.0, 3.0, 2.0};
  EXPECT_EQ(sides(side), 1);
}

TEST_F(DerivedSets, ChoosesTheSmoothPartAroundAPoint) {
  SetOptions patch = of({"brick/surface"});
  patch.patch = {0.1, 1.4, 2.0};
  EXPECT_EQ(sides(patch), 12);  // the top
  patch.patch_angle = 90.0;     // edges of a brick turn by no more
  EXPECT_EQ(sides(patch), 2 * (6 + 12 + 8));
  patch.patch_angle = 89.0;
  patch.box = {0.0, 0.0, 0.0, 1.0, 3.0, 2.0};
  EXPECT_EQ(sides(patch), 3);
  SetOptions two = of({"brick/top", "brick/left"});
  two.patch = {0.0, 1.5, 0.5};
  EXPECT_EQ(sides(two), 6);
}

TEST(SurfacePatches, RunRoundADiskOnAnyNumberOfRanks) {
  auto disk = std::make_shared<FullDiskMesh>();
  disk->cells_around = 16;  // on a quarter: neighbours turn by 5.6 degrees
  disk->cells_across = 3;
  const auto mesh = build_mesh(Tpetra::getDefaultComm(), {{"disk", {}, disk, CellShape::quadrilateral4}}, {});
  const SideSet& arc = mesh->side_sets.at("disk/arc");
  const auto smooth = patches_of(*mesh, arc, 6.0), sharp = patches_of(*mesh, arc, 5.0);
  GlobalOrdinal least = std::numeric_limits<GlobalOrdinal>::max();
  for (std::size_t s = 0; s < arc.sides.size(); ++s) {
    EXPECT_EQ(sharp[s], side_number(*mesh, arc.sides[s]));
    least = std::min(least, side_number(*mesh, arc.sides[s]));
  }
  GlobalOrdinal of_all = 0;
  Teuchos::reduceAll(*mesh->comm, Teuchos::REDUCE_MIN, least, Teuchos::outArg(of_all));
  for (const GlobalOrdinal patch : smooth) EXPECT_EQ(patch, of_all);
}

TEST_F(DerivedSets, RefusesNumbersThatDoNotFit) {
  using ::testing::HasSubstr;
  SetOptions flat = of({"brick"});
  flat.box = {0.0, 0.0, 1.0, 1.0};
  EXPECT_THAT(error(flat), HasSubstr("\"box\" of set \"set 0\" has 4 numbers; in 3D it needs 6"));
  SetOptions turned = of({"brick"});
  turned.box = {0.0, 2.0, 0.0, 1.0, 1.0, 1.0};
  EXPECT_THAT(error(turned), HasSubstr("begins at 2 and ends at 1 in direction y"));
  SetOptions zero = of({"brick/top"});
  zero.kind = SetKind::sides;
  zero.normal = {0.0, 0.0, 0.0};
  EXPECT_THAT(error(zero), HasSubstr("it has to have a direction"));
  SetOptions unknown = of({"brick"});
  unknown.not_in = {{"brick/topp"}, place};
  EXPECT_THAT(error(unknown), HasSubstr("did you mean \"brick/top\""));
  SetOptions outside = of({"brick"});
  outside.sphere = {9.0, 9.0, 9.0, 1.0};
  EXPECT_THAT(error(outside), HasSubstr("no node of \"brick\" lies in the sphere 9, 9, 9, 1"));
}

}  // namespace
}  // namespace mortise
