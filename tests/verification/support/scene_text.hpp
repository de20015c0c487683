#pragma once
// Pieces of scene files.

#include <string>

namespace scene_text {

inline std::string of_type(const std::string& name, const std::string& type, const std::string& value) {
  return "<Parameter name=\"" + name + "\" type=\"" + type + "\" value=\"" + value + "\"/>\n";
}

inline std::string parameter(const std::string& name, const std::string& value) { return of_type(name, "string", value); }

inline std::string list(const std::string& name, const std::string& content) {
  return "<ParameterList name=\"" + name + "\">\n" + content + "</ParameterList>\n";
}

}  // namespace scene_text
