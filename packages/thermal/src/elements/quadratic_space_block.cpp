// Blocks of solid cells with nodes on their edges.

#include "elements/cell_block.hpp"

namespace mortise {

std::unique_ptr<ThermalBlock> make_quadratic_space_block(const ThermalBlockContext& context) {
  return make_cell_block(context, [](auto cell) {
    return std::bool_constant < decltype(cell)::dimension == 3 && decltype(cell)::nodes != decltype(cell)::corners > {};
  });
}

}  // namespace mortise
