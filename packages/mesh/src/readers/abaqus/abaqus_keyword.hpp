#pragma once
// Keyword lines and data lines of Abaqus.

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "readers/abaqus/abaqus_lines.hpp"

namespace mortise {

/// *NAME, PARAMETER=VALUE, FLAG
struct AbaqusKeyword {
  std::string name;                                             ///< capital letters without blanks: ENDPART
  std::vector<std::pair<std::string, std::string>> parameters;  ///< their names as `name`; values as written, without quotes
  AbaqusSpot spot;

  bool has(const std::string& parameter) const;
  /// The value; nothing without the parameter.
  std::optional<std::string> value(const std::string& parameter) const;
};

/// The keyword of a line that begins with *, with the lines that go on with it: a comma at its end says so.
AbaqusKeyword read_abaqus_keyword(std::string_view line, AbaqusLines& lines);

/// In capital letters: names are the same whatever their letters.
std::string in_capitals(std::string_view text);

/// Takes the first field of a data line off it, without blanks around it and without quotes. Returns false at the end of the line; a comma at the
/// end of a line begins no field.
bool take_abaqus_field(std::string_view& line, std::string_view& field);

}  // namespace mortise
