// Bodies of mesh files, made of values in memory: which cells, nodes and sets they have, and what is refused.

#include "mortise/mesh/file_body.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mesh_test_support.hpp"

namespace mortise {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Four unit squares in a row along x, each with a label; nodes along y = 0 first.
MeshFile row_of_squares() {
  MeshFile file;
  file.path = "row.msh";
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 5; ++i) {
      file.coordinates.push_back({1.0 * i, 1.0 * j, 7.0});
      file.node_labels.push_back(100 + static_cast<std::int64_t>(file.node_labels.size()));
    }
  FileCells squares{CellShape::quadrilateral4, {}, {}};
  for (int i = 0; i < 4; ++i) {
    squares.nodes.insert(squares.nodes.end(), {i, i + 1, i + 6, i + 5});
    squares.labels.push_back(10 + i);
  }
  file.cells = {squares, {CellShape::line2, {0, 1, 2, 1, 2, 7}, {1, 2, 3}}};
  file.cell_sets = {{"left", {{0, 0, 2}}}, {"right", {{0, 2, 2}}}, {"foot", {{1, 0, 2}}}, {"joint", {{1, 2, 1}}}};
  file.side_sets = {{"top", {{0, 0, 2}, {0, 1, 2}, {0, 2, 2}, {0, 3, 2}}}};
  file.node_sets = {{"corner", {9}}, {"top", {5, 6, 7, 8, 9}}};
  return file;
}

FileBodyRequest request(int dimension) {
  FileBodyRequest request;
  request.name = "body";
  request.place = {"scene.xml", 5, "bodies/body"};
  request.file = "row.msh";
  request.dimension = dimension;
  return request;
}

std::string refused(const MeshFile& file, const FileBodyRequest& wanted) {
  return input_error_of([&] { make_file_body(file, wanted); });
}

std::vector<std::int32_t> nodes_of(const ListedBody& body, GlobalOrdinal element) {
  const auto row = body.element_nodes.row(element);
  return {row.begin(), row.end()};
}

std::vector<std::pair<int, int>> sides_of(const ListedBody& body, GlobalOrdinal element) {
  const auto row = body.surface_sides.row(element);
  std::vector<std::pair<int, int>> sides;
  for (const auto* at = row.begin(); at != row.end(); at += 2) sides.emplace_back(at[0], at[1]);
  return sides;
}

TEST(FileBody, HasTheCellsAndSetsOfTheFile) {
  const ListedBody body = make_file_body(row_of_squares(), request(2));
  EXPECT_EQ(body.nodes, 10);
  ASSERT_EQ(body.parts.size(), 1u);
  EXPECT_EQ(body.parts[0].elements, 4);
  EXPECT_THAT(body.side_names, ElementsAre("top", "foot"));
  // A line inside the body is no side; sets of cells that are parts of the body are sets of nodes; "top" of nodes is that of the sides.
  EXPECT_THAT(body.node_set_names, ElementsAre("joint", "corner", "left", "right"));
  EXPECT_THAT(body.notes, ElementsAre(HasSubstr("\"body/joint\" is no set of sides: 2 of its 2 sides lie inside")));
  EXPECT_THAT(sides_of(body, 0), ElementsAre(std::pair(0, 1), std::pair(2, 0), std::pair(3, -1)));
  EXPECT_THAT(sides_of(body, 3), ElementsAre(std::pair(0, -1), std::pair(1, -1), std::pair(2, 0)));
  EXPECT_EQ(body.coordinates.row(4).first[2], 0.0);
  EXPECT_EQ(*body.labels.row(2).first, 12.0);
}

TEST(FileBody, IsMadeOfNamedBlocksAlone) {
  FileBodyRequest wanted = request(2);
  wanted.blocks = {"right"};
  wanted.scale = 0.5;
  const ListedBody body = make_file_body(row_of_squares(), wanted);
  EXPECT_EQ(body.nodes, 6);
  EXPECT_THAT(nodes_of(body, 0), ElementsAre(0, 1, 4, 3));
  EXPECT_EQ(body.coordinates.row(0).first[0], 1.0);
  EXPECT_THAT(body.side_names, ElementsAre("top", "joint"));  // which is on its surface now
  wanted.blocks = {"rihgt"};
  EXPECT_THAT(refused(row_of_squares(), wanted), AllOf(HasSubstr("scene.xml:5"), HasSubstr("did you mean \"right\"?")));
  wanted.blocks = {"foot"};
  EXPECT_THAT(refused(row_of_squares(), wanted), HasSubstr("blocks \"foot\" of row.msh have lines alone; body \"body\" needs cells of 2 dimensions"));
}

TEST(FileBody, HasPartsWithMaterialsOfTheirOwn) {
  FileBodyRequest wanted = request(2);
  wanted.parts = {{"left", wanted.place}};
  const ListedBody body = make_file_body(row_of_squares(), wanted);
  ASSERT_EQ(body.parts.size(), 2u);
  EXPECT_EQ(body.parts[0].name, "");
  EXPECT_EQ(body.parts[1].name, "left");
  EXPECT_EQ(*body.labels.row(0).first, 12.0);  // the rest comes first
  MeshFile overlapping = row_of_squares();
  overlapping.cell_sets[1].members = {{0, 1, 3}};
  wanted.parts.push_back({"right", wanted.place});
  EXPECT_THAT(refused(overlapping, wanted), HasSubstr("element 11 of row.msh is in \"left\" and in \"right\""));
}

TEST(FileBody, TurnsPlaneCellsThatRunClockwise) {
  MeshFile file = row_of_squares();
  auto& nodes = file.cells[0].nodes;
  std::swap(nodes[5], nodes[7]);  // square 1: 1, 6, 7, 2
  file.side_sets[0].members[1].side = 1;
  const ListedBody body = make_file_body(file, request(2));
  EXPECT_THAT(body.notes, ::testing::Contains(HasSubstr("1 of 4 elements ran clockwise")));
  EXPECT_THAT(nodes_of(body, 1), ElementsAre(1, 2, 7, 6));
  EXPECT_THAT(sides_of(body, 1), ElementsAre(std::pair(0, 1), std::pair(2, 0)));
}

TEST(FileBody, RefusesMeshesThatAreNotFlat) {
  MeshFile file = row_of_squares();
  file.coordinates[3][2] = 7.5;
  EXPECT_THAT(refused(file, request(2)), HasSubstr("reaches from z = 7 to 7.5"));
}

TEST(FileBody, RefusesPieces) {
  MeshFile file = row_of_squares();
  FileCells& squares = file.cells[0];
  squares.nodes.erase(squares.nodes.begin() + 4, squares.nodes.begin() + 8);
  squares.labels.erase(squares.labels.begin() + 1);
  file.cell_sets.resize(0);
  file.side_sets.resize(0);
  EXPECT_THAT(refused(file, request(2)), AllOf(HasSubstr("falls into 2 pieces"), HasSubstr("element 12 with node 102 at (2, 0, 7)")));
}

TEST(FileBody, RefusesElementsThatStandTwice) {
  MeshFile file = row_of_squares();
  FileCells& squares = file.cells[0];
  const std::vector<std::int32_t> again(squares.nodes.begin(), squares.nodes.begin() + 4);
  for (int i = 0; i < 2; ++i) {
    squares.nodes.insert(squares.nodes.end(), again.begin(), again.end());
    squares.labels.push_back(50 + i);
  }
  EXPECT_THAT(refused(file, request(2)), HasSubstr("elements 10, 50 and 51 share one side"));
}

/// A cube of labels 1, and on its face x = 1 two tetrahedra whose triangles halve that face.
MeshFile cube_with_tetrahedra() {
  MeshFile file;
  file.path = "cube.exo";
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i) file.coordinates.push_back({1.0 * i, 1.0 * j, 1.0 * k});
  file.coordinates.push_back({2.0, 0.5, 0.5});
  for (std::size_t n = 0; n < file.coordinates.size(); ++n) file.node_labels.push_back(static_cast<std::int64_t>(n) + 1);
  file.cells = {{CellShape::hexahedron8, {0, 1, 3, 2, 4, 5, 7, 6}, {1}}, {CellShape::tetrahedron4, {1, 3, 7, 8, 1, 7, 5, 8}, {2, 3}}};
  file.cell_sets = {{"cube", {{0, 0, 1}}}, {"hat", {{1, 0, 2}}}};
  return file;
}

TEST(FileBody, RefusesTrianglesOnQuadrilaterals) {
  EXPECT_THAT(
      refused(cube_with_tetrahedra(), request(3)),
      AllOf(HasSubstr("a triangle of element"), HasSubstr("lies on a quadrilateral of element 1"), HasSubstr("Please put pyramids between them")));
}

TEST(FileBody, OfARigidBodyIsItsSurface) {
  FileBodyRequest wanted = request(3);
  wanted.is_surface = true;
  wanted.blocks = {"hat"};
  const ListedBody hat = make_file_body(cube_with_tetrahedra(), wanted);
  EXPECT_EQ(hat.nodes, 5);
  ASSERT_EQ(hat.parts.size(), 1u);
  EXPECT_EQ(hat.parts[0].shape, CellShape::triangle3);
  EXPECT_EQ(hat.parts[0].elements, 6);
  // Closed, seen from outside counterclockwise: sum of x . n over the facets is three times the volume, 2/3 here times 1/2.
  double volume = 0.0;
  for (GlobalOrdinal facet = 0; facet < 6; ++facet) {
    const auto n = nodes_of(hat, facet);
    const double *a = hat.coordinates.row(n[0]).first, *b = hat.coordinates.row(n[1]).first, *c = hat.coordinates.row(n[2]).first;
    volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6.0;
    EXPECT_THAT(sides_of(hat, facet), ElementsAre(std::pair(the_cell_itself, -1)));
  }
  EXPECT_NEAR(volume, 1.0 / 3.0, 1e-15);
}

TEST(FileBody, OfFacetsIsARigidSurface) {
  MeshFile file = cube_with_tetrahedra();
  file.cells = {{CellShape::triangle3, {1, 3, 7, 1, 7, 5}, {4, 5}}};
  file.cell_sets = {{"lower", {{0, 0, 1}}}, {"upper", {{0, 1, 1}}}};
  FileBodyRequest wanted = request(3);
  EXPECT_THAT(refused(file, wanted), HasSubstr("needs cells of 3 dimensions"));
  wanted.is_surface = true;
  const ListedBody body = make_file_body(file, wanted);
  EXPECT_EQ(body.nodes, 4);
  EXPECT_THAT(body.side_names, ElementsAre("lower", "upper"));
  EXPECT_THAT(sides_of(body, 1), ElementsAre(std::pair(the_cell_itself, 1)));
}

TEST(FileBody, OfFacetsHasOneOutside) {
  MeshFile file = cube_with_tetrahedra();
  file.cells = {{CellShape::triangle3, {1, 3, 7, 1, 5, 7}, {4, 5}}};  // the second one turned
  file.cell_sets.clear();
  FileBodyRequest wanted = request(3);
  wanted.is_surface = true;
  EXPECT_THAT(refused(file, wanted), HasSubstr("facets 4 and 5 have their outsides on different sides"));
  MeshFile row = row_of_squares();
  row.cells = {{CellShape::line2, {0, 1, 2, 1}, {1, 2}}};
  row.cell_sets.clear(), row.side_sets.clear();
  wanted.dimension = 2;
  EXPECT_THAT(refused(row, wanted), HasSubstr("facets 1 and 2 have their outsides on different sides"));
}

// A set of the other face of one facet turns all that hang together with it, so that the body has its outside there.
TEST(FileBody, OfFacetsIsTurnedWhereSetsNameItsOtherFace) {
  MeshFile file = cube_with_tetrahedra();
  file.cells = {{CellShape::triangle3, {1, 3, 7, 1, 7, 5}, {4, 5}}};
  file.cell_sets.clear();
  file.side_sets = {{"touched", {{0, 0, the_other_face}}}};
  FileBodyRequest wanted = request(3);
  wanted.is_surface = true;
  const ListedBody body = make_file_body(file, wanted);
  EXPECT_THAT(nodes_of(body, 0), ElementsAre(0, 3, 1));  // of the body's four nodes: 1, 3, 5, 7
  EXPECT_THAT(nodes_of(body, 1), ElementsAre(0, 2, 3));
  EXPECT_THAT(body.side_names, ElementsAre("touched"));
  EXPECT_THAT(body.notes, ElementsAre("2 of 2 facets were turned, as sets of sides name their other face"));
  file.side_sets.push_back({"seen", {{0, 1, the_cell_itself}}});
  const ListedBody both = make_file_body(file, wanted);
  EXPECT_THAT(nodes_of(both, 0), ElementsAre(0, 1, 3));
  EXPECT_THAT(both.notes, ElementsAre(HasSubstr("sets \"seen\" and \"touched\" name both faces of a surface of body \"body\"")));
  MeshFile row = row_of_squares();
  row.cells = {{CellShape::line2, {0, 1, 1, 2}, {1, 2}}};
  row.cell_sets.clear();
  row.side_sets = {{"touched", {{0, 0, the_other_face}}}};
  wanted.dimension = 2;
  EXPECT_THAT(nodes_of(make_file_body(row, wanted), 1), ElementsAre(2, 1));
}

TEST(FileBody, HasTheNodesOfEdgesOfFacets) {
  MeshFile file = cube_with_tetrahedra();
  file.cells = {{CellShape::triangle3, {1, 3, 7, 1, 7, 5}, {4, 5}}};
  file.cell_sets.clear();
  file.side_sets = {{"rim", {{0, 0, 0}}}};
  FileBodyRequest wanted = request(3);
  wanted.is_surface = true;
  const ListedBody body = make_file_body(file, wanted);
  EXPECT_THAT(body.node_set_names, ElementsAre("rim"));
  EXPECT_TRUE(body.side_names.empty());
}

TEST(FileBody, SaysThatFacesOfPlaneCellsAreLeftOut) {
  MeshFile file = row_of_squares();
  file.side_sets.push_back({"face", {{0, 0, the_cell_itself}}});
  const ListedBody body = make_file_body(file, request(2));
  EXPECT_THAT(body.notes, ::testing::Contains("set \"face\": 1 faces of shells are left out, as they lie in the plane of the model"));
}

TEST(FileBody, SaysWhyABlockIsLeftOut) {
  MeshFile file = row_of_squares();
  file.left_out = {{"springs", "its 3 elements are of types that are not read"}};
  FileBodyRequest wanted = request(2);
  EXPECT_EQ(make_file_body(file, wanted).left_out.size(), 1u);
  wanted.blocks = {"springs"};
  EXPECT_THAT(refused(file, wanted), HasSubstr("\"springs\" of row.msh is left out: its 3 elements are of types that are not read"));
}

TEST(FileBody, SaysWhereMeshesOnlyLieOnOneAnother) {
  MeshFile file = row_of_squares();
  EXPECT_TRUE(make_file_body(file, request(2)).warnings.empty());
  // Two half squares on top of the first one: a hanging node at (0.5, 1).
  file.coordinates.insert(file.coordinates.end(), {{0.5, 1.0, 7.0}, {0.0, 1.5, 7.0}, {0.5, 1.5, 7.0}, {1.0, 1.5, 7.0}});
  for (int n = 0; n < 4; ++n) file.node_labels.push_back(200 + n);
  FileCells& squares = file.cells[0];
  squares.nodes.insert(squares.nodes.end(), {5, 10, 12, 11, 10, 6, 13, 12});
  squares.labels.insert(squares.labels.end(), {14, 15});
  EXPECT_THAT(make_file_body(file, request(2)).warnings, ElementsAre(AllOf(HasSubstr("1 nodes of the surface"), HasSubstr("side of element 10"))));
}

TEST(FileBody, KeepsReservedNames) {
  MeshFile file = row_of_squares();
  file.side_sets[0].name = "surface";
  const ListedBody body = make_file_body(file, request(2));
  EXPECT_THAT(body.side_names, ::testing::Contains("surface of file"));
  EXPECT_THAT(body.notes, ::testing::Contains(HasSubstr("the set \"surface\" is called \"body/surface of file\"")));
}

}  // namespace
}  // namespace mortise
