#include "listed/named_sets.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace mortise {
namespace {

bool before(const ElementSide& a, const ElementSide& b) { return a.element != b.element ? a.element < b.element : a.side < b.side; }
bool same(const ElementSide& a, const ElementSide& b) { return a.element == b.element && a.side == b.side; }

template <class Value, class Less, class Equal>
void make_unique(std::vector<Value>& values, const Less& less, const Equal& equal) {
  std::sort(values.begin(), values.end(), less);
  values.erase(std::unique(values.begin(), values.end(), equal), values.end());
}

void make_unique_nodes(std::vector<std::int32_t>& nodes) { make_unique(nodes, std::less<>(), std::equal_to<>()); }

/// Sides and nodes of a set, as far as they are the body's.
struct SetMembers {
  std::string name;
  std::vector<ElementSide> sides;
  std::vector<std::int32_t> nodes;
  std::int64_t faces = 0;  ///< of plane cells that are elements: they lie in the plane of the model
};

class Finder {
 public:
  /// `sides`: of the elements; null: they are facets themselves
  Finder(const MeshFile& file, const FileBodyRequest& request, const ChosenCells& chosen, const SideTable* sides)
      : file_(file), request_(request), chosen_(chosen), sides_(sides), number_(file.coordinates.size(), -1) {
    for (std::size_t node = 0; node < chosen.file_nodes.size(); ++node)
      number_[static_cast<std::size_t>(chosen.file_nodes[node])] = static_cast<std::int32_t>(node);
  }

  SetMembers of_sides(const FileSet<FileSide>& set) const {
    SetMembers found{set.name, {}, {}, 0};
    for (const FileSide& side : set.members) {
      const auto group = static_cast<std::size_t>(side.group), cell = static_cast<std::size_t>(side.cell);
      const std::int32_t element = chosen_.elements_of_cells[group][cell];
      const CellTopology& shape = topology(file_.cells[group].shape);
      if (side.side < 0) {  // a facet of the file: itself an element, or on sides of elements
        if (element >= 0 && sides_ == nullptr) found.sides.push_back({element, the_cell_itself});
        if (sides_ != nullptr && shape.dimension == request_.dimension - 1) add_sides_under(file_.cells[group], cell, found);
        if (sides_ != nullptr && element >= 0) ++found.faces;
        continue;
      }
      if (shape.dimension < request_.dimension) {  // the edge of a facet
        for (const int place : shape.sides[static_cast<std::size_t>(side.side)].nodes)
          if (const std::int32_t node = number_[static_cast<std::size_t>(
                  file_.cells[group].nodes[static_cast<std::size_t>(shape.nodes) * cell + static_cast<std::size_t>(place)])];
              node >= 0)
            found.nodes.push_back(node);
        continue;
      }
      if (element < 0) continue;
      // Turned cells: the side from corner s to s + 1 is the one from n - 1 - s to n - s.
      const bool turned = !chosen_.turned[group].empty() && chosen_.turned[group][cell];
      found.sides.push_back({element, turned ? shape.corners - 1 - side.side : side.side});
    }
    make_unique_nodes(found.nodes);
    return found;
  }

  /// Cells that are sides: they lie on sides of elements, or are facets themselves.
  SetMembers of_facets(const FileSet<FileCellRange>& set) const {
    SetMembers found{set.name, {}, {}, 0};
    if (sides_ == nullptr) {
      for (const FileCellRange& range : set.members)
        for (std::int32_t cell = range.first; cell < range.first + range.count; ++cell)
          if (const std::int32_t element = chosen_.elements_of_cells[static_cast<std::size_t>(range.group)][static_cast<std::size_t>(cell)];
              element >= 0)
            found.sides.push_back({element, the_cell_itself});
      return found;
    }
    for (const FileCellRange& range : set.members) {
      const FileCells& cells = file_.cells[static_cast<std::size_t>(range.group)];
      if (topology(cells.shape).dimension != request_.dimension - 1) continue;
      for (std::int32_t c = range.first; c < range.first + range.count; ++c) add_sides_under(cells, static_cast<std::size_t>(c), found);
    }
    return found;
  }

  /// Nodes of cells that make no sides: points, in 3D lines, and parts of the body.
  SetMembers of_cells(const FileSet<FileCellRange>& set) const {
    SetMembers found{set.name, {}, {}, 0};
    for (const int dimension : {1, 2, 3}) {
      if (dimension == request_.dimension - 1) continue;
      for_each_cell(set, dimension, [&](const CellTopology& cell, const std::int32_t* nodes) {
        for (int a = 0; a < cell.nodes; ++a)
          if (const std::int32_t node = number_[static_cast<std::size_t>(nodes[a])]; node >= 0) found.nodes.push_back(node);
      });
    }
    make_unique_nodes(found.nodes);
    if (found.nodes.size() == chosen_.file_nodes.size()) found.nodes.clear();  // the body itself
    return found;
  }

  SetMembers of_nodes(const FileSet<std::int32_t>& set) const {
    SetMembers found{set.name, {}, {}, 0};
    for (const std::int32_t node : set.members)
      if (number_[static_cast<std::size_t>(node)] >= 0) found.nodes.push_back(number_[static_cast<std::size_t>(node)]);
    make_unique_nodes(found.nodes);
    return found;
  }

  bool is_inside(const ElementSide& side) const { return sides_ != nullptr && sides_->find(sides_->key(side)).size() > 1; }

 private:
  /// The sides of elements that a cell of one dimension less lies on.
  void add_sides_under(const FileCells& cells, std::size_t cell, SetMembers& found) const {
    const CellTopology& facet = topology(cells.shape);
    const std::int32_t* nodes = cells.nodes.data() + static_cast<std::size_t>(facet.nodes) * cell;
    std::array<std::int32_t, 4> corners{};
    for (int a = 0; a < facet.corners; ++a) {
      corners[a] = number_[static_cast<std::size_t>(nodes[a])];
      if (corners[a] < 0) return;
    }
    const auto on = sides_->find(corner_key(corners.data(), facet.corners));
    found.sides.insert(found.sides.end(), on.begin(), on.end());
  }

  template <class Visit>
  void for_each_cell(const FileSet<FileCellRange>& set, int dimension, const Visit& visit) const {
    for (const FileCellRange& range : set.members) {
      const FileCells& cells = file_.cells[static_cast<std::size_t>(range.group)];
      const CellTopology& cell = topology(cells.shape);
      if (cell.dimension != dimension) continue;
      for (std::int32_t c = range.first; c < range.first + range.count; ++c)
        visit(cell, cells.nodes.data() + static_cast<std::size_t>(cell.nodes) * static_cast<std::size_t>(c));
    }
  }

  const MeshFile& file_;
  const FileBodyRequest& request_;
  const ChosenCells& chosen_;
  const SideTable* sides_;
  std::vector<std::int32_t> number_;  ///< [nodes of the file] the body's
};

std::vector<std::int32_t> nodes_of(const BodyElements& elements, const std::vector<ElementSide>& sides) {
  std::vector<std::int32_t> nodes;
  for (const ElementSide& side : sides) {
    const auto of_side = nodes_of_side(elements, side);
    nodes.insert(nodes.end(), of_side.begin(), of_side.end());
  }
  make_unique_nodes(nodes);
  return nodes;
}

/// Sets of a body, one after the other.
class SetNamer {
 public:
  SetNamer(const FileBodyRequest& request, const ChosenCells& chosen, const Finder& find) : request_(request), chosen_(chosen), find_(find) {}

  void add_sides(SetMembers found) {
    if (found.faces > 0)
      sets_.notes.push_back(
          fmt::format("set \"{}\": {} faces of shells are left out, as they lie in the plane of the model", found.name, found.faces));
    add_nodes(found);
    if (found.sides.empty()) return;
    make_unique(found.sides, before, same);
    const auto inside = std::count_if(found.sides.begin(), found.sides.end(), [&](const ElementSide& side) { return find_.is_inside(side); });
    const auto nodes = nodes_of(chosen_.elements, found.sides);
    if (inside > 0) {
      sets_.notes.push_back(
          fmt::format("\"{}/{}\" is no set of sides: {} of its {} sides lie inside the body, between two elements; its nodes are a set",
                      request_.name, found.name, inside, found.sides.size()));
      add_node_set(found.name, nodes);
      return;
    }
    sets_.side_names.push_back(free_name(found.name));
    for (const ElementSide& side : found.sides) sets_.sides.push_back({side, static_cast<std::int32_t>(sets_.side_names.size()) - 1});
    nodes_of_names_.push_back(nodes);
  }

  /// A set of the nodes of a set of sides that has the same name is there already.
  void add_nodes(const SetMembers& found) {
    if (found.nodes.empty()) return;
    const auto named = std::find(sets_.side_names.begin(), sets_.side_names.end(), found.name);
    if (named != sets_.side_names.end() && nodes_of_names_[static_cast<std::size_t>(named - sets_.side_names.begin())] == found.nodes) return;
    add_node_set(found.name, found.nodes);
  }

  /// Sides of `surface` (by element and side) that no set has get no name.
  BodySets finish(const std::vector<ElementSide>& surface) {
    const auto less = [](const NamedSide& a, const NamedSide& b) { return before(a.side, b.side); };
    std::stable_sort(sets_.sides.begin(), sets_.sides.end(), less);
    const std::size_t named = sets_.sides.size();
    for (const ElementSide& side : surface)
      if (!std::binary_search(sets_.sides.begin(), sets_.sides.begin() + static_cast<std::ptrdiff_t>(named), NamedSide{side, -1}, less))
        sets_.sides.push_back({side, -1});
    std::inplace_merge(sets_.sides.begin(), sets_.sides.begin() + static_cast<std::ptrdiff_t>(named), sets_.sides.end(), less);
    std::sort(sets_.set_of_node.begin(), sets_.set_of_node.end());
    return std::move(sets_);
  }

 private:
  void add_node_set(const std::string& name, const std::vector<std::int32_t>& nodes) {
    sets_.node_set_names.push_back(free_name(name));
    for (const std::int32_t node : nodes) sets_.set_of_node.emplace_back(node, static_cast<std::int32_t>(sets_.node_set_names.size()) - 1);
  }

  std::string free_name(const std::string& given) {
    const auto is_taken = [&](const std::string& name) {
      return name == "surface" || name == "reference" || std::count(sets_.side_names.begin(), sets_.side_names.end(), name) > 0 ||
             std::count(sets_.node_set_names.begin(), sets_.node_set_names.end(), name) > 0;
    };
    std::string name = given;
    while (is_taken(name)) name += " of file";
    if (name != given) sets_.notes.push_back(fmt::format("the set \"{}\" is called \"{}/{}\": its name is taken", given, request_.name, name));
    return name;
  }

  const FileBodyRequest& request_;
  const ChosenCells& chosen_;
  const Finder& find_;
  BodySets sets_;
  std::vector<std::vector<std::int32_t>> nodes_of_names_;  ///< [side names]
};

void add_all_nodes(SetNamer& namer, const Finder& find, const MeshFile& file) {
  for (const auto& set : file.node_sets) namer.add_nodes(find.of_nodes(set));
  for (const auto& set : file.cell_sets) namer.add_nodes(find.of_cells(set));
}

}  // namespace

BodySets name_sets(const MeshFile& file, const FileBodyRequest& request, const ChosenCells& chosen, const SideTable& sides) {
  const Finder find(file, request, chosen, &sides);
  SetNamer namer(request, chosen, find);
  for (const auto& set : file.side_sets) namer.add_sides(find.of_sides(set));
  for (const auto& set : file.cell_sets) namer.add_sides(find.of_facets(set));
  add_all_nodes(namer, find, file);
  return namer.finish(sides.surface());
}

BodySets name_facets(const MeshFile& file, const FileBodyRequest& request, const ChosenCells& chosen) {
  const Finder find(file, request, chosen, nullptr);
  SetNamer namer(request, chosen, find);
  for (const auto& set : file.side_sets) namer.add_sides(find.of_sides(set));
  for (const auto& set : file.cell_sets) namer.add_sides(find.of_facets(set));
  add_all_nodes(namer, find, file);
  std::vector<ElementSide> all;
  for (std::int32_t e = 0; e < chosen.elements.size(); ++e) all.push_back({e, the_cell_itself});
  return namer.finish(all);
}

}  // namespace mortise
