#pragma once
// Memory of a run, stored and restored by one function.

#include <algorithm>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "mortise/core/error.hpp"
#include "mortise/core/types.hpp"
#include "mortise/core/whole_number.hpp"

namespace mortise {

/// Ids of the rows of a table that this rank has. Rows are stored by the rank that owns them; any number of ranks restores them.
struct RowIds {
  std::string name;                ///< of these ids, e.g. "nodes": tables of the same rows share them
  std::vector<GlobalOrdinal> ids;  ///< first those of owned rows, each on exactly one rank; then ghosts, which are restored and not stored
  std::size_t owned = 0;           ///< number of owned rows
};

/// Stores values by name, or restores them. A class with a memory has one function that hands all of it over: it serves both directions, so that
/// they cannot disagree. Collective in all members, which are called with the same names in the same order on every rank.
/// @throws FileError on all ranks, where a file cannot be written, lacks a value, holds another number of them or one that cannot stand there
class StateArchive {
 public:
  virtual ~StateArchive() = default;
  /// True if values are restored, into the arguments; else they are stored.
  virtual bool restores() const = 0;
  /// Numbers that are the same on every rank, as many as there were.
  virtual void values(const std::string& name, std::vector<double>& values) = 0;
  /// Any bytes that are the same on every rank.
  virtual void text(const std::string& name, std::string& text) = 0;
  /// A table of finite numbers.
  /// @param rows  [ids.ids x columns]; what is restored gets this size
  virtual void rows(const std::string& name, const RowIds& ids, std::size_t columns, std::vector<double>& rows) = 0;
  /// Throws FileError on all ranks if any of them has found something wrong with what it restored.
  virtual void refuse_if(const std::optional<std::string>& wrong) = 0;
};

/// Error message for a number that was stored as a whole one.
std::string not_whole(const std::string& name, double value);
/// Error message for numbers of which one is not finite; none: all are.
std::optional<std::string> not_finite(const std::string& name, const std::vector<double>& values);

/// Restored numbers of a kind. Throws as StateArchive does where one is not finite, or not whole where the kind is.
template <class Number>
std::vector<Number> restored_numbers(StateArchive& archive, const std::string& name, const std::vector<double>& values) {
  static_assert(std::is_arithmetic_v<Number>, "for numbers");
  if constexpr (std::is_integral_v<Number>) {
    const auto wrong = std::find_if(values.begin(), values.end(), [](double value) { return !whole_number<Number>(value); });
    archive.refuse_if(wrong == values.end() ? std::nullopt : std::optional(not_whole(name, *wrong)));
    std::vector<Number> numbers;
    for (const double value : values) numbers.push_back(*whole_number<Number>(value));
    return numbers;
  } else {
    archive.refuse_if(not_finite(name, values));
    return {values.begin(), values.end()};
  }
}

/// One number, the same on every rank.
template <class Number, std::enable_if_t<std::is_arithmetic_v<Number>, int> = 0>
void serialize(StateArchive& archive, const std::string& name, Number& number) {
  std::vector<double> one{static_cast<double>(number)};
  archive.values(name, one);
  if (!archive.restores()) return;
  if (one.size() != 1) throw FileError("a stored state has " + std::to_string(one.size()) + " numbers \"" + name + "\"; expected is 1");
  number = restored_numbers<Number>(archive, name, one).front();
}

/// Numbers that are the same on every rank, as many as there were.
template <class Number>
void serialize(StateArchive& archive, const std::string& name, std::vector<Number>& numbers) {
  std::vector<double> values(numbers.begin(), numbers.end());
  archive.values(name, values);
  if (archive.restores()) numbers = restored_numbers<Number>(archive, name, values);
}

/// A finite number that there may be.
void serialize(StateArchive& archive, const std::string& name, std::optional<double>& number);

/// The values of a vector, by the ids of its map.
/// @param rows  name of these ids: vectors on the same map share it
void serialize(StateArchive& archive, const std::string& name, const std::string& rows, Vector& vector);

/// One number for each row, [ids].
template <class Number>
void serialize(StateArchive& archive, const std::string& name, const RowIds& ids, std::vector<Number>& numbers) {
  std::vector<double> rows(numbers.begin(), numbers.end());
  archive.rows(name, ids, 1, rows);
  if (archive.restores()) numbers = restored_numbers<Number>(archive, name, rows);
}

/// Rows of different lengths, [ids]. Collective.
void serialize(StateArchive& archive, const Communicator& comm, const std::string& name, const RowIds& ids, std::vector<std::vector<double>>& rows);

}  // namespace mortise
