#include "readers/file_cells.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace mortise {
namespace {

constexpr std::size_t most_errors = 10;  ///< that are reported together

std::array<int, 2> in_order(std::array<int, 2> edge) { return {std::min(edge[0], edge[1]), std::max(edge[0], edge[1])}; }

/// from_chars knows no sign +.
std::string_view without_plus(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  return text;
}

}  // namespace

std::int32_t group_of(std::vector<FileCells>& cells, CellShape shape) {
  const auto found = std::find_if(cells.begin(), cells.end(), [&](const FileCells& one) { return one.shape == shape; });
  const auto group = static_cast<std::int32_t>(found - cells.begin());
  if (found == cells.end()) cells.push_back({shape, {}, {}});
  return group;
}

void add_cells(std::vector<FileCellRange>& ranges, FileCellRange added) {
  if (added.count == 0) return;
  if (!ranges.empty() && ranges.back().group == added.group && ranges.back().first + ranges.back().count == added.first)
    ranges.back().count += added.count;
  else
    ranges.push_back(added);
}

std::vector<std::int32_t> turned_round(const std::int32_t* nodes, const CellTopology& cell) {
  std::vector<std::int32_t> result;
  if (cell.dimension == 1) {
    result.assign(nodes, nodes + cell.nodes);
    std::swap(result[0], result[1]);
    return result;
  }
  for (int a = 0; a < cell.corners; ++a) result.push_back(nodes[(cell.corners - a) % cell.corners]);
  for (int k = 0; k < cell.mid_side_nodes(); ++k) result.push_back(nodes[cell.corners + cell.corners - 1 - k]);
  return result;
}

void turn_round(FileCells& cells, std::size_t cell) {
  const CellTopology& shape = topology(cells.shape);
  const auto begin = cells.nodes.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(shape.nodes) * cell);
  const std::vector<std::int32_t> turned = turned_round(&*begin, shape);
  std::copy(turned.begin(), turned.end(), begin);
}

void join_ranges(std::vector<FileCellRange>& ranges) {
  std::sort(ranges.begin(), ranges.end(),
            [](const FileCellRange& a, const FileCellRange& b) { return a.group != b.group ? a.group < b.group : a.first < b.first; });
  std::vector<FileCellRange> joined;
  for (const FileCellRange& range : ranges) {
    if (!joined.empty() && joined.back().group == range.group && range.first <= joined.back().first + joined.back().count)
      joined.back().count = std::max(joined.back().count, range.first + range.count - joined.back().first);
    else
      joined.push_back(range);
  }
  ranges = std::move(joined);
}

std::vector<int> order_of_nodes(CellShape shape, const std::vector<std::array<int, 2>>& edges_in_file) {
  const CellTopology& cell = topology(shape);
  std::vector<int> order;
  for (int node = 0; node < cell.corners; ++node) order.push_back(node);
  for (int m = 0; m < cell.mid_side_nodes(); ++m) {
    const auto place =
        std::find_if(edges_in_file.begin(), edges_in_file.end(), [&](const auto& edge) { return in_order(edge) == in_order(cell.edges[m]); });
    if (place == edges_in_file.end()) throw std::logic_error("the order of a file misses an edge of a shape");
    order.push_back(cell.corners + static_cast<int>(place - edges_in_file.begin()));
  }
  return order;
}

int side_with_corners(CellShape shape, std::vector<int> corners) {
  std::sort(corners.begin(), corners.end());
  const auto& sides = topology(shape).sides;
  const auto found = std::find_if(sides.begin(), sides.end(), [&](const CellSide& side) {
    std::vector<int> own(side.nodes.begin(), side.nodes.begin() + side.corners);
    std::sort(own.begin(), own.end());
    return own == corners;
  });
  return found == sides.end() ? -1 : static_cast<int>(found - sides.begin());
}

std::optional<std::int64_t> whole_number_of(std::string_view text) {
  text = without_plus(text);
  std::int64_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [last, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || last != end) return std::nullopt;
  return value;
}

std::optional<double> real_number_of(std::string_view text) {
  constexpr std::size_t longest = 64;
  text = without_plus(text);
  std::array<char, longest> changed;
  if (const auto d = text.find_first_of("dD"); d != std::string_view::npos && text.size() <= longest) {
    std::copy(text.begin(), text.end(), changed.begin());
    changed[d] = 'e';
    text = {changed.data(), text.size()};
  }
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto [last, error] = std::from_chars(text.data(), end, value);
  if (last != end || !std::isfinite(value)) return std::nullopt;
  // A number too near to zero for its type is zero; one too large is none.
  if (error == std::errc::result_out_of_range) {
    const auto exponent = text.find_first_of("eE");
    if (exponent == std::string_view::npos || exponent + 1 >= text.size() || text[exponent + 1] != '-') return std::nullopt;
    return 0.0;
  }
  if (error != std::errc()) return std::nullopt;
  return value;
}

void FileErrors::add(Place place, std::string message) {
  diagnostics_.push_back({std::move(place), std::move(message)});
  if (diagnostics_.size() >= most_errors) throw InputError(diagnostics_);
}

void FileErrors::stop(Place place, std::string message) {
  diagnostics_.push_back({std::move(place), std::move(message)});
  throw InputError(diagnostics_);
}

void FileErrors::finish() const {
  if (!diagnostics_.empty()) throw InputError(diagnostics_);
}

}  // namespace mortise
