// Input files of Abaqus and CalculiX: what is read, and what is refused and where.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "mesh_file_test_support.hpp"
#include "mortise/mesh/cell_nodes.hpp"

namespace mortise {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;
using ::testing::UnorderedElementsAre;
using ::testing::UnorderedElementsAreArray;

MeshFile read_text(const std::string& text) { return read_mesh_text("a.inp", text); }
std::string refused_text(const std::string& text) { return refusal_of("a.inp", text); }

/// Two unit cubes on one another, nodes 1 to 12 by layers.
const std::string two_cubes =
    "*NODE, NSET=NALL\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n9,0,0,2\n10,1,0,2\n11,1,1,2\n12,0,1,2\n"
    "*ELEMENT, TYPE=C3D8, ELSET=Lower\n1, 1,2,3,4,5,6,7,8\n*ELEMENT, TYPE=C3D8R, ELSET=Upper\n2, 5,6,7,8,9,10,11,12\n";

/// One element of a type on its reference cell, with a surface of each of its faces.
struct OneAbaqusElement {
  const char* type;
  CellShape shape;
  std::vector<std::vector<int>> faces;  ///< corners of S1, S2, ..., from 1, as the manuals of Abaqus and CalculiX list them
};

void PrintTo(const OneAbaqusElement& one, std::ostream* stream) { *stream << one.type; }

class AbaqusShapes : public ::testing::TestWithParam<OneAbaqusElement> {};

TEST_P(AbaqusShapes, HaveTheirNodesAndFacesInOurOrder) {
  const OneAbaqusElement& one = GetParam();
  std::string text = "*NODE\n", element = "1";
  std::vector<std::array<double, 3>> positions;
  visit_cell(one.shape, [&](auto kind) {
    for (const auto& node : decltype(kind)::node_positions) {
      std::array<double, 3> position{};
      for (std::size_t i = 0; i < node.size(); ++i) position[i] = node[i];
      positions.push_back(position);
    }
  });
  for (std::size_t n = 0; n < positions.size(); ++n) {
    text += std::to_string(n + 1);
    for (const double x : positions[n]) text += "," + std::to_string(x);
    text += "\n";
    element += (n == 10 ? ",\n" : ",") + std::to_string(n + 1);
  }
  text += std::string("*ELEMENT, TYPE=") + one.type + "\n" + element + "\n";
  for (std::size_t f = 1; f <= one.faces.size(); ++f) text += "*SURFACE, NAME=face " + std::to_string(f) + "\n1, S" + std::to_string(f) + "\n";
  const MeshFile file = read_text(text);
  ASSERT_EQ(file.cells.size(), 1u);
  EXPECT_EQ(file.cells[0].shape, one.shape);
  expect_middles(file);
  EXPECT_GT(measure_of(file, file.cells[0], 0), 0.0);
  for (std::size_t f = 1; f <= one.faces.size(); ++f) {
    const auto& members = set_named(file.side_sets, "face " + std::to_string(f)).members;
    ASSERT_EQ(members.size(), 1u);
    std::vector<std::array<double, 3>> corners;
    for (const int node : one.faces[f - 1]) corners.push_back(positions[static_cast<std::size_t>(node - 1)]);
    EXPECT_THAT(corners_of(file, members[0]), UnorderedElementsAreArray(corners)) << "S" << f;
  }
  EXPECT_THAT(refused_text(text + "*SURFACE, NAME=none\n1, S" + std::to_string(one.faces.size() + 1) + "\n"), HasSubstr("surface \"none\": "));
}

const std::vector<std::vector<int>> hexahedron_faces{{1, 2, 3, 4}, {5, 8, 7, 6}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 8, 4}, {4, 8, 5, 1}},
    wedge_faces{{1, 2, 3}, {4, 6, 5}, {1, 4, 5, 2}, {2, 5, 6, 3}, {3, 6, 4, 1}},
    pyramid_faces{{1, 2, 3, 4}, {1, 5, 2}, {2, 5, 3}, {3, 5, 4}, {4, 5, 1}}, tetrahedron_faces{{1, 2, 3}, {1, 4, 2}, {2, 4, 3}, {3, 4, 1}},
    triangle_faces{{1, 2}, {2, 3}, {3, 1}}, quadrilateral_faces{{1, 2}, {2, 3}, {3, 4}, {4, 1}};

INSTANTIATE_TEST_SUITE_P(All, AbaqusShapes,
                         ::testing::Values(OneAbaqusElement{"C3D8", CellShape::hexahedron8, hexahedron_faces},
                                           OneAbaqusElement{"c3d8i", CellShape::hexahedron8, hexahedron_faces},
                                           OneAbaqusElement{"C3D20R", CellShape::hexahedron20, hexahedron_faces},
                                           OneAbaqusElement{"C3D4", CellShape::tetrahedron4, tetrahedron_faces},
                                           OneAbaqusElement{"C3D10MH", CellShape::tetrahedron10, tetrahedron_faces},
                                           OneAbaqusElement{"C3D6", CellShape::wedge6, wedge_faces},
                                           OneAbaqusElement{"C3D15", CellShape::wedge15, wedge_faces},
                                           OneAbaqusElement{"C3D5", CellShape::pyramid5, pyramid_faces},
                                           OneAbaqusElement{"CPE3", CellShape::triangle3, triangle_faces},
                                           OneAbaqusElement{"CAX6", CellShape::triangle6, triangle_faces},
                                           OneAbaqusElement{"CPS4", CellShape::quadrilateral4, quadrilateral_faces},
                                           OneAbaqusElement{"CAX8R", CellShape::quadrilateral8, quadrilateral_faces}),
                         [](const auto& info) { return std::string(info.param.type); });

TEST(Abaqus, SetsHaveLabelsRangesAndOtherSets) {
  const MeshFile file = read_text(two_cubes +
                                  "*NSET, NSET=bottom, GENERATE\n1, 4\n*nset, nset=Even , generate\n2,12,2\n*NSET,NSET=both\nBOTTOM, even, 9\n"
                                  "*NSET, NSET=bottom\n5\n*ELSET, ELSET=all\nLOWER,\n2\n*ELSET,ELSET=\"my set, 1\"\n 2,\n");
  EXPECT_THAT(names_of_sets(file.node_sets), ElementsAre("NALL", "bottom", "Even", "both"));
  EXPECT_EQ(file.node_sets[0].members.size(), 12u);
  EXPECT_THAT(file.node_sets[1].members, ElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(file.node_sets[2].members, ElementsAre(1, 3, 5, 7, 9, 11));
  EXPECT_THAT(file.node_sets[3].members, ElementsAre(0, 1, 2, 3, 4, 5, 7, 8, 9, 11));
  EXPECT_THAT(names_of_sets(file.cell_sets), ElementsAre("Lower", "Upper", "all", "my set, 1"));
  EXPECT_NEAR(measure_of(file, set_named(file.cell_sets, "all")), 2.0, 1e-14);
  EXPECT_NEAR(measure_of(file, set_named(file.cell_sets, "my set, 1")), 1.0, 1e-14);
  EXPECT_THAT(file.notes, ElementsAre("elements of type C3D8R are computed with full integration"));
}

TEST(Abaqus, SurfacesHaveFacesExteriorFacesOrNodes) {
  const MeshFile file =
      read_text(two_cubes +
                "*SURFACE, NAME=top\nUpper, S2\n*SURFACE, TYPE=ELEMENT, NAME=lower skin\nLOWER,\n*SURFACE, NAME=skin\nlower\nupper\n"
                "*SURFACE, NAME=points, TYPE=NODE\nNALL\n*SURFACE, NAME=NALL, TYPE=NODE\n3, 1.0\n");
  const auto& top = set_named(file.side_sets, "top").members;
  ASSERT_EQ(top.size(), 1u);
  for (const auto& corner : corners_of(file, top[0])) EXPECT_EQ(corner[2], 2.0);
  EXPECT_EQ(set_named(file.side_sets, "lower skin").members.size(), 5u);
  for (const FileSide& side : set_named(file.side_sets, "lower skin").members) EXPECT_EQ(side.cell, 0);
  EXPECT_EQ(set_named(file.side_sets, "skin").members.size(), 10u);
  EXPECT_EQ(set_named(file.node_sets, "points").members.size(), 12u);
  EXPECT_THAT(set_named(file.node_sets, "surface NALL").members, ElementsAre(2));
}

TEST(Abaqus, ShellsAndRigidElementsAreTheirOwnSides) {
  const MeshFile file = read_text(
      "*NODE\n1\n2, 1.\n3, 1., 1.\n4, 0., 1.D0\n5, 0, 0, 1\n*ELEMENT, TYPE=S4R, ELSET=shell\n1, 1, 2, 3, 4\n*ELEMENT, TYPE=R3D3\n2, 1, 2, 5\n"
      "*SURFACE, NAME=up\nshell, SPOS\n*SURFACE, NAME=down\n2, SNEG\n*SURFACE, NAME=all\nshell\n*SURFACE, NAME=as CalculiX\nshell, S2\n");
  EXPECT_THAT(names_of_sets(file.side_sets), ElementsAre("up", "down", "all", "as CalculiX"));
  for (const auto& set : file.side_sets) {
    ASSERT_EQ(set.members.size(), 1u) << set.name;
    EXPECT_EQ(set.members[0].side, set.name == "down" ? the_other_face : the_cell_itself) << set.name;
  }
  EXPECT_EQ(file.coordinates[3][1], 1.0);
  EXPECT_THAT(file.notes, ElementsAre("elements of type S4R are surfaces, without thickness or stiffness",
                                      "elements of type R3D3 are surfaces, without thickness or stiffness"));
}

TEST(Abaqus, LinesMayBeWrittenInManyWays) {
  const MeshFile file = read_text(
      "** a comment\r\n*Heading\r\nanything, at all\r\n\r\n  *node ,\r\n nset = \"n 1\"\r\n 1, 0., 0.\r\n2,1.0D+0,\r\n** between\r\n3 , +1e0 , 1.\r\n"
      "*Element, type = cpe3 , elset=E\r\n7, 1,\r\n2,\r\n3\r\n*MATERIAL, NAME=M\r\n*Elastic\r\n1., 2.\r\n*ELASTIC\r\n*STEP\r\n*NODE\r\nnonsense");
  EXPECT_EQ(file.coordinates.size(), 3u);
  EXPECT_EQ(file.coordinates[1][0], 1.0);
  EXPECT_THAT(file.cells[0].labels, ElementsAre(7));
  EXPECT_THAT(names_of_sets(file.node_sets), ElementsAre("n 1"));
  EXPECT_THAT(file.notes, ElementsAre("passed over, as they say nothing of the mesh: *ELASTIC (2), *HEADING, *MATERIAL"));
}

TEST(Abaqus, ElementsMayStandBeforeTheirNodes) {
  const MeshFile file = read_text("*ELEMENT, TYPE=CPE3\n1, 30, 10, 20\n*NODE\n10, 0, 0\n20, 1, 0\n30, 0, 1\n");
  EXPECT_THAT(file.cells[0].nodes, ElementsAre(2, 0, 1));
}

const std::string part_file =
    "*HEADING\n*PART, NAME=Brick\n*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n*ELEMENT, TYPE=C3D8\n1, "
    "1,2,3,4,5,6,7,8\n"
    "*NSET, NSET=corner\n2\n*ELSET, ELSET=all\n1\n*SURFACE, NAME=top\nall, S2\n*END PART\n"
    "*ASSEMBLY, NAME=Assembly\n*INSTANCE, NAME=Brick-1, PART=brick\n*END INSTANCE\n*INSTANCE, NAME=Brick-2, PART=Brick\n2., 0., 0.\n2., 0., 0., 2., "
    "0., 1., 90.\n*END "
    "INSTANCE\n"
    "*NODE\n1, 9., 9., 9.\n*NSET, NSET=reference\n1\n*NSET, NSET=corners, INSTANCE=BRICK-2\n corner, 3\n*NSET, NSET=mixed\n Brick-1.corner, "
    "Brick-2.2\n"
    "*ELSET, ELSET=_top_S2, INTERNAL, INSTANCE=Brick-2, GENERATE\n1, 1, 1\n*SURFACE, NAME=tops\n_top_S2, S2\nBrick-1.all, S2\n*END ASSEMBLY\n";

TEST(Abaqus, InstancesOfPartsArePutInTheirPlaces) {
  const MeshFile file = read_text(part_file);
  ASSERT_EQ(file.coordinates.size(), 17u);
  EXPECT_THAT(names_of_sets(file.node_sets), UnorderedElementsAre("reference", "corners", "mixed", "Brick-1.corner", "Brick-2.corner"));
  EXPECT_THAT(names_of_sets(file.cell_sets), UnorderedElementsAre("Brick-1.all", "Brick-2.all"));
  EXPECT_THAT(names_of_sets(file.side_sets), UnorderedElementsAre("tops", "Brick-1.top", "Brick-2.top"));
  const auto position = [&](const std::string& set, std::size_t member) {
    return file.coordinates[static_cast<std::size_t>(set_named(file.node_sets, set).members.at(member))];
  };
  EXPECT_THAT(position("reference", 0), ElementsAre(9.0, 9.0, 9.0));
  EXPECT_THAT(position("Brick-1.corner", 0), ElementsAre(1.0, 0.0, 0.0));
  // (1, 0, 0) moved to (3, 0, 0) and turned by a quarter about the upright axis through (2, 0, 0).
  const auto turned = position("Brick-2.corner", 0);
  EXPECT_NEAR(turned[0], 2.0, 1e-15);
  EXPECT_NEAR(turned[1], 1.0, 1e-15);
  EXPECT_EQ(set_named(file.node_sets, "corners").members.size(), 2u);
  EXPECT_EQ(set_named(file.node_sets, "mixed").members.size(), 2u);
  EXPECT_NEAR(measure_of(file, set_named(file.cell_sets, "Brick-2.all")), 1.0, 1e-14);
  ASSERT_EQ(set_named(file.side_sets, "tops").members.size(), 2u);
  EXPECT_EQ(set_named(file.side_sets, "tops").members[0].cell, 1);
  for (const FileSide& side : set_named(file.side_sets, "tops").members)
    for (const auto& corner : corners_of(file, side)) EXPECT_NEAR(corner[2], 1.0, 1e-15);
}

TEST(Abaqus, FilesIncludeOthers) {
  mesh_file_folder().write("nodes.inc", "*NODE\n1, 0, 0\n2, 1, 0\n*INCLUDE, INPUT=\"more nodes.inc\"\n4, 5, 5\n");
  mesh_file_folder().write("more nodes.inc", "3, 0, 1\n");
  const std::string element = "*ELEMENT, TYPE=CPS3\n1, 1, 2, 3\n";
  EXPECT_EQ(read_text("*INCLUDE, INPUT=nodes.inc\n" + element).coordinates.size(), 4u);
  EXPECT_EQ(read_text("*NODE, INPUT=more nodes.inc, NSET=n\n1, 0, 0\n2, 1, 0\n" + element).node_sets.at(0).members.size(), 3u);
  mesh_file_folder().write("more nodes.inc", "3, 0, y\n");
  EXPECT_EQ(refused_text("*INCLUDE, INPUT=nodes.inc\n" + element), "more nodes.inc:1: error: node 3: coordinate y is \"y\", no finite number");
  mesh_file_folder().write("more nodes.inc", "*INCLUDE, INPUT=a.inp\n");
  EXPECT_EQ(refused_text("*INCLUDE, INPUT=nodes.inc\n"), "more nodes.inc:1: error: \"a.inp\" includes itself");
  EXPECT_EQ(refused_text("*INCLUDE, INPUT=missing.inc\n"), "a.inp:1: error: missing.inc: cannot be read: No such file or directory");
  EXPECT_THAT(refused_text("*INCLUDE\n"), StartsWith("a.inp:1: error: *INCLUDE has no INPUT="));
}

TEST(Abaqus, TellsTheLineOfWhatIsWrong) {
  EXPECT_THAT(refused_text("solid\n"), StartsWith("a.inp:1: error: expected a keyword, as *NODE, found \"solid\""));
  EXPECT_EQ(refused_text("*NODE\n1, 0, 0\n1, 1, 0\n"), "a.inp:3: error: node 1 stands twice, with other coordinates; the first is at a.inp:2");
  EXPECT_EQ(refused_text("*NODE\n1, 0, nan\n2, 0, 1e999\n"),
            "a.inp:2: error: node 1: coordinate y is \"nan\", no finite number\na.inp:3: error: node 2: coordinate y is \"1e999\", no finite number");
  EXPECT_THAT(refused_text("*NODE\n-1, 0, 0\n99999999999, 0\n"),
              AllOf(HasSubstr("a.inp:2: error: expected the label of a node, a number from 1 to 2147483647, found \"-1\""), HasSubstr("a.inp:3: ")));
  EXPECT_THAT(refused_text("*NODE, SYSTEM=C\n1, 0, 0\n"), StartsWith("a.inp:1: error: *NODE: SYSTEM=C is not read"));
  EXPECT_THAT(refused_text("*NODE\n1\n*NGEN\n1, 3\n"), StartsWith("a.inp:3: error: *NGEN is not read"));
  EXPECT_EQ(refused_text(two_cubes + "*ELEMENT, TYPE=C3D8\n3, 1, 2, 3, 4, 5, 6, 7, 80\n"), "a.inp:19: error: element 3: there is no node 80");
  EXPECT_EQ(refused_text(two_cubes + "*ELEMENT, TYPE=C3D8\n1, 1, 2, 3, 4, 5, 6, 7, 8\n"),
            "a.inp:19: error: element 1 stands twice; the first is at a.inp:15");
  EXPECT_EQ(refused_text(two_cubes + "*ELEMENT, TYPE=C3D8\n3, 1, 2, 3, 4, 5, 6, 7\n*STEP\n"), "a.inp:19: error: element 3 has 7 nodes; C3D8 has 8");
  EXPECT_EQ(refused_text(two_cubes + "*ELEMENT, TYPE=C3D8\n3, 1, 2, 3, 4, 5, 6, 7, 8, 9\n"),
            "a.inp:19: error: element 3 has more nodes than the 8 of C3D8; what is beyond them is \"9\"");
  EXPECT_THAT(refused_text("*ELEMENT\n1, 1, 2\n"), StartsWith("a.inp:1: error: *ELEMENT has no TYPE="));
  EXPECT_THAT(refused_text("*NSET\n1\n"), StartsWith("a.inp:1: error: *NSET has no NSET="));
  EXPECT_EQ(refused_text(two_cubes + "*NSET, NSET=n\n1, 99\n"), "a.inp:19: error: there is no node 99");
  EXPECT_EQ(refused_text(two_cubes + "*NSET, NSET=n\nm\n"), "a.inp:19: error: there is no set \"m\" of nodes before this line");
  EXPECT_EQ(refused_text(two_cubes + "*NSET, NSET=n\nn\n"), "a.inp:19: error: there is no set \"n\" of nodes before this line");
  EXPECT_EQ(refused_text(two_cubes + "*NSET, NSET=n, GENERATE\n20, 30\n"), "a.inp:19: error: none of the numbers 20 to 30 by 1 is of a node");
  EXPECT_THAT(refused_text(two_cubes + "*NSET, NSET=n, GENERATE\n3, 1\n"),
              StartsWith("a.inp:19: error: set \"n\", GENERATE: expected first, last and step"));
  EXPECT_THAT(refused_text(two_cubes + "*ELSET, ELSET=e, ELSET=f, SOMETHING\n1\n"),
              StartsWith("a.inp:18: error: *ELSET: the parameter SOMETHING is not read"));
  EXPECT_EQ(refused_text(two_cubes + "*SURFACE, NAME=s\n1, S7\n"),
            "a.inp:19: error: surface \"s\": the face \"S7\" is not read; faces are S1 to S6, SPOS and SNEG");
  EXPECT_EQ(refused_text(two_cubes + "*SURFACE, NAME=s\n1, SPOS\n"), "a.inp:19: error: surface \"s\": element 1 has no face SPOS or SNEG");
  EXPECT_EQ(refused_text("*PART, NAME=P\n*NODE\n1\n"), "a.inp:1: error: *PART P has no *END PART");
  EXPECT_THAT(refused_text("*PART, NAME=P\n*END PART\n"), HasSubstr("there are parts, and no *INSTANCE of any"));
  EXPECT_EQ(refused_text("*INSTANCE, NAME=I, PART=P\n"), "a.inp:1: error: instance I: there is no part \"P\" before this line");
  EXPECT_THAT(refused_text("*NODE\n1, 0\0, 0\n" + std::string(1, '\0')), StartsWith("a.inp:"));
}

TEST(Abaqus, RefusesElementsByTheirNames) {
  const auto of_type = [&](const std::string& type) { return refused_text("*ELEMENT, TYPE=" + type + "\n1, 1, 2\n"); };
  EXPECT_EQ(of_type("COH3D8"), "a.inp:1: error: *ELEMENT: type COH3D8 is not read: these are cohesive elements");
  EXPECT_EQ(of_type("C3D8P"), "a.inp:1: error: *ELEMENT: type C3D8P is not read; C3D8 is, and C3D8R, C3D8I, C3D8H, C3D8M and C3D8T");
  EXPECT_EQ(of_type("U1"), "a.inp:1: error: *ELEMENT: type U1 is not read: it is not known");
}

// Each set names the one before it twice: without care the last one would have 2^40 members.
TEST(Abaqus, SetsOfSetsDoNotGrowBeyondTheMesh) {
  std::string text = two_cubes + "*NSET, NSET=S0\n1, 2\n";
  for (int s = 1; s <= 40; ++s) text += "*NSET, NSET=S" + std::to_string(s) + "\nS" + std::to_string(s - 1) + ", S" + std::to_string(s - 1) + "\n";
  EXPECT_THAT(set_named(read_text(text).node_sets, "S40").members, ElementsAre(0, 1));
}

/// Each letter left out, doubled or exchanged with the next one.
std::vector<std::string> misspellings(const std::string& word) {
  std::vector<std::string> all;
  for (std::size_t i = 0; i < word.size(); ++i) {
    all.push_back(word.substr(0, i) + word.substr(i + 1));
    all.push_back(word.substr(0, i) + word[i] + word.substr(i));
    if (i + 1 < word.size() && word[i] != word[i + 1]) {
      all.push_back(word);
      std::swap(all.back()[i], all.back()[i + 1]);
    }
  }
  return all;
}

std::string letters_of(std::string word) {
  word.erase(std::remove(word.begin(), word.end(), ' '), word.end());
  return word;
}

TEST(Abaqus, NoMisspeltKeywordOfTheMeshIsPassedOver) {
  for (const std::string word : {"NODE", "ELEMENT", "NSET", "ELSET", "SURFACE", "PART", "INSTANCE", "END INSTANCE", "ASSEMBLY", "INCLUDE", "STEP"})
    for (const std::string& wrong : misspellings(word)) {
      if (letters_of(wrong) == letters_of(word)) continue;  // blanks do not count
      const std::string text = refused_text(two_cubes + "*" + wrong + ", TYPE=C3D8, NAME=n\n3, 1\n");
      EXPECT_THAT(text, HasSubstr("a.inp:18: error: there is no keyword *" + letters_of(wrong))) << wrong;
    }
  EXPECT_EQ(refused_text("*NODE\n1, 0, 0\n*ELEMNT, TYPE=C3D8\n1, 1, 2\n*NODES\n2, 0, 1\n"),
            "a.inp:3: error: there is no keyword *ELEMNT; did you mean \"*ELEMENT\"?; what it stands for is not read, so nodes, elements or sets may "
            "be missing\na.inp:5: error: there is no keyword *NODES; did you mean \"*NODE\"?; what it stands for is not read, so nodes, elements or "
            "sets may be missing");
  EXPECT_THAT(refused_text(two_cubes + "*QUITE SOMETHING ELSE\n"), HasSubstr("there is no keyword *QUITESOMETHINGELSE; what it stands for"));
  EXPECT_THAT(refused_text(two_cubes + "*IMPERFECTION, FILE=f, STEP=1\n1, 0.1\n"), HasSubstr("a.inp:18: error: *IMPERFECTION is not read"));
}

TEST(Abaqus, KeywordsWithoutMeaningForAMeshAreListed) {
  // CalculiX takes "fluid sections" for *FLUID SECTION, and passes over *MEMBRANE itself: its own examples have both.
  const MeshFile file =
      read_text(two_cubes +
                "*fluid sections, elset=e\n1.\n*Membrane, elset=e\n1.\n*VALUES AT INFINITY\n1.\n*Mohr Coulomb\n30.\n*Solid\tSection\n"
                "*SOLIDSECTION\n*PRE-TENSION SECTION\n*BOUNDARYF\n*Boundary\n1, 1\n");
  EXPECT_THAT(file.notes.back(),
              "passed over, as they say nothing of the mesh: *BOUNDARY, *BOUNDARYF, *FLUID SECTION, *MEMBRANE SECTION, *MOHR COULOMB, *PRE-TENSION "
              "SECTION, *SOLID SECTION (2), *VALUES AT INFINITY");
}

TEST(Abaqus, RangesOfLabelsCostNoMoreThanTheMesh) {
  const MeshFile file = read_text("*NODE\n1, 0\n2000000000, 1\n*NSET, NSET=n, GENERATE\n1, 2147483647, 1\n");
  EXPECT_THAT(file.node_sets.at(0).members, ElementsAre(0, 1));
  EXPECT_THAT(file.notes, ElementsAre("set \"n\": 2147483645 of the numbers of its GENERATE lines are of no node, and are left out"));
}

}  // namespace
}  // namespace mortise
