// Input files of Abaqus and CalculiX as people and their programs write them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mesh_file_test_support.hpp"
#include "mortise/mesh/cell_nodes.hpp"

namespace mortise {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::UnorderedElementsAre;

MeshFile read_deck(const std::string& text) { return read_mesh_text("deck.inp", text); }
std::string refused_deck(const std::string& text) { return refusal_of("deck.inp", text); }

const std::string cube_nodes = "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n";
const std::string cube_element = "*ELEMENT, TYPE=C3D8, ELSET=CUBE\n1, 1,2,3,4,5,6,7,8\n";

TEST(AbaqusDecks, AnInstanceMayHoldItsOwnMesh) {
  const std::string begin = "*PART, NAME=P\n*END PART\n*ASSEMBLY, NAME=A\n*INSTANCE, NAME=P-1, PART=P\n5., 0., 0.\n";
  const std::string sets = "*NSET, NSET=FOOT\n1, 2\n*SURFACE, NAME=TOP\nCUBE, S2\n*SOLID SECTION, ELSET=CUBE, MATERIAL=M\n";
  const std::string end = "*END INSTANCE\n*NSET, NSET=OUTSIDE, INSTANCE=P-1\n3\n*END ASSEMBLY\n";
  const MeshFile file = read_deck(begin + cube_nodes + cube_element + sets + end);
  ASSERT_EQ(file.coordinates.size(), 8u);
  EXPECT_EQ(file.coordinates[0][0], 5.0);
  EXPECT_THAT(set_named(file.node_sets, "P-1.FOOT").members, ElementsAre(0, 1));
  EXPECT_THAT(set_named(file.node_sets, "OUTSIDE").members, ElementsAre(2));
  EXPECT_EQ(set_named(file.side_sets, "P-1.TOP").members.size(), 1u);
  EXPECT_THAT(refused_deck("*PART, NAME=P\n" + cube_nodes + "*END PART\n*INSTANCE, NAME=P-1, PART=P\n" + cube_nodes),
              HasSubstr("deck.inp:13: error: instance P-1 has *NODE, and its part P has nodes"));
  EXPECT_THAT(refused_deck("*PART, NAME=P\n*END PART\n*INSTANCE, NAME=P-1, PART=P\n*PART, NAME=Q\n"),
              HasSubstr("deck.inp:4: error: *PART inside of *INSTANCE is not read"));
}

TEST(AbaqusDecks, SpringsMassesAndBeamsAreLeftOutWithTheSetsThatHoldNothingElse) {
  const MeshFile file = read_deck(cube_nodes + cube_element +
                                  "*ELEMENT, TYPE=SPRINGA, ELSET=SPRINGS\n10, 1, 2\n11, 3, 4\n*ELEMENT, TYPE=MASS\n12, 5\n*ELEMENT, TYPE=B32,\n"
                                  "ELSET=BEAMS\n13, 1, 2,\n3\n*ELSET, ELSET=BOTH\n1, 10, 12\n*ELSET, ELSET=ALL, GENERATE\n1, 13\n"
                                  "*ELSET, ELSET=OF SETS\nSPRINGS, BEAMS\n*SURFACE, NAME=ON BEAMS\nBEAMS\n*SURFACE, NAME=ON BOTH\nBOTH, S1\n");
  ASSERT_EQ(file.cells.size(), 1u);
  EXPECT_THAT(names_of_sets(file.cell_sets), ElementsAre("CUBE", "BOTH", "ALL"));
  EXPECT_THAT(names_of_sets(file.side_sets), ElementsAre("ON BOTH"));
  std::vector<std::string> left_out;
  for (const LeftOutSet& set : file.left_out) left_out.push_back(set.name + ": " + set.reason);
  EXPECT_THAT(left_out, UnorderedElementsAre(
                            "SPRINGS: its 2 elements are of types that are not read", "BEAMS: its 1 elements are of types that are not read",
                            "OF SETS: its 3 elements are of types that are not read", "ON BEAMS: its 1 elements are of types that are not read"));
  EXPECT_THAT(file.notes, Contains("elements that are left out, as they have no cells here: 1 beams (B32), 1 masses (MASS), 2 springs (SPRINGA)"));
  EXPECT_THAT(file.notes, Contains("set \"BOTH\": 2 of its 3 elements are of types that are not read, and are left out"));
  EXPECT_THAT(file.notes, Contains(HasSubstr("set \"ALL\": 8 of the numbers of its GENERATE lines are of no element")));
  EXPECT_THAT(refused_deck(cube_nodes + "*ELEMENT, TYPE=SPRINGA\n10, 1, 2\n*ELSET, ELSET=E\n11\n"),
              HasSubstr("deck.inp:13: error: there is no element 11"));
}

TEST(AbaqusDecks, SurfacesNameTheFacesOfShells) {
  const MeshFile file = read_deck(cube_nodes +
                                  "*ELEMENT, TYPE=S4, ELSET=E\n1, 1,2,3,4\n*SURFACE, NAME=P\nE, SPOS\n*SURFACE, NAME=N\nE, SNEG\n"
                                  "*SURFACE, NAME=S1\nE, S1\n*SURFACE, NAME=S2\nE, S2\n");
  for (const auto& set : file.side_sets)
    EXPECT_EQ(set.members.at(0).side, set.name == "P" || set.name == "S2" ? the_cell_itself : the_other_face) << set.name;
}

// Abaqus has the normal of a line from node 1 to node 2 on its left, the program on its right.
TEST(AbaqusDecks, SurfacesNameTheSidesOfLines) {
  const MeshFile file = read_deck(cube_nodes + "*ELEMENT, TYPE=RAX2, ELSET=E\n1, 1,2\n*SURFACE, NAME=left\nE, SPOS\n*SURFACE, NAME=right\nE, SNEG\n");
  EXPECT_EQ(set_named(file.side_sets, "left").members.at(0).side, the_other_face);
  EXPECT_EQ(set_named(file.side_sets, "right").members.at(0).side, the_cell_itself);
}

TEST(AbaqusDecks, SetsOfNodesAreThoseOfElements) {
  const MeshFile file = read_deck(cube_nodes + "9, 2, 0, 0\n10, 2, 1, 0\n*ELEMENT, TYPE=S4\n2, 2,9,10,3\n" + cube_element +
                                  "*ELSET, ELSET=SHELL\n2\n*NSET, NSET=N, ELSET=SHELL\n");
  EXPECT_THAT(set_named(file.node_sets, "N").members, ElementsAre(1, 2, 8, 9));
  const std::string part = "*PART, NAME=P\n" + cube_nodes + cube_element + "*NSET, NSET=OF PART, ELSET=CUBE\n*END PART\n";
  const MeshFile placed = read_deck(part +
                                    "*ASSEMBLY, NAME=A\n*INSTANCE, NAME=I, PART=P\n*END INSTANCE\n*INSTANCE, NAME=J, PART=P\n*END INSTANCE\n"
                                    "*ELSET, ELSET=E, INSTANCE=J\n1\n*NSET, NSET=ALL, ELSET=E\n*NSET, NSET=I2, ELSET=CUBE, INSTANCE=I\n");
  EXPECT_EQ(set_named(placed.node_sets, "J.OF PART").members.size(), 8u);
  EXPECT_THAT(set_named(placed.node_sets, "ALL").members, ElementsAre(8, 9, 10, 11, 12, 13, 14, 15));
  EXPECT_THAT(set_named(placed.node_sets, "I2").members, ElementsAre(0, 1, 2, 3, 4, 5, 6, 7));
  EXPECT_THAT(refused_deck(cube_nodes + "*NSET, NSET=N, ELSET=NONE\n"), HasSubstr("deck.inp:10: error: there is no set \"NONE\" of elements"));
}

TEST(AbaqusDecks, SetsBehindAStepAreRead) {
  const MeshFile file = read_deck(cube_nodes + cube_element +
                                  "*STEP\n*STATIC\n0.1, 1.\n*NO KEYWORD\n*NSET, NSET=LATE\n3\n*SURFACE, NAME=TOP\nCUBE, S2\n"
                                  "*CLOAD\nLATE, 1, 1.\n*END STEP\n");
  EXPECT_THAT(set_named(file.node_sets, "LATE").members, ElementsAre(2));
  EXPECT_THAT(names_of_sets(file.side_sets), ElementsAre("TOP"));
}

TEST(AbaqusDecks, AnalyticSurfacesAreLeftOutWithTheGeneratorThatMakesThem) {
  const MeshFile file =
      read_deck(cube_nodes + cube_element + "*SURFACE, TYPE=REVOLUTION, NAME=Punch\nSTART, 0., 0.\nLINE, 1., 0.\n*SURFACE, NAME=TOP\nCUBE, S2\n");
  ASSERT_EQ(file.left_out.size(), 1u);
  EXPECT_EQ(file.left_out[0].name, "Punch");
  EXPECT_THAT(file.left_out[0].reason, HasSubstr("TYPE=REVOLUTION, which has no mesh; the generator \"revolved\""));
  EXPECT_THAT(names_of_sets(file.side_sets), ElementsAre("TOP"));
}

TEST(AbaqusDecks, MayBeginWithAByteOrderMarkAndEndTheirLinesInAnyWay) {
  const std::string text = cube_nodes + cube_element;
  const auto with_ends = [&](const std::string& end) {
    std::string changed;
    for (const char c : text) c == '\n' ? changed += end : changed += c;
    return changed;
  };
  for (const std::string& deck : {"\xEF\xBB\xBF" + text, with_ends("\r"), with_ends("\r\n"), "\xEF\xBB\xBF" + with_ends("\r")}) {
    const MeshFile file = read_deck(deck);
    EXPECT_EQ(file.coordinates.size(), 8u);
    EXPECT_EQ(file.cells.size(), 1u);
  }
  EXPECT_THAT(refused_deck(with_ends("\r") + "*NSET, NSET=N\r99\r"), HasSubstr("deck.inp:13: error: there is no node 99"));
  // More than a buffer of lines.
  std::string many = "*NODE\r";
  for (int n = 1; n <= 40000; ++n) many += std::to_string(n) + ", 1.5\r";
  EXPECT_EQ(read_deck(many).coordinates.size(), 40000u);
}

TEST(AbaqusDecks, ANodeMayStandTwiceAtOnePlace) {
  const MeshFile file = read_deck(cube_nodes + "*NODE, NSET=AGAIN\n8,0,1,1\n7, 1, 1, 1\n9, 0, 0, 2\n" + cube_element);
  EXPECT_THAT(set_named(file.node_sets, "AGAIN").members, ElementsAre(6, 7, 10));
  EXPECT_THAT(file.notes, Contains("2 lines of nodes stand twice with the same coordinates"));
  EXPECT_THAT(refused_deck(cube_nodes + "*NODE\n8,0,1,1.5\n"),
              HasSubstr("deck.inp:11: error: node 8 stands twice, with other coordinates; the first is at deck.inp:9"));
}

TEST(AbaqusDecks, ANodeHasSixNumbersAtMost) {
  EXPECT_EQ(read_deck("*NODE\n1, 0, 0, 0, 0, 0, 1\n").coordinates.size(), 1u);
  EXPECT_THAT(refused_deck("*NODE\n1, 0, 0, 0, 2, 1, 0, 0\n"), HasSubstr("deck.inp:2: error: node 1 has 7 numbers behind its label"));
  EXPECT_THAT(refused_deck("*NODE\n1, 0, 0, 0, x\n"), HasSubstr("deck.inp:2: error: node 1: number 4 behind its label is \"x\", no finite number"));
}

TEST(AbaqusDecks, ElementsOfHeatAreThoseOfSolids) {
  const MeshFile file = read_deck(
      cube_nodes + "*ELEMENT, TYPE=DC3D8\n1, 1,2,3,4,5,6,7,8\n*ELEMENT, TYPE=C3D8RT\n2, 1,2,3,4,5,6,7,8\n*ELEMENT, TYPE=C3D4T\n3, 1,2,3,5\n");
  ASSERT_EQ(file.cells.size(), 2u);
  EXPECT_EQ(file.cells[0].labels.size(), 2u);
  EXPECT_THAT(file.notes, ElementsAre("elements of type C3D8RT are computed with full integration"));
}

TEST(AbaqusDecks, OfOtherKindsSayWhatTheyAre) {
  const auto refused_as = [&](const std::string& name, const std::string& bytes) { return refusal_of(name, bytes); };
  EXPECT_THAT(refused_as("a.inp", "$MeshFormat\n4.1 0 8\n"),
              HasSubstr("\"a.inp\" is to be Abaqus or CalculiX by its name, and by its content it is a mesh of Gmsh; rename"));
  EXPECT_THAT(refused_as("a.msh", "** a comment\n" + cube_nodes), HasSubstr("by its content it is an input file of Abaqus or CalculiX"));
  EXPECT_THAT(refused_as("a.inp", std::string("CDF\x01", 4)), HasSubstr("by its content it is netCDF or HDF5, as Exodus II is"));
  EXPECT_THAT(refused_as("a.exo", cube_nodes), HasSubstr("by its content it is an input file of Abaqus or CalculiX"));
  EXPECT_THAT(refused_as("a.inp", std::string("\xFF\xFE*\0N\0", 6)), HasSubstr("by its content it is text in UTF-16; please save it in UTF-8"));
  EXPECT_THAT(refused_as("a.mesh", "$MeshFormat\n4.1 0 8\n"), HasSubstr("By its content it is a mesh of Gmsh. Rename the file"));
  EXPECT_THAT(refused_as("a.inp", "ISO-10303-21;\n"), HasSubstr("a drawing in STEP"));
  EXPECT_THAT(refused_as("a.msh", "\x1F\x8B\x08"), HasSubstr("packed by gzip"));
}

}  // namespace
}  // namespace mortise
