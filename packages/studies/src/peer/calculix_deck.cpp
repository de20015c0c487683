#include "peer/calculix_deck.hpp"

#include <fmt/format.h>

#include <map>

#include "mortise/core/names.hpp"
#include "mortise/material/materials.hpp"

namespace mortise {

std::string calculix_element(CellShape shape) {
  static const std::map<CellShape, std::string> elements{
      {CellShape::triangle3, "C3D6"},      {CellShape::quadrilateral4, "C3D8"}, {CellShape::hexahedron8, "C3D8"}, {CellShape::tetrahedron4, "C3D4"},
      {CellShape::tetrahedron10, "C3D10"}, {CellShape::hexahedron20, "C3D20"},  {CellShape::wedge6, "C3D6"},      {CellShape::wedge15, "C3D15"}};
  const auto found = elements.find(shape);
  return found == elements.end() ? "" : found->second;
}

std::string deck_comment(const std::string& text) {
  constexpr std::size_t longest = 200;  // of 1320 that a line of a deck may have
  return "** " + without_control_characters(text).substr(0, longest) + "\n";
}

std::string calculix_deck(const Scene& scene, const Model& model, Peer peer, std::optional<double> penalty) {
  const auto& first = *model.bodies()->properties().front().material;
  const bool small_strain = std::visit([](const auto& law) { return law.small_strain; }, first.law());
  const DeckConditions conditions = deck_conditions(scene, model);
  const std::size_t increments = deck_times(scene.stepping).size() - 1;
  std::string deck = deck_comment(scene.name);
  deck += deck_bodies(model) + deck_contact(scene, model, peer, penalty) + conditions.before;
  // DIRECT: the steps of the scene and no others. Results are written at the end of the step only.
  deck += fmt::format("*STEP{},INC={}\n*STATIC,DIRECT\n{:.10g},{:.10g}\n", small_strain ? "" : ",NLGEOM", 2 * increments + 10,
                      std::min(scene.stepping.step, scene.stepping.end_time), scene.stepping.end_time);
  deck += conditions.within;
  deck += fmt::format("*NODE FILE,FREQUENCY={0}\nU,RF\n", 2 * increments + 10);
  if (!scene.contact.empty()) deck += fmt::format("*CONTACT FILE,FREQUENCY={0}\nCDIS,CSTR\n", 2 * increments + 10);
  return deck + "*END STEP\n";
}

}  // namespace mortise
