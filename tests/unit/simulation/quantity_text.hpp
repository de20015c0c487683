#pragma once
// Quantities written by tests as a scene gives them.

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mortise/input/read_parameters.hpp"
#include "mortise/simulation/quantities/quantity.hpp"
#include "scene_text.hpp"

namespace mortise::test {

/// A quantity of a kind with these parameters, of which the first stands in line 3 of "scene.xml".
inline std::shared_ptr<const Quantity> quantity(const std::string& type, const std::vector<std::pair<std::string, std::string>>& parameters = {}) {
  std::string content = parameter("type", "string", type);
  for (const auto& [name, value] : parameters) content += parameter(name, "string", value);
  QuantityChoice read;
  std::vector<Diagnostic> diagnostics;
  read_parameters(read, parse_xml(list("quantity", content), "scene.xml"), Symbols{}, {}, diagnostics);
  if (!diagnostics.empty()) throw InputError(diagnostics);
  return read.quantity.options;
}

}  // namespace mortise::test
