#include "distribution/body_set.hpp"

#include <algorithm>
#include <iterator>

#include "generators/interval.hpp"
#include "placement/reflected_cell.hpp"

namespace mortise {
namespace {

SpatialPoint in_space(const Point& point) { return {point[0], point[1], 0.0}; }
SpatialPoint in_space(const SpatialPoint& point) { return point; }

/// Of ascending ids, those in [first, end), counted from `first`.
std::vector<GlobalOrdinal> within(const std::vector<GlobalOrdinal>& ids, GlobalOrdinal first, GlobalOrdinal end) {
  std::vector<GlobalOrdinal> result(std::lower_bound(ids.begin(), ids.end(), first), std::lower_bound(ids.begin(), ids.end(), end));
  for (GlobalOrdinal& id : result) id -= first;
  return result;
}

}  // namespace

std::vector<BodyPart> parts_of(const BodyDescription& body) {
  if (body.listed) return body.listed->parts;
  return {{"", body.shape, 0}};
}

BodyComplex complex_of(const BodyDescription& body) {
  if (body.listed) return ListedComplex(body.listed);
  return body.mesh->complex(body.shape, body.place);
}

BodySet::BodySet(const std::vector<BodyDescription>& bodies) {
  for (const auto& body : bodies) {
    dimension_ = body.dimension();
    bodies_.push_back({complex_of(body), body.copy, body.copy && body.copy->reflects()});
    const int index = static_cast<int>(bodies_.size()) - 1;
    GlobalOrdinal first = first_element_.back();
    for (const BodyPart& part : parts_of(body)) {
      blocks_.push_back({index, part.name, part.shape, first});
      first += part.elements;
    }
    const BodyComplex& complex = bodies_.back().complex;
    first_node_.push_back(first_node_.back() + std::visit([](const auto& one) { return one.node_count(); }, complex));
    first_element_.push_back(first_element_.back() + std::visit([](const auto& one) { return one.element_count(); }, complex));
  }
}

int BodySet::body_of_node(GlobalOrdinal node) const { return interval(first_node_, node); }

int BodySet::body_of_element(GlobalOrdinal element) const { return interval(first_element_, element); }

const BlockRange& BodySet::block_of(GlobalOrdinal element) const {
  const auto is_before = [](GlobalOrdinal e, const BlockRange& block) { return e < block.first_element; };
  return *std::prev(std::upper_bound(blocks_.begin(), blocks_.end(), element, is_before));
}

CellNodes BodySet::element_nodes(GlobalOrdinal element) const {
  const BlockRange& block = block_of(element);
  const Body& body = bodies_[block.body];
  auto nodes = std::visit([&](const auto& complex) { return complex.element_nodes(element - first_element_[block.body]); }, body.complex);
  for (GlobalOrdinal& node : nodes) node += first_node_[block.body];
  if (!body.is_reflected) return nodes;
  CellNodes reflected;
  for (const int a : reflected_cell(block.shape).nodes) reflected.push_back(nodes[static_cast<std::size_t>(a)]);
  return reflected;
}

SpatialPoint BodySet::coordinate(GlobalOrdinal node) const {
  const int b = body_of_node(node);
  const Body& body = bodies_[b];
  const SpatialPoint x = std::visit([&](const auto& complex) { return in_space(complex.coordinate(node - first_node_[b])); }, body.complex);
  return body.copy ? (*body.copy)(x) : x;
}

std::vector<GlobalOrdinal> BodySet::elements_of_node(GlobalOrdinal node) const {
  const int body = body_of_node(node);
  auto elements = std::visit([&](const auto& complex) { return complex.elements_of_node(node - first_node_[body]); }, bodies_[body].complex);
  for (GlobalOrdinal& element : elements) element += first_element_[body];
  return elements;
}

std::vector<SurfaceSide> BodySet::surface_sides(GlobalOrdinal element) const {
  const BlockRange& block = block_of(element);
  const Body& body = bodies_[block.body];
  auto sides = std::visit([&](const auto& complex) { return complex.surface_sides(element - first_element_[block.body]); }, body.complex);
  if (body.is_reflected)
    for (SurfaceSide& side : sides)
      if (side.side != the_cell_itself) side.side = reflected_cell(block.shape).sides[static_cast<std::size_t>(side.side)];
  return sides;
}

std::vector<int> BodySet::sides_of_node(GlobalOrdinal node) const {
  const int body = body_of_node(node);
  return std::visit([&](const auto& complex) { return complex.sides_of_node(node - first_node_[body]); }, bodies_[body].complex);
}

std::vector<int> BodySet::node_sets_of_node(GlobalOrdinal node) const {
  const int body = body_of_node(node);
  const auto* listed = std::get_if<ListedComplex>(&bodies_[body].complex);
  if (listed == nullptr) return {};
  const auto row = listed->body().node_sets_of_node.row(node - first_node_[body]);
  return {row.begin(), row.end()};
}

const std::vector<std::string>& BodySet::side_names(int body) const {
  return std::visit([](const auto& complex) -> const std::vector<std::string>& { return complex.side_names(); }, bodies_[body].complex);
}

const std::vector<std::string>& BodySet::node_set_names(int body) const {
  static const std::vector<std::string> none;
  const auto* listed = std::get_if<ListedComplex>(&bodies_[body].complex);
  return listed == nullptr ? none : listed->body().node_set_names;
}

const std::vector<LeftOutSet>& BodySet::left_out_sets(int body) const {
  static const std::vector<LeftOutSet> none;
  const auto* listed = std::get_if<ListedComplex>(&bodies_[body].complex);
  return listed == nullptr ? none : listed->body().left_out;
}

/// fetch(body, index) for each body of a mesh file.
template <class Fetch>
void BodySet::for_each_listed(const Fetch& fetch) const {
  for (std::size_t body = 0; body < bodies_.size(); ++body)
    if (const auto* listed = std::get_if<ListedComplex>(&bodies_[body].complex)) fetch(listed->body(), body);
}

void BodySet::fetch_elements(const Communicator& comm, const std::vector<GlobalOrdinal>& elements) const {
  for_each_listed([&](ListedBody& body, std::size_t b) {
    const auto mine = within(elements, first_element_[b], first_element_[b + 1]);
    body.element_nodes.fetch(comm, mine);
    body.surface_sides.fetch(comm, mine);
    body.labels.fetch(comm, mine);
  });
}

void BodySet::fetch_elements_around(const Communicator& comm, const std::vector<GlobalOrdinal>& nodes) const {
  for_each_listed([&](ListedBody& body, std::size_t b) { body.elements_of_node.fetch(comm, within(nodes, first_node_[b], first_node_[b + 1])); });
}

void BodySet::fetch_nodes(const Communicator& comm, const std::vector<GlobalOrdinal>& nodes) const {
  for_each_listed([&](ListedBody& body, std::size_t b) {
    const auto mine = within(nodes, first_node_[b], first_node_[b + 1]);
    body.coordinates.fetch(comm, mine);
    body.sides_of_node.fetch(comm, mine);
    body.node_sets_of_node.fetch(comm, mine);
  });
}

}  // namespace mortise
