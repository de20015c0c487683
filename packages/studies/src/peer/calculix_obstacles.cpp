// Features of a scene that a deck of CalculiX cannot hold.

#include <fmt/format.h>

#include "mortise/contact/enforcement/pressure_overclosure.hpp"
#include "mortise/material/materials.hpp"
#include "peer/calculix_deck.hpp"

namespace mortise {
namespace {

bool small_strain(const BodyProperties& body) {
  return std::visit([](const auto& law) { return law.small_strain; }, body.material->law());
}

bool is_plain_coulomb(const FrictionLaw& law) {
  const auto* coulomb = dynamic_cast<const CoulombFriction*>(&law);
  return coulomb != nullptr && coulomb->coefficient.is_constant() && !coulomb->largest_traction;
}

}  // namespace

std::vector<Diagnostic> calculix_obstacles(const Scene& scene, const Model& model) {
  std::vector<Diagnostic> found;
  const auto say = [&](const Place& place, const std::string& what) { found.push_back({place, "the deck of CalculiX cannot hold it: " + what}); };
  if (scene.kinematics != Kinematics::plane_strain && scene.kinematics != Kinematics::three_dimensional)
    say({}, fmt::format("kinematics \"{}\"; decks are for plane strain and space. Mortar contact of CalculiX refuses axisymmetric elements (it takes "
                        "no nodes with "
                        "multiple point constraints), and results at plane nodes hold no contact stresses",
                        to_string(scene.kinematics)));
  if (scene.heat.acts()) say(scene.heat.place, "temperatures");
  const BodyProperties* first = nullptr;
  for (const auto& body : model.bodies()->properties()) {
    if (body.is_rigid()) {
      say(body.place, fmt::format("\"{}\" is rigid", body.name));
      continue;
    }
    if (calculix_element(cell_shape(body.element)).empty())
      say(body.place,
          fmt::format("the elements {} of \"{}\"; in 2D it takes linear ones, in 3D it has no pyramids", to_string(body.element), body.name));
    if (first == nullptr) first = &body;
    if (small_strain(body) != small_strain(*first))
      say(body.place, fmt::format("small strain in one of \"{}\" and \"{}\" and finite strain in the other", first->name, body.name));
  }
  for (const auto& point : scene.reference_points) say(point.place, fmt::format("the reference point \"{}\"", point.name));
  for (const auto& tie : scene.ties) say(tie.place, fmt::format("the tie \"{}\"", tie.name));
  for (const auto& spring : scene.springs) say(spring.place, fmt::format("the spring \"{}\"", spring.name));
  for (const auto& dashpot : scene.dashpots) say(dashpot.place, fmt::format("the dashpot \"{}\"", dashpot.name));
  for (const auto& mass : scene.point_masses) say(mass.place, fmt::format("the point mass \"{}\"", mass.name));
  if (scene.stabilisation.acts()) say(scene.stabilisation.place, "stabilisation");
  for (const auto& condition : scene.boundary_conditions)
    if (!condition.value.x_axis.empty()) say(condition.place, fmt::format("the axes of boundary condition \"{}\"", condition.name));
  for (const auto& load : scene.loads)
    if (load.value.load.options->make(model.bodies())->follows()) say(load.place, fmt::format("the load \"{}\", which follows the body", load.name));
  for (const auto& pair : scene.contact) {
    const ContactOptions& contact = pair.value.contact;
    if (contact.geometry != ContactGeometry::current) say(pair.place, fmt::format("contact \"{}\" in the reference configuration", pair.name));
    if (contact.clearance) say(pair.place, fmt::format("the clearance of \"{}\"", pair.name));
    if (pair.value.start.facets == FacetShape::round) say(pair.place, fmt::format("the round facets of \"{}\"", pair.name));
    if (pair.value.start.taken_up_at) say(pair.place, fmt::format("the overlap of \"{}\" that is taken up over time", pair.name));
    if (dynamic_cast<const PressureOverclosureEnforcement*>(contact.formulation.options->enforcement().get()) != nullptr)
      say(pair.place, fmt::format("the pressure overclosure law of \"{}\"", pair.name));
    if (contact.friction.options->acts() && !is_plain_coulomb(*contact.friction.options))
      say(pair.place, fmt::format("friction of \"{}\" other than Coulomb's with a constant coefficient", pair.name));
  }
  return found;
}

}  // namespace mortise
