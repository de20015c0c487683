// Cells of round bodies with a lowest point.

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <cmath>

#include "generators/describe_cells.hpp"
#include "mortise/mesh/generators.hpp"

namespace mortise {

void PolarCells::describe(Parameters& parameters) {
  parameters.add("radius", radius, Says("radius of the body").unit("length").above(0.0));
  parameters.add(
      "cells along", cells_along,
      Says("number of cells on the arc between the lowest point and 45 degrees; 0: as \"grading along\" asks for").at_least(0).at_most(most_cells));
  parameters.add("cells beyond", cells_beyond,
                 Says("number of cells on the arc between 45 degrees and the diameter; 0: as fits the others").at_least(0).at_most(most_cells));
  parameters.add("cells across", cells_across,
                 Says("number of cells between the arc and the inner patch; 0: as \"grading across\" asks for").at_least(0).at_most(most_cells));
  parameters.list("grading along", grading_along, Says("grading of the arc from the lowest point (its start) to 45 degrees"));
  parameters.list("grading across", grading_across, Says("grading from the lowest point (its start) to the inner patch, half the radius above"));
  if (cells_along == 0 && !grading_along.smallest_cell)
    parameters.error("cells along", "give \"cells along\", or a \"smallest cell\" in \"grading along\"");
  if (cells_along != 0 && grading_along.smallest_cell)
    parameters.error("cells along", "give either \"cells along\" or a \"smallest cell\" in \"grading along\"");
  if (cells_across == 0 && !grading_across.smallest_cell)
    parameters.error("cells across", "give \"cells across\", or a \"smallest cell\" in \"grading across\"");
  if (cells_across != 0 && grading_across.smallest_cell)
    parameters.error("cells across", "give either \"cells across\" or a \"smallest cell\" in \"grading across\"");
}

PolarCells::Spacings PolarCells::spacings(const Place& place) const {
  Spacings result;
  const double eighth = radius * boost::math::constants::quarter_pi<double>();
  const Spacing& along = result.along = grading_along.spacing(eighth, cells_along, place);
  result.across = grading_across.spacing((1.0 - inner) * radius, cells_across, place);
  // Beyond 45 degrees: cells as long as the longer of an average cell of the inner side and the last one along the arc.
  const double last = 1.0 - along.position(along.cells() - 1);
  const int fitting = std::max(1, static_cast<int>(std::lround(1.0 / std::max(last, 1.0 / along.cells()))));
  result.beyond = Spacing(cells_beyond > 0 ? cells_beyond : fitting);
  return result;
}

}  // namespace mortise
