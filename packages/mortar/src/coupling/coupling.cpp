#include "mortise/mortar/coupling.hpp"

#include <stdexcept>

#include "mortise/mortar/coupling/dual_mortar.hpp"
#include "mortise/mortar/coupling/node_to_segment.hpp"
#include "mortise/mortar/coupling/standard_mortar.hpp"
#include "mortise/mortar/coupling/variational_mortar.hpp"

namespace mortise {

const std::vector<SharedCoupling>& coupling_registry() {
  static const std::vector<SharedCoupling> registry = {coupling_of<DualMortarCoupling>(), coupling_of<StandardMortarCoupling>(),
                                                       coupling_of<VariationalMortarCoupling>(), coupling_of<NodeToSegmentCoupling>()};
  return registry;
}

bool Coupling::couple_node(const SlaveNodeData&, const std::vector<Facet<LocalOrdinal>>&, double, const std::vector<PlaneVector>&,
                           const InterfaceMeasure&, double, bool, FacetCoupling&) const {
  throw std::logic_error("contact: \"" + name() + "\" integrates facets: it couples no node by itself");
}

CornerRule Coupling::corner_rule(CornerRule asked, int dimension) const {
  return dimension == 3 && asked == CornerRule::nearest_facet ? CornerRule::averaged : asked;
}

}  // namespace mortise
