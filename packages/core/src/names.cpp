#include "mortise/core/names.hpp"

#include <fmt/format.h>

#include <cctype>

#include "mortise/core/xml.hpp"

namespace mortise {

std::string name_for_files(std::string text) {
  for (char& c : text)
    if (!std::isalnum(static_cast<unsigned char>(c)) && std::string("=,._-+").find(c) == std::string::npos) c = '_';
  return text;
}

std::string unknown_name(const std::string& what, const std::string& name, const std::vector<std::string>& known) {
  const std::string hint = did_you_mean(name, known);
  const std::string all = known.empty() ? "there is none" : "there are: " + quoted_list(known);
  return fmt::format("there is no {} \"{}\"{}", what, name, hint.empty() ? "; " + all : hint + " T" + all.substr(1));
}

}  // namespace mortise
