#include "paper_runs.hpp"

#include <stdexcept>

#include "mortise/simulation/paper.hpp"

namespace mortise {
namespace {

const std::string friction = "variables/mu=0.1", no_friction = "variables/mu=0", fine = "variables/n=16", at_end = "output/every step=0";
const std::string elastic_fields = "output/fields=displacement, cauchy_stress", plastic_fields = elastic_fields + ", equivalent_plastic_strain",
                  contact_fields = plastic_fields + ", contact_pressure, contact_shear, gap";

}  // namespace

const std::vector<PaperRun>& paper_runs() {
  static const std::vector<PaperRun> runs{
      {"patch_test", "patch_test", {elastic_fields, at_end}},
      {"patch_test_plastic", "patch_test_plastic", {plastic_fields, at_end}},
      {"block_pile", "block_pile", {plastic_fields, at_end}},
      {"block_pile_axisymmetric", "block_pile_axisymmetric", {plastic_fields, at_end}},
      {"hertz_elastic", "hertz_elastic", {friction, fine, contact_fields, at_end}},
      {"hertz_elastic_frictionless", "hertz_elastic", {no_friction, fine, contact_fields, at_end}},
      {"hertz_elastic_as_printed", "hertz_elastic_as_printed", {friction, fine, contact_fields, at_end}},
      {"hertz_elastic_as_printed_frictionless", "hertz_elastic_as_printed", {no_friction, fine, contact_fields, at_end}},
      {"hertz_plastic", "hertz_plastic", {fine, contact_fields, at_end}},
      {"hertz_plastic_as_printed", "hertz_elastic_as_printed", {"variables/F=12500", fine, "stepping/step=1/200", contact_fields, at_end}},
      {"conical_extrusion", "conical_extrusion", {contact_fields, at_end}},
  };
  return runs;
}

const PaperScene& scene_of(const PaperRun& run) {
  for (const auto& scene : paper_scenes())
    if (scene.name == run.scene) return scene;
  throw std::logic_error("inputs/paper had no " + run.scene + ".xml when this program was built");
}

std::vector<std::string> paper_run_names() {
  std::vector<std::string> names;
  for (const auto& run : paper_runs()) names.push_back(run.name);
  return names;
}

}  // namespace mortise
