#pragma once
// The unknowns of a model: fields on the nodes of its mesh, their rows and their sparsity.

#include <memory>
#include <string>
#include <vector>

#include "mortise/core/nodal_field.hpp"
#include "mortise/mesh/field_rows.hpp"
#include "mortise/mesh/mesh.hpp"
#include "mortise/mesh/nodal_sparsity.hpp"

namespace mortise {

/// What a row stands for.
struct FieldPlace {
  std::size_t field = 0;
  LocalOrdinal node = 0;  ///< owned
  int component = 0;
};

/// Fields are numbered one after the other, by make_field_table(). Only this class knows where in a vector a component of a field stands.
class FieldSpace {
 public:
  /// Collective.
  /// @throws std::invalid_argument as make_field_table() does, and without a field
  FieldSpace(RCP<const Mesh> mesh, const std::vector<FieldDeclaration>& fields);
  FieldSpace(const FieldSpace&) = delete;
  FieldSpace& operator=(const FieldSpace&) = delete;

  const RCP<const Mesh>& mesh() const { return mesh_; }
  std::size_t field_count() const { return fields_.size(); }
  const NodalField& field(std::size_t index) const { return fields_.at(index); }
  const FieldRows& rows(std::size_t field) const { return rows_[field]; }
  /// The row of a component of a field at a local node, where the field lives.
  LocalOrdinal row(std::size_t field, LocalOrdinal node, int component) const { return rows_[field](node, component); }
  /// The row of the first field.
  LocalOrdinal row(LocalOrdinal node, int component) const { return rows_[0](node, component); }
  /// The global id of the node of a dof's global id.
  GlobalOrdinal node_of(GlobalOrdinal id) const;
  /// What the row of an owned dof stands for.
  FieldPlace place(LocalOrdinal row) const;
  /// The global id of a component of a field at any node of the mesh, by its global id, where the field lives.
  GlobalOrdinal id(std::size_t field, GlobalOrdinal node, int component) const {
    return first_ids_[field] + rows_[field].components * node + component;
  }

  const RCP<const Map>& dofs() const { return dofs_; }              ///< owned
  const RCP<const Map>& local_dofs() const { return local_dofs_; }  ///< owned, then ghosts
  /// From dofs() to local_dofs().
  const RCP<const Import>& ghost_import() const { return ghost_import_; }
  const NodalSparsity& sparsity() const { return *sparsity_; }
  /// See NodalSparsity::graph().
  RCP<const Graph> graph() const { return sparsity_->graph(); }

 private:
  RCP<const Mesh> mesh_;
  std::vector<NodalField> fields_;
  std::vector<GlobalOrdinal> first_ids_;               ///< [fields] of the node 0
  std::vector<std::vector<LocalOrdinal>> first_rows_;  ///< [fields][local nodes] of fields that live on some nodes only, else empty
  std::vector<FieldRows> rows_;
  RCP<const Map> dofs_, local_dofs_;
  RCP<const Import> ghost_import_;
  std::unique_ptr<NodalSparsity> sparsity_;
};

}  // namespace mortise
