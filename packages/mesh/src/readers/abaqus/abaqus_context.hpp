#pragma once
// Context for reading lines of Abaqus: their places, and errors.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "readers/abaqus/abaqus_keyword.hpp"

namespace mortise {

/// Errors at lines, and what keyword lines and data lines have to have.
class AbaqusContext {
 public:
  AbaqusContext(AbaqusLines& all_lines, FileErrors& all_errors) : lines(all_lines), errors(all_errors) {}

  AbaqusLines& lines;
  FileErrors& errors;

  /// At the last line; reading goes on.
  void error(const std::string& message) { error(lines.spot(), message); }
  void error(AbaqusSpot spot, const std::string& message) { errors.add(lines.place(spot), message); }
  /// Ends the reading.
  [[noreturn]] void stop(AbaqusSpot spot, const std::string& message) { errors.stop(lines.place(spot), message); }
  /// The value of a parameter that has to be there.
  std::string required(const AbaqusKeyword& keyword, const char* parameter);
  /// Refuses other parameters: what they would change is not to be guessed.
  void require_parameters(const AbaqusKeyword& keyword, const std::vector<std::string>& known);
  /// The field as a label of a "node" or an "element"; nothing, and an error, if it is none.
  std::optional<std::int32_t> label_of(std::string_view field, const char* of);
};

}  // namespace mortise
