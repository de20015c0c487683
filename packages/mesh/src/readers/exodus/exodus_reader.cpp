// Exodus II, through its library: blocks of elements, side sets and node sets.

#include <exodusII.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mortise/mesh/cell_nodes.hpp"
#include "readers/exodus/exodus_element_types.hpp"
#include "readers/exodus/exodus_file.hpp"
#include "readers/file_cells.hpp"
#include "readers/readers.hpp"

namespace mortise {
namespace {

/// Nodes, or elements, that are read at once. Counts in the file are not believed beyond the part that was read.
constexpr std::int64_t slice = 65536;

struct ExodusBlock {
  std::int64_t id = 0;
  ExodusElementType type;
  std::int32_t group = 0;
  std::int64_t first_cell = 0;     ///< in the group
  std::int64_t first_element = 0;  ///< in the file, from 0
  std::int64_t count = 0;
};

class ExodusReader {
 public:
  explicit ExodusReader(const std::string& path) : in_(path), path_(path) { file_.path = path; }

  MeshFile read() {
    read_nodes();
    for (const std::int64_t id : in_.ids(EX_ELEM_BLOCK, in_.blocks(), "element blocks")) read_block(id);
    if (read_elements_ != in_.elements())
      in_.refuse(fmt::format("the file says that it has {} elements, and its blocks have {}", in_.elements(), read_elements_));
    read_element_labels();
    for (const std::int64_t id : in_.ids(EX_SIDE_SET, in_.side_sets(), "side sets")) read_side_set(id);
    for (const std::int64_t id : in_.ids(EX_NODE_SET, in_.node_sets(), "node sets")) read_node_set(id);
    errors_.finish();
    file_.cell_sets = cell_sets_.take();
    for (auto& set : file_.cell_sets) join_ranges(set.members);
    file_.side_sets = side_sets_.take();
    file_.node_sets = node_sets_.take();
    return std::move(file_);
  }

 private:
  void error(const std::string& message) { errors_.add({path_, 0, ""}, message); }

  void read_nodes() {
    std::vector<double> x(slice), y(slice), z(slice);
    for (std::int64_t first = 0; first < in_.nodes(); first += slice) {
      const std::int64_t count = std::min(slice, in_.nodes() - first);
      in_.read_coordinates(first, count, 0, x.data());
      if (in_.dimension() > 1) in_.read_coordinates(first, count, 1, y.data());
      if (in_.dimension() > 2) in_.read_coordinates(first, count, 2, z.data());
      for (std::int64_t n = 0; n < count; ++n) {
        const std::array<double, 3> position{x[n], y[n], z[n]};
        // Where nothing was ever written the library gives these.
        const auto is_number = [](double value) {
          return std::isfinite(value) && value != NC_FILL_DOUBLE && static_cast<float>(value) != NC_FILL_FLOAT;
        };
        if (!std::all_of(position.begin(), position.end(), is_number))
          in_.refuse(fmt::format("node {} (by its place in the file) is at ({}, {}, {}): a coordinate is no finite number, or was never written",
                                 first + n + 1, position[0], position[1], position[2]));
        file_.coordinates.push_back(position);
      }
    }
    file_.node_labels = labels_of(EX_NODE_MAP, in_.nodes(), "nodes");
  }

  /// Of nodes or elements. Where the file has none, the library counts from 1.
  std::vector<std::int64_t> labels_of(ex_entity_type kind, std::int64_t count, const char* what) {
    std::vector<std::int64_t> labels(static_cast<std::size_t>(count));
    if (count > 0) in_.require(ex_get_id_map(in_.id(), kind, labels.data()), fmt::format("the labels of {}", what));
    return labels;
  }

  std::string name_of(ex_entity_type kind, std::int64_t id, const char* unnamed) {
    const std::string name = in_.name(kind, id);
    return name.empty() ? fmt::format("{} {}", unnamed, id) : name;
  }

  template <class Sets>
  auto& new_set(Sets& sets, const std::string& name) {
    if (sets.contains(name)) file_.notes.push_back(fmt::format("several blocks or sets are called \"{}\": they make one set", name));
    return sets[name];
  }

  void read_block(std::int64_t id) {
    // The library takes names of up to 32 characters, and what the file says beyond them.
    std::array<char, NC_MAX_NAME + 1> type{};
    std::int64_t count = 0, nodes = 0, edges = 0, faces = 0, attributes = 0;
    in_.require(ex_get_block(in_.id(), EX_ELEM_BLOCK, id, type.data(), &count, &nodes, &edges, &faces, &attributes),
                fmt::format("element block {}", id));
    const std::string name = name_of(EX_ELEM_BLOCK, id, "block");
    if (count == 0) return void(new_set(cell_sets_, name));
    if (count < 0 || count > in_.elements() - read_elements_)
      in_.refuse(fmt::format("element block {} has {} elements; {} of the {} in the file are left", id, count, in_.elements() - read_elements_,
                             in_.elements()));
    std::string refusal;
    ExodusBlock block{id, exodus_element_type(type.data(), nodes, static_cast<int>(in_.dimension()), refusal), 0, 0, read_elements_, count};
    if (!refusal.empty()) in_.refuse(fmt::format("element block {}: {}", id, refusal));
    if (block.type.is_point) {
      auto& members = new_set(node_sets_, name);
      file_.notes.push_back(fmt::format("block \"{}\" of elements of type \"{}\" is a set of nodes", name, type.data()));
      for_each_element(block, 1, [&](const std::int64_t* nodes_of) { members.push_back(static_cast<std::int32_t>(nodes_of[0] - 1)); });
    } else {
      block.group = group_of(file_.cells, block.type.shape);
      auto& to = file_.cells[static_cast<std::size_t>(block.group)].nodes;
      block.first_cell = static_cast<std::int64_t>(to.size()) / nodes;
      for_each_element(block, nodes, [&](const std::int64_t* nodes_of) {
        for (const int place : block.type.order) to.push_back(static_cast<std::int32_t>(nodes_of[place] - 1));
      });
      add_cells(new_set(cell_sets_, name), {block.group, static_cast<std::int32_t>(block.first_cell), static_cast<std::int32_t>(count)});
    }
    blocks_.push_back(block);
    read_elements_ += count;
  }

  /// visit(nodes, from 1) for each element of a block, whose nodes are all there.
  template <class Visit>
  void for_each_element(const ExodusBlock& block, std::int64_t nodes, Visit&& visit) {
    std::vector<std::int64_t> connectivity(static_cast<std::size_t>(slice * nodes));
    for (std::int64_t first = 0; first < block.count; first += slice) {
      const std::int64_t count = std::min(slice, block.count - first);
      in_.require(ex_get_n_conn(in_.id(), EX_ELEM_BLOCK, block.id, first + 1, count, connectivity.data(), nullptr, nullptr),
                  fmt::format("the nodes of elements {} to {} of block {}", first + 1, first + count, block.id));
      for (std::int64_t e = 0; e < count; ++e) {
        const std::int64_t* const own = connectivity.data() + e * nodes;
        const std::int64_t* const wrong = std::find_if(own, own + nodes, [&](std::int64_t node) { return node < 1 || node > in_.nodes(); });
        if (wrong != own + nodes)
          in_.refuse(fmt::format("element {} of block {} has node {}, outside of 1 to {}", first + e + 1, block.id, *wrong, in_.nodes()));
        visit(own);
      }
    }
  }

  void read_element_labels() {
    const std::vector<std::int64_t> labels = labels_of(EX_ELEM_MAP, in_.elements(), "elements");
    for (const ExodusBlock& block : blocks_) {
      if (block.type.is_point) continue;
      auto& to = file_.cells[static_cast<std::size_t>(block.group)].labels;
      const auto begin = labels.begin() + static_cast<std::ptrdiff_t>(block.first_element);
      to.insert(to.end(), begin, begin + static_cast<std::ptrdiff_t>(block.count));
    }
  }

  /// Members of a set, at most as many as the rest of the file would hold.
  std::int64_t entries_of(ex_entity_type kind, std::int64_t id, const std::string& what) {
    std::int64_t entries = 0, factors = 0;
    in_.require(ex_get_set_param(in_.id(), kind, id, &entries, &factors), what);
    const std::int64_t most = kind == EX_NODE_SET ? in_.nodes() : 6 * in_.elements();
    if (entries < 0 || entries > most) in_.refuse(fmt::format("{} has {} members; the mesh has room for {}", what, entries, most));
    return entries;
  }

  void read_side_set(std::int64_t id) {
    const std::string what = fmt::format("side set {}", id);
    auto& members = new_set(side_sets_, name_of(EX_SIDE_SET, id, "side set"));
    const std::int64_t count = entries_of(EX_SIDE_SET, id, what);
    if (count == 0) return;
    std::vector<std::int64_t> elements(static_cast<std::size_t>(count)), sides(elements.size());
    in_.require(ex_get_set(in_.id(), EX_SIDE_SET, id, elements.data(), sides.data()), what);
    for (std::size_t s = 0; s < elements.size(); ++s) {
      const std::int64_t element = elements[s] - 1, side = sides[s] - 1;
      if (element < 0 || element >= in_.elements()) {
        error(fmt::format("{}, member {}: there is no element {}; the file has 1 to {}", what, s + 1, elements[s], in_.elements()));
        continue;
      }
      const auto after =
          std::upper_bound(blocks_.begin(), blocks_.end(), element, [](std::int64_t e, const ExodusBlock& b) { return e < b.first_element; });
      const ExodusBlock& block = *std::prev(after);
      const auto known = static_cast<std::int64_t>(block.type.sides.size());
      if (side < 0 || side >= known) {
        error(fmt::format("{}, member {}: element {} of block {} has no side {}; sides are 1 to {}", what, s + 1, elements[s], block.id, sides[s],
                          known));
        continue;
      }
      members.push_back({block.group, static_cast<std::int32_t>(block.first_cell + element - block.first_element),
                         block.type.sides[static_cast<std::size_t>(side)]});
    }
  }

  void read_node_set(std::int64_t id) {
    const std::string what = fmt::format("node set {}", id);
    auto& members = new_set(node_sets_, name_of(EX_NODE_SET, id, "node set"));
    const std::int64_t count = entries_of(EX_NODE_SET, id, what);
    if (count == 0) return;
    std::vector<std::int64_t> nodes(static_cast<std::size_t>(count));
    in_.require(ex_get_set(in_.id(), EX_NODE_SET, id, nodes.data(), nullptr), what);
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      if (nodes[n] < 1 || nodes[n] > in_.nodes())
        error(fmt::format("{}, member {}: there is no node {}; the file has 1 to {}", what, n + 1, nodes[n], in_.nodes()));
      else
        members.push_back(static_cast<std::int32_t>(nodes[n] - 1));
    }
  }

  ExodusFile in_;
  std::string path_;
  MeshFile file_;
  FileErrors errors_;
  std::vector<ExodusBlock> blocks_;
  std::int64_t read_elements_ = 0;
  SetsInOrder<FileCellRange> cell_sets_;
  SetsInOrder<FileSide> side_sets_;
  SetsInOrder<std::int32_t> node_sets_;
};

}  // namespace

MeshFile read_exodus(const std::string& path) { return ExodusReader(path).read(); }

}  // namespace mortise
