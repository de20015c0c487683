#include "checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace mortise {
namespace {

// Contact keeps ids in doubles, and multipliers have ids above those of rows.
constexpr std::int64_t most_id = std::int64_t{1} << 50;
constexpr auto most_length = static_cast<std::size_t>(std::numeric_limits<int>::max());

std::optional<Problem> wrong_ids(const std::string& name, Span<const std::int64_t> ids) {
  std::vector<std::int64_t> sorted(ids.begin(), ids.end());
  std::sort(sorted.begin(), sorted.end());
  for (const std::int64_t id : sorted)
    if (id < 0 || id > most_id) return Problem{MORTISE_REFUSED, fmt::format("\"{}\" holds {}; ids are from 0 to {}", name, id, most_id)};
  const auto repeated = std::adjacent_find(sorted.begin(), sorted.end());
  if (repeated != sorted.end()) return Problem{MORTISE_REFUSED, fmt::format("\"{}\" holds {} twice", name, *repeated)};
  return std::nullopt;
}

std::optional<Problem> wrong_node_rows(const PlainModel& model) {
  std::vector<std::int64_t> owned(model.row_ids.begin(), model.row_ids.end()), used;
  std::sort(owned.begin(), owned.end());
  for (const std::int64_t row : model.node_rows) {
    if (row < -1 || (row >= 0 && !std::binary_search(owned.begin(), owned.end(), row)))
      return Problem{MORTISE_REFUSED,
                     fmt::format("\"node_rows\" holds {}, which is not among the \"row_ids\" of this rank; -1 says that there is no row", row)};
    if (row >= 0) used.push_back(row);
  }
  std::sort(used.begin(), used.end());
  const auto repeated = std::adjacent_find(used.begin(), used.end());
  if (repeated == used.end()) return std::nullopt;
  return Problem{MORTISE_REFUSED, fmt::format("\"node_rows\" holds {} twice; each component has a row of its own", *repeated)};
}

}  // namespace

std::optional<Problem> unless_finite(const std::string& name, Span<const double> array) {
  const auto wrong = std::find_if(array.begin(), array.end(), [](double value) { return !std::isfinite(value); });
  if (wrong == array.end()) return std::nullopt;
  return Problem{MORTISE_NOT_FINITE,
                 fmt::format("\"{}\" holds {} at place {}", name, std::isnan(*wrong) ? std::abs(*wrong) : *wrong, wrong - array.begin())};
}

std::optional<Problem> wrong_numbers(const std::string& name, Span<const double> array, std::size_t expected) {
  const auto wrong = wrong_length(name, array, expected);
  return wrong ? wrong : unless_finite(name, array);
}

std::optional<Problem> wrong_model(const PlainModel& model) {
  if (model.dimension != 2 && model.dimension != 3)
    return Problem{MORTISE_REFUSED, fmt::format("\"dimension\" is {}; it has to be 2 or 3", model.dimension)};
  const auto dimension = static_cast<std::size_t>(model.dimension);
  const std::size_t nodes = model.node_ids.size();
  if (nodes > most_length / dimension || model.row_ids.size() > most_length)
    return Problem{MORTISE_WRONG_LENGTH, fmt::format("a rank can have at most {} rows; a length below 0 counts as more", most_length)};
  const auto lengths =
      first_of({wrong_length("node_ids", model.node_ids, nodes), wrong_length("row_ids", model.row_ids, model.row_ids.size()),
                wrong_length("node_rows", model.node_rows, dimension * nodes), wrong_optional("marks", model.marks, dimension * nodes)});
  if (lengths) return lengths;
  for (const std::int32_t mark : model.marks)
    if (mark < 0 || mark > 2) return Problem{MORTISE_REFUSED, fmt::format("\"marks\" holds {}; a mark is 0, 1 or 2", mark)};
  return first_of({wrong_numbers("positions", model.positions, dimension * nodes), wrong_ids("node_ids", model.node_ids),
                   wrong_ids("row_ids", model.row_ids), wrong_node_rows(model)});
}

std::optional<Problem> wrong_facets(int dimension, int nodes_per_facet, Span<const std::int64_t> nodes) {
  const std::vector<int> kinds = dimension == 2 ? std::vector<int>{2, 3} : std::vector<int>{3, 4, 6, 8};
  if (std::find(kinds.begin(), kinds.end(), nodes_per_facet) == kinds.end())
    return Problem{MORTISE_REFUSED,
                   fmt::format("\"nodes_per_facet\" is {}; in {}D it is {}", nodes_per_facet, dimension, dimension == 2 ? "2 or 3" : "3, 4, 6 or 8")};
  const auto length = static_cast<std::size_t>(nodes_per_facet);
  if (nodes.size() % length != 0)
    return Problem{MORTISE_WRONG_LENGTH, fmt::format("{} nodes do not make facets of {}", nodes.size(), nodes_per_facet)};
  if (const auto wrong = wrong_length("nodes", nodes, nodes.size())) return wrong;
  for (std::size_t first = 0; first < nodes.size(); first += length)
    if (const auto wrong = wrong_ids("nodes", {nodes.data() + first, length}))
      return Problem{wrong->status, fmt::format("facet {}: {}", first / length, wrong->text)};
  return std::nullopt;
}

std::optional<Problem> wrong_matrix(const PlainMatrix& matrix, std::size_t rows) {
  if (const auto wrong = wrong_length("starts", matrix.starts, rows + 1)) return wrong;
  if (matrix.starts[0] != 0 || !std::is_sorted(matrix.starts.begin(), matrix.starts.end()))
    return Problem{MORTISE_WRONG_LENGTH, "\"starts\" has to begin with 0 and never to fall"};
  const auto entries = static_cast<std::size_t>(matrix.starts[rows]);
  if (const auto wrong = wrong_length("columns", matrix.columns, entries)) return wrong;
  for (const std::int64_t column : matrix.columns)
    if (column < 0 || column > most_id) return Problem{MORTISE_REFUSED, fmt::format("\"columns\" holds {}, which is the id of no row", column)};
  return wrong_numbers("values", matrix.values, entries);
}

}  // namespace mortise
