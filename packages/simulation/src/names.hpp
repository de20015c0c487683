#pragma once
// Names of a scene that do not exist.

#include <fmt/format.h>

#include <cctype>
#include <string>
#include <vector>

#include "mortise/core/parameters.hpp"
#include "mortise/core/xml.hpp"

namespace mortise {

template <class T>
std::vector<std::string> names_of(const std::vector<Named<T>>& entries) {
  std::vector<std::string> names;
  for (const auto& entry : entries) names.push_back(entry.name);
  return names;
}

/// A name that every file system takes: what may be no letter, digit or one of =,._-+ becomes an underscore.
inline std::string name_for_files(std::string text) {
  for (char& c : text)
    if (!std::isalnum(static_cast<unsigned char>(c)) && std::string("=,._-+").find(c) == std::string::npos) c = '_';
  return text;
}

/// there is no material "stel"; did you mean "steel"? There are: "rubber", "steel"
inline std::string unknown_name(const std::string& what, const std::string& name, const std::vector<std::string>& known) {
  const std::string hint = did_you_mean(name, known);
  const std::string all = known.empty() ? "there is none" : "there are: " + quoted_list(known);
  return fmt::format("there is no {} \"{}\"{}", what, name, hint.empty() ? "; " + all : hint + " T" + all.substr(1));
}

}  // namespace mortise
