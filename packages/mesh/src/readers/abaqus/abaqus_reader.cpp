// Input files of Abaqus and CalculiX: parts are read, put in their places and made one mesh.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

#include "mortise/mesh/cell_nodes.hpp"
#include "readers/abaqus/abaqus_element_types.hpp"
#include "readers/abaqus/abaqus_keyword.hpp"
#include "readers/abaqus/abaqus_placement.hpp"
#include "readers/abaqus/abaqus_sets.hpp"
#include "readers/abaqus/abaqus_surfaces.hpp"
#include "readers/readers.hpp"

namespace mortise {
namespace {

/// A scope with what its labels and names mean.
struct ReadScope {
  AbaqusScope* scope;
  std::vector<std::int32_t> first;  ///< cell of each group, and the number of all cells
  std::unique_ptr<AbaqusSets> nodes, elements;
};

/// Where a scope's nodes and cells are in the mesh.
struct PlacedScope {
  const ReadScope* of = nullptr;
  std::string prefix;  ///< of the names of its sets
  std::int32_t first_node = 0, nodes = 0, first_element = 0;
  std::vector<std::int32_t> groups, first;  ///< of each of its groups of cells: the group in the mesh, and where it begins there
};

class AbaqusReader {
 public:
  explicit AbaqusReader(const std::string& path) : lines_(path, errors_) { file_.path = path; }

  MeshFile read() {
    model_ = parse_abaqus(lines_, errors_);
    errors_.finish();
    for (AbaqusScope& part : model_.parts) parts_.push_back(index(part));
    outside_ = index(model_.outside);
    errors_.finish();
    for (ReadScope& part : parts_) resolve_sets(part, {}, {});
    place_all();
    resolve_sets(outside_, of_instances(&ReadScope::nodes, &PlacedScope::first_node),
                 of_instances(&ReadScope::elements, &PlacedScope::first_element));
    add_sets();
    errors_.finish();
    tell_what_was_passed_over();
    file_.cell_sets = cell_sets_.take();
    for (auto& set : file_.cell_sets) join_ranges(set.members);
    file_.side_sets = side_sets_.take();
    file_.node_sets = node_sets_.take();
    return std::move(file_);
  }

 private:
  /// Finds labels: those that stand twice are refused, and labels in cells become indices.
  ReadScope index(AbaqusScope& scope) {
    ReadScope read{&scope, scope.first_cells(), nullptr, nullptr};
    std::vector<std::int64_t> cell_labels;
    for (const FileCells& group : scope.cells) cell_labels.insert(cell_labels.end(), group.labels.begin(), group.labels.end());
    const std::vector<std::int64_t> none;
    read.nodes = std::make_unique<AbaqusSets>("node", scope, scope.node_sets, scope.node_labels, none, std::vector<std::int32_t>{0}, lines_, errors_);
    read.elements =
        std::make_unique<AbaqusSets>("element", scope, scope.element_sets, cell_labels, scope.left_out_elements, read.first, lines_, errors_);
    if (read.nodes->table().repeated()) check_repeated_nodes(read);
    if (const auto& twice = read.elements->table().repeated())
      refuse_second("element", cell_labels[(*twice)[1]], spot_of_cell(read, (*twice)[0]), spot_of_cell(read, (*twice)[1]));
    for (std::size_t g = 0; g < scope.cells.size(); ++g) {
      FileCells& cells = scope.cells[g];
      const auto width = static_cast<std::size_t>(topology(cells.shape).nodes);
      for (std::size_t n = 0; n < cells.nodes.size(); ++n) {
        const std::int32_t label = cells.nodes[n];
        cells.nodes[n] = read.nodes->table().find(label);
        if (cells.nodes[n] < 0)
          errors_.add(lines_.place(scope.cell_spots[g][n / width]), fmt::format("element {}: there is no node {}", cells.labels[n / width], label));
      }
    }
    return read;
  }

  std::size_t group_of_cell(const ReadScope& read, std::int32_t cell) const {
    return static_cast<std::size_t>(std::upper_bound(read.first.begin(), read.first.end(), cell) - read.first.begin() - 1);
  }

  AbaqusSpot spot_of_cell(const ReadScope& read, std::int32_t cell) const {
    const std::size_t group = group_of_cell(read, cell);
    return read.scope->cell_spots[group][static_cast<std::size_t>(cell - read.first[group])];
  }

  void refuse_second(const char* kind, std::int64_t label, AbaqusSpot first, AbaqusSpot second, const char* how = "") {
    const Place place = lines_.place(first);
    errors_.add(lines_.place(second), fmt::format("{} {} stands twice{}; the first is at {}:{}", kind, label, how, place.file, place.line));
  }

  /// A node may stand twice at one place. The second has no element then.
  void check_repeated_nodes(const ReadScope& read) {
    const AbaqusScope& scope = *read.scope;
    std::int64_t repeated = 0;
    for (std::size_t n = 0; n < scope.node_labels.size(); ++n) {
      const auto first = static_cast<std::size_t>(read.nodes->table().find(scope.node_labels[n]));
      if (first == n) continue;
      ++repeated;
      if (scope.coordinates[n] != scope.coordinates[first])
        refuse_second("node", scope.node_labels[n], scope.node_spots[first], scope.node_spots[n], ", with other coordinates");
    }
    file_.notes.push_back(fmt::format("{} lines of nodes stand twice with the same coordinates", repeated));
  }

  void resolve_sets(ReadScope& read, const AbaqusSets::Instances& nodes, const AbaqusSets::Instances& elements) {
    for (std::string& note : read.elements->resolve(elements)) file_.notes.push_back(std::move(note));
    const auto nodes_of_elements = [&](const AbaqusSetItem& item, std::vector<std::int32_t>& to) {
      AbaqusSetItem of = item;
      of.kind = AbaqusSetItem::Kind::set;
      std::vector<std::int32_t> cells;
      read.elements->append(of, elements, cells);
      for (const std::int32_t cell : cells) append_nodes(read, cell, to);
    };
    for (std::string& note : read.nodes->resolve(nodes, nodes_of_elements)) file_.notes.push_back(std::move(note));
  }

  /// Nodes of a cell of a scope, which are those of the mesh where the scope is that outside of parts.
  void append_nodes(const ReadScope& read, std::int32_t cell, std::vector<std::int32_t>& to) const {
    const FileCells* cells = nullptr;
    std::size_t place = 0;
    if (&read == &outside_) {
      const FileSide of = side_of(find_cell(cell), 0);
      cells = &file_.cells[static_cast<std::size_t>(of.group)];
      place = static_cast<std::size_t>(of.cell);
    } else {
      const std::size_t group = group_of_cell(read, cell);
      cells = &read.scope->cells[group];
      place = static_cast<std::size_t>(cell - read.first[group]);
    }
    const auto width = static_cast<std::size_t>(topology(cells->shape).nodes);
    const auto begin = cells->nodes.begin() + static_cast<std::ptrdiff_t>(width * place);
    to.insert(to.end(), begin, begin + static_cast<std::ptrdiff_t>(width));
  }

  // ---- places

  void place_all() {
    place_outside();
    for (const AbaqusInstance& instance : model_.instances) place(parts_[instance.part], instance.name + ".", &instance);
    if (model_.instances.empty() && !model_.parts.empty())
      errors_.stop(Place{file_.path, 0, ""}, "there are parts, and no *INSTANCE of any: write the file with its assembly");
  }

  /// Most files have nothing else, and what they have may be large: it is not copied.
  void place_outside() {
    AbaqusScope& scope = *outside_.scope;
    PlacedScope placed{&outside_, "", 0, static_cast<std::int32_t>(scope.coordinates.size()), 0, {}, {}};
    file_.coordinates = std::move(scope.coordinates);
    file_.node_labels = std::move(scope.node_labels);
    file_.cells = std::move(scope.cells);
    for (std::size_t g = 0; g < file_.cells.size(); ++g) {
      placed.groups.push_back(static_cast<std::int32_t>(g));
      placed.first.push_back(0);
    }
    elements_ = outside_.first.back();
    placed_.push_back(std::move(placed));
  }

  void place(const ReadScope& read, const std::string& prefix, const AbaqusInstance* instance) {
    const AbaqusScope& scope = *read.scope;
    const std::int32_t cells = read.first.back();
    const std::size_t nodes = file_.coordinates.size() + scope.coordinates.size();
    const std::size_t elements = static_cast<std::size_t>(elements_) + static_cast<std::size_t>(cells);
    if (static_cast<std::int64_t>(std::max(nodes, elements)) > most_indices)
      errors_.stop(Place{file_.path, 0, ""},
                   fmt::format("all instances have {} nodes and {} elements; up to {} are read", nodes, elements, most_indices));
    PlacedScope placed{
        &read, prefix, static_cast<std::int32_t>(file_.coordinates.size()), static_cast<std::int32_t>(scope.coordinates.size()), elements_, {}, {}};
    if (instance != nullptr && !instance->translation.empty()) {
      const AbaqusPlacement move(*instance, lines_, errors_);
      for (const auto& x : scope.coordinates) file_.coordinates.push_back(move(x));
    } else {
      file_.coordinates.insert(file_.coordinates.end(), scope.coordinates.begin(), scope.coordinates.end());
    }
    file_.node_labels.insert(file_.node_labels.end(), scope.node_labels.begin(), scope.node_labels.end());
    for (const FileCells& group : scope.cells) {
      placed.groups.push_back(group_of(file_.cells, group.shape));
      FileCells& to = file_.cells[static_cast<std::size_t>(placed.groups.back())];
      placed.first.push_back(static_cast<std::int32_t>(to.labels.size()));
      for (const std::int32_t node : group.nodes) to.nodes.push_back(placed.first_node + node);
      to.labels.insert(to.labels.end(), group.labels.begin(), group.labels.end());
    }
    elements_ += cells;
    placed_.push_back(std::move(placed));
  }

  AbaqusSets::Instances of_instances(std::unique_ptr<AbaqusSets> ReadScope::*sets, std::int32_t PlacedScope::*first) const {
    AbaqusSets::Instances all;
    for (std::size_t i = 0; i < model_.instances.size(); ++i) {
      const PlacedScope& placed = placed_[i + 1];
      all.emplace(in_capitals(model_.instances[i].name), AbaqusSets::OfInstance{(placed.of->*sets).get(), placed.*first});
    }
    return all;
  }

  // ---- sets

  /// A cell of the mesh: of a scope, and its number there.
  struct PlacedCell {
    const PlacedScope* scope;
    std::int32_t cell;
  };

  /// Of the number of an element in the mesh.
  PlacedCell find_cell(std::int32_t element) const {
    const auto after =
        std::upper_bound(placed_.begin(), placed_.end(), element, [](std::int32_t e, const PlacedScope& placed) { return e < placed.first_element; });
    const PlacedScope& placed = *std::prev(after);
    return {&placed, element - placed.first_element};
  }

  FileSide side_of(const PlacedCell& of, std::int32_t side) const {
    const std::size_t group = group_of_cell(*of.scope->of, of.cell);
    return {of.scope->groups[group], of.scope->first[group] + of.cell - of.scope->of->first[group], side};
  }

  void add_sets() {
    for (const PlacedScope& placed : placed_) {
      const ReadScope& read = *placed.of;
      const auto& node_sets = read.scope->node_sets.all();
      for (std::size_t s = 0; s < node_sets.size(); ++s) {
        if (node_sets[s].is_internal) continue;
        auto& members = node_sets_[placed.prefix + node_sets[s].name];
        for (const std::int32_t node : read.nodes->members(s)) members.push_back(placed.first_node + node);
      }
      const auto& element_sets = read.scope->element_sets.all();
      for (std::size_t s = 0; s < element_sets.size(); ++s) {
        if (element_sets[s].is_internal) continue;
        if (read.elements->members(s).empty() && read.elements->left_out(s) > 0) {
          leave_out(placed.prefix + element_sets[s].name, read.elements->left_out(s));
          continue;
        }
        auto& ranges = cell_sets_[placed.prefix + element_sets[s].name];
        for (const std::int32_t element : read.elements->members(s)) {
          const FileSide cell = side_of(find_cell(placed.first_element + element), 0);
          add_cells(ranges, {cell.group, cell.cell, 1});
        }
      }
    }
    const auto nodes = of_instances(&ReadScope::nodes, &PlacedScope::first_node),
               elements = of_instances(&ReadScope::elements, &PlacedScope::first_element);
    for (const PlacedScope& placed : placed_) {
      for (const AbaqusSurface& surface : placed.of->scope->surfaces.all()) add_surface(placed, surface, nodes, elements);
      for (const LeftOutSet& surface : placed.of->scope->left_out_surfaces) {
        file_.left_out.push_back({placed.prefix + surface.name, surface.reason});
        file_.notes.push_back(fmt::format("surface \"{}\" is left out: {}", placed.prefix + surface.name, surface.reason));
      }
    }
  }

  void leave_out(const std::string& name, std::int64_t elements) {
    file_.left_out.push_back({name, fmt::format("its {} elements are of types that are not read", elements)});
    file_.notes.push_back(fmt::format("\"{}\" is left out: {}", name, file_.left_out.back().reason));
  }

  void add_surface(const PlacedScope& placed, const AbaqusSurface& surface, const AbaqusSets::Instances& nodes,
                   const AbaqusSets::Instances& elements) {
    if (surface.is_internal) return;
    if (surface.is_of_nodes) {
      // A surface may be called as a set of nodes that is another one.
      std::string name = placed.prefix + surface.name;
      if (node_sets_.contains(name)) name = "surface " + name;
      auto& members = node_sets_[name];
      std::vector<std::int32_t> found;
      for (const AbaqusSurfaceItem& item : surface.items) placed.of->nodes->append(item.of, nodes, found);
      for (const std::int32_t node : found) members.push_back(placed.first_node + node);
      return;
    }
    std::vector<FileSide> members;
    std::int64_t left_out = 0;
    for (const AbaqusSurfaceItem& item : surface.items) {
      std::vector<std::int32_t> found;
      left_out += placed.of->elements->append(item.of, elements, found).left_out;
      for (std::int32_t& element : found) element += placed.first_element;
      if (item.face == AbaqusSurfaceItem::Face::exterior)
        add_exterior(std::move(found), members);
      else
        for (const std::int32_t element : found) add_side(item, find_cell(element), surface.name, members);
    }
    if (members.empty() && left_out > 0) return leave_out(placed.prefix + surface.name, left_out);
    auto& all = side_sets_[placed.prefix + surface.name];
    all.insert(all.end(), members.begin(), members.end());
  }

  void add_exterior(std::vector<std::int32_t> elements, std::vector<FileSide>& members) const {
    std::sort(elements.begin(), elements.end());
    for (std::size_t begin = 0, end = 0; begin < elements.size(); begin = end) {
      const PlacedScope* const scope = find_cell(elements[begin]).scope;
      std::vector<std::int32_t> cells;
      for (end = begin; end < elements.size() && find_cell(elements[end]).scope == scope; ++end)
        cells.push_back(elements[end] - scope->first_element);
      std::vector<AbaqusCells> part;
      for (std::size_t g = 0; g < scope->groups.size(); ++g)
        part.push_back({&file_.cells[static_cast<std::size_t>(scope->groups[g])], scope->first[g], scope->of->first[g + 1] - scope->of->first[g],
                        &scope->of->scope->cell_is_surface[g]});
      for (const AbaqusCellSide& side : exterior_sides(part, scope->first_node, scope->nodes, cells))
        members.push_back(side_of({scope, side.cell}, side.side));
    }
  }

  void add_side(const AbaqusSurfaceItem& item, const PlacedCell& of, const std::string& surface, std::vector<FileSide>& members) {
    const ReadScope& read = *of.scope->of;
    const std::size_t group = group_of_cell(read, of.cell);
    const bool is_surface = read.scope->cell_is_surface[group][static_cast<std::size_t>(of.cell - read.first[group])];
    // CalculiX calls the faces of a shell S1 and S2, too: against its normal, and along it.
    const bool is_negative = item.face == AbaqusSurfaceItem::Face::negative || (is_surface && item.number == 1);
    const bool wants_itself = is_negative || item.face == AbaqusSurfaceItem::Face::positive || (is_surface && item.number == 2);
    FileSide side = side_of(of, the_cell_itself);
    const FileCells& cells = file_.cells[static_cast<std::size_t>(side.group)];
    // The normal of a line stands to the left of it in Abaqus, to the right here.
    if (is_negative != (topology(cells.shape).dimension == 1)) side.side = the_other_face;
    if (!wants_itself && !is_surface) side.side = abaqus_side(cells.shape, item.number);
    if (wants_itself != is_surface || (!is_surface && side.side < 0))
      return errors_.add(lines_.place(item.of.spot),
                         fmt::format("surface \"{}\": element {} has no face {}", surface, cells.labels[static_cast<std::size_t>(side.cell)],
                                     item.number == 0 ? "SPOS or SNEG" : fmt::format("S{}", item.number)));
    members.push_back(side);
  }

  void tell_what_was_passed_over() {
    for (std::string& note : model_.notes) file_.notes.push_back(std::move(note));
    std::vector<std::string> types;
    for (const auto& [type, count] : model_.left_out) types.push_back(fmt::format("{} {}", count, type));
    if (!types.empty()) file_.notes.push_back(fmt::format("elements that are left out, as they have no cells here: {}", fmt::join(types, ", ")));
    if (model_.passed_over.empty()) return;
    std::vector<std::string> words;
    for (const auto& [name, count] : model_.passed_over) words.push_back(count == 1 ? "*" + name : fmt::format("*{} ({})", name, count));
    file_.notes.push_back(fmt::format("passed over, as they say nothing of the mesh: {}", fmt::join(words, ", ")));
  }

  FileErrors errors_;
  AbaqusLines lines_;
  AbaqusModel model_;
  std::vector<ReadScope> parts_;
  ReadScope outside_{};
  std::vector<PlacedScope> placed_;  ///< the scope outside of parts, then the instances
  std::int32_t elements_ = 0;        ///< that are placed
  MeshFile file_;
  SetsInOrder<FileCellRange> cell_sets_;
  SetsInOrder<FileSide> side_sets_;
  SetsInOrder<std::int32_t> node_sets_;
};

}  // namespace

MeshFile read_abaqus(const std::string& path) { return AbaqusReader(path).read(); }

}  // namespace mortise
