// From lines to parts: keywords and their data.

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "abaqus_element_types.hpp"
#include "abaqus_keyword.hpp"
#include "abaqus_model.hpp"

namespace mortise {
namespace {

/// Keywords that make nodes or elements in ways that are not read.
const std::set<std::string>& refused_keywords() {
  static const std::set<std::string> all{"NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "SYSTEM", "PARAMETER", "IMPORT", "SUBSTRUCTURE"};
  return all;
}

class AbaqusParser {
 public:
  AbaqusParser(AbaqusLines& lines, FileErrors& errors) : lines_(lines), errors_(errors) {}

  AbaqusModel parse() {
    std::string_view line;
    while (lines_.next(line)) {
      if (line.front() != '*') {
        read_data(line);
        continue;
      }
      const AbaqusKeyword keyword = read_abaqus_keyword(line, lines_);
      if (keyword.name == "INCLUDE") {
        require_parameters(keyword, {"INPUT"});
        lines_.include(required(keyword, "INPUT"), keyword.spot);
        continue;
      }
      end_data();
      if (keyword.name == "STEP") break;
      read_keyword(keyword);
    }
    end_data();
    if (part_ != nullptr) error(part_spot_, fmt::format("*PART {} has no *END PART", part_->name));
    return std::move(model_);
  }

 private:
  enum class Data { none, passed_over, nodes, elements, node_set, element_set, surface, instance };

  void error(AbaqusSpot spot, const std::string& message) { errors_.add(lines_.place(spot), message); }
  void error(const std::string& message) { error(lines_.spot(), message); }
  [[noreturn]] void stop(AbaqusSpot spot, const std::string& message) { errors_.stop(lines_.place(spot), message); }

  AbaqusScope& scope() { return part_ != nullptr ? *part_ : model_.outside; }

  std::string required(const AbaqusKeyword& keyword, const char* parameter) {
    const auto value = keyword.value(parameter);
    if (!value || value->empty()) stop(keyword.spot, fmt::format("*{} has no {}=", keyword.name, parameter));
    return *value;
  }

  /// What a parameter would change is not to be guessed.
  void require_parameters(const AbaqusKeyword& keyword, const std::vector<std::string>& known) {
    for (const auto& [name, value] : keyword.parameters)
      if (std::find(known.begin(), known.end(), name) == known.end())
        error(keyword.spot, fmt::format("*{}: the parameter {} is not read; read are {}", keyword.name, name, fmt::join(known, ", ")));
  }

  void read_keyword(const AbaqusKeyword& keyword) {
    data_ = Data::passed_over;
    const std::string& name = keyword.name;
    if (instance_open_ && name != "ENDINSTANCE")
      stop(keyword.spot, fmt::format("*{} inside of *INSTANCE is not read; give it in the part or in the assembly", name));
    if (name == "NODE")
      read_nodes(keyword);
    else if (name == "ELEMENT")
      read_elements(keyword);
    else if (name == "NSET" || name == "ELSET")
      read_set(keyword, name == "NSET");
    else if (name == "SURFACE")
      read_surface(keyword);
    else if (name == "PART")
      read_part(keyword);
    else if (name == "ENDPART")
      part_ = nullptr;
    else if (name == "ASSEMBLY" || name == "ENDASSEMBLY")
      part_ == nullptr ? void() : stop(keyword.spot, fmt::format("*{} stands inside of *PART", name));
    else if (name == "INSTANCE")
      read_instance(keyword);
    else if (name == "ENDINSTANCE")
      instance_open_ = false;
    else if (refused_keywords().count(name) > 0)
      error(keyword.spot, fmt::format("*{} is not read; write the file with all nodes and elements, as preprocessors do", name));
    else
      ++model_.passed_over[name];
  }

  // ---- nodes

  void read_nodes(const AbaqusKeyword& keyword) {
    require_parameters(keyword, {"NSET", "SYSTEM", "INPUT"});
    if (const auto system = keyword.value("SYSTEM"); system && in_capitals(*system) != "R")
      error(keyword.spot, fmt::format("*NODE: SYSTEM={} is not read; coordinates are x, y and z", *system));
    data_ = Data::nodes;
    set_ = keyword.value("NSET").value_or("");
    first_ = static_cast<std::int32_t>(scope().coordinates.size());
    set_spot_ = keyword.spot;
    if (keyword.has("INPUT")) lines_.include(required(keyword, "INPUT"), keyword.spot);
  }

  void read_node(std::string_view line) {
    std::string_view field;
    take_abaqus_field(line, field);
    const auto label = label_of(field, "node");
    if (!label) return;
    std::array<double, 3> position{};
    for (int i = 0; i < 3 && take_abaqus_field(line, field); ++i) {
      if (field.empty()) continue;  // is 0
      const auto value = real_number_of(field);
      if (!value) return error(fmt::format("node {}: coordinate {} is \"{}\", no finite number", *label, "xyz"[i], field));
      position[static_cast<std::size_t>(i)] = *value;
    }
    require_indices(scope().coordinates.size(), "nodes");
    scope().coordinates.push_back(position);
    scope().node_labels.push_back(*label);
    scope().node_spots.push_back(lines_.spot());
  }

  std::optional<std::int32_t> label_of(std::string_view field, const char* of) {
    const auto label = whole_number_of(field);
    if (label && *label > 0 && *label <= most_indices) return static_cast<std::int32_t>(*label);
    error(fmt::format("expected the label of {} {}, a number from 1 to {}, found \"{}\"", of[0] == 'e' ? "an" : "a", of, most_indices, field));
    return std::nullopt;
  }

  void require_indices(std::size_t count, const char* what) {
    if (static_cast<std::int64_t>(count) >= most_indices) stop(lines_.spot(), fmt::format("more than {} {} are not read", most_indices, what));
  }

  // ---- elements

  void read_elements(const AbaqusKeyword& keyword) {
    require_parameters(keyword, {"TYPE", "ELSET", "INPUT"});
    type_name_ = in_capitals(required(keyword, "TYPE"));
    const AbaqusElementType type = abaqus_element_type(type_name_);
    if (!type.shape) return error(keyword.spot, fmt::format("*ELEMENT: type {}", type.note));
    if (!type.note.empty() && noted_.insert(type.note).second) model_.notes.push_back(type.note);
    is_surface_ = type.is_surface;
    data_ = Data::elements;
    group_ = group_of(scope().cells, *type.shape);
    scope().cell_spots.resize(scope().cells.size());
    scope().cell_is_surface.resize(scope().cells.size());
    nodes_of_type_ = static_cast<std::size_t>(topology(*type.shape).nodes);
    set_ = keyword.value("ELSET").value_or("");
    first_ = static_cast<std::int32_t>(scope().cells[static_cast<std::size_t>(group_)].labels.size());
    set_spot_ = keyword.spot;
    if (keyword.has("INPUT")) lines_.include(required(keyword, "INPUT"), keyword.spot);
  }

  /// Nodes may go on over lines: an element ends when it has all of them.
  void read_element(std::string_view line) {
    FileCells& cells = scope().cells[static_cast<std::size_t>(group_)];
    std::string_view field;
    while (take_abaqus_field(line, field)) {
      if (!in_element_) {
        const auto label = label_of(field, "element");
        if (!label) return;
        require_indices(++elements_, "elements");
        element_ = *label;
        element_spot_ = lines_.spot();
        element_nodes_.clear();
        in_element_ = true;
        continue;
      }
      const auto node = label_of(field, "node");
      if (!node) return void(in_element_ = false);
      element_nodes_.push_back(*node);
      if (element_nodes_.size() < nodes_of_type_) continue;
      in_element_ = false;
      if (!line.empty())
        return error(
            fmt::format("element {} has more nodes than the {} of {}; what is beyond them is \"{}\"", element_, nodes_of_type_, type_name_, line));
      cells.nodes.insert(cells.nodes.end(), element_nodes_.begin(), element_nodes_.end());
      cells.labels.push_back(element_);
      scope().cell_spots[static_cast<std::size_t>(group_)].push_back(element_spot_);
      scope().cell_is_surface[static_cast<std::size_t>(group_)].push_back(is_surface_);
    }
  }

  // ---- sets and surfaces

  std::int32_t name_index(std::string_view name) {
    auto& names = scope().names;
    // Most lines name what the line before named.
    if (names.empty() || names.back() != name) names.emplace_back(name);
    return static_cast<std::int32_t>(names.size() - 1);
  }

  void read_set(const AbaqusKeyword& keyword, bool of_nodes) {
    const char* const kind = of_nodes ? "NSET" : "ELSET";
    require_parameters(keyword, {kind, "GENERATE", "INSTANCE", "INTERNAL", "UNSORTED"});
    data_ = of_nodes ? Data::node_set : Data::element_set;
    set_ = required(keyword, kind);
    is_generated_ = keyword.has("GENERATE");
    read_instance_parameter(keyword);
    AbaqusSet& set = of_nodes ? scope().node_sets[set_] : scope().element_sets[set_];
    if (keyword.has("INTERNAL")) set.is_internal = true;
  }

  void read_instance_parameter(const AbaqusKeyword& keyword) {
    of_instance_ = -1;
    if (!keyword.has("INSTANCE")) return;
    if (part_ != nullptr) stop(keyword.spot, fmt::format("*{}: INSTANCE= stands inside of *PART", keyword.name));
    of_instance_ = name_index(required(keyword, "INSTANCE"));
  }

  /// A label, the name of a set, or one of these behind the name of an instance and a point.
  AbaqusSetItem item_of(std::string_view field) {
    AbaqusSetItem item;
    item.spot = lines_.spot();
    item.instance = of_instance_;
    if (const auto point = field.find('.'); point != std::string_view::npos && has_instance(field.substr(0, point))) {
      item.instance = name_index(field.substr(0, point));
      field.remove_prefix(point + 1);
    }
    const auto label = whole_number_of(field);
    if (label && *label > 0 && *label <= most_indices) {
      item.a = static_cast<std::int32_t>(*label);
    } else {
      item.kind = AbaqusSetItem::Kind::set;
      item.a = name_index(field);
    }
    return item;
  }

  bool has_instance(std::string_view name) const { return part_ == nullptr && instance_names_.count(in_capitals(name)) > 0; }

  void read_members(std::string_view line, AbaqusSet& set, const char* of) {
    std::string_view field;
    if (is_generated_) return read_generated(line, set, of);
    while (take_abaqus_field(line, field)) {
      if (!field.empty()) set.items.push_back(item_of(field));
    }
  }

  void read_generated(std::string_view line, AbaqusSet& set, const char* of) {
    std::array<std::int32_t, 3> numbers{0, 0, 1};
    std::string_view field;
    int count = 0;
    for (; count < 3 && take_abaqus_field(line, field); ++count) {
      if (field.empty()) continue;
      const auto number = label_of(field, of);
      if (!number) return;
      numbers[static_cast<std::size_t>(count)] = *number;
    }
    const auto [first, last, step] = numbers;
    if (count < 2 || first == 0 || last < first || !line.empty())
      return error(fmt::format("set \"{}\", GENERATE: expected first, last and step with first <= last", set.name));
    AbaqusSetItem item;
    item.kind = AbaqusSetItem::Kind::labels;
    item.a = first, item.b = last, item.c = step;
    item.instance = of_instance_;
    item.spot = lines_.spot();
    set.items.push_back(item);
  }

  void read_surface(const AbaqusKeyword& keyword) {
    require_parameters(keyword, {"NAME", "TYPE", "INTERNAL"});
    const std::string type = in_capitals(keyword.value("TYPE").value_or("ELEMENT"));
    if (type != "ELEMENT" && type != "NODE") return error(keyword.spot, fmt::format("*SURFACE: TYPE={} is not read; ELEMENT and NODE are", type));
    data_ = Data::surface;
    set_ = required(keyword, "NAME");
    surface_of_nodes_ = type == "NODE";
    of_instance_ = -1;
    AbaqusSurface& surface = scope().surfaces[set_];
    if (keyword.has("INTERNAL")) surface.is_internal = true;
  }

  void read_surface_line(std::string_view line) {
    std::string_view of, face;
    take_abaqus_field(line, of);
    if (of.empty()) return error(fmt::format("surface \"{}\": expected a set or a label before the comma", set_));
    AbaqusSurfaceItem item;
    item.of = item_of(of);
    if (surface_of_nodes_) {
      item.face = AbaqusSurfaceItem::Face::nodes;  // areas and weights may follow
    } else if (take_abaqus_field(line, face) && !face.empty()) {
      const std::string name = in_capitals(face);
      const auto number = name[0] == 'S' ? whole_number_of(std::string_view(name).substr(1)) : std::nullopt;
      if (name == "SPOS" || name == "SNEG") {
        item.face = AbaqusSurfaceItem::Face::itself;
      } else if (number && *number >= 1 && *number <= 6) {
        item.face = AbaqusSurfaceItem::Face::side;
        item.number = static_cast<int>(*number);
      } else {
        return error(fmt::format("surface \"{}\": the face \"{}\" is not read; faces are S1 to S6, SPOS and SNEG", set_, face));
      }
    }
    scope().surfaces[set_].items.push_back(item);
  }

  // ---- parts and instances

  void read_part(const AbaqusKeyword& keyword) {
    const std::string name = required(keyword, "NAME");
    if (part_ != nullptr) stop(keyword.spot, fmt::format("*PART {} begins before *END PART of {}", name, part_->name));
    if (!part_places_.emplace(in_capitals(name), model_.parts.size()).second) stop(keyword.spot, fmt::format("part {} stands twice", name));
    part_ = &model_.parts.emplace_back();
    part_->name = name;
    part_spot_ = keyword.spot;
  }

  void read_instance(const AbaqusKeyword& keyword) {
    require_parameters(keyword, {"NAME", "PART"});
    AbaqusInstance instance;
    instance.name = required(keyword, "NAME");
    instance.spot = keyword.spot;
    const std::string part = required(keyword, "PART");
    const auto found = part_places_.find(in_capitals(part));
    if (part_ != nullptr) stop(keyword.spot, "*INSTANCE stands inside of *PART");
    if (found == part_places_.end()) stop(keyword.spot, fmt::format("instance {}: there is no part \"{}\" before this line", instance.name, part));
    if (!instance_names_.insert(in_capitals(instance.name)).second) stop(keyword.spot, fmt::format("instance {} stands twice", instance.name));
    instance.part = found->second;
    model_.instances.push_back(std::move(instance));
    instance_open_ = true;
    data_ = Data::instance;
  }

  /// A translation, then an axis and an angle.
  void read_position(std::string_view line) {
    AbaqusInstance& instance = model_.instances.back();
    const bool is_rotation = !instance.translation.empty();
    std::vector<double>& numbers = is_rotation ? instance.rotation : instance.translation;
    const std::size_t wanted = is_rotation ? 7 : 3;
    if (!numbers.empty()) return error(fmt::format("instance {}: expected no more than two lines, a translation and a rotation", instance.name));
    std::string_view field;
    while (take_abaqus_field(line, field)) {
      const auto value = field.empty() ? std::optional(0.0) : real_number_of(field);
      if (!value) return error(fmt::format("instance {}: \"{}\" is no finite number", instance.name, field));
      numbers.push_back(*value);
    }
    if (numbers.size() > wanted || (is_rotation && numbers.size() < wanted))
      error(fmt::format("instance {}: expected {} numbers of a {}, found {}", instance.name, wanted, is_rotation ? "rotation" : "translation",
                        numbers.size()));
    numbers.resize(wanted);
  }

  // ---- data lines

  void read_data(std::string_view line) {
    switch (data_) {
      case Data::none:
        return stop(lines_.spot(), fmt::format("expected a keyword, as *NODE, found \"{}\": this is no input file of Abaqus or CalculiX", line));
      case Data::passed_over:
        return;
      case Data::nodes:
        return read_node(line);
      case Data::elements:
        return read_element(line);
      case Data::node_set:
        return read_members(line, scope().node_sets[set_], "node");
      case Data::element_set:
        return read_members(line, scope().element_sets[set_], "element");
      case Data::surface:
        return read_surface_line(line);
      case Data::instance:
        return read_position(line);
    }
  }

  /// What was read since the last keyword is whole.
  void end_data() {
    if (in_element_)
      error(element_spot_, fmt::format("element {} has {} nodes; {} has {}", element_, element_nodes_.size(), type_name_, nodes_of_type_));
    in_element_ = false;
    const bool is_nodes = data_ == Data::nodes;
    if ((is_nodes || data_ == Data::elements) && !set_.empty()) {
      AbaqusSetItem item;
      item.kind = AbaqusSetItem::Kind::indices;
      item.a = first_;
      item.b =
          static_cast<std::int32_t>(is_nodes ? scope().coordinates.size() : scope().cells[static_cast<std::size_t>(group_)].labels.size()) - first_;
      item.c = is_nodes ? 0 : group_;
      item.spot = set_spot_;
      (is_nodes ? scope().node_sets[set_] : scope().element_sets[set_]).items.push_back(item);
    }
    data_ = Data::passed_over;
  }

  AbaqusLines& lines_;
  FileErrors& errors_;
  AbaqusModel model_;
  Data data_ = Data::none;
  std::unordered_map<std::string, std::size_t> part_places_;
  std::set<std::string> instance_names_, noted_;
  AbaqusScope* part_ = nullptr;  ///< that is open
  AbaqusSpot part_spot_;
  bool instance_open_ = false;

  std::string set_;  ///< that data lines go to
  AbaqusSpot set_spot_;
  std::int32_t first_ = 0;  ///< node or cell behind the last keyword
  bool is_generated_ = false, surface_of_nodes_ = false;
  std::int32_t of_instance_ = -1;

  std::string type_name_;
  std::size_t nodes_of_type_ = 0, elements_ = 0;
  std::int32_t group_ = 0, element_ = 0;
  bool is_surface_ = false, in_element_ = false;
  AbaqusSpot element_spot_;
  std::vector<std::int32_t> element_nodes_;
};

}  // namespace

AbaqusModel parse_abaqus(AbaqusLines& lines, FileErrors& errors) { return AbaqusParser(lines, errors).parse(); }

}  // namespace mortise
