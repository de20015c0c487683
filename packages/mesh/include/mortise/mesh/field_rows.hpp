#pragma once
// Rows of one field in the vectors of a rank.

#include "mortise/core/types.hpp"

namespace mortise {

/// (local node, component) -> row. Rows of owned nodes are indices into vectors on the owned dofs and on the local dofs, those of ghosts into the
/// latter. By itself it describes an array over the local nodes, [components * node + i]. A value; what `rows` points to has to outlive it.
struct FieldRows {
  int components = 1;                  ///< of the field at a node
  LocalOrdinal owned_nodes = 0;        ///< local nodes before the first ghost
  LocalOrdinal start = 0;              ///< of components * node, for owned nodes
  LocalOrdinal ghost_start = 0;        ///< of components * node, for ghosts
  const LocalOrdinal* rows = nullptr;  ///< [local nodes] first row of a node, -1 without; null: the field lives on all nodes

  /// The field has to live at the node.
  LocalOrdinal operator()(LocalOrdinal node, int component) const { return first(node) + component; }
  bool lives(LocalOrdinal node) const { return rows == nullptr || rows[node] >= 0; }

 private:
  LocalOrdinal first(LocalOrdinal node) const {
    if (rows != nullptr) return rows[node];
    return components * node + (node < owned_nodes ? start : ghost_start);
  }
};

/// Values of a field, by its rows.
template <class Number>
struct FieldView {
  Number* values = nullptr;
  FieldRows rows{};
  Number& operator()(LocalOrdinal node, int component) const { return values[rows(node, component)]; }
};

}  // namespace mortise
