#include "mortise/mortar/mortar_interface.hpp"

#include <fmt/format.h>

#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>

#include "interface/interface_implementation.hpp"
#include "mortise/mortar/surface_nodes.hpp"
#include "slave/facet_placement.hpp"

namespace mortise {
namespace {

// Collective.
void refuse_unknown_facets(const InterfaceInput& input, int dimension) {
  std::vector<Diagnostic> unknown, quadratic;
  for (const SurfaceFacets* facets : {&input.slave, &input.master})
    for (const SurfaceFacet& facet : *facets) {
      const std::size_t size = facet.size();
      const bool is_linear = dimension == 2 ? size == 2 : size == 3 || size == 4, is_quadratic = dimension == 2 ? size == 3 : size == 6 || size == 8;
      if (!is_linear && !is_quadratic && unknown.empty())
        unknown.push_back({input.place, fmt::format("a contact surface has facets of {} nodes{}; {} are available", size,
                                                    facet.empty() ? "" : fmt::format(" (one starts at node {})", facet.front()),
                                                    dimension == 2 ? "lines of 2 or 3" : "triangles of 3 or 6, quadrilaterals of 4 or 8")});
      if (is_quadratic && quadratic.empty())
        quadratic.push_back({input.place, fmt::format("{} needs linear facets, as linear elements have, but a surface of the pair has "
                                                      "facets of {} nodes (one starts at node {})",
                                                      input.options.coupling->name(), size, facet.front())});
    }
  const Communicator& comm = *input.owned_nodes->getComm();
  throw_if_any(comm, unknown);
  if (input.options.coupling->takes_quadratic_facets()) return;
  try {
    throw_if_any(comm, quadratic);
  } catch (const InputError& error) {
    throw UnfitCoupling(error.diagnostics());
  }
}

// Collective.
void refuse_common_nodes(const InterfaceInput& input) {
  std::vector<Diagnostic> diagnostics;
  const std::vector<char> on_slave = nodes_on_surface(input.owned_nodes, input.slave), on_master = nodes_on_surface(input.owned_nodes, input.master);
  for (std::size_t node = 0; node < on_slave.size() && diagnostics.empty(); ++node)
    if (on_slave[node] && on_master[node])
      diagnostics.push_back({input.place, fmt::format("node {} lies on the slave and on the master surface; the two have to be disjoint",
                                                      input.owned_nodes->getGlobalElement(static_cast<LocalOrdinal>(node)))});
  throw_if_any(*input.owned_nodes->getComm(), diagnostics);
}

}  // namespace

MortarInterface::MortarInterface(RCP<const Map> owned_nodes, RCP<const MultiVector> reference, RCP<const MultiVector> fixed,
                                 const SurfaceFacets& slave, const SurfaceFacets& master, const InterfaceMeasure& measure,
                                 const MortarOptions& options, const Place& place) {
  const auto dimension = static_cast<int>(reference->getNumVectors());
  const InterfaceInput input = {owned_nodes, reference, fixed, slave, master, measure, options, place};
  if (!options.coupling) throw InputError(place, "the coupling is null; give a Coupling, as coupling_of<DualMortarCoupling>()");
  if (!options.coupling->exists_in(dimension))
    throw UnfitCoupling(place, fmt::format("{} is not available in {}D", options.coupling->name(), dimension));
  if (const auto refusal = options.coupling->refusal(options)) throw InputError(place, *refusal);
  refuse_unknown_facets(input, dimension);
  refuse_misplaced_facets(*owned_nodes, slave, master, place);
  refuse_common_nodes(input);
  implementation_ = dimension == 2 ? make_interface<2>(input) : make_interface<3>(input);
}

MortarInterface::~MortarInterface() = default;

bool MortarInterface::search(const MultiVector& x) { return implementation_->search(x); }

void MortarInterface::evaluate(const MultiVector& x, bool derivatives, std::vector<FacetCoupling>& couplings, std::vector<NodalNormal>& normals,
                               std::optional<StepFailure>& failure) const {
  implementation_->evaluate(x, derivatives, couplings, normals, failure);
}

std::vector<GapCurvature> MortarInterface::gap_curvatures(const MultiVector& x, const std::vector<double>& pressures) const {
  return implementation_->gap_curvatures(x, pressures);
}

std::vector<std::optional<double>> MortarInterface::distances_to_master(const MultiVector& x, const std::vector<std::size_t>& nodes,
                                                                        const std::vector<SpatialVector>& normals) const {
  return implementation_->distances_to_master(x, nodes, normals);
}

SurfaceKinks MortarInterface::find_kinks(const MultiVector& x, const std::vector<Facet<LocalOrdinal>>& nearest, const SurfaceKinks& before) const {
  return implementation_->find_kinks(x, nearest, before);
}
std::vector<GlobalOrdinal> MortarInterface::nodes_of_kinks() const {
  const SlaveSurface& slave = implementation_->slave;
  return {slave.node_ids.begin(), slave.node_ids.begin() + static_cast<std::ptrdiff_t>(slave.nodes_with_normal)};
}

bool MortarInterface::set_kinks(const SurfaceKinks& kinks) { return implementation_->set_kinks(kinks); }
long MortarInterface::kinks(const MultiVector& x) const { return implementation_->kinks(x); }
bool MortarInterface::retain(const std::shared_ptr<const RetainedNodes>& nodes) { return implementation_->retain(nodes); }
const std::shared_ptr<const InterfacePattern>& MortarInterface::pattern() const { return implementation_->pattern; }
const RCP<const Map>& MortarInterface::local_nodes() const { return implementation_->local_nodes; }
const std::vector<SlaveNode>& MortarInterface::slave_nodes() const { return implementation_->slave.owned; }
const std::vector<LocalOrdinal>& MortarInterface::coupled_nodes(std::size_t s) const { return implementation_->pattern->coupled[s]; }
const std::vector<LocalOrdinal>& MortarInterface::loaded_nodes(std::size_t s) const { return implementation_->pattern->loaded[s]; }
const InterfaceLoad& MortarInterface::load() const { return implementation_->load; }
const std::vector<std::size_t>& MortarInterface::segments() const { return implementation_->segments; }
double MortarInterface::reach() const { return implementation_->reach; }
double MortarInterface::shortest_facet() const { return implementation_->shortest; }
double MortarInterface::longest_facet() const { return implementation_->longest; }

}  // namespace mortise
