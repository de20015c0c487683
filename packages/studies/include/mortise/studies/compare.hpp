#pragma once
// Comparison of the results of two runs.

#include <optional>
#include <string>
#include <vector>

#include "mortise/core/types.hpp"
#include "mortise/io/compare_fields.hpp"

namespace mortise {

/// A quantity of both runs.
struct QuantityDifference {
  std::string name;
  double a = 0.0, b = 0.0;          ///< at the end
  double difference = 0.0;          ///< a - b
  double largest_difference = 0.0;  ///< over the times that both histories span; the shorter one is taken at the other's times on straight lines
  double time = 0.0;                ///< of the largest difference
  double scale = 0.0;               ///< largest value of both histories
};

/// Results of two runs beside one another.
struct RunComparison {
  std::vector<QuantityDifference> quantities;  ///< in the order of the first run
  std::vector<std::string> in_one_alone;       ///< names of quantities
  std::vector<std::string> remarks;            ///< other ends, steps and versions, in words
  std::optional<FieldComparison> fields;       ///< nothing: a run has none
};

/// Reads the results below two directories. Collective.
/// @throws FileError  what is missing or damaged
RunComparison compare_runs(const Communicator& comm, const std::string& a, const std::string& b);

/// Largest difference of all quantities and fields, each over its scale; not finite where a value is not.
double largest_relative_difference(const RunComparison& comparison);

/// The comparison as a table for people.
std::string to_text(const RunComparison& comparison);

}  // namespace mortise
