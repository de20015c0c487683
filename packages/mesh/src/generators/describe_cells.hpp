#pragma once
// Parameters for numbers of cells that generators share.

#include <string>

#include "mortise/mesh/spacing.hpp"

namespace mortise {

/// Most cells along a line. So many in each of three directions, cut into tetrahedra, can still be numbered by GlobalOrdinal in several blocks.
constexpr int most_cells = 500000;

/// A number of cells and a grading, of which exactly one says how many cells there are. Either may have had another name in earlier versions.
void describe_cells(Parameters& parameters, int& cells, GradingOptions& grading, const std::string& cells_name, const std::string& grading_name,
                    const std::string& direction, const std::string& former_cells_name = "", const std::string& former_grading_name = "");

}  // namespace mortise
