#pragma once
// A slave node as Coupling::couple_node() gets it.

#include "mortise/mortar/mortar_interface.hpp"
#include "normals/nodal_normal.hpp"

namespace mortise {

struct SettledCorner;

/// A slave node, its facets and its normal.
struct SlaveNodeData {
  LocalOrdinal node = 0;
  const NormalStencil* stencil = nullptr;  ///< its facets
  const NodalNormal* normal = nullptr;
  const SettledCorner* corner = nullptr;  ///< weights of its facets; null: all of them count wholly
};

}  // namespace mortise
