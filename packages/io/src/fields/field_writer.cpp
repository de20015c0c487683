#include "mortise/io/field_writer.hpp"

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <numeric>
#include <set>
#include <stdexcept>
#include <type_traits>

#include "fields/field_files.hpp"
#include "fields/id_order.hpp"
#include "fields/xdmf.hpp"
#include "hdf5/hdf5_file.hpp"
#include "mortise/io/files.hpp"

namespace mortise {
namespace {

/// Numbers of cells in XDMF's mixed topology.
long long xdmf_cell(CellShape shape) {
  return visit_cell(shape, [](auto cell) -> long long { return decltype(cell)::xdmf_number; });
}

/// Order of a cell's nodes in XDMF, whose orders are those of VTK. VTK's wedges begin with the triangle that has the others' normals
/// turned round, outward: bottom and top change places.
std::vector<int> xdmf_order(CellShape shape) {
  return visit_cell(shape, [](auto cell) {
    using Cell = decltype(cell);
    std::vector<int> order(Cell::nodes);
    std::iota(order.begin(), order.end(), 0);
    if constexpr (std::is_base_of_v<ReferenceWedge, Cell>)
      for (int first = 0; first + 6 <= Cell::nodes; first += 6)  // corners, then edges of the triangles
        std::rotate(order.begin() + first, order.begin() + first + 3, order.begin() + first + 6);
    return order;
  });
}

/// Columns that hold [xdmf cell, body, number of nodes, nodes ...] of each element of the mesh; nodes beyond those of an element are not used.
int element_columns(const Mesh& mesh) {
  int nodes = 0;
  for (const Block& block : mesh.blocks) nodes = std::max(nodes, block.nodes_per_element);
  return 3 + nodes;
}

RCP<const Map> element_map(const Mesh& mesh) {
  std::vector<GlobalOrdinal> ids;
  for (const Block& block : mesh.blocks) ids.insert(ids.end(), block.element_ids.begin(), block.element_ids.begin() + block.owned);
  return rcp(new Map(Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid(), ids.data(), static_cast<LocalOrdinal>(ids.size()), 0, mesh.comm));
}

std::vector<double> element_rows(const Mesh& mesh) {
  const auto columns = static_cast<std::size_t>(element_columns(mesh));
  std::vector<double> rows;
  for (const Block& block : mesh.blocks) {
    const std::vector<int> order = xdmf_order(block.shape);
    for (LocalOrdinal element = 0; element < block.owned; ++element) {
      const std::size_t end = rows.size() + columns;
      for (const auto entry : {xdmf_cell(block.shape), static_cast<long long>(block.body), static_cast<long long>(block.nodes_per_element)})
        rows.push_back(static_cast<double>(entry));
      for (const int a : order) rows.push_back(static_cast<double>(mesh.local_nodes->getGlobalElement(block.nodes(element)[a])));
      rows.resize(end, 0.0);
    }
  }
  return rows;
}

/// From the components as given to those of the file: vectors (x, y, z), tensors xx, xy, xz, yy, yz, zz.
std::vector<double> as_stored(const Field& field) {
  const int given = field.components, stored = stored_components(field.kind);
  static const int tensor[6] = {0, 3, 5, 1, 4, 2};  // of xx, yy, zz, xy, yz, xz
  const std::size_t rows = field.values.size() / given;
  std::vector<double> values(rows * stored, 0.0);
  for (std::size_t row = 0; row < rows; ++row)
    for (int c = 0; c < stored; ++c) {
      const int from = field.kind == FieldKind::symmetric_tensor ? tensor[c] : c;
      if (from < given) values[row * stored + c] = field.values[row * given + from];
    }
  return values;
}

bool fits(FieldKind kind, int components) {
  if (kind == FieldKind::vector) return components == 2 || components == 3;
  if (kind == FieldKind::symmetric_tensor) return components == 4 || components == 6;
  return components == 1;
}

std::vector<long long> whole(const std::vector<double>& values) {
  std::vector<long long> result;
  for (const double value : values) result.push_back(static_cast<long long>(value));
  return result;
}

}  // namespace

struct FieldWriter::Implementation {
  Implementation(RCP<const Mesh> mesh_, std::string directory_)
      : mesh(std::move(mesh_)),
        comm(mesh->comm),
        directory(std::move(directory_)),
        xdmf_path(path("fields.xdmf")),
        nodes(mesh->owned_nodes),
        elements(element_map(*mesh)) {
    for (const Block& block : mesh->blocks) topology_size += block.owned * (1 + block.nodes_per_element + (block.shape == CellShape::line2 ? 1 : 0));
    GlobalOrdinal size = 0;
    Teuchos::reduceAll(*comm, Teuchos::REDUCE_SUM, topology_size, Teuchos::outArg(size));
    description = {nodes.size(), elements.size(), size, {}};
    for (const MeshBody& body : mesh->bodies) description.bodies.push_back(body.name);
  }

  std::string path(const std::string& name) const { return directory + "/" + name; }

  /// Collective: calls `work` on rank 0 and throws on all ranks what it returns.
  template <class Work>
  void on_rank_0(const std::string& what, const std::string& path, const Work& work) const {
    std::optional<std::string> reason;
    if (comm->getRank() == 0) reason = work();
    throw_if_any_file_error(*comm, what, path, reason);
  }

  /// Makes the directory of fields. Of the files there, those of steps up to `last` stay, and the mesh if `keeps_mesh`.
  void clear(int last, bool keeps_mesh) const {
    on_rank_0("cannot make room in", path(fields_directory), [&]() -> std::optional<std::string> {
      namespace fs = std::filesystem;
      std::error_code error;
      fs::create_directory(path(fields_directory), error);
      if (error) return error.message();
      std::vector<fs::path> old;
      for (fs::directory_iterator entry(path(fields_directory), error); !error && entry != fs::directory_iterator(); entry.increment(error)) {
        const std::string name = fields_directory + "/" + entry->path().filename().string();
        const bool stays = name == mesh_file ? keeps_mesh : step_of_file(name).value_or(last + 1) <= last;
        if (is_field_file(name) && !stays) old.push_back(entry->path());
      }
      for (auto file = old.begin(); !error && file != old.end(); ++file) fs::remove(*file, error);
      return error ? std::optional(error.message()) : std::nullopt;
    });
  }

  void write_mesh() const {
    std::vector<double> coordinates;
    for (LocalOrdinal node = 0; node < mesh->owned_count(); ++node)
      coordinates.insert(coordinates.end(), mesh->coordinates[node].begin(), mesh->coordinates[node].end());
    const int columns = element_columns(*mesh);
    const auto rows = elements.arrange(element_rows(*mesh), columns);
    std::vector<long long> topology, body;
    for (auto row = rows.begin(); row != rows.end(); row += columns) {
      topology.push_back(static_cast<long long>(row[0]));
      body.push_back(static_cast<long long>(row[1]));
      if (row[0] == Line2::xdmf_number) topology.push_back(2);  // a polyline, whose number of nodes follows
      for (int a = 0; a < row[2]; ++a) topology.push_back(static_cast<long long>(row[3 + a]));
    }
    const auto mine = static_cast<GlobalOrdinal>(topology.size());
    GlobalOrdinal end = 0;
    Teuchos::scan(*comm, Teuchos::REDUCE_SUM, mine, Teuchos::outArg(end));

    Hdf5File file(comm, path(mesh_file));
    file.write("/coordinates", nodes.size(), nodes.first(), 3, nodes.arrange(coordinates, 3));
    file.write("/topology", description.topology_size, end - mine, 1, topology);
    file.write("/body", elements.size(), elements.first(), 1, body);
    file.close();
  }

  /// True if the mesh's file is there. If it is, it has to be that of this mesh.
  bool has_mesh() const {
    int is_there = 0;
    std::error_code error;
    if (comm->getRank() == 0) is_there = std::filesystem::exists(path(mesh_file), error) ? 1 : 0;
    Teuchos::broadcast(*comm, 0, Teuchos::outArg(is_there));
    if (is_there == 0) return false;
    on_rank_0("cannot continue", path(mesh_file), [&]() -> std::optional<std::string> {
      std::vector<long long> found;
      if (auto reason = read_rows(path(mesh_file), {"coordinates", "body", "topology"}, found)) return reason;
      const std::vector<long long> expected{description.nodes, description.elements, description.topology_size};
      if (found == expected) return {};
      return fmt::format(
          "it holds {} nodes and {} elements ({} entries of topology), but the mesh has {} and {} ({}); please continue with the mesh "
          "that the run began with",
          found[0], found[1], found[2], expected[0], expected[1], expected[2]);
    });
    return true;
  }

  /// The index of the steps up to `last` that have files, on rank 0. Changes no file.
  std::string read_index(int last) {
    std::string head = xdmf_head(description);
    on_rank_0("cannot continue", path(fields_directory), [&]() -> std::optional<std::string> {
      std::error_code error;
      for (std::filesystem::directory_iterator entry(path(fields_directory), error); !error && entry != std::filesystem::directory_iterator();
           entry.increment(error))
        if (const auto step = step_of_file(fields_directory + "/" + entry->path().filename().string()); step && *step <= last) steps.push_back(*step);
      if (error && error != std::errc::no_such_file_or_directory) return error.message();
      std::sort(steps.begin(), steps.end());
      for (const int step : steps) {
        StoredStep stored;
        if (const auto reason = read_step(path(step_file(step)), stored))
          return fmt::format("{} cannot be read ({}); please remove it", step_file(step), *reason);
        if (stored.step != step) return fmt::format("{} is of step {}; please remove it", step_file(step), stored.step);
        head += xdmf_step(description, stored);
      }
      return {};
    });
    int count = static_cast<int>(steps.size());
    Teuchos::broadcast(*comm, 0, Teuchos::outArg(count));
    steps.resize(static_cast<std::size_t>(count));
    if (count > 0) Teuchos::broadcast(*comm, 0, count, steps.data());
    return head;
  }

  void write_index(const std::string& head) {
    write_file(*comm, xdmf_path, [&] { return head + xdmf_tail(); });
    tail_of_xdmf = head.size();
  }

  /// The step takes the place of the tail, which follows it.
  void add_to_index(const StoredStep& step) {
    const std::string grid = xdmf_step(description, step);
    on_rank_0("cannot write", xdmf_path, [&] { return replace_end_of_file(xdmf_path, tail_of_xdmf, grid + xdmf_tail()); });
    tail_of_xdmf += grid.size();
  }

  /// Empty if the fields can be written.
  std::string wrong(int step, const std::vector<Field>& fields) const {
    const int last = steps.empty() ? -1 : steps.back();
    if (step <= last) return fmt::format("fields of step {} cannot follow those of step {}", step, last);
    std::set<std::string> names{"body"};
    std::size_t owned_elements = 0;
    for (const Block& block : mesh->blocks) owned_elements += static_cast<std::size_t>(block.owned);
    for (const Field& field : fields) {
      const std::size_t rows = field.center == Field::Center::node ? static_cast<std::size_t>(mesh->owned_count()) : owned_elements;
      if (!fits(field.kind, field.components) || field.values.size() != rows * static_cast<std::size_t>(field.components))
        return fmt::format("field \"{}\": {} values in {} components do not fit {} rows", field.name, field.values.size(), field.components, rows);
      if (field.name.empty() || field.name.find('/') != std::string::npos || !names.insert(field.name).second)
        return fmt::format("\"{}\" cannot be the name of a field here", field.name);
    }
    return {};
  }

  RCP<const Mesh> mesh;
  RCP<const Communicator> comm;
  std::string directory, xdmf_path;
  IdOrder nodes, elements;
  GlobalOrdinal topology_size = 0;  ///< entries of this rank's elements
  XdmfMesh description;
  std::uintmax_t tail_of_xdmf = 0;    ///< bytes before it, on rank 0
  std::vector<int> steps;             ///< that the index names, ascending
  std::vector<std::string> unsynced;  ///< files that may not be on the disk yet
};

FieldWriter::FieldWriter(RCP<const Mesh> mesh, const std::string& directory, std::optional<int> continue_after)
    : implementation_(std::make_unique<Implementation>(std::move(mesh), directory)) {
  // All that may be refused comes before anything is removed.
  const int last = continue_after.value_or(-1);
  const bool keeps_mesh = continue_after && implementation_->has_mesh();
  const std::string index = implementation_->read_index(last);
  implementation_->clear(last, keeps_mesh);
  if (!keeps_mesh) implementation_->write_mesh();
  implementation_->write_index(index);
  implementation_->unsynced.push_back(implementation_->path(mesh_file));
}

FieldWriter::~FieldWriter() = default;

void FieldWriter::write(int step, double time, const std::vector<Field>& fields) {
  Implementation& self = *implementation_;
  const std::string wrong = self.wrong(step, fields);
  const int mine = wrong.empty() ? 0 : 1;
  int any = mine;
  Teuchos::reduceAll(*self.comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(any));
  if (any != 0) throw std::invalid_argument(wrong.empty() ? "fields do not fit the mesh on another rank" : wrong);

  StoredStep stored{step, time, {}};
  Hdf5File file(self.comm, self.path(step_file(step)));
  file.attribute("/", "step", static_cast<long long>(step));
  file.attribute("/", "time", time);
  for (const Field& field : fields) {
    const IdOrder& order = field.center == Field::Center::node ? self.nodes : self.elements;
    const int components = stored_components(field.kind);
    const auto values = order.arrange(as_stored(field), components);
    if (field.kind == FieldKind::integer)
      file.write(field.name, order.size(), order.first(), components, whole(values));
    else
      file.write(field.name, order.size(), order.first(), components, values);
    file.attribute(field.name, "kind", attribute_text(field.kind));
    file.attribute(field.name, "center", attribute_text(field.center));
    stored.fields.push_back({field.name, field.center, field.kind});
  }
  file.close();
  self.unsynced.push_back(self.path(step_file(step)));
  self.steps.push_back(step);
  self.add_to_index(stored);
}

const std::vector<int>& FieldWriter::steps() const { return implementation_->steps; }

void FieldWriter::sync() {
  Implementation& self = *implementation_;
  self.on_rank_0("cannot write to the disk", self.path(fields_directory), [&]() -> std::optional<std::string> {
    for (const std::string& file : self.unsynced)
      if (auto reason = sync_file(file)) return reason;
    if (auto reason = sync_file(self.xdmf_path)) return reason;
    return sync_directory(self.path(fields_directory));
  });
  self.unsynced.clear();
}

}  // namespace mortise
