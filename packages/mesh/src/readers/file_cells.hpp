#pragma once
// Common parts of the readers of mesh files: cells and sets in the making, orders of nodes, numbers in text, errors.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "mortise/core/error.hpp"
#include "mortise/mesh/mesh_file.hpp"

namespace mortise {

/// The group of the cells of a shape, which is added if there is none.
std::int32_t group_of(std::vector<FileCells>& cells, CellShape shape);

/// Adds the cells to ranges; those that go on where the last range ends make it longer.
void add_cells(std::vector<FileCellRange>& ranges, FileCellRange added);

/// Turns a line or a plane cell round. Corner 0 of a plane cell stays the first. Mid-side node corners + k lies between corners k and k + 1.
void turn_round(FileCells& cells, std::size_t cell);
/// Its nodes in this order.
std::vector<std::int32_t> turned_round(const std::int32_t* nodes, const CellTopology& cell);

/// Sorts ranges and joins those that overlap or touch.
void join_ranges(std::vector<FileCellRange>& ranges);

/// For each node of the shape its place in the order of a file that has the corners as we do, and mid-side nodes on these edges in this order.
std::vector<int> order_of_nodes(CellShape shape, const std::vector<std::array<int, 2>>& edges_in_file);

/// The side of the shape with these corners, in any order; -1 if there is none.
int side_with_corners(CellShape shape, std::vector<int> corners);

/// The whole text as a number; nothing if it is none, or none that fits.
std::optional<std::int64_t> whole_number_of(std::string_view text);

/// The whole text as a finite number; exponents may be written with D, as Fortran does.
std::optional<double> real_number_of(std::string_view text);

/// Most nodes, and most cells, that 32 bit indices can tell apart.
inline constexpr std::int64_t most_indices = 2147483647;

/// Sets of one kind in the making, found by their names.
template <class Member>
class SetsInOrder {
 public:
  /// The members of the set of this name, which is added if there is none.
  std::vector<Member>& operator[](const std::string& name) {
    const auto [entry, added] = places_.emplace(name, sets_.size());
    if (added) sets_.push_back({name, {}});
    return sets_[entry->second].members;
  }
  bool contains(const std::string& name) const { return places_.count(name) > 0; }
  std::vector<FileSet<Member>> take() { return std::move(sets_); }

 private:
  std::vector<FileSet<Member>> sets_;
  std::unordered_map<std::string, std::size_t> places_;
};

/// Errors of a file. Reading goes on after them, to tell the first few together.
class FileErrors {
 public:
  /// @throws InputError with all of them when they are many
  void add(Place place, std::string message);
  /// @throws InputError with all of them and this one
  [[noreturn]] void stop(Place place, std::string message);
  /// @throws InputError if there is any
  void finish() const;

 private:
  std::vector<Diagnostic> diagnostics_;
};

}  // namespace mortise
