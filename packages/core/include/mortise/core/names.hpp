#pragma once
// Names that are given: lists of them, file names made of them, and names that do not exist.

#include <string>
#include <vector>

#include "mortise/core/parameters.hpp"

namespace mortise {

/// The names of the entries, in their order.
template <class T>
std::vector<std::string> names_of(const std::vector<Named<T>>& entries) {
  std::vector<std::string> names;
  for (const auto& entry : entries) names.push_back(entry.name);
  return names;
}

/// A name that every file system takes, of one file in a directory. Other characters than letters, digits and =,._-+ become underscores, and so does
/// a point that begins it. Of a long name the end is replaced by a number that is made of all of it.
std::string name_for_files(std::string text);

/// The text with "?" for each control character of ASCII and Unicode, line breaks and tabs included: a terminal would obey them.
std::string without_control_characters(const std::string& text);

/// "; did you mean "..."?" if one of `candidates` is close to `name`, else "".
std::string did_you_mean(const std::string& name, const std::vector<std::string>& candidates);

/// "a", "b", "c"
std::string quoted_list(const std::vector<std::string>& names);

/// there is no material "stel"; did you mean "steel"? There are: "rubber", "steel"
std::string unknown_name(const std::string& what, const std::string& name, const std::vector<std::string>& known);

}  // namespace mortise
