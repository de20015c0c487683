// The sections of Gmsh's format MSH 4.1.

#include <fmt/format.h>

#include <cstdlib>

#include "readers/gmsh/gmsh_mesh.hpp"

namespace mortise {
namespace {

/// Reads an entity of a dimension: a box or a position, groups and what bounds it. Numbers take 2 bytes at least as text.
void read_gmsh_entity(GmshNumbers& numbers, GmshMesh& mesh, int dimension, bool partitioned) {
  const std::int64_t at = numbers.spot(), tag = numbers.whole("the tag of an entity");
  numbers.about("entity", tag);
  GmshEntity entity;
  entity.parent = {dimension, tag};
  if (partitioned) {
    const std::int64_t of_dimension = numbers.whole("the dimension of a parent"), of_tag = numbers.whole("the tag of a parent");
    entity.parent = {static_cast<int>(of_dimension), of_tag};
    const std::int64_t partitions = numbers.count("the number of partitions", 2, 4);
    for (std::int64_t p = 0; p < partitions; ++p) {
      const std::int64_t partition = numbers.whole("a partition");
      if (partitions == 1) entity.partition = partition;
    }
  }
  for (int i = 0; i < (dimension == 0 ? 3 : 6); ++i) numbers.real("a coordinate");
  const std::int64_t groups = numbers.count("the number of physical groups", 2, 4);
  // The sign of a group says that its elements are to be turned round. Of several groups with other signs none is.
  entity.is_turned = groups > 0 && (dimension == 1 || dimension == 2);
  for (std::int64_t g = 0; g < groups; ++g) {
    const std::int64_t group = numbers.whole("the tag of a physical group");
    entity.is_turned = entity.is_turned && group < 0;
    entity.physical.push_back(std::abs(group));
  }
  if (dimension > 0) {
    const std::int64_t bounds = numbers.count("the number of bounding entities", 2, 4);
    for (std::int64_t b = 0; b < bounds; ++b) numbers.whole("the tag of a bounding entity");
  }
  if (!mesh.entities.emplace(GmshTag{dimension, tag}, std::move(entity)).second && !partitioned)
    numbers.error_at(at, fmt::format("entity {} of dimension {} stands twice", tag, dimension));
}

/// A block says how many things it has; all blocks together have what the section announced.
struct GmshBlocks {
  std::int64_t blocks = 0, things = 0;
};

GmshBlocks read_gmsh_blocks(GmshNumbers& numbers, const char* things, std::int64_t bytes_of_text, std::int64_t bytes) {
  GmshBlocks head;
  head.blocks = numbers.count("the number of blocks", 8, 20);
  head.things = numbers.count(things, bytes_of_text, bytes);
  numbers.size("the lowest label");
  numbers.size("the highest label");
  return head;
}

void require_all(GmshNumbers& numbers, const GmshBlocks& head, std::int64_t read, const char* things) {
  if (read != head.things)
    numbers.stop_at(numbers.spot(), fmt::format("{} {} were announced, and {} stand in the {} blocks", head.things, things, read, head.blocks));
}

int read_gmsh_dimension(GmshNumbers& numbers) {
  const std::int64_t at = numbers.spot(), dimension = numbers.whole("the dimension of an entity");
  if (dimension < 0 || dimension > 3) numbers.stop_at(at, fmt::format("the dimension of an entity is {}, outside of 0 to 3", dimension));
  return static_cast<int>(dimension);
}

}  // namespace

void read_gmsh_4_entities(GmshNumbers& numbers, GmshMesh& mesh, bool partitioned) {
  if (partitioned) {
    mesh.partitions = numbers.size("the number of partitions");
    const std::int64_t ghosts = numbers.count("the number of ghost entities", 4, 8);
    for (std::int64_t g = 0; g < ghosts; ++g) {
      numbers.whole("the tag of a ghost entity");
      numbers.whole("a partition");
    }
  }
  std::array<std::int64_t, 4> counts;
  for (std::int64_t& count : counts) count = numbers.count("the number of entities", 10, 36);
  for (int dimension = 0; dimension < 4; ++dimension)
    for (std::int64_t e = 0; e < counts[dimension]; ++e) read_gmsh_entity(numbers, mesh, dimension, partitioned);
}

void read_gmsh_4_nodes(GmshNumbers& numbers, GmshMesh& mesh) {
  const GmshBlocks head = read_gmsh_blocks(numbers, "the number of nodes", 8, 32);
  auto& labels = mesh.file.node_labels;
  std::vector<std::int64_t> spots;
  spots.reserve(head.things);
  labels.reserve(head.things);
  mesh.file.coordinates.reserve(head.things);
  for (std::int64_t b = 0; b < head.blocks; ++b) {
    numbers.about("block of nodes after", b);
    const std::int64_t at = numbers.spot();
    const int dimension = read_gmsh_dimension(numbers);
    numbers.whole("the tag of an entity");
    const bool parametric = numbers.whole("0 or 1, for parametric nodes") != 0;
    const std::int64_t count = numbers.size("the number of nodes of a block"), first = static_cast<std::int64_t>(labels.size());
    if (count > head.things - first)
      numbers.stop_at(at, fmt::format("{} nodes follow, but {} of the {} announced are left", count, head.things - first, head.things));
    for (std::int64_t n = 0; n < count; ++n) {
      spots.push_back(numbers.spot());
      labels.push_back(numbers.size("the label of a node"));
    }
    for (std::int64_t n = 0; n < count; ++n) {
      numbers.about("node", labels[static_cast<std::size_t>(first + n)]);
      const double x = numbers.real("coordinate x"), y = numbers.real("coordinate y"), z = numbers.real("coordinate z");
      mesh.file.coordinates.push_back({x, y, z});
      for (int p = 0; parametric && p < dimension; ++p) numbers.real("a parameter");
    }
  }
  require_all(numbers, head, static_cast<std::int64_t>(labels.size()), "nodes");
  index_gmsh_nodes(numbers, mesh, spots);
}

void read_gmsh_4_elements(GmshNumbers& numbers, GmshMesh& mesh) {
  const GmshBlocks head = read_gmsh_blocks(numbers, "the number of elements", 4, 16);
  std::int64_t read = 0;
  for (std::int64_t b = 0; b < head.blocks; ++b) {
    numbers.about("block of elements after", b);
    const std::int64_t at = numbers.spot();
    const int dimension = read_gmsh_dimension(numbers);
    const GmshTag tag{dimension, numbers.whole("the tag of an entity")};
    const GmshElementType& type = require_gmsh_type(numbers, numbers.whole("an element type"), at);
    if (type.dimension != dimension)
      numbers.stop_at(at, fmt::format("entity {} is of dimension {}, and its elements of dimension {}", tag.second, dimension, type.dimension));
    const std::int64_t count = numbers.size("the number of elements of a block");
    if (count > head.things - read)
      numbers.stop_at(at, fmt::format("{} elements follow, but {} of the {} announced are left", count, head.things - read, head.things));
    const auto known = mesh.entities.find(tag);
    const GmshEntity entity = known == mesh.entities.end() ? GmshEntity{{}, tag} : known->second;
    for (std::int64_t e = 0; e < count; ++e, ++read) {
      const std::int64_t spot = numbers.spot(), label = numbers.size("the label of an element");
      numbers.about("element", label);
      const FileCellRange cell = read_gmsh_nodes_of(numbers, mesh, type, label, spot);
      if (cell.group >= 0) {
        if (entity.is_turned) turn_round(mesh.file.cells[static_cast<std::size_t>(cell.group)], static_cast<std::size_t>(cell.first));
        if (entity.partition > 0) mesh.partitions_here.insert(entity.partition);
        for (const std::int64_t group : entity.physical) add_cells(mesh.physical_cells[{dimension, group}], cell);
        // Boundaries of partitions are no entities of the geometry.
        if (entity.parent.first == dimension) add_cells(mesh.entity_cells[entity.parent], cell);
      } else if (cell.count > 0) {
        for (const std::int64_t group : entity.physical) mesh.physical_points[{0, group}].push_back(cell.first);
        if (entity.parent.first == 0) mesh.entity_points[entity.parent].push_back(cell.first);
      }
    }
  }
  require_all(numbers, head, read, "elements");
  const auto here = static_cast<std::int64_t>(mesh.partitions_here.size());
  if (here > 0 && here < mesh.partitions)
    numbers.stop_at(numbers.spot(),
                    fmt::format("the mesh was cut into {} partitions, and the file has elements of {} of them; please write all into one "
                                "file (Mesh.PartitionSplitMeshFiles=0), or save the mesh before it is cut",
                                mesh.partitions, here));
}

}  // namespace mortise
