#pragma once
// Triangles, wedges, pyramids and tetrahedra that a file has as quadrilaterals, hexahedra and wedges with nodes that stand twice.

#include "mortise/mesh/mesh_file.hpp"

namespace mortise {

/// Gives these cells the shape that they have, and a note of how many there are. Sides of sets follow their cells; those that are but an edge or a
/// point are left out. Cells that have none of these shapes stay as they are.
void replace_collapsed_cells(MeshFile& file);

}  // namespace mortise
