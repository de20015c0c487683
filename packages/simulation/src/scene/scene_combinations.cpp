#include "scene/scene_combinations.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "mortise/contact/enforcement.hpp"
#include "mortise/mesh/file_mesh.hpp"
#include "mortise/simulation/scene/scene_bodies.hpp"
#include "mortise/solid/element_type.hpp"

namespace mortise {
namespace {

/// Positions of reference points have as many numbers as the scene has dimensions.
void check_position(const Scene& scene, const std::vector<double>& position, const Place& place, std::vector<Diagnostic>& diagnostics) {
  const std::size_t numbers = scene.kinematics == Kinematics::three_dimensional ? 3 : 2;
  if (!position.empty() && position.size() != numbers)
    diagnostics.push_back({place, fmt::format("the position of its reference point has {} numbers; a scene with kinematics \"{}\" needs {}",
                                              position.size(), to_string(scene.kinematics), numbers)});
}

/// Copies of a body in 2D stay in its plane.
void refuse_out_of_plane(const Scene& scene, const Named<BodyOptions>& body, std::vector<Diagnostic>& diagnostics) {
  if (scene.kinematics == Kinematics::three_dimensional) return;
  const PatternOptions& pattern = body.value.pattern;
  const bool moves = !pattern.translation.empty() && pattern.translation[2] != 0.0;
  const bool turns = pattern.rotation != 0.0 && (pattern.axis[0] != 0.0 || pattern.axis[1] != 0.0);
  if (body.value.mirror == Mirror::z || moves || turns)
    diagnostics.push_back(
        {body.place,
         fmt::format("\"mirror\" or \"pattern\" of body \"{}\" leaves the plane; in a 2D scene a body is reflected at x or y, turns about z "
                     "and moves in x and y",
                     body.name)});
}

/// Stabilisation is of statics, and the last state has none.
void check_stabilisation(const Scene& scene, std::vector<Diagnostic>& diagnostics) {
  const StabilisationOptions& options = scene.stabilisation;
  if (!options.acts()) return;
  const auto refuse = [&](const std::string& words) { diagnostics.push_back({options.place, words}); };
  if (scene.inertia.acts()) refuse("a scene with inertia needs no stabilisation: mass holds bodies; please remove the list \"stabilisation\"");
  const double until = options.until.value_or(scene.stepping.end_time);
  if (until > scene.stepping.end_time)
    refuse(
        fmt::format("\"until\" is {}, after the \"end time\" {}: the last state would not be in balance without it", until, scene.stepping.end_time));
  if (scene.stepping.step >= until)
    refuse(fmt::format("the \"step\" of {} ends when stabilisation has vanished, at {}; please take steps that are shorter, as a tenth of that",
                       scene.stepping.step, until));
}

}  // namespace

std::vector<Diagnostic> wrong_combinations(const Scene& scene) {
  std::vector<Diagnostic> diagnostics;
  if (scene.inertia.contact_condition == InertiaOptions::ContactCondition::gap_rate)
    for (const auto& pair : scene.contact)
      if (const auto& formulation = pair.value.contact.formulation; formulation.options && !formulation.options->enforcement()->holds_exactly())
        diagnostics.push_back({pair.place, fmt::format("the \"contact condition\" \"gap rate\" is for conditions that hold exactly, and \"{}\" gives "
                                                       "way; please take another formulation, or the condition \"gap\"",
                                                       formulation.type)});
  for (const auto& body : scene.bodies) {
    check_position(scene, body.value.reference_point, body.place, diagnostics);
    if (body.value.rigid.value && !body.value.reference_point.empty() && scene.kinematics == Kinematics::axisymmetric &&
        body.value.reference_point[0] != 0.0)
      diagnostics.push_back({body.place, "a rigid body in an axisymmetric scene moves along the axis only; please put its reference point on r = 0"});
    refuse_out_of_plane(scene, body, diagnostics);
    const auto material =
        std::find_if(scene.materials.begin(), scene.materials.end(), [&](const auto& one) { return one.name == body.value.material.value; });
    if (material == scene.materials.end() || !body.value.mesh.options) continue;  // a rigid body, or a name that is reported as unknown
    const bool is_generated = dynamic_cast<const FileMesh*>(body.value.mesh.options.get()) == nullptr;
    if (!is_generated && !body.value.element.value) continue;  // the file says which
    const auto wrong = check_combination(
        {body.name, body.place, material->value.law.options, is_generated ? element_of(body.value) : *body.value.element.value}, scene.kinematics);
    diagnostics.insert(diagnostics.end(), wrong.begin(), wrong.end());
  }
  check_stabilisation(scene, diagnostics);
  for (const auto& tie : scene.reference_points) check_position(scene, tie.value.position, tie.place, diagnostics);
  return diagnostics;
}

}  // namespace mortise
