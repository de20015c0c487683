#pragma once
// Names of parameters and lists that scenes of earlier versions have.

#include <string>
#include <vector>

namespace mortise {

/// What `name` is called now, if that is one of `known`; "" otherwise.
std::string present_name(const std::string& name, const std::vector<std::string>& known);

}  // namespace mortise
