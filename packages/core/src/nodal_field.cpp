#include "mortise/core/nodal_field.hpp"

#include <fmt/format.h>

#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <algorithm>
#include <stdexcept>
#include <utility>

#include "mortise/core/trilinos_versions.hpp"

namespace mortise {

NodalField::NodalField(std::string name, RCP<const Map> nodes, int components, std::vector<GlobalOrdinal> ids)
    : name_(std::move(name)), nodes_(std::move(nodes)), components_(components), ids_(std::move(ids)) {
  if (ids_.size() != local_id_count(*nodes_) * static_cast<std::size_t>(components_))
    throw std::invalid_argument(
        fmt::format("field '{}': {} ids for {} nodes of {} components", name_, ids_.size(), local_id_count(*nodes_), components_));
  const auto wrong = std::find_if(ids_.begin(), ids_.end(), [](GlobalOrdinal id) { return id < none; });
  if (wrong != ids_.end())
    throw std::invalid_argument(
        fmt::format("field '{}': the id {}; an id is at least 0, or NodalField::none where there is no unknown", name_, *wrong));
}

// Ids are whole numbers below 2^53, which doubles hold exactly.
std::vector<GlobalOrdinal> NodalField::ids_on(const RCP<const Map>& nodes) const {
  const auto columns = static_cast<std::size_t>(components_);
  MultiVector owned(nodes_, columns), result(nodes, columns);
  {
    const auto view = owned.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (std::size_t node = 0; node < view.extent(0); ++node)
      for (std::size_t i = 0; i < columns; ++i) view(node, i) = static_cast<double>(ids_[columns * node + i]);
  }
  result.doImport(owned, Import(nodes_, nodes), Tpetra::INSERT);
  std::vector<GlobalOrdinal> ids;
  ids.reserve(columns * local_id_count(*nodes));
  const auto view = result.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t node = 0; node < view.extent(0); ++node)
    for (std::size_t i = 0; i < columns; ++i) ids.push_back(static_cast<GlobalOrdinal>(view(node, i)));
  return ids;
}

NodalField numbered_by_nodes(std::string name, const RCP<const Map>& nodes, int components) {
  std::vector<GlobalOrdinal> ids;
  ids.reserve(local_id_count(*nodes) * static_cast<std::size_t>(components));
  for (const GlobalOrdinal node : local_ids(*nodes))
    for (int i = 0; i < components; ++i) ids.push_back(components * node + i);
  return {std::move(name), nodes, components, std::move(ids)};
}

FieldTable make_field_table(const RCP<const Map>& nodes, const std::vector<FieldDeclaration>& declarations) {
  FieldTable table;
  const GlobalOrdinal all = nodes->getMaxAllGlobalIndex() + 1;
  GlobalOrdinal first = 0;
  std::vector<GlobalOrdinal> dofs;
  for (const FieldDeclaration& field : declarations) {
    if (field.components < 1) throw std::invalid_argument(fmt::format("field '{}' has {} components", field.name, field.components));
    if (!field.lives.empty() && field.lives.size() != local_id_count(*nodes))
      throw std::invalid_argument(
          fmt::format("field '{}': {} marks of where it lives for {} owned nodes", field.name, field.lives.size(), local_id_count(*nodes)));
    std::vector<GlobalOrdinal> ids;
    for (std::size_t node = 0; node < local_id_count(*nodes); ++node)
      for (int i = 0; i < field.components; ++i) {
        const bool lives = field.lives.empty() || field.lives[node] != 0;
        ids.push_back(lives ? first + field.components * nodes->getGlobalElement(static_cast<LocalOrdinal>(node)) + i : NodalField::none);
        if (lives) dofs.push_back(ids.back());
      }
    table.fields.emplace_back(field.name, nodes, field.components, std::move(ids));
    first += field.components * all;
  }
  const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  table.dofs = rcp(new Map(invalid, dofs.data(), static_cast<LocalOrdinal>(dofs.size()), 0, nodes->getComm()));
  return table;
}

}  // namespace mortise
