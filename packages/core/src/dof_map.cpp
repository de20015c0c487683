#include "mortise/core/dof_map.hpp"

#include <Tpetra_Map.hpp>
#include <vector>

#include "mortise/core/trilinos_versions.hpp"

namespace mortise {

RCP<const Map> make_dof_map(const Map& nodes, int dimension) {
  const auto node_ids = local_ids(nodes);
  std::vector<GlobalOrdinal> ids;
  ids.reserve(dimension * node_ids.size());
  for (const GlobalOrdinal node : node_ids)
    for (int component = 0; component < dimension; ++component) ids.push_back(dimension * node + component);
  const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  return rcp(new Map(invalid, ids.data(), static_cast<LocalOrdinal>(ids.size()), nodes.getIndexBase(), nodes.getComm()));
}

}  // namespace mortise
