// Derived sets and facets on several ranks: the same for every number of ranks, errors on all ranks at once.

#include "mortise/mesh/sets.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_DefaultSerialComm.hpp>
#include <Tpetra_Core.hpp>
#include <Tpetra_Map.hpp>
#include <map>
#include <set>

#include "mesh_test_support.hpp"
#include "mortise/input/expression.hpp"
#include "mortise/mesh/build_mesh.hpp"

namespace mortise {
namespace {

Named<SetOptions> set_of(const std::string& name, const std::string& of, const std::string& where, SetKind kind) {
  const Place place{"scene.xml", 12, "sets/" + name};
  SetOptions options;
  options.of = {{of}, place};
  options.where = parse_expression(where, {}, place);
  options.kind = kind;
  return {name, place, options};
}

const std::vector<std::string> contact_sides{"quarter disk/arc", "block/top"};

RCP<Mesh> with_sets(const RCP<const Communicator>& comm, CellShape cell) {
  auto mesh = build_mesh(comm, all_kinds(cell), contact_sides);
  add_set(*mesh, set_of("low arc", "quarter disk/arc", "-0.5 - y", SetKind::sides));
  add_set(*mesh, set_of("lower block", "block", "1 - y", SetKind::nodes));
  add_set(*mesh, set_of("part of part", "low arc", "0.3 - x", SetKind::sides));
  return mesh;
}

using Facets = std::set<SurfaceFacet>;

TEST(Sets, AreTheSameOnAnyNumberOfRanks) {
  for (const auto cell : {CellShape::quadrilateral4, CellShape::triangle3}) {
    const auto mesh = with_sets(Tpetra::getDefaultComm(), cell), whole = with_sets(rcp(new Teuchos::SerialComm<int>()), cell);
    ASSERT_EQ(mesh->node_sets.size(), whole->node_sets.size());
    for (const auto& [name, nodes] : whole->node_sets) {
      SCOPED_TRACE(name);
      // Every local node, owned or ghost, knows whether it is in the set.
      const std::set<LocalOrdinal> all(nodes.begin(), nodes.end()), here(mesh->node_sets.at(name).begin(), mesh->node_sets.at(name).end());
      EXPECT_EQ(here.size(), mesh->node_sets.at(name).size());
      for (LocalOrdinal n = 0; n < mesh->local_count(); ++n)
        EXPECT_EQ(here.count(n), all.count(whole->local_nodes->getLocalElement(mesh->local_nodes->getGlobalElement(n))));
    }
    ASSERT_EQ(mesh->side_sets.size(), whole->side_sets.size());
    for (const auto& [name, sides] : whole->side_sets) {
      SCOPED_TRACE(name);
      const auto list = facets_of_owned_elements(*whole, sides);
      const Facets all(list.begin(), list.end());
      const auto owned = facets_of_owned_elements(*mesh, mesh->side_sets.at(name)), slave = facets_at_owned_nodes(*mesh, mesh->side_sets.at(name));
      // Masters: each facet on one rank.
      const GlobalOrdinal mine = static_cast<GlobalOrdinal>(owned.size());
      GlobalOrdinal total = 0;
      Teuchos::reduceAll(*mesh->comm, Teuchos::REDUCE_SUM, 1, &mine, &total);
      EXPECT_EQ(total, static_cast<GlobalOrdinal>(all.size()));
      for (const auto& facet : owned) EXPECT_EQ(all.count(facet), 1u);
      // Slaves: exactly the facets with a node that is owned here.
      Facets expected;
      for (const auto& facet : all)
        if (mesh->owned_nodes->isNodeGlobalElement(facet[0]) || mesh->owned_nodes->isNodeGlobalElement(facet[1])) expected.insert(facet);
      EXPECT_EQ(Facets(slave.begin(), slave.end()), expected);
      EXPECT_EQ(slave.size(), expected.size());
    }
  }
}

TEST(Sets, KeepSidesByTheirMiddleAndNodesByTheirPosition) {
  auto block = std::make_shared<BlockMesh>();
  block->width = 4.0;
  block->cells_x = 8;
  block->cells_y = 2;
  const auto mesh = build_mesh(Tpetra::getDefaultComm(), {{"body", {}, block, CellShape::quadrilateral4}}, {});
  add_set(*mesh, set_of("right part", "body/top", "x - 1.2", SetKind::sides));  // the side from 1 to 1.5 has its middle at 1.25
  add_set(*mesh, set_of("right nodes", "body/top", "x - 1.2", SetKind::nodes));
  const auto total = [&](std::size_t mine) {
    const auto here = static_cast<GlobalOrdinal>(mine);
    GlobalOrdinal all = 0;
    Teuchos::reduceAll(*mesh->comm, Teuchos::REDUCE_SUM, 1, &here, &all);
    return all;
  };
  const auto owned_nodes = [&](const std::string& name) {
    const auto& nodes = mesh->node_sets.at(name);
    return total(std::count_if(nodes.begin(), nodes.end(), [&](LocalOrdinal node) { return node < mesh->owned_count(); }));
  };
  EXPECT_EQ(total(mesh->side_sets.at("right part").owned), 6);
  EXPECT_EQ(owned_nodes("right part"), 7);
  EXPECT_EQ(owned_nodes("right nodes"), 6);
}

TEST(Sets, ErrorsAreTheSameOnEveryRank) {
  using ::testing::HasSubstr;
  const auto mesh = with_sets(Tpetra::getDefaultComm(), CellShape::quadrilateral4);
  EXPECT_THAT(input_error_of([&] { add_set(*mesh, set_of("low arc", "block", "1", SetKind::nodes)); }), HasSubstr("already a set named \"low arc\""));
  EXPECT_THAT(input_error_of([&] { add_set(*mesh, set_of("none", "block", "-1", SetKind::nodes)); }),
              ::testing::AllOf(HasSubstr("scene.xml:12: error: sets/none"), HasSubstr("is empty")));
  EXPECT_THAT(input_error_of([&] { add_set(*mesh, set_of("none", "block/top", "x - 100", SetKind::sides)); }), HasSubstr("no side of \"block/top\""));
  EXPECT_THAT(input_error_of([&] { add_set(*mesh, set_of("sides", "block", "1", SetKind::sides)); }),
              ::testing::AllOf(HasSubstr("no side set \"block\", only a set of nodes of this name"), HasSubstr("The side sets are: block/")));
  // Not finite at one node, so on some ranks only.
  EXPECT_THAT(input_error_of([&] { add_set(*mesh, set_of("bad", "block", "1/(x^2 + y^2)", SetKind::nodes)); }), HasSubstr("scene.xml:12: error"));
  EXPECT_THAT(input_error_of([&] {
                require_side_set(*mesh, {"block/tpo", {"scene.xml", 3, "contact/die"}});
              }),
              ::testing::AllOf(HasSubstr("scene.xml:3: error: contact/die"), HasSubstr("did you mean \"block/top\""),
                               HasSubstr("low arc, lower half disk/arc")));
  EXPECT_THAT(input_error_of([&] { require_node_set(*mesh, {"blocc", {}}); }), HasSubstr("did you mean \"block\""));
  EXPECT_THAT(input_error_of([&] {
                require_node_set(*mesh, {"nothing like it", {}});
              }),
              HasSubstr("\"nothing like it\"; the node sets are: block, "));
}

}  // namespace
}  // namespace mortise
