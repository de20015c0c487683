// Elements that are turned inside out: refused, or warned of where it is so at a corner alone.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>

#include "mesh_test_support.hpp"
#include "mortise/mesh/build_mesh.hpp"
#include "mortise/mesh/file_body.hpp"

namespace mortise {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Two quadratic tetrahedra with a face in common, edges of length 1 and labels 20 and 21. The node in the middle of the edge from (0, 0, 0) to (1,
/// 0, 0) of the first lies at (middle, 0, 0): on this line x = 4 s (1 - s) middle + s (2 s - 1) has dx/ds = 4 middle - 1 at its beginning.
MeshFile two_tetrahedra(double middle) {
  MeshFile file;
  file.path = "tetrahedra.msh";
  const std::vector<std::array<double, 3>> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  file.coordinates = corners;
  std::map<std::array<int, 2>, std::int32_t> middles;
  FileCells cells{CellShape::tetrahedron10, {}, {20, 21}};
  const std::array<std::array<int, 4>, 2> tetrahedra{{{0, 1, 2, 3}, {1, 2, 3, 4}}};
  for (const auto& own : tetrahedra) {
    for (const int corner : own) cells.nodes.push_back(corner);
    for (const auto& [a, b] : topology(CellShape::tetrahedron10).edges) {
      const std::array<int, 2> ends{own[static_cast<std::size_t>(a)], own[static_cast<std::size_t>(b)]};
      const auto [entry, added] = middles.emplace(ends, static_cast<std::int32_t>(file.coordinates.size()));
      if (added) {
        std::array<double, 3> x{};
        for (std::size_t i = 0; i < 3; ++i)
          x[i] = 0.5 * (corners[static_cast<std::size_t>(ends[0])][i] + corners[static_cast<std::size_t>(ends[1])][i]);
        if (ends == std::array<int, 2>{0, 1}) x = {middle, 0.0, 0.0};
        file.coordinates.push_back(x);
      }
      cells.nodes.push_back(entry->second);
    }
  }
  file.cells = {cells};
  for (std::size_t n = 0; n < file.coordinates.size(); ++n) file.node_labels.push_back(static_cast<std::int64_t>(n) + 1);
  return file;
}

RCP<Mesh> mesh_of(const MeshFile& file) {
  const auto comm = Tpetra::getDefaultComm();
  FileBodyRequest request;
  request.name = "part";
  request.place = {"scene.xml", 5, "bodies/part"};
  request.made = std::make_shared<const MeshFile>(file);
  const auto bodies = make_file_bodies(*comm, {request});
  BodyDescription description;
  description.name = "part";
  description.place = request.place;
  description.listed = bodies.at(0);
  return build_mesh(comm, {description}, {});
}

TEST(InvertedElements, WithEdgesCurvedTooMuchAtACornerAreWarnedOf) {
  EXPECT_THAT(mesh_of(two_tetrahedra(0.5))->warnings, IsEmpty());
  EXPECT_THAT(mesh_of(two_tetrahedra(0.26))->warnings, IsEmpty());
  EXPECT_THAT(mesh_of(two_tetrahedra(0.24))->warnings,
              ElementsAre(AllOf(HasSubstr("part: 1 elements are turned inside out at a corner"), HasSubstr("Elements: 20"))));
}

TEST(InvertedElements, AtAPointOfIntegrationAreRefused) {
  EXPECT_THAT(input_error_of([&] { mesh_of(two_tetrahedra(-0.5)); }),
              AllOf(HasSubstr("scene.xml:5: error: bodies/part"), HasSubstr("body \"part\": element 20 is inverted: det J = -")));
}

TEST(InvertedElements, SayThatANodeStandsInThemTwice) {
  MeshFile file = two_tetrahedra(0.5);
  file.cells[0].nodes[3] = 0;  // a corner that is another one
  EXPECT_THAT(input_error_of([&] { mesh_of(file); }), HasSubstr("its node at (0, 0, 0) stands in it twice"));
}

}  // namespace
}  // namespace mortise
