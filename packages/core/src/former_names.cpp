#include "former_names.hpp"

#include <algorithm>
#include <array>

namespace mortise {
namespace {

/// Former and present name; spelling tells nothing of them.
constexpr std::array<std::array<const char*, 2>, 6> renamed{{{"cells radial", "cells across"},
                                                             {"grading radial", "grading across"},
                                                             {"length", "height"},
                                                             {"center", "centre"},
                                                             {"center x", "centre x"},
                                                             {"center y", "centre y"}}};

}  // namespace

std::string present_name(const std::string& name, const std::vector<std::string>& known) {
  for (const auto& [former, present] : renamed)
    if (name == former && std::find(known.begin(), known.end(), present) != known.end()) return present;
  return "";
}

}  // namespace mortise
