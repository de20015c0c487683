#include "mortise/io/field_writer.hpp"

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>
#include <algorithm>
#include <cstdint>
#include <optional>
#include <set>
#include <stdexcept>

#include "hdf5_file.hpp"
#include "id_order.hpp"
#include "mortise/io/files.hpp"
#include "xdmf.hpp"

namespace mortise {
namespace {

/// Numbers of cells in XDMF's mixed topology.
long long xdmf_cell(CellShape shape) {
  return visit_cell(shape, [](auto cell) -> long long { return decltype(cell)::xdmf_number; });
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
  for (std::size_t body = 0; body < mesh.blocks.size(); ++body) {
    const Block& block = mesh.blocks[body];
    for (LocalOrdinal element = 0; element < block.owned; ++element) {
      const std::size_t end = rows.size() + columns;
      for (const auto entry : {xdmf_cell(block.shape), static_cast<long long>(body), static_cast<long long>(block.nodes_per_element)})
        rows.push_back(static_cast<double>(entry));
      for (int a = 0; a < block.nodes_per_element; ++a)
        rows.push_back(static_cast<double>(mesh.local_nodes->getGlobalElement(block.nodes(element)[a])));
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
  Implementation(RCP<const Mesh> mesh_, const std::string& directory)
      : mesh(std::move(mesh_)),
        comm(mesh->comm),
        hdf5_path(directory + "/fields.h5"),
        xdmf_path(directory + "/fields.xdmf"),
        nodes(mesh->owned_nodes),
        elements(element_map(*mesh)) {}

  void write_mesh() {
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
    GlobalOrdinal end = 0, size = 0;
    Teuchos::scan(*comm, Teuchos::REDUCE_SUM, mine, Teuchos::outArg(end));
    Teuchos::reduceAll(*comm, Teuchos::REDUCE_SUM, mine, Teuchos::outArg(size));

    Hdf5File file(comm, hdf5_path, Hdf5File::Mode::create);
    file.make_group("/mesh");
    file.make_group("/steps");
    file.write("/mesh/coordinates", nodes.size(), nodes.first(), 3, nodes.arrange(coordinates, 3));
    file.write("/mesh/topology", size, end - mine, 1, topology);
    file.write("/mesh/body", elements.size(), elements.first(), 1, body);
    file.close();

    description = {"fields.h5", nodes.size(), elements.size(), size, {}};
    for (const Block& block : mesh->blocks) description.bodies.push_back(block.name);
    const std::string head = xdmf_head(description);
    write_file(*comm, xdmf_path, [&] { return head + xdmf_tail(); });
    tail_of_xdmf = head.size();
  }

  /// The step takes the place of the tail, which follows it.
  void write_xdmf(const XdmfStep& step) {
    const std::string grid = xdmf_step(description, step, steps);
    std::optional<std::string> reason;
    if (comm->getRank() == 0) reason = replace_end_of_file(xdmf_path, tail_of_xdmf, grid + xdmf_tail());
    throw_if_any_file_error(*comm, "cannot write", xdmf_path, reason);
    tail_of_xdmf += grid.size();
    ++steps;
  }

  /// Empty if the fields can be written.
  std::string wrong(const std::vector<Field>& fields) const {
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
  std::string hdf5_path, xdmf_path;
  IdOrder nodes, elements;
  XdmfMesh description;
  std::uintmax_t tail_of_xdmf = 0;  ///< bytes before it
  std::size_t steps = 0;            ///< written so far
};

FieldWriter::FieldWriter(RCP<const Mesh> mesh, const std::string& directory)
    : implementation_(std::make_unique<Implementation>(std::move(mesh), directory)) {
  implementation_->write_mesh();
}

FieldWriter::~FieldWriter() = default;

void FieldWriter::write(double time, const std::vector<Field>& fields) {
  Implementation& self = *implementation_;
  const std::string wrong = self.wrong(fields);
  const int mine = wrong.empty() ? 0 : 1;
  int any = mine;
  Teuchos::reduceAll(*self.comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(any));
  if (any != 0) throw std::invalid_argument(wrong.empty() ? "fields do not fit the mesh on another rank" : wrong);

  XdmfStep step{time, {}};
  Hdf5File file(self.comm, self.hdf5_path, Hdf5File::Mode::append);
  const std::string group = step_group(self.steps);
  file.make_group(group);
  for (const Field& field : fields) {
    const IdOrder& order = field.center == Field::Center::node ? self.nodes : self.elements;
    const int components = stored_components(field.kind);
    const auto values = order.arrange(as_stored(field), components);
    const std::string path = group + "/" + field.name;
    if (field.kind == FieldKind::integer)
      file.write(path, order.size(), order.first(), components, whole(values));
    else
      file.write(path, order.size(), order.first(), components, values);
    step.fields.push_back({field.name, field.center, field.kind});
  }
  file.close();
  self.write_xdmf(step);
}

}  // namespace mortise
