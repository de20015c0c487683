#include "mortise/mortar/surface_nodes.hpp"

#include <Tpetra_Export.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <set>

namespace mortise {

std::vector<char> nodes_on_surface(const RCP<const Map>& owned_nodes, const SurfaceFacets& facets) {
  std::set<GlobalOrdinal> mine;
  for (const auto& facet : facets) mine.insert(facet.begin(), facet.end());
  const std::vector<GlobalOrdinal> ids(mine.begin(), mine.end());
  const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  const auto map = rcp(new Map(invalid, ids.data(), static_cast<LocalOrdinal>(ids.size()), 0, owned_nodes->getComm()));
  Vector source(map), target(owned_nodes);
  source.putScalar(1.0);
  target.doExport(source, Export(map, owned_nodes), Tpetra::ADD);
  const auto view = target.getLocalViewHost(Tpetra::Access::ReadOnly);
  std::vector<char> on_surface(view.extent(0));
  for (std::size_t node = 0; node < on_surface.size(); ++node) on_surface[node] = view(node, 0) > 0.0;
  return on_surface;
}

}  // namespace mortise
