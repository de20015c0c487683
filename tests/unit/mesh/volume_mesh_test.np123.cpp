// Distributed 3D meshes: volumes, surfaces, ownership, ghosts, sets; the same for every number of ranks; errors.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_DefaultSerialComm.hpp>
#include <Tpetra_Core.hpp>
#include <Tpetra_Map.hpp>
#include <set>

#include "mortise/input/expression.hpp"
#include "mortise/mesh/build_mesh.hpp"
#include "mortise/mesh/sets.hpp"
#include "volume_test_support.hpp"

namespace mortise {
namespace {

using ::testing::HasSubstr;

template <class Number>
Number total(const Mesh& mesh, Number mine) {
  Number all = 0;
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_SUM, mine, Teuchos::outArg(all));
  return all;
}

/// Every kind, of all cells in turn, beginning with number `first`.
std::vector<BodyDescription> all_volumes(int first) {
  std::vector<BodyDescription> bodies;
  for (const auto& mesh : example_volumes()) {
    const auto cells = cells_of(*mesh.options);
    bodies.push_back({mesh.name, {}, mesh.options, cells[(first + bodies.size()) % cells.size()]});
  }
  return bodies;
}

const std::vector<std::string> contact_sides{"brick/top", "cylinder/mantle"};

RCP<Mesh> with_sets(const RCP<const Communicator>& comm, int first) {
  const auto mesh = build_mesh(comm, all_volumes(first), contact_sides);
  const Place place{"scene.xml", 12, "sets"};
  add_set(*mesh, {"upper front", place, {{"brick/front", place}, parse_expression("z - 0.5", {}, place), SetKind::sides}});
  add_set(*mesh, {"upper nodes", place, {{"brick", place}, parse_expression("z - 0.2*x", {}, place), SetKind::nodes}});
  return mesh;
}

Positions positions_of(const Mesh& mesh, const LocalOrdinal* nodes, std::size_t count) {
  Positions x;
  for (std::size_t a = 0; a < count; ++a) x.push_back(Eigen::Vector3d::Map(mesh.coordinates[nodes[a]].data()));
  return x;
}

TEST(VolumeMesh, ElementsFillTheVolumeThatFacetsOfOwnedElementsEnclose) {
  for (const int first_cell : {0, 1, 2, 3, 4, 5}) {
    const auto mesh = build_mesh(Tpetra::getDefaultComm(), all_volumes(first_cell), contact_sides);
    EXPECT_EQ(mesh->dimension, 3);
    const auto examples = example_volumes();
    for (std::size_t b = 0; b < mesh->blocks.size(); ++b) {
      const Block& block = mesh->blocks[b];
      SCOPED_TRACE(block.name);
      double volume = 0.0, enclosed = 0.0;
      for (LocalOrdinal e = 0; e < block.owned; ++e)
        volume += volume_of_cell(block.shape, positions_of(*mesh, block.nodes(e), block.nodes_per_element));
      const SideSet& surface = mesh->side_sets.at(block.name + "/surface");
      const SurfaceFacets facets = facets_of_owned_elements(*mesh, surface);
      for (std::size_t s = 0; s < facets.size(); ++s) {
        std::vector<LocalOrdinal> nodes;
        for (const GlobalOrdinal node : facets[s]) nodes.push_back(mesh->local_nodes->getLocalElement(node));
        enclosed += volume_below_facet(mesh->side_shape(surface.sides[s]), positions_of(*mesh, nodes.data(), nodes.size()));
      }
      if (examples[b].volume > 0.0 && block.nodes_per_element <= 8) EXPECT_NEAR(total(*mesh, volume), examples[b].volume, 1e-12 * examples[b].volume);
      EXPECT_NEAR(total(*mesh, enclosed), total(*mesh, volume), 1e-12 * total(*mesh, volume));
    }
  }
}

TEST(VolumeMesh, IsTheSameOnAnyNumberOfRanks) {
  for (const int first_cell : {0, 1, 2, 3, 4, 5}) {
    const auto mesh = with_sets(Tpetra::getDefaultComm(), first_cell), whole = with_sets(rcp(new Teuchos::SerialComm<int>()), first_cell);
    EXPECT_TRUE(mesh->owned_nodes->isOneToOne());
    const auto global = [&](LocalOrdinal node) { return mesh->local_nodes->getGlobalElement(node); };
    // Elements and, at nodes that are owned here, all of them.
    std::vector<int> touched(mesh->local_count(), 0), of_whole(whole->local_count(), 0);
    GlobalOrdinal first = 0;
    for (std::size_t b = 0; b < mesh->blocks.size(); ++b) {
      const auto &block = mesh->blocks[b], &all = whole->blocks[b];
      EXPECT_EQ(total<GlobalOrdinal>(*mesh, block.owned), all.size());
      for (LocalOrdinal e = 0; e < block.size(); ++e) {
        const auto inside = static_cast<LocalOrdinal>(block.element_ids[e] - first);
        ASSERT_TRUE(inside >= 0 && inside < all.size());
        for (int a = 0; a < block.nodes_per_element; ++a) {
          EXPECT_EQ(global(block.nodes(e)[a]), whole->local_nodes->getGlobalElement(all.nodes(inside)[a]));
          ++touched[block.nodes(e)[a]];
        }
      }
      for (const LocalOrdinal node : all.connectivity) ++of_whole[node];
      first += all.size();
    }
    for (LocalOrdinal node = 0; node < mesh->local_count(); ++node) {
      const LocalOrdinal there = whole->local_nodes->getLocalElement(global(node));
      EXPECT_EQ(mesh->coordinates[node], whole->coordinates[there]);
      if (node < mesh->owned_count()) EXPECT_EQ(touched[node], of_whole[there]);
    }
    for (const auto& [name, nodes] : whole->node_sets) {
      SCOPED_TRACE(name);
      const std::set<LocalOrdinal> all(nodes.begin(), nodes.end()), here(mesh->node_sets.at(name).begin(), mesh->node_sets.at(name).end());
      for (LocalOrdinal n = 0; n < mesh->local_count(); ++n) EXPECT_EQ(here.count(n), all.count(whole->local_nodes->getLocalElement(global(n))));
    }
    for (const auto& [name, sides] : whole->side_sets) {
      SCOPED_TRACE(name);
      const auto list = facets_of_owned_elements(*whole, sides), owned = facets_of_owned_elements(*mesh, mesh->side_sets.at(name));
      const std::set<SurfaceFacet> all(list.begin(), list.end());
      EXPECT_EQ(total(*mesh, static_cast<GlobalOrdinal>(owned.size())), static_cast<GlobalOrdinal>(all.size()));
      for (const auto& facet : owned) EXPECT_EQ(all.count(facet), 1u);
      std::set<SurfaceFacet> expected;
      for (const auto& facet : all)
        if (std::any_of(facet.begin(), facet.end(), [&](GlobalOrdinal node) { return mesh->owned_nodes->isNodeGlobalElement(node); }))
          expected.insert(facet);
      const auto at_owned = facets_at_owned_nodes(*mesh, mesh->side_sets.at(name));
      EXPECT_EQ(std::set<SurfaceFacet>(at_owned.begin(), at_owned.end()), expected);
      EXPECT_EQ(at_owned.size(), expected.size());
    }
    const MeshSize size = mesh_size(*mesh), reference = mesh_size(*whole);
    EXPECT_EQ(size.nodes, reference.nodes);
    EXPECT_EQ(size.elements, first);
    EXPECT_EQ(size.length, reference.length);
    EXPECT_EQ(size.shortest_side, reference.shortest_side);
  }
}

TEST(VolumeMesh, SetsAreChosenByAllThreeCoordinates) {
  // Layers of the brick from 0 to 0.5 and from 0.5 to 1.5; 4 cells along x on the front.
  const auto mesh = with_sets(Tpetra::getDefaultComm(), 0);
  EXPECT_EQ(total<GlobalOrdinal>(*mesh, mesh->side_sets.at("upper front").owned), 4);
  for (const Side& side : mesh->side_sets.at("upper front").sides)
    for (const LocalOrdinal node : mesh->side_nodes(side)) EXPECT_GE(mesh->coordinates[node][2], 0.5 - 1e-14);
  for (const LocalOrdinal node : mesh->node_sets.at("upper nodes")) EXPECT_GT(mesh->coordinates[node][2], 0.2 * mesh->coordinates[node][0]);
}

TEST(VolumeMesh, SizeIsThatOfTheBoxAndOfTheShortestEdge) {
  BrickMesh options;
  options.width = 3.0, options.depth = 4.0, options.height = 12.0;
  options.cells_x = 6, options.cells_y = 4, options.cells_z = 6;
  const auto mesh = build_mesh(Tpetra::getDefaultComm(), {{"brick", {}, std::make_shared<BrickMesh>(options), CellShape::hexahedron8}}, {});
  const MeshSize size = mesh_size(*mesh);
  EXPECT_EQ(size.nodes, 7 * 5 * 7);
  EXPECT_EQ(size.elements, 6 * 4 * 6);
  EXPECT_NEAR(size.length, 13.0, 1e-14);
  EXPECT_NEAR(size.shortest_side, 0.5, 1e-14);
}

TEST(VolumeMesh, RefusesWhatDoesNotFitOnEveryRank) {
  const auto comm = Tpetra::getDefaultComm();
  const Place place{"scene.xml", 5, "bodies/die"};
  const std::shared_ptr<const MeshOptions> brick = example_volumes()[0].options, block = example_meshes()[0].options;
  EXPECT_THAT(input_error_of([&] {
                build_mesh(comm, {{"block", {}, block, CellShape::quadrilateral4}, {"die", place, brick, CellShape::hexahedron8}}, {});
              }),
              ::testing::AllOf(HasSubstr("scene.xml:5: error: bodies/die"), HasSubstr("body \"die\" has a 3D mesh, but body \"block\" a 2D one")));
  EXPECT_THAT(input_error_of([&] {
                build_mesh(comm, {{"die", place, brick, CellShape::triangle3}}, {});
              }),
              HasSubstr("has a 3D mesh, but 2D elements"));
  EXPECT_THAT(input_error_of([&] {
                build_mesh(comm, {{"die", place, block, CellShape::tetrahedron4}}, {});
              }),
              HasSubstr("has a 2D mesh, but 3D elements"));
  EXPECT_THAT(input_error_of([&] {
                build_mesh(comm, {{"die", place, brick, CellShape::line2}}, {});
              }),
              HasSubstr("has a 3D mesh, but line elements"));
  // A profile that is turned inside out: its cells, and those over them, are inverted.
  auto crossed = std::make_shared<BlockMesh>();
  crossed->corners = {0.0, 0.0, 1.0, 0.0, 0.4, 0.4, 0.0, 1.0};
  crossed->cells_x = crossed->cells_y = 8;
  for (const auto cell : cells_of(ExtrudedMesh())) {
    auto extruded = std::make_shared<ExtrudedMesh>();
    extruded->profile = {"block", crossed, {}};
    extruded->cells_z = 2;
    EXPECT_THAT(input_error_of([&] {
                  build_mesh(comm, {{"die", place, extruded, cell}}, {});
                }),
                ::testing::AllOf(HasSubstr("scene.xml:5: error: bodies/die"), HasSubstr("body \"die\": element "), HasSubstr("det J = -")));
  }
}

}  // namespace
}  // namespace mortise
