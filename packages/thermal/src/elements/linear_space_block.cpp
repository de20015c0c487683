// Blocks of solid cells with nodes at corners alone.

#include "elements/cell_block.hpp"

namespace mortise {

std::unique_ptr<ThermalBlock> make_linear_space_block(const ThermalBlockContext& context) {
  return make_cell_block(context, [](auto cell) {
    return std::bool_constant < decltype(cell)::dimension == 3 && decltype(cell)::nodes == decltype(cell)::corners > {};
  });
}

}  // namespace mortise
