#include "readers/abaqus/abaqus_keyword.hpp"

#include <algorithm>
#include <cctype>

namespace mortise {
namespace {

std::string_view without_blanks_around(std::string_view text) {
  constexpr std::string_view blanks = " \t\f\v\r";
  const std::size_t first = text.find_first_not_of(blanks);
  return first == std::string_view::npos ? std::string_view() : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string_view without_quotes(std::string_view text) {
  return text.size() >= 2 && text.front() == '"' && text.back() == '"' ? text.substr(1, text.size() - 2) : text;
}

/// Abaqus takes no notice of blanks in names of keywords and parameters.
std::string as_abaqus_name(std::string_view text) {
  std::string name = in_capitals(text);
  name.erase(std::remove_if(name.begin(), name.end(), [](unsigned char c) { return std::isspace(c); }), name.end());
  return name;
}

/// Where the field that begins the text ends: at a comma outside of quotes.
std::size_t end_of_field(std::string_view text) {
  if (text.find('"') == std::string_view::npos) return std::min(text.find(','), text.size());
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') quoted = !quoted;
    if (text[i] == ',' && !quoted) return i;
  }
  return text.size();
}

}  // namespace

bool AbaqusKeyword::has(const std::string& parameter) const {
  return std::any_of(parameters.begin(), parameters.end(), [&](const auto& one) { return one.first == parameter; });
}

std::optional<std::string> AbaqusKeyword::value(const std::string& parameter) const {
  const auto found = std::find_if(parameters.begin(), parameters.end(), [&](const auto& one) { return one.first == parameter; });
  return found == parameters.end() ? std::nullopt : std::optional(found->second);
}

std::string in_capitals(std::string_view text) {
  std::string capitals(text);
  std::transform(capitals.begin(), capitals.end(), capitals.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return capitals;
}

bool take_abaqus_field(std::string_view& line, std::string_view& field) {
  if (line.empty()) return false;
  // Most fields have no quotes, and lines may be long.
  const std::size_t comma = line.find(',');
  const std::size_t end = line.substr(0, comma).find('"') == std::string_view::npos ? std::min(comma, line.size()) : end_of_field(line);
  field = without_quotes(without_blanks_around(line.substr(0, end)));
  line.remove_prefix(std::min(end + 1, line.size()));
  line = without_blanks_around(line);
  return true;
}

AbaqusKeyword read_abaqus_keyword(std::string_view line, AbaqusLines& lines) {
  AbaqusKeyword keyword;
  keyword.spot = lines.spot();
  std::string text(line.substr(1));
  std::string_view more;
  while (!text.empty() && text.back() == ',' && lines.next(more)) text += more;
  std::string_view rest = text;
  for (bool first = true; !rest.empty(); first = false) {
    const std::size_t end = end_of_field(rest);
    const std::string_view field = without_blanks_around(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
    const std::size_t equal = field.find('=');
    if (first)
      keyword.name = as_abaqus_name(field);
    else if (!field.empty())
      keyword.parameters.emplace_back(
          as_abaqus_name(field.substr(0, equal)),
          equal == std::string_view::npos ? std::string() : std::string(without_quotes(without_blanks_around(field.substr(equal + 1)))));
  }
  return keyword;
}

}  // namespace mortise
