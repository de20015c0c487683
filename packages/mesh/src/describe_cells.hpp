#pragma once
// What generators say alike about numbers of cells.

#include <string>

#include "mortise/mesh/spacing.hpp"

namespace mortise {

/// A number of cells and a grading, of which exactly one says how many cells there are.
void describe_cells(Parameters& parameters, int& cells, GradingOptions& grading, const std::string& cells_name, const std::string& grading_name,
                    const std::string& direction);

}  // namespace mortise
