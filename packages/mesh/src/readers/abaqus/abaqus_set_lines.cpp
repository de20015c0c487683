#include "readers/abaqus/abaqus_set_lines.hpp"

#include <fmt/format.h>

#include <map>

namespace mortise {

std::int32_t AbaqusSetLines::name_index(std::string_view name) {
  auto& names = scope_->names;
  // Most lines name what the line before named.
  if (names.empty() || names.back() != name) names.emplace_back(name);
  return static_cast<std::int32_t>(names.size() - 1);
}

void AbaqusSetLines::begin_set(const AbaqusKeyword& keyword, AbaqusScope& scope) {
  scope_ = &scope;
  kind_ = keyword.name == "NSET" ? Kind::nodes : Kind::elements;
  const bool of_nodes = kind_ == Kind::nodes;
  const char* const kind = of_nodes ? "NSET" : "ELSET";
  std::vector<std::string> known{kind, "GENERATE", "INSTANCE", "INTERNAL", "UNSORTED"};
  if (of_nodes) known.emplace_back("ELSET");
  context_.require_parameters(keyword, known);
  set_ = context_.required(keyword, kind);
  is_generated_ = keyword.has("GENERATE");
  read_instance_parameter(keyword);
  AbaqusSet& set = of_nodes ? scope_->node_sets[set_] : scope_->element_sets[set_];
  if (keyword.has("INTERNAL")) set.is_internal = true;
  if (of_nodes && keyword.has("ELSET")) {
    AbaqusSetItem item;
    item.kind = AbaqusSetItem::Kind::of_elements;
    item.a = name_index(context_.required(keyword, "ELSET"));
    item.instance = of_instance_;
    item.spot = keyword.spot;
    set.items.push_back(item);
  }
}

void AbaqusSetLines::read_instance_parameter(const AbaqusKeyword& keyword) {
  of_instance_ = -1;
  if (!keyword.has("INSTANCE")) return;
  if (!scope_->name.empty()) context_.stop(keyword.spot, fmt::format("*{}: INSTANCE= stands inside of *PART", keyword.name));
  of_instance_ = name_index(context_.required(keyword, "INSTANCE"));
}

AbaqusSetItem AbaqusSetLines::item_of(std::string_view field) {
  AbaqusSetItem item;
  item.spot = context_.lines.spot();
  item.instance = of_instance_;
  if (const auto point = field.find('.');
      point != std::string_view::npos && scope_->name.empty() && instances_.count(in_capitals(field.substr(0, point))) > 0) {
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

void AbaqusSetLines::read(std::string_view line) {
  if (kind_ == Kind::surface) return read_surface_line(line);
  AbaqusSet& set = kind_ == Kind::nodes ? scope_->node_sets[set_] : scope_->element_sets[set_];
  const char* const of = kind_ == Kind::nodes ? "node" : "element";
  std::string_view field;
  if (is_generated_) return read_generated(line, set, of);
  while (take_abaqus_field(line, field)) {
    if (!field.empty()) set.items.push_back(item_of(field));
  }
}

void AbaqusSetLines::read_generated(std::string_view line, AbaqusSet& set, const char* of) {
  std::array<std::int32_t, 3> numbers{0, 0, 1};
  std::string_view field;
  int count = 0;
  for (; count < 3 && take_abaqus_field(line, field); ++count) {
    if (field.empty()) continue;
    const auto number = context_.label_of(field, of);
    if (!number) return;
    numbers[static_cast<std::size_t>(count)] = *number;
  }
  const auto [first, last, step] = numbers;
  if (count < 2 || first == 0 || last < first || !line.empty())
    return context_.error(fmt::format("set \"{}\", GENERATE: expected first, last and step with first <= last", set.name));
  AbaqusSetItem item;
  item.kind = AbaqusSetItem::Kind::labels;
  item.a = first, item.b = last, item.c = step;
  item.instance = of_instance_;
  item.spot = context_.lines.spot();
  set.items.push_back(item);
}

bool AbaqusSetLines::begin_surface(const AbaqusKeyword& keyword, AbaqusScope& scope) {
  context_.require_parameters(keyword, {"NAME", "TYPE", "INTERNAL"});
  const std::string type = in_capitals(keyword.value("TYPE").value_or("ELEMENT"));
  static const std::map<std::string, const char*> analytic{{"SEGMENTS", "the generator \"profile\" makes such a rigid surface in 2D"},
                                                           {"CYLINDER", "the generator \"extruded\" makes such a rigid surface"},
                                                           {"REVOLUTION", "the generator \"revolved\" makes such a rigid surface"}};
  if (const auto found = analytic.find(type); found != analytic.end()) {
    scope.left_out_surfaces.push_back(
        {context_.required(keyword, "NAME"), fmt::format("it is a surface of TYPE={}, which has no mesh; {}", type, found->second)});
    return false;
  }
  if (type != "ELEMENT" && type != "NODE") {
    context_.error(keyword.spot, fmt::format("*SURFACE: TYPE={} is not read; ELEMENT and NODE are", type));
    return false;
  }
  scope_ = &scope;
  kind_ = Kind::surface;
  set_ = context_.required(keyword, "NAME");
  of_instance_ = -1;
  AbaqusSurface& surface = scope_->surfaces[set_];
  if (!surface.items.empty() && surface.is_of_nodes != (type == "NODE"))
    context_.error(keyword.spot, fmt::format("surface \"{}\" stands twice, once of elements and once of nodes", set_));
  surface.is_of_nodes = type == "NODE";
  if (keyword.has("INTERNAL")) surface.is_internal = true;
  return true;
}

void AbaqusSetLines::read_surface_line(std::string_view line) {
  AbaqusSurface& surface = scope_->surfaces[set_];
  std::string_view of, face;
  take_abaqus_field(line, of);
  if (of.empty()) return context_.error(fmt::format("surface \"{}\": expected a set or a label before the comma", set_));
  AbaqusSurfaceItem item;
  item.of = item_of(of);
  // Areas may follow nodes.
  if (!surface.is_of_nodes && take_abaqus_field(line, face) && !face.empty()) {
    const std::string name = in_capitals(face);
    const auto number = name[0] == 'S' ? whole_number_of(std::string_view(name).substr(1)) : std::nullopt;
    if (name == "SPOS" || name == "SNEG") {
      item.face = name == "SPOS" ? AbaqusSurfaceItem::Face::positive : AbaqusSurfaceItem::Face::negative;
    } else if (number && *number >= 1 && *number <= 6) {
      item.face = AbaqusSurfaceItem::Face::side;
      item.number = static_cast<int>(*number);
    } else {
      return context_.error(fmt::format("surface \"{}\": the face \"{}\" is not read; faces are S1 to S6, SPOS and SNEG", set_, face));
    }
  }
  surface.items.push_back(item);
}

}  // namespace mortise
