#include "mortise/core/column_map.hpp"

#include <Tpetra_Map.hpp>
#include <algorithm>

#include "mortise/core/trilinos_versions.hpp"

namespace mortise {

RCP<const Map> with_further_columns(const Map& columns, std::vector<GlobalOrdinal> further) {
  further.erase(std::remove_if(further.begin(), further.end(), [&](GlobalOrdinal id) { return columns.isNodeGlobalElement(id); }), further.end());
  std::sort(further.begin(), further.end());
  further.erase(std::unique(further.begin(), further.end()), further.end());
  const auto own = local_ids(columns);
  std::vector<GlobalOrdinal> ids(own.begin(), own.end());
  ids.insert(ids.end(), further.begin(), further.end());
  const auto unknown = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  return rcp(new const Map(unknown, ids.data(), static_cast<LocalOrdinal>(ids.size()), 0, columns.getComm()));
}

}  // namespace mortise
