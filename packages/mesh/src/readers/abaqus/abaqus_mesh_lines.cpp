#include "readers/abaqus/abaqus_mesh_lines.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "readers/abaqus/abaqus_element_types.hpp"

namespace mortise {

void AbaqusMeshLines::require_indices(std::size_t count, const char* what) {
  if (static_cast<std::int64_t>(count) >= most_indices)
    context_.stop(context_.lines.spot(), fmt::format("more than {} {} are not read", most_indices, what));
}

void AbaqusMeshLines::begin_nodes(const AbaqusKeyword& keyword, AbaqusScope& scope) {
  scope_ = &scope;
  is_nodes_ = true;
  context_.require_parameters(keyword, {"NSET", "SYSTEM", "INPUT"});
  if (const auto system = keyword.value("SYSTEM"); system && in_capitals(*system) != "R")
    context_.error(keyword.spot, fmt::format("*NODE: SYSTEM={} is not read; coordinates are x, y and z", *system));
  set_ = keyword.value("NSET").value_or("");
  first_ = static_cast<std::int32_t>(scope_->coordinates.size());
  set_spot_ = keyword.spot;
  if (keyword.has("INPUT")) context_.lines.include(context_.required(keyword, "INPUT"), keyword.spot);
}

void AbaqusMeshLines::read_node(std::string_view line) {
  std::string_view field;
  take_abaqus_field(line, field);
  const auto label = context_.label_of(field, "node");
  if (!label) return;
  std::array<double, 3> position{};
  for (int i = 0; i < 3 && take_abaqus_field(line, field); ++i) {
    if (field.empty()) continue;  // is 0
    const auto value = real_number_of(field);
    if (!value) return context_.error(fmt::format("node {}: coordinate {} is \"{}\", no finite number", *label, "xyz"[i], field));
    position[static_cast<std::size_t>(i)] = *value;
  }
  require_indices(scope_->coordinates.size(), "nodes");
  scope_->coordinates.push_back(position);
  scope_->node_labels.push_back(*label);
  scope_->node_spots.push_back(context_.lines.spot());
}

bool AbaqusMeshLines::begin_elements(const AbaqusKeyword& keyword, AbaqusScope& scope) {
  context_.require_parameters(keyword, {"TYPE", "ELSET", "INPUT"});
  type_name_ = in_capitals(context_.required(keyword, "TYPE"));
  const AbaqusElementType type = abaqus_element_type(type_name_);
  if (!type.shape) {
    context_.error(keyword.spot, fmt::format("*ELEMENT: type {}", type.note));
    return false;
  }
  if (!type.note.empty() && std::find(notes_.begin(), notes_.end(), type.note) == notes_.end()) notes_.push_back(type.note);
  scope_ = &scope;
  is_nodes_ = false;
  is_surface_ = type.is_surface;
  group_ = group_of(scope_->cells, *type.shape);
  scope_->cell_spots.resize(scope_->cells.size());
  scope_->cell_is_surface.resize(scope_->cells.size());
  nodes_of_type_ = static_cast<std::size_t>(topology(*type.shape).nodes);
  set_ = keyword.value("ELSET").value_or("");
  first_ = static_cast<std::int32_t>(scope_->cells[group()].labels.size());
  set_spot_ = keyword.spot;
  if (keyword.has("INPUT")) context_.lines.include(context_.required(keyword, "INPUT"), keyword.spot);
  return true;
}

void AbaqusMeshLines::read_element(std::string_view line) {
  FileCells& cells = scope_->cells[group()];
  std::string_view field;
  while (take_abaqus_field(line, field)) {
    if (!in_element_) {
      const auto label = context_.label_of(field, "element");
      if (!label) return;
      require_indices(++elements_, "elements");
      element_ = *label;
      element_spot_ = context_.lines.spot();
      element_nodes_.clear();
      in_element_ = true;
      continue;
    }
    const auto node = context_.label_of(field, "node");
    if (!node) return void(in_element_ = false);
    element_nodes_.push_back(*node);
    if (element_nodes_.size() < nodes_of_type_) continue;
    in_element_ = false;
    if (!line.empty())
      return context_.error(
          fmt::format("element {} has more nodes than the {} of {}; what is beyond them is \"{}\"", element_, nodes_of_type_, type_name_, line));
    cells.nodes.insert(cells.nodes.end(), element_nodes_.begin(), element_nodes_.end());
    cells.labels.push_back(element_);
    scope_->cell_spots[group()].push_back(element_spot_);
    scope_->cell_is_surface[group()].push_back(is_surface_);
  }
}

void AbaqusMeshLines::end() {
  if (in_element_)
    context_.error(element_spot_, fmt::format("element {} has {} nodes; {} has {}", element_, element_nodes_.size(), type_name_, nodes_of_type_));
  in_element_ = false;
  if (set_.empty()) return;
  AbaqusSetItem item;
  item.kind = AbaqusSetItem::Kind::indices;
  item.a = first_;
  item.b = static_cast<std::int32_t>(is_nodes_ ? scope_->coordinates.size() : scope_->cells[group()].labels.size()) - first_;
  item.c = is_nodes_ ? 0 : group_;
  item.spot = set_spot_;
  (is_nodes_ ? scope_->node_sets[set_] : scope_->element_sets[set_]).items.push_back(item);
}

}  // namespace mortise
