#include "generators/describe_cells.hpp"

namespace mortise {

void describe_cells(Parameters& parameters, int& cells, GradingOptions& grading, const std::string& cells_name, const std::string& grading_name,
                    const std::string& direction, const std::string& former_cells_name, const std::string& former_grading_name) {
  parameters.add(cells_name, cells,
                 Says("number of cells " + direction + "; 0: as many as the grading's \"smallest cell\" asks for")
                     .at_least(0)
                     .at_most(most_cells)
                     .formerly(former_cells_name));
  parameters.list(grading_name, grading, Says("grading of the cells " + direction).formerly(former_grading_name));
  if (cells == 0 && !grading.smallest_cell)
    parameters.error(cells_name, "give \"" + cells_name + "\", or a \"smallest cell\" in \"" + grading_name + "\"");
  if (cells != 0 && grading.smallest_cell)
    parameters.error(cells_name, "give either \"" + cells_name + "\" or a \"smallest cell\" in \"" + grading_name + "\"");
}

}  // namespace mortise
