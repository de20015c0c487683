#pragma once
// Studies written and run by tests.

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "launch.hpp"

namespace study_support {

inline const std::string directory = std::string(SCRATCH) + "/study";

inline Ending study(const std::string& file, const std::string& results, std::vector<std::string> before = {}) {
  before.insert(before.end(), {MORTISE, "study", file, "-o", results});
  return launch(before, 240);
}

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// A study of the two rings, whose exact solution is known; from the list "axes" on.
inline std::string write_study(const std::string& name, const std::string& rest) {
  std::filesystem::create_directories(directory);
  const std::string path = directory + "/" + name + ".xml";
  std::ofstream(path) << "<ParameterList name=\"rings\">\n<Parameter name=\"scene\" type=\"string\" value=\"" << INPUTS
                      << "/verification/ring_in_ring.xml\"/>\n<Parameter name=\"h\" type=\"string\" value=\"1/n\"/>\n"
                      << rest << "</ParameterList>\n";
  return path;
}

inline const std::string meshes = R"(<ParameterList name="n">
  <Parameter name="setting" type="string" value="variables/n"/><Parameter name="values" type="string" value="6, 12"/></ParameterList>
)";

}  // namespace study_support
