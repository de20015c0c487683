#include "readers/abaqus/abaqus_mesh_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

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
  int numbers = 0;
  for (; take_abaqus_field(line, field); ++numbers) {
    if (field.empty()) continue;  // is 0
    const auto value = real_number_of(field);
    if (!value) {
      const std::string which = numbers < 3 ? fmt::format("coordinate {}", "xyz"[numbers]) : fmt::format("number {} behind its label", numbers + 1);
      return context_.error(fmt::format("node {}: {} is \"{}\", no finite number", *label, which, field));
    }
    if (numbers < 3) position[static_cast<std::size_t>(numbers)] = *value;
  }
  // The components of a normal may follow.
  if (numbers > 6)
    return context_.error(fmt::format("node {} has {} numbers behind its label; expected are x, y, z and a normal, up to 6", *label, numbers));
  require_indices(scope_->coordinates.size(), "nodes");
  scope_->coordinates.push_back(position);
  scope_->node_labels.push_back(*label);
  scope_->node_spots.push_back(context_.lines.spot());
}

bool AbaqusMeshLines::begin_elements(const AbaqusKeyword& keyword, AbaqusScope& scope) {
  context_.require_parameters(keyword, {"TYPE", "ELSET", "INPUT"});
  type_name_ = in_capitals(context_.required(keyword, "TYPE"));
  const AbaqusElementType type = abaqus_element_type(type_name_);
  if (!type.shape && !type.is_left_out) {
    context_.error(keyword.spot, fmt::format("*ELEMENT: type {}", type.note));
    return false;
  }
  scope_ = &scope;
  is_nodes_ = false;
  set_ = keyword.value("ELSET").value_or("");
  set_spot_ = keyword.spot;
  left_out_ = type.is_left_out ? &model_.left_out[fmt::format("{} ({})", type.note, type_name_)] : nullptr;
  if (keyword.has("INPUT")) context_.lines.include(context_.required(keyword, "INPUT"), keyword.spot);
  if (left_out_ != nullptr) {
    first_ = static_cast<std::int32_t>(scope_->left_out_elements.size());
    return true;
  }
  auto& notes = model_.notes;
  if (!type.note.empty() && std::find(notes.begin(), notes.end(), type.note) == notes.end()) notes.push_back(type.note);
  is_surface_ = type.is_surface;
  group_ = group_of(scope_->cells, *type.shape);
  scope_->cell_spots.resize(scope_->cells.size());
  scope_->cell_is_surface.resize(scope_->cells.size());
  nodes_of_type_ = static_cast<std::size_t>(topology(*type.shape).nodes);
  first_ = static_cast<std::int32_t>(scope_->cells[group()].labels.size());
  return true;
}

/// Its nodes are not looked at. They go on in the next line if a comma ends this one.
void AbaqusMeshLines::read_left_out(std::string_view line) {
  const bool goes_on = line.back() == ',';
  std::string_view field;
  take_abaqus_field(line, field);
  if (!std::exchange(in_element_, goes_on)) {
    const auto label = context_.label_of(field, "element");
    if (!label) return;
    require_indices(++elements_, "elements");
    scope_->left_out_elements.push_back(*label);
    ++*left_out_;
  }
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
  if (in_element_ && left_out_ == nullptr)
    context_.error(element_spot_, fmt::format("element {} has {} nodes; {} has {}", element_, element_nodes_.size(), type_name_, nodes_of_type_));
  in_element_ = false;
  if (set_.empty()) return;
  AbaqusSetItem item;
  item.spot = set_spot_;
  if (!is_nodes_ && left_out_ != nullptr) {
    item.kind = AbaqusSetItem::Kind::left_out;
    item.a = static_cast<std::int32_t>(scope_->left_out_elements.size()) - first_;
    return scope_->element_sets[set_].items.push_back(item);
  }
  item.kind = AbaqusSetItem::Kind::indices;
  item.a = first_;
  item.b = static_cast<std::int32_t>(is_nodes_ ? scope_->coordinates.size() : scope_->cells[group()].labels.size()) - first_;
  item.c = is_nodes_ ? 0 : group_;
  (is_nodes_ ? scope_->node_sets[set_] : scope_->element_sets[set_]).items.push_back(item);
}

}  // namespace mortise
