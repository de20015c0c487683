#include "mortise/simulation/quantities/fields.hpp"

#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "quantities/fields/principal_stress.hpp"
#include "surfaces/surface_projection.hpp"

namespace mortise {
namespace {

using Values = std::vector<double>;

/// A vector on the dofs as one on the nodes. The entry of a node for the rotation of a reference point is 0.
Values on_nodes(const FieldSpace& space, const Vector& vector) {
  const Mesh& mesh = *space.mesh();
  const auto view = vector.getLocalViewHost(Tpetra::Access::ReadOnly);
  std::vector<char> turns(static_cast<std::size_t>(mesh.owned_count()), 0);
  for (const ReferencePoint& point : mesh.reference_points)
    if (point.rotation_node >= 0 && point.rotation_node < mesh.owned_count()) turns[static_cast<std::size_t>(point.rotation_node)] = 1;
  Values values;
  for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node)
    for (int i = 0; i < mesh.dimension; ++i) values.push_back(turns[static_cast<std::size_t>(node)] != 0 ? 0.0 : view(space.row(node, i), 0));
  return values;
}

Values displacement(const FieldState& state) { return on_nodes(state.bodies.space(), state.displacement); }

/// 0 where there is no such vector.
Values on_nodes_or_none(const FieldState& state, const Vector* vector) {
  const Mesh& mesh = *state.bodies.mesh();
  return vector != nullptr ? on_nodes(state.bodies.space(), *vector) : Values(static_cast<std::size_t>(mesh.dimension) * mesh.owned_count(), 0.0);
}

Values reaction_force(const FieldState& state) { return on_nodes_or_none(state, state.reaction); }
Values velocity(const FieldState& state) { return on_nodes_or_none(state, state.velocity); }
Values acceleration(const FieldState& state) { return on_nodes_or_none(state, state.acceleration); }

/// `put(node, values of the node)` for every owned slave node of every pair.
Values on_slave_nodes(const FieldState& state, int components, const std::function<void(const ContactNodeState&, double*)>& put) {
  Values values(static_cast<std::size_t>(state.bodies.mesh()->owned_count()) * components, 0.0);
  if (state.contact == nullptr) return values;
  for (std::size_t pair = 0; pair < state.contact->pairs(); ++pair)
    for (const auto& node : node_states(*state.laws, pair)) put(node, &values[components * node.owned_node]);
  return values;
}

/// Components xx, yy, zz, xy, in 3D also yz, xz, of each owned element of all blocks.
Values on_elements(const FieldState& state, std::vector<StressComponents> (Bodies::*tensors)(const Vector&, LocalOrdinal) const) {
  Values values;
  for (LocalOrdinal block = 0; block < static_cast<LocalOrdinal>(state.bodies.mesh()->blocks.size()); ++block)
    for (const auto& tensor : (state.bodies.*tensors)(state.local_displacement, block))
      values.insert(values.end(), tensor.begin(), tensor.begin() + state.bodies.stress_components());
  return values;
}

Values stresses(const FieldState& state) { return on_elements(state, &Bodies::element_stresses); }

Values strains(const FieldState& state) { return on_elements(state, &Bodies::element_strains); }

/// The same components of each owned node.
Values rows_of(const MultiVector& columns) {
  const auto view = columns.getLocalViewHost(Tpetra::Access::ReadOnly);
  Values values;
  for (std::size_t node = 0; node < view.extent(0); ++node)
    for (std::size_t c = 0; c < view.extent(1); ++c) values.push_back(view(node, c));
  return values;
}

Values nodal_stresses(const FieldState& state) { return rows_of(*state.bodies.nodal_stresses(state.local_displacement)); }

Values nodal_strains(const FieldState& state) { return rows_of(*state.bodies.nodal_strains(state.local_displacement)); }

/// q = sqrt(3/2 dev sigma : dev sigma) of the element's mean stress.
Values von_mises(const FieldState& state) {
  const Values s = stresses(state);
  const std::size_t components = state.bodies.stress_components();
  Values values(s.size() / components);
  for (std::size_t e = 0; e < values.size(); ++e) {
    const double *normal = &s[components * e], *shear = normal + 3;
    const double xx = normal[0], yy = normal[1], zz = normal[2];
    double shears = 0.0;
    for (std::size_t c = 0; c < components - 3; ++c) shears += shear[c] * shear[c];
    values[e] = std::sqrt(0.5 * ((xx - yy) * (xx - yy) + (yy - zz) * (yy - zz) + (zz - xx) * (zz - xx)) + 3.0 * shears);
  }
  return values;
}

/// A principal stress of each element's mean stress.
Values principal_values(const FieldState& state, std::size_t which) {
  const Values s = stresses(state);
  const int components = state.bodies.stress_components();
  Values values;
  for (std::size_t first = 0; first < s.size(); first += static_cast<std::size_t>(components))
    values.push_back(principal_stresses(tensor_of(&s[first], components))[which].value);
  return values;
}

/// The same along its direction, of which models in 2D have the part in their plane.
Values principal_vectors(const FieldState& state, std::size_t which) {
  const Values s = stresses(state);
  const int components = state.bodies.stress_components();
  Values values;
  for (std::size_t first = 0; first < s.size(); first += static_cast<std::size_t>(components)) {
    const PrincipalStress principal = principal_stresses(tensor_of(&s[first], components))[which];
    for (int i = 0; i < state.bodies.dimension(); ++i) values.push_back(principal.value * principal.direction[static_cast<std::size_t>(i)]);
  }
  return values;
}

Values plastic_strains(const FieldState& state) {
  Values values;
  for (LocalOrdinal block = 0; block < static_cast<LocalOrdinal>(state.bodies.mesh()->blocks.size()); ++block)
    for (const double strain : state.bodies.element_plastic_strains(state.local_displacement, block)) values.push_back(strain);
  return values;
}

bool has_heat(const FieldState& state) { return state.heat != nullptr && state.heat->bodies != nullptr; }

/// 0 at nodes without a temperature.
Values temperature(const FieldState& state) {
  const Mesh& mesh = *state.bodies.mesh();
  Values values(static_cast<std::size_t>(mesh.owned_count()), 0.0);
  if (!has_heat(state)) return values;
  const FieldRows& rows = state.bodies.space().rows(state.heat->bodies->temperature());
  const auto unknowns = state.displacement.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node)
    if (rows.lives(node)) values[static_cast<std::size_t>(node)] = unknowns(rows(node, 0), 0);
  return values;
}

Values heat_flux(const FieldState& state) {
  const Mesh& mesh = *state.bodies.mesh();
  Values values;
  for (LocalOrdinal block = 0; block < static_cast<LocalOrdinal>(mesh.blocks.size()); ++block) {
    if (!has_heat(state)) {
      values.insert(values.end(),
                    static_cast<std::size_t>(mesh.dimension) * static_cast<std::size_t>(mesh.blocks[static_cast<std::size_t>(block)].owned), 0.0);
      continue;
    }
    for (const std::array<double, 3>& flux : state.heat->bodies->element_heat_fluxes(state.local_displacement, block))
      values.insert(values.end(), flux.begin(), flux.begin() + mesh.dimension);
  }
  return values;
}

/// A number of the slave nodes across which heat flows; 0 on all others.
Values on_heated_nodes(const FieldState& state, const std::function<double(const NodeHeat&)>& number) {
  const Mesh& mesh = *state.bodies.mesh();
  Values values(static_cast<std::size_t>(mesh.owned_count()), 0.0);
  if (!has_heat(state)) return values;
  for (const HeatOfStep::PairFlow& pair : state.heat->pairs)
    for (const NodeHeat& node : *pair.nodes) values[static_cast<std::size_t>(mesh.owned_nodes->getLocalElement(node.node))] = number(node);
  return values;
}

/// A number of the slave nodes of all pairs, projected on their surfaces. At a node of several pairs it is the sum.
Values projected(const FieldState& state, const std::function<std::vector<double>(std::size_t pair)>& numbers) {
  Values values(static_cast<std::size_t>(state.bodies.mesh()->owned_count()), 0.0);
  if (state.contact == nullptr) return values;
  for (std::size_t pair = 0; pair < state.contact->pairs(); ++pair) {
    const std::vector<double> of_pair = numbers(pair);
    const Values on_nodes =
        projected_on_slave(state.bodies, *state.contact, *state.laws, state.local_displacement, pair, [&](std::size_t s) { return of_pair[s]; });
    for (std::size_t node = 0; node < values.size(); ++node) values[node] += on_nodes[node];
  }
  return values;
}

Values smooth_pressures(const FieldState& state) {
  return projected(state, [&](std::size_t pair) {
    std::vector<double> pressures;
    for (const ContactNodeState& node : node_states(*state.laws, pair)) pressures.push_back(node.pressure);
    return pressures;
  });
}

Values smooth_heat_fluxes(const FieldState& state) {
  return projected(state, [&](std::size_t pair) {
    std::vector<double> fluxes(state.contact->slave_ids(pair).size(), 0.0);
    if (!has_heat(state)) return fluxes;
    const std::vector<GlobalOrdinal> ids = state.contact->slave_ids(pair);
    for (const HeatOfStep::PairFlow& flow : state.heat->pairs) {
      if (flow.pair != state.contact->pair_name(pair)) continue;
      for (const NodeHeat& node : *flow.nodes)
        if (const auto found = std::find(ids.begin(), ids.end(), node.node); found != ids.end())
          fluxes[static_cast<std::size_t>(found - ids.begin())] = node.flux;
    }
    return fluxes;
  });
}

struct Kind {
  std::string name, sentence;
  Field::Center center;
  FieldKind kind;
  int in_plane, in_space;  ///< components
  std::function<Values(const FieldState&)> values;
};

const std::vector<Kind>& kinds() {
  using Center = Field::Center;
  static const std::vector<Kind> all{
      {"displacement", "displacement of the nodes", Center::node, FieldKind::vector, 2, 3, displacement},
      {"contact_traction", "multiplier of the slave nodes, force per area, compression positive along the slave's normal", Center::node,
       FieldKind::vector, 2, 3,
       [](const FieldState& state) {
         const int dimension = state.bodies.mesh()->dimension;
         return on_slave_nodes(state, dimension, [&](const ContactNodeState& node, double* v) { std::copy_n(node.traction.begin(), dimension, v); });
       }},
      {"contact_pressure", "normal part of the contact traction of the slave nodes", Center::node, FieldKind::scalar, 1, 1,
       [](const FieldState& state) { return on_slave_nodes(state, 1, [](const ContactNodeState& node, double* v) { *v = node.pressure; }); }},
      {"smooth_contact_pressure",
       "contact pressure of the slave nodes, projected on the shape functions of their surface: more exact than contact_pressure where it is smooth",
       Center::node, FieldKind::scalar, 1, 1, smooth_pressures},
      {"gap", "weighted gap over weight of the slave nodes; 0 on all others", Center::node, FieldKind::scalar, 1, 1,
       [](const FieldState& state) { return on_slave_nodes(state, 1, [](const ContactNodeState& node, double* v) { *v = node.gap; }); }},
      {"contact_shear", "tangential part of the contact traction, along the slave's normal turned by +90 degrees; in 3D its size", Center::node,
       FieldKind::scalar, 1, 1,
       [](const FieldState& state) { return on_slave_nodes(state, 1, [](const ContactNodeState& node, double* v) { *v = node.shear; }); }},
      {"slip", "slip of the slave nodes in the last step, the same way; 0 without friction", Center::node, FieldKind::scalar, 1, 1,
       [](const FieldState& state) { return on_slave_nodes(state, 1, [](const ContactNodeState& node, double* v) { *v = node.slip; }); }},
      {"contact_state", "0 open, 1 stick, 2 slip; nodes without friction slip", Center::node, FieldKind::integer, 1, 1,
       [](const FieldState& state) {
         return on_slave_nodes(state, 1, [](const ContactNodeState& node, double* v) { *v = static_cast<double>(node.state); });
       }},
      {"cauchy_stress", "volume mean of the Cauchy stress of each element", Center::cell, FieldKind::symmetric_tensor, 4, 6, stresses},
      {"von_mises", "von Mises stress of each element's mean Cauchy stress", Center::cell, FieldKind::scalar, 1, 1, von_mises},
      {"largest_principal_stress", "largest principal stress of each element's mean Cauchy stress", Center::cell, FieldKind::scalar, 1, 1,
       [](const FieldState& state) { return principal_values(state, 0); }},
      {"smallest_principal_stress", "smallest principal stress of each element's mean Cauchy stress", Center::cell, FieldKind::scalar, 1, 1,
       [](const FieldState& state) { return principal_values(state, 2); }},
      {"largest_principal_vector", "largest principal stress along its direction; in 2D the part in the plane", Center::cell, FieldKind::vector, 2, 3,
       [](const FieldState& state) { return principal_vectors(state, 0); }},
      {"smallest_principal_vector", "smallest principal stress along its direction; in 2D the part in the plane", Center::cell, FieldKind::vector, 2,
       3, [](const FieldState& state) { return principal_vectors(state, 2); }},
      {"equivalent_plastic_strain", "volume mean of the accumulated plastic strain of each element; 0 in elastic bodies", Center::cell,
       FieldKind::scalar, 1, 1, plastic_strains},
      {"logarithmic_strain", "volume mean of the logarithmic strain of each element, 1/2 ln(F F^T); laws of small strain: symmetric part of F - 1",
       Center::cell, FieldKind::symmetric_tensor, 4, 6, strains},
      {"nodal_cauchy_stress", "Cauchy stress at the nodes: extrapolated from the points of each element, mean over a body's elements there",
       Center::node, FieldKind::symmetric_tensor, 4, 6, nodal_stresses},
      {"nodal_logarithmic_strain", "logarithmic strain at the nodes, in the same way", Center::node, FieldKind::symmetric_tensor, 4, 6,
       nodal_strains},
      {"reaction_force", "force of the supports on each node, in prescribed directions; 0 in all others", Center::node, FieldKind::vector, 2, 3,
       reaction_force},
      {"temperature", "temperature of the nodes; 0 where there is none", Center::node, FieldKind::scalar, 1, 1, temperature},
      {"heat_flux", "volume mean of the heat flux of each element, per current area; 0 in bodies without a temperature", Center::cell,
       FieldKind::vector, 2, 3, heat_flux},
      {"contact_heat_flux", "heat that flows from the slave nodes to the master, per area; 0 on all others", Center::node, FieldKind::scalar, 1, 1,
       [](const FieldState& state) { return on_heated_nodes(state, [](const NodeHeat& node) { return node.flux; }); }},
      {"smooth_contact_heat_flux", "contact_heat_flux, projected on the shape functions of the slave surface: more exact where it is smooth",
       Center::node, FieldKind::scalar, 1, 1, smooth_heat_fluxes},
      {"conductance", "conductance of the pair at the slave nodes; 0 on all others", Center::node, FieldKind::scalar, 1, 1,
       [](const FieldState& state) { return on_heated_nodes(state, [](const NodeHeat& node) { return node.conductance; }); }},
      {"friction_heat", "power that friction takes at the slave nodes, per area; 0 on all others", Center::node, FieldKind::scalar, 1, 1,
       [](const FieldState& state) {
         return on_heated_nodes(state, [](const NodeHeat& node) { return node.weight > 0.0 ? node.friction / node.weight : 0.0; });
       }},
      {"velocity", "velocity of the nodes; 0 without inertia", Center::node, FieldKind::vector, 2, 3, velocity},
      {"acceleration", "acceleration of the nodes, of contact nodes without mass that of their neighbours; 0 without inertia", Center::node,
       FieldKind::vector, 2, 3, acceleration}};
  return all;
}

}  // namespace

const std::vector<std::pair<std::string, std::string>>& field_names() {
  static const std::vector<std::pair<std::string, std::string>> names = [] {
    std::vector<std::pair<std::string, std::string>> list;
    for (const auto& kind : kinds()) list.emplace_back(kind.name, kind.sentence);
    return list;
  }();
  return names;
}

Field make_field(const std::string& name, const FieldState& state) {
  for (const auto& kind : kinds())
    if (kind.name == name)
      return {kind.name, kind.center, kind.kind, state.bodies.mesh()->dimension == 3 ? kind.in_space : kind.in_plane, kind.values(state)};
  throw std::invalid_argument("no field " + name);
}

}  // namespace mortise
