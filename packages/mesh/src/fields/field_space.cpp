#include "mortise/mesh/field_space.hpp"

#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <stdexcept>
#include <utility>

#include "mortise/core/trilinos_versions.hpp"

namespace mortise {

FieldSpace::FieldSpace(RCP<const Mesh> mesh, const std::vector<FieldDeclaration>& fields) : mesh_(std::move(mesh)) {
  if (fields.empty()) throw std::invalid_argument("a field space without a field");
  FieldTable table = make_field_table(mesh_->owned_nodes, fields);
  dofs_ = table.dofs;
  fields_ = std::move(table.fields);

  const LocalOrdinal owned = mesh_->owned_count(), nodes = static_cast<LocalOrdinal>(local_id_count(*mesh_->local_nodes));
  std::vector<GlobalOrdinal> local(local_ids(*dofs_).begin(), local_ids(*dofs_).end());
  LocalOrdinal next_owned = 0;
  const GlobalOrdinal all = mesh_->owned_nodes->getMaxAllGlobalIndex() + 1;
  for (std::size_t f = 0; f < fields.size(); ++f) {
    const int components = fields[f].components;
    first_ids_.push_back(f == 0 ? 0 : first_ids_[f - 1] + fields[f - 1].components * all);
    const std::vector<GlobalOrdinal> ids = fields_[f].ids_on(mesh_->local_nodes);
    const auto next_ghost = static_cast<LocalOrdinal>(local.size());
    FieldRows rows{components, owned, next_owned, next_ghost - components * owned};
    std::vector<LocalOrdinal> first(nodes, -1);
    LocalOrdinal next = next_owned;
    for (LocalOrdinal node = 0; node < nodes; ++node) {
      if (node == owned) {
        next_owned = next;
        next = next_ghost;
      }
      const GlobalOrdinal* of_node = ids.data() + static_cast<std::size_t>(components) * node;
      if (of_node[0] == NodalField::none) continue;
      first[node] = next;
      next += components;
      if (node >= owned) local.insert(local.end(), of_node, of_node + components);
    }
    if (nodes == owned) next_owned = next;
    first_rows_.push_back(fields[f].lives.empty() ? std::vector<LocalOrdinal>() : std::move(first));
    rows_.push_back(rows);
  }
  for (std::size_t f = 0; f < fields.size(); ++f)
    if (!fields[f].lives.empty()) rows_[f].rows = first_rows_[f].data();

  const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  local_dofs_ = rcp(new Map(invalid, local.data(), static_cast<LocalOrdinal>(local.size()), dofs_->getIndexBase(), dofs_->getComm()));
  ghost_import_ = rcp(new Import(dofs_, local_dofs_));
  sparsity_ = std::make_unique<NodalSparsity>(*mesh_, rows_, dofs_, local_dofs_);
}

GlobalOrdinal FieldSpace::node_of(GlobalOrdinal id) const {
  std::size_t field = fields_.size() - 1;
  while (id < first_ids_[field]) --field;
  return (id - first_ids_[field]) / rows_[field].components;
}

FieldPlace FieldSpace::place(LocalOrdinal row) const {
  std::size_t field = fields_.size() - 1;
  while (field > 0 && row < rows_[field].start) --field;
  const FieldRows& rows = rows_[field];
  if (rows.rows == nullptr) return {field, (row - rows.start) / rows.components, (row - rows.start) % rows.components};
  // The last owned node whose first row is not after it. Nodes without the field have -1.
  LocalOrdinal node = rows.owned_nodes - 1;
  while (!rows.lives(node) || rows.rows[node] > row) --node;
  return {field, node, row - rows.rows[node]};
}

}  // namespace mortise
