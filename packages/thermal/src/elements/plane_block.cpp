// Blocks of plane cells.

#include "elements/cell_block.hpp"

namespace mortise {

std::unique_ptr<ThermalBlock> make_plane_block(const ThermalBlockContext& context) {
  return make_cell_block(context, [](auto cell) { return std::bool_constant<decltype(cell)::dimension == 2>{}; });
}

}  // namespace mortise
