#pragma once
// Columns of history.csv that every run has, before those of the scene's quantities.

#include <string>
#include <vector>

namespace mortise {

inline const std::vector<std::string>& history_columns() {
  static const std::vector<std::string> columns{"step", "time", "newton_iterations"};
  return columns;
}

}  // namespace mortise
