#pragma once
// Point files: one material and the path of one point of it.

#include <string>
#include <vector>

#include "mortise/core/types.hpp"
#include "mortise/input/expression.hpp"
#include "mortise/material/material_options.hpp"
#include "mortise/material/point_path.hpp"

namespace mortise {

/// A point file's content. Variables and tables are read before all the rest and stand in `symbols`.
struct PointFile {
  std::string name;  ///< of the file's outermost list
  Symbols symbols;

  Choice<MaterialOptions> material;
  Choice<PointPath> path;
  std::string stress_unit;  ///< for the axes of the plot

  void describe(Parameters& parameters);
};

/// Collective, as read_scene. Throws FileError if the file cannot be read, InputError with everything that is wrong with it.
PointFile read_point(const Communicator& comm, const std::string& file, const std::vector<std::string>& settings);

}  // namespace mortise
