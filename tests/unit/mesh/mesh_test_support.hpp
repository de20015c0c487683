#pragma once
// One small mesh of every built-in kind; errors as text.

#include <memory>
#include <string>
#include <vector>

#include "mortise/mesh/build_mesh.hpp"
#include "mortise/mesh/generators.hpp"

namespace mortise {

struct ExampleMesh {
  std::string name;
  std::shared_ptr<PlaneMesh> options;
  std::vector<std::string> sides;
};

inline std::vector<ExampleMesh> example_meshes() {
  auto block = std::make_shared<BlockMesh>();
  block->corners = {0.0, 0.0, 3.0, 0.2, 2.5, 2.0, -0.3, 1.5};
  block->cells_x = 5;
  block->cells_y = 4;
  block->grading_x.ratio = 3.0;
  auto wedge = std::make_shared<WedgeMesh>();
  wedge->cells_x = 3;
  wedge->cells_y = 2;
  auto ring = std::make_shared<RingSectorMesh>();
  ring->start_angle = -30.0;
  ring->end_angle = 240.0;  // more than half a turn
  ring->cells_radial = 3;
  ring->cells_around = 17;
  const auto fill = [](DiskMesh& disk) {
    disk.cells_along = 5;
    disk.cells_across = 4;
    disk.cells_beyond = 3;
    disk.grading_along.ratio = 4.0;
    disk.grading_across.ratio = 4.0;
  };
  auto quarter = std::make_shared<QuarterDiskMesh>();
  auto lower = std::make_shared<HalfDiskMesh>(), right = std::make_shared<HalfDiskMesh>();
  right->half = DiskHalf::right;
  fill(*quarter);
  fill(*lower);
  fill(*right);
  auto disk = std::make_shared<FullDiskMesh>();
  disk->cells_around = 4;
  disk->cells_across = 3;
  disk->grading_across.ratio = 2.0;
  return {{"block", block, {"bottom", "left", "right", "top"}},
          {"wedge", wedge, {"bottom", "left", "right", "top"}},
          {"ring sector", ring, {"end", "inner", "outer", "start"}},
          {"quarter disk", quarter, {"arc", "axis", "diameter"}},
          {"lower half disk", lower, {"arc", "diameter"}},
          {"right half disk", right, {"arc", "axis"}},
          {"disk", disk, {"arc"}}};
}

inline std::vector<BodyDescription> all_kinds(CellShape cell) {
  std::vector<BodyDescription> bodies;
  for (const auto& mesh : example_meshes()) bodies.push_back({mesh.name, {}, mesh.options, cell});
  return bodies;
}

/// Message of the error that `call` throws; it has to throw on every rank.
template <class Call>
std::string input_error_of(Call&& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace mortise
