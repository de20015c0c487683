// Gmsh's formats: what is refused and where, groups, byte orders.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "mesh_file_test_support.hpp"

namespace mortise {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string head_22 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n", head_41 = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
const std::string triangle_nodes_22 = "$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n";
const std::string triangle_nodes_41 = "$Nodes\n1 3 1 3\n2 1 0 3\n1\n2\n3\n0 0 0\n1 0 0\n0 1 0\n$EndNodes\n";

std::string refused(const std::string& text) { return refusal_of("a.msh", text); }

TEST(Gmsh, TellsTheLineOfWhatIsWrong) {
  EXPECT_EQ(refused(""), "a.msh:1: error: expected $MeshFormat in the first line, found \"\": this is no mesh of Gmsh");
  EXPECT_THAT(refused("solid\n"), StartsWith("a.msh:1: error: expected $MeshFormat in the first line, found \"solid\""));
  EXPECT_THAT(refused("$MeshFormat\n3 0 8\n"), StartsWith("a.msh:2: error: the format's version is \"3\"; save it as MSH 4.1 or 2.2"));
  EXPECT_THAT(refused("$MeshFormat\n2.2 0 4\n"), StartsWith("a.msh:2: error: numbers take \"4\" bytes"));
  EXPECT_THAT(refused(head_22), HasSubstr("there is no section $Nodes"));
  EXPECT_THAT(refused(head_22 + triangle_nodes_22), HasSubstr("there is no section $Elements"));
  EXPECT_THAT(refused(head_22 + "$Nodes\n3\n1 0 0 0\n2 1 x 0\n3 0 1 0\n$EndNodes\n"),
              StartsWith("a.msh:7: error: node 2: expected coordinate y, found \"x\""));
  EXPECT_THAT(refused(head_22 + "$Nodes\n3\n1 0 0 0\n2 1 nan 0\n3 0 1 0\n$EndNodes\n"),
              StartsWith("a.msh:7: error: node 2: expected coordinate y, found \"nan\""));
  EXPECT_THAT(refused(head_22 + "$Nodes\n3\n1 0 0 0\n2 1 0 0\n$EndNodes\n" + "$Elements\n0\n$EndElements\n"),
              StartsWith("a.msh:8: error: node after 2: expected the label of a node, found \"$EndNodes\""));
  EXPECT_THAT(refused(head_22 + "$Nodes\n2\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n"),
              StartsWith("a.msh:8: error: expected $EndNodes, found \"3\"; is a count of the section $Nodes wrong?"));
  EXPECT_EQ(refused(head_22 + "$Nodes\n3\n1 0 0 0\n2 1 0 0\n2 0 1 0\n$EndNodes\n"), "a.msh:8: error: node 2 stands twice; the first is at line 7");
  EXPECT_THAT(refused(head_22 + "$Nodes\n2\n1 0.00 0.00 0.00\n2 1 0"),
              StartsWith("a.msh:7: error: node 2: expected coordinate z, found the end of the file: it is cut off"));
  EXPECT_THAT(refused(head_22 + "$Comments\nnothing"), StartsWith("a.msh:4: error: the section $Comments has no end"));
  EXPECT_THAT(refused(head_22 + triangle_nodes_22 + triangle_nodes_22), StartsWith("a.msh:10: error: $Nodes stands twice"));
  EXPECT_THAT(refused(head_22 + "$Elements\n0\n$EndElements\n"), StartsWith("a.msh:4: error: $Elements stands before $Nodes"));
  EXPECT_THAT(refused(head_22 + "Nodes\n"), StartsWith("a.msh:4: error: expected a section, as $Nodes, found \"Nodes\""));
}

TEST(Gmsh, RefusesCountsForWhichTheFileHasNoRoom) {
  EXPECT_THAT(refused(head_22 + "$Nodes\n1000000000000000000\n1 0 0 0\n$EndNodes\n"),
              StartsWith("a.msh:5: error: the number of nodes is 1000000000000000000, above 2147483647"));
  EXPECT_THAT(refused(head_22 + "$Nodes\n2000000000\n1 0 0 0\n$EndNodes\n"),
              StartsWith("a.msh:5: error: the number of nodes is 2000000000, but the 18 bytes that follow have no room for more than 2"));
  EXPECT_THAT(refused(head_22 + "$Nodes\n-1\n$EndNodes\n"), StartsWith("a.msh:5: error: the number of nodes is -1, below 0"));
  EXPECT_THAT(refused(head_41 + "$Nodes\n1 99999999 1 3\n"), StartsWith("a.msh:5: error: the number of nodes is 99999999, but"));
  EXPECT_THAT(refused(head_41 + "$Entities\n7000000 0 0 0\n$EndEntities\n"), StartsWith("a.msh:5: error: the number of entities is 7000000, but"));
  EXPECT_THAT(refused(head_41 + "$Nodes\n1 3 1 3\n2 1 0 4\n1\n2\n3\n0 0 0\n1 0 0\n0 1 0\n$EndNodes\n"),
              StartsWith("a.msh:6: error: 4 nodes follow, but 3 of the 3 announced are left"));
  EXPECT_THAT(refused(head_41 + "$Nodes\n1 3 1 3\n2 1 0 2\n1\n2\n0 0 0\n1 0 0\n0 1 0\n$EndNodes\n"),
              StartsWith("a.msh:11: error: 3 nodes were announced, and 2 stand in the 1 blocks"));
}

TEST(Gmsh, TellsTheElementThatIsWrong) {
  const auto with_22 = [&](const std::string& elements) {
    return refused(head_22 + triangle_nodes_22 + "$Elements\n" + elements + "$EndElements\n");
  };
  EXPECT_EQ(with_22("1\n7 2 2 1 1 1 2 4\n"), "a.msh:12: error: element 7: there is no node 4");
  EXPECT_EQ(with_22("2\n7 2 2 1 1 1 5 4\n8 2 2 1 1 1 2 9\n"),
            "a.msh:12: error: element 7: there is no node 5\na.msh:12: error: element 7: there is no node 4\na.msh:13: error: element 8: there is no "
            "node 9");
  EXPECT_EQ(with_22("2\n7 2 2 1 1 1 2 3\n7 2 2 1 1 2 3 1\n"), "a.msh:13: error: element 7 stands twice; the first is at line 12");
  EXPECT_THAT(with_22("1\n7 10 2 1 1 1 2 3\n"),
              AllOf(StartsWith("a.msh:12: error: an element of type 10"), HasSubstr("Mesh.SecondOrderIncomplete=1")));
  EXPECT_THAT(with_22("1\n7 12 2 1 1 1 2 3\n"), HasSubstr("hexahedron of 27 nodes"));
  EXPECT_THAT(with_22("1\n7 19 2 1 1 1 2 3\n"), HasSubstr("pyramid of 13 nodes"));
  EXPECT_THAT(with_22("1\n7 93 2 1 1 1 2 3\n"), HasSubstr("type 93 is not read"));
  EXPECT_THAT(with_22("1\n7 2 -1 1 2 3\n"), StartsWith("a.msh:12: error: the number of tags is -1"));
  EXPECT_THAT(refused(head_41 + triangle_nodes_41 + "$Elements\n1 1 1 1\n3 1 2 1\n1 1 2 3\n$EndElements\n"),
              StartsWith("a.msh:16: error: entity 1 is of dimension 3, and its elements of dimension 2"));
  // Some errors of a long file are reported, neither all nor the first one alone.
  std::string many = "20\n";
  for (int e = 1; e <= 20; ++e) many += std::to_string(e) + " 2 2 1 1 1 2 9\n";
  const std::string told = with_22(many);
  EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 9);
}

TEST(Gmsh, KeepsNodesWithoutElementsAndLabelsAsTheyAre) {
  const MeshFile file = read_mesh_text("a.msh", head_22 +
                                                    "$Nodes\n4\n1000000007 0 0 0\n5 1 0 0\n70 0 1 0\n8 9 9 9\n$EndNodes\n"
                                                    "$Elements\n1\n44 2 2 0 3 1000000007 5 70\n$EndElements\n");
  EXPECT_THAT(file.node_labels, ElementsAre(1000000007, 5, 70, 8));
  ASSERT_EQ(file.cells.size(), 1u);
  EXPECT_THAT(file.cells[0].nodes, ElementsAre(0, 1, 2));
  EXPECT_THAT(file.cells[0].labels, ElementsAre(44));
  EXPECT_THAT(names_of_sets(file.cell_sets), ElementsAre("surface 3"));
}

TEST(Gmsh, NamesOfSeveralDimensionsTellWhichOne) {
  const MeshFile file = read_mesh_text("a.msh", head_22 + "$PhysicalNames\n2\n1 1 \"part\"\n2 1 \"part\"\n$EndPhysicalNames\n" + triangle_nodes_22 +
                                                    "$Elements\n2\n1 1 2 1 1 1 2\n2 2 2 1 1 1 2 3\n$EndElements\n");
  EXPECT_THAT(names_of_sets(file.cell_sets), ElementsAre("part (curve)", "part (surface)"));
  ASSERT_EQ(file.notes.size(), 1u);
  EXPECT_THAT(file.notes[0], HasSubstr("\"part\" names groups of several dimensions"));
}

TEST(Gmsh, PassesOverWhatIsNoMesh) {
  const std::string more = "$Periodic\n1\n0 1 2\n$EndPeriodic\n$NodeData\n1\n\"$Nodes\"\n$EndNodeData\n";
  EXPECT_EQ(
      read_mesh_text("a.msh", head_22 + more + triangle_nodes_22 + more + "$Elements\n1\n1 2 2 1 1 1 2 3\n$EndElements\n" + more).coordinates.size(),
      3u);
}

/// Bytes of a binary file, in this machine's order or in the other one.
class BinaryMesh {
 public:
  explicit BinaryMesh(bool swapped) : swapped_(swapped) {}
  BinaryMesh& text(const std::string& text) {
    bytes_ += text;
    return *this;
  }
  template <class Number>
  BinaryMesh& numbers(std::initializer_list<Number> all) {
    for (const Number number : all) {
      std::string bytes(sizeof number, '\0');
      std::memcpy(bytes.data(), &number, sizeof number);
      if (swapped_) std::reverse(bytes.begin(), bytes.end());
      bytes_ += bytes;
    }
    return *this;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  bool swapped_;
  std::string bytes_;
};

BinaryMesh binary_41(bool swapped, std::uint64_t node_of_element) {
  BinaryMesh mesh(swapped);
  mesh.text("$MeshFormat\n4.1 1 8\n").numbers({1}).text("\n$EndMeshFormat\n$Nodes\n");
  mesh.numbers<std::uint64_t>({1, 3, 1, 3}).numbers({2, 1, 0}).numbers<std::uint64_t>({3, 1, 2, 3});
  mesh.numbers({0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0}).text("\n$EndNodes\n$Elements\n");
  mesh.numbers<std::uint64_t>({1, 1, 1, 1}).numbers({2, 1, 2}).numbers<std::uint64_t>({1, 1, 1, 2, node_of_element}).text("\n$EndElements\n");
  return mesh;
}

TEST(Gmsh, ReadsEitherOrderOfBytes) {
  for (const bool swapped : {false, true}) {
    const MeshFile file = read_mesh_text("a.msh", binary_41(swapped, 3).bytes());
    EXPECT_EQ(file.coordinates[2][1], 1.0);
    EXPECT_THAT(file.cells[0].nodes, ElementsAre(0, 1, 2));
    BinaryMesh old(swapped);
    old.text("$MeshFormat\n2.2 1 8\n").numbers({1}).text("\n$EndMeshFormat\n$Nodes\n3\n");
    for (int n = 1; n <= 3; ++n) old.numbers({n}).numbers({0.5 * n, 0.0, n == 3 ? 1.0 : 0.0});
    old.text("\n$EndNodes\n$Elements\n1\n").numbers({2, 1, 2, 1, 7, 8, 1, 2, 3}).text("\n$EndElements\n");
    const MeshFile from_old = read_mesh_text("a.msh", old.bytes());
    EXPECT_THAT(names_of_sets(from_old.cell_sets), ElementsAre("physical surface 7"));
    EXPECT_EQ(from_old.coordinates[1][0], 1.0);
  }
}

TEST(Gmsh, TellsTheByteOfWhatIsWrong) {
  const std::string whole = binary_41(false, 3).bytes();
  const auto last_node = static_cast<long>(whole.find("\n$EndElements")) - 8;
  EXPECT_EQ(refused(binary_41(false, 9).bytes()), "a.msh: error: byte " + std::to_string(last_node) + ": element 1: there is no node 9");
  // Wherever the file is cut off before the last word, it is refused.
  for (std::size_t size = 0; size + std::strlen("\n") < whole.size(); ++size) EXPECT_NE(refused(whole.substr(0, size)), "no error") << size;
  EXPECT_THAT(refused("$MeshFormat\n4.1 1 8\nabcd\n$EndMeshFormat\n"), StartsWith("a.msh:2: error: expected the number 1 in 4 bytes"));
}

const std::string one_triangle =
    "$Nodes\n1 3 1 3\n2 1 0 3\n1\n2\n3\n0 0 0\n1 0 0\n0 1 0\n$EndNodes\n$Elements\n1 1 1 1\n2 1 2 1\n1 1 2 3\n$EndElements\n";

// Gmsh writes elements as its geometry has them, and turns those of groups with a sign when it reads them. Version 2.2 has them turned.
TEST(Gmsh, TurnsElementsOfGroupsWithASign) {
  const auto nodes_of = [&](const std::string& groups) {
    const std::string entities = "$Entities\n0 0 1 0\n1 0 0 0 1 1 0 " + groups + " 0\n$EndEntities\n";
    return read_mesh_text("a.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n" + entities + one_triangle).cells.at(0).nodes;
  };
  EXPECT_THAT(nodes_of("1 5"), ::testing::ElementsAre(0, 1, 2));
  EXPECT_THAT(nodes_of("1 -5"), ::testing::ElementsAre(0, 2, 1));
  EXPECT_THAT(nodes_of("2 -5 -6"), ::testing::ElementsAre(0, 2, 1));
  EXPECT_THAT(nodes_of("2 -5 6"), ::testing::ElementsAre(0, 1, 2));
}

TEST(Gmsh, RefusesOneFileOfAMeshThatWasCut) {
  const auto of_partitions = [&](int partitions) {
    const std::string entities =
        "$PartitionedEntities\n" + std::to_string(partitions) + "\n0\n0 0 1 0\n1 2 9 1 1 0 0 0 1 1 0 0 0\n$EndPartitionedEntities\n";
    return refusal_of("a.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n" + entities + one_triangle);
  };
  EXPECT_EQ(of_partitions(1), "no error");
  EXPECT_THAT(of_partitions(3), ::testing::HasSubstr("the mesh was cut into 3 partitions, and the file has elements of 1 of them"));
}

}  // namespace
}  // namespace mortise
