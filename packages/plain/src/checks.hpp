#pragma once
// Checks of arrays that a host gives, on this rank.

#include <cstddef>
#include <optional>
#include <string>

#include "agreement.hpp"
#include "mortise/plain/plain_contact.hpp"

namespace mortise {

/// Null, or of another length than expected.
template <class T>
std::optional<Problem> wrong_length(const std::string& name, Span<T> array, std::size_t expected) {
  if (array.size() != expected)
    return Problem{MORTISE_WRONG_LENGTH,
                   "\"" + name + "\" has the length " + std::to_string(array.size()) + "; expected is " + std::to_string(expected)};
  if (array.data() == nullptr && expected > 0) return Problem{MORTISE_NULL_POINTER, "\"" + name + "\" is null"};
  return std::nullopt;
}

/// The same, of an array that may be left out.
template <class T>
std::optional<Problem> wrong_optional(const std::string& name, Span<T> array, std::size_t expected) {
  return array.empty() ? std::nullopt : wrong_length(name, array, expected);
}

/// A number that is not finite, in an array whose length is right.
std::optional<Problem> unless_finite(const std::string& name, Span<const double> array);

/// Either.
std::optional<Problem> wrong_numbers(const std::string& name, Span<const double> array, std::size_t expected);

/// Lengths, signs, repeats and ranges of a model, on this rank.
std::optional<Problem> wrong_model(const PlainModel& model);

/// Facets of a kind that there is not, or whose nodes repeat.
std::optional<Problem> wrong_facets(int dimension, int nodes_per_facet, Span<const std::int64_t> nodes);

/// A host's matrix on `rows` rows, without what only all ranks know.
std::optional<Problem> wrong_matrix(const PlainMatrix& matrix, std::size_t rows);

}  // namespace mortise
