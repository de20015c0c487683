#pragma once
// Lists and words in one text.

#include <string>
#include <vector>

namespace mortise {

/// Characters that a name in expressions may have: as many as muParser takes.
constexpr std::size_t longest_name_in_expressions = 100;

/// "a, f(b, c), d" -> {"a", "f(b, c)", "d"}; an empty text has no parts.
std::vector<std::string> split(const std::string& text);

/// True if `text` contains `name` as a word of its own.
bool has_word(const std::string& text, const std::string& name);

}  // namespace mortise
