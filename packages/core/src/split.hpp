#pragma once
// Lists in one text.

#include <string>
#include <vector>

namespace mortise {

/// "a, f(b, c), d" -> {"a", "f(b, c)", "d"}; an empty text has no parts.
std::vector<std::string> split(const std::string& text);

}  // namespace mortise
