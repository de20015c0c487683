#include "mortise/simulation/quantities/quantity_support.hpp"

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <cmath>

#include "mortise/core/names.hpp"
#include "mortise/mortar/quadratic_facet.hpp"

namespace mortise {

const std::vector<std::pair<std::string, Component>>& component_names() {
  static const std::vector<std::pair<std::string, Component>> names{{"x", Component::x}, {"y", Component::y}, {"z", Component::z}};
  return names;
}

double sum_over_ranks(const Mesh& mesh, double mine) {
  double all = 0.0;
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_SUM, mine, Teuchos::outArg(all));
  return all;
}

double largest_over_ranks(const Mesh& mesh, double mine) {
  double all = mine;
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(all));
  return all;
}

void require_inertia(const QuantityContext& context) {
  if (context.mass == nullptr)
    throw InputError(Place{}, "this quantity is one of motion; the scene has no inertia: please give the list \"inertia\"");
}

void require_temperature(const QuantityContext& context) {
  if (context.heat.bodies == nullptr)
    throw InputError(Place{}, "this quantity is one of heat; the scene has no temperature: please give the list \"heat\" an \"analysis\"");
}

double sum_over_body(const QuantityContext& context, const std::optional<LocalOrdinal>& body, const Vector& a, const Vector& b) {
  const Mesh& mesh = context.mesh();
  const auto of_a = a.getLocalViewHost(Tpetra::Access::ReadOnly), of_b = b.getLocalViewHost(Tpetra::Access::ReadOnly);
  double mine = 0.0;
  for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node) {
    if (body && mesh.body_of_node[node] != *body) continue;
    for (int i = 0; i < mesh.dimension; ++i) mine += of_a(context.space().row(node, i), 0) * of_b(context.space().row(node, i), 0);
  }
  return sum_over_ranks(mesh, mine);
}

void require_component(const QuantityContext& context, Component component) {
  if (component == Component::z && context.mesh().dimension == 2)
    throw InputError(Place{}, "\"component\" is \"z\", which exists in three-dimensional scenes only; in 2D please take \"x\" or \"y\"");
}

LocalOrdinal find_body(const QuantityContext& context, const Located<std::string>& name) {
  std::vector<std::string> known;
  for (const MeshBody& body : context.mesh().bodies) {
    if (body.name == name.value) return static_cast<LocalOrdinal>(known.size());
    known.push_back(body.name);
  }
  throw InputError(name.place, unknown_name("body", name.value, known));
}

std::optional<LocalOrdinal> find_optional_body(const QuantityContext& context, const Located<std::string>& name) {
  if (name.value.empty()) return {};
  return find_body(context, name);
}

std::size_t find_pair(const QuantityContext& context, const Located<std::string>& name) {
  if (context.pairs.empty()) throw InputError(name.place, "the scene has no contact");
  std::vector<std::string> known;
  for (const auto& pair : context.pairs) {
    if (pair.name == name.value) return known.size();
    known.push_back(pair.name);
  }
  if (!name.value.empty()) throw InputError(name.place, unknown_name("contact pair", name.value, known));
  if (known.size() > 1) throw InputError(name.place, fmt::format("please add which contact pair: one of \"{}\"", fmt::join(known, "\", \"")));
  return 0;
}

std::size_t find_pair_of_plane(const QuantityContext& context, const Located<std::string>& name) {
  const std::size_t pair = find_pair(context, name);
  if (context.mesh().dimension != 2)
    throw InputError(name.place, "this quantity is one of lines and has a meaning in plane and axisymmetric scenes only");
  return pair;
}

void PairQuantity::describe(Parameters& parameters) { parameters.add("pair", pair, "contact pair; may be left out if the scene has one only"); }

void describe_measure(Parameters& parameters, TractionMeasure& measure) {
  parameters.add("measure", measure, {{"pair", TractionMeasure::pair}, {"reference", TractionMeasure::reference}},
                 "pair: lengths and tractions where the pair's geometry is; reference: per undeformed area at undeformed positions");
}

double PressedFacet::length() const { return std::hypot(position[1][0] - position[0][0], position[1][1] - position[0][1]); }

std::vector<PressedFacet> pressed_facets(const QuantityContext& context, std::size_t pair, TractionMeasure measure) {
  const bool undeformed = measure == TractionMeasure::reference;
  const Mesh& mesh = context.mesh();
  MultiVector owned(mesh.owned_nodes, 6), local(mesh.local_nodes, 6);  // start as zero
  {
    const auto values = owned.getLocalViewHost(Tpetra::Access::ReadWrite);
    for (const auto& state : node_states(*context.laws, pair)) {
      const double factor = undeformed ? state.covered / state.weight : 1.0;
      values(state.owned_node, 0) = factor * state.pressure;
      values(state.owned_node, 1) = state.closed ? 1.0 : 0.0;
      values(state.owned_node, 2) = factor * state.shear;
      values(state.owned_node, 3) = factor * state.shear_bound;
      for (int i = 0; i < 2; ++i) values(state.owned_node, 4 + i) = factor * state.traction[i];
    }
  }
  local.doImport(owned, Import(mesh.owned_nodes, mesh.local_nodes), Tpetra::INSERT);
  const auto values = local.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto displacement = context.local_displacement->getLocalViewHost(Tpetra::Access::ReadOnly);

  const double moves = context.contact->geometry(pair) == ContactGeometry::current && !undeformed ? 1.0 : 0.0;
  const SideSet& slave = mesh.side_sets.at(context.pairs[pair].slave);
  std::vector<PressedFacet> facets;
  for (LocalOrdinal side = 0; side < slave.owned; ++side) {
    const auto nodes = mesh.side_nodes(slave.sides[side]);
    for (const FacetPart& part : linear_parts(2, nodes.size())) {
      PressedFacet facet;
      for (int end = 0; end < 2; ++end) {
        const LocalOrdinal node = nodes[static_cast<std::size_t>(part[end])];
        for (int i = 0; i < 2; ++i) facet.position[end][i] = mesh.coordinates[node][i] + moves * displacement(context.space().row(node, i), 0);
        facet.pressure[end] = values(node, 0);
        facet.closed[end] = values(node, 1) != 0.0;
        facet.shear[end] = values(node, 2);
        facet.shear_bound[end] = values(node, 3);
        for (int i = 0; i < 2; ++i) facet.traction[end][i] = values(node, 4 + i);
      }
      facets.push_back(facet);
    }
  }
  return facets;
}

}  // namespace mortise
