#include "mortise/io/compare_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fields/stored_run.hpp"
#include "hdf5/hdf5_rows.hpp"

namespace mortise {
namespace {

constexpr double same_place = 1e-9;  ///< over the size of the mesh
constexpr double same_time = 1e-9;   ///< over the time

/// visit(first row, values of a, values of b) of one column, chunk by chunk.
template <class Visit>
void for_each_chunk(const Hdf5Rows& a, const Hdf5Rows& b, int column, const Visit& visit) {
  for (long long first = 0; first < a.rows(); first += chunk_rows) {
    const long long count = std::min(chunk_rows, a.rows() - first);
    visit(first, a.numbers(first, count, column), b.numbers(first, count, column));
  }
}

std::string difference_of_meshes(const StoredRun& a, const StoredRun& b) {
  if (a.nodes() != b.nodes() || a.elements() != b.elements())
    return fmt::format("the meshes differ: {} nodes and {} elements, {} and {}", a.nodes(), a.elements(), b.nodes(), b.elements());
  const Hdf5Rows cells_of_a(a.path(mesh_file), "topology"), cells_of_b(b.path(mesh_file), "topology");
  bool same = cells_of_a.rows() == cells_of_b.rows();
  for (long long first = 0; same && first < cells_of_a.rows(); first += chunk_rows) {
    const long long count = std::min(chunk_rows, cells_of_a.rows() - first);
    same = cells_of_a.whole_numbers(first, count) == cells_of_b.whole_numbers(first, count);
  }
  if (!same) return "the meshes differ: their elements have other nodes";
  const Hdf5Rows x_of_a(a.path(mesh_file), "coordinates"), x_of_b(b.path(mesh_file), "coordinates");
  double size = 0.0, moved = 0.0;
  for (int i = 0; i < x_of_a.columns(); ++i) {
    double low = 0.0, high = 0.0;
    for_each_chunk(x_of_a, x_of_b, i, [&](long long first, const std::vector<double>& of_a, const std::vector<double>& of_b) {
      for (std::size_t n = 0; n < of_a.size(); ++n) {
        if (first == 0 && n == 0) low = high = of_a[n];
        low = std::min(low, of_a[n]);
        high = std::max(high, of_a[n]);
        moved = std::max(moved, std::abs(of_a[n] - of_b[n]));
      }
    });
    size = std::max(size, high - low);
  }
  return moved > same_place * size ? fmt::format("the meshes differ: nodes are up to {:.3g} apart", moved) : "";
}

/// The first node of an element.
long long first_node(const StoredRun& run, long long element) {
  long long found = 0;
  run.visit_elements([&](std::size_t block, const std::vector<long long>& nodes, long long first) {
    const auto width = static_cast<std::size_t>(topology(run.blocks()[block].shape).nodes);
    const long long count = static_cast<long long>(nodes.size() / width);
    if (element >= first && element < first + count) found = nodes[static_cast<std::size_t>(element - first) * width];
  });
  return found;
}

void compare(const std::string& file_of_a, const std::string& file_of_b, double time, FieldDifference& field) {
  const Hdf5Rows of_a(file_of_a, field.name), of_b(file_of_b, field.name);
  for (int column = 0; column < std::min(of_a.columns(), of_b.columns()); ++column)
    for_each_chunk(of_a, of_b, column, [&](long long first, const std::vector<double>& a, const std::vector<double>& b) {
      for (std::size_t n = 0; n < a.size(); ++n) {
        field.scale = std::max({field.scale, std::abs(a[n]), std::abs(b[n])});
        if (std::isnan(a[n]) && std::isnan(b[n])) continue;  // a body without this field
        const double difference = a[n] == b[n] ? 0.0 : std::abs(a[n] - b[n]);
        if (difference <= field.difference || std::isnan(field.difference)) continue;
        field.difference = difference;
        field.time = time;
        field.id = first + static_cast<long long>(n);
      }
    });
}

}  // namespace

FieldComparison compare_fields(const std::string& run_a, const std::string& run_b) {
  const StoredRun a(run_a), b(run_b);
  FieldComparison result;
  result.not_compared = difference_of_meshes(a, b);
  if (!result.not_compared.empty()) return result;
  const auto in = [](const StoredStep& step, const std::string& name) {
    return std::find_if(step.fields.begin(), step.fields.end(), [&](const StoredField& field) { return field.name == name; }) != step.fields.end();
  };
  const auto leave_out = [&](const std::string& name) {
    if (std::find(result.in_one_alone.begin(), result.in_one_alone.end(), name) == result.in_one_alone.end()) result.in_one_alone.push_back(name);
  };
  for (const StoredStep& step : a.steps()) {
    const auto same = std::find_if(b.steps().begin(), b.steps().end(), [&](const StoredStep& other) {
      return std::abs(other.time - step.time) <= same_time * std::max(std::abs(other.time), std::abs(step.time));
    });
    if (same == b.steps().end()) continue;
    ++result.times;
    for (const StoredField& field : step.fields) {
      if (!in(*same, field.name)) {
        leave_out(field.name);
        continue;
      }
      auto found = std::find_if(result.fields.begin(), result.fields.end(), [&](const FieldDifference& one) { return one.name == field.name; });
      if (found == result.fields.end()) {
        result.fields.push_back({field.name, 0.0, 0.0, step.time, field.center == Field::Center::node, 0, {}});
        found = std::prev(result.fields.end());
      }
      compare(a.path(step_file(step.step)), b.path(step_file(same->step)), step.time, *found);
    }
    for (const StoredField& field : same->fields)
      if (!in(step, field.name)) leave_out(field.name);
  }
  if (result.times == 0) result.not_compared = "the runs have no fields at the same time";
  const Hdf5Rows coordinates(a.path(mesh_file), "coordinates");
  for (FieldDifference& field : result.fields) {
    const long long node = field.of_nodes ? field.id : first_node(a, field.id);
    for (int i = 0; i < std::min(coordinates.columns(), 3); ++i) field.place[static_cast<std::size_t>(i)] = coordinates.numbers(node, 1, i)[0];
  }
  return result;
}

}  // namespace mortise
