#pragma once
// Unknowns are fields on nodes: which row of the system a component of a field has at a node.

#include <string>
#include <vector>

#include "mortise/core/types.hpp"

namespace mortise {

/// The unknowns of one field: (node, component) -> global id in a system of equations. A value.
class NodalField {
 public:
  /// The id of what is no unknown: it is prescribed and was eliminated, or the field does not live at the node.
  static constexpr GlobalOrdinal none = -1;

  /// @param nodes  owned nodes, all of them, one to one
  /// @param ids    [owned nodes x components]
  /// @throws std::invalid_argument for another number of ids, or negative ones that are not `none`
  NodalField(std::string name, RCP<const Map> nodes, int components, std::vector<GlobalOrdinal> ids);

  const std::string& name() const { return name_; }       ///< as messages say it
  const RCP<const Map>& nodes() const { return nodes_; }  ///< owned
  int components() const { return components_; }          ///< at a node
  /// Of an owned node, by its local index.
  GlobalOrdinal id(LocalOrdinal node, int component) const { return ids_[static_cast<std::size_t>(components_ * node + component)]; }
  /// Ids at the nodes of another map, owned and ghosts, [nodes x components]. Collective.
  std::vector<GlobalOrdinal> ids_on(const RCP<const Map>& nodes) const;

 private:
  std::string name_;
  RCP<const Map> nodes_;
  int components_;
  std::vector<GlobalOrdinal> ids_;
};

/// A field whose ids are components * node + component, those of make_dof_map().
NodalField numbered_by_nodes(std::string name, const RCP<const Map>& nodes, int components);

/// Declaration of a field of a table.
struct FieldDeclaration {
  std::string name;              ///< as messages say it
  int components = 1;            ///< at a node
  std::vector<char> lives = {};  ///< [owned nodes] where it has unknowns, as on the nodes of some bodies only; empty: everywhere
};

/// All fields of a model in one numbering.
struct FieldTable {
  RCP<const Map> dofs;             ///< owned, field after field, the components of a node together
  std::vector<NodalField> fields;  ///< in the order of their declarations
};

/// Numbers the fields one after the other. The first one that lives everywhere has the ids of make_dof_map(). Collective.
/// @throws std::invalid_argument for a field without components, or marks for another number of nodes
FieldTable make_field_table(const RCP<const Map>& nodes, const std::vector<FieldDeclaration>& declarations);

}  // namespace mortise
