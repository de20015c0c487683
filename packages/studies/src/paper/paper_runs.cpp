#include "paper/paper_runs.hpp"

#include <stdexcept>

#include "mortise/studies/paper.hpp"

namespace mortise {
namespace {

const std::string friction = "variables/mu=0.1", no_friction = "variables/mu=0", fine = "variables/n=16", at_end = "output/every step=0";
const std::string elastic_fields = "output/fields=displacement, cauchy_stress", plastic_fields = elastic_fields + ", equivalent_plastic_strain",
                  contact_fields = plastic_fields + ", contact_pressure, contact_shear, gap";

struct Example {
  PaperRun run;
  std::vector<std::string> pairs;  ///< to be computed with nodes on segments as well
  std::string misses;              ///< why that run misses checks; empty: it does not
};

// Checks are those of dual mortar; what the paper says of nodes on segments contradicts them.
const std::string uneven = "nodes on segments do not pass a uniform pressure on, as the paper's figure 3 shows",
                  slipping = "corner nodes leave the side that they stand on with nodes on segments, as the paper's figure 5 shows",
                  oscillating = "pressures oscillate from node to node with nodes on segments, as the paper says";

/// Each example, followed by the same with the paper's "Lagrange".
std::vector<PaperRun> with_rivals(const std::vector<Example>& examples) {
  std::vector<PaperRun> runs;
  for (const Example& example : examples) {
    runs.push_back(example.run);
    if (example.pairs.empty()) continue;
    PaperRun rival = example.run;
    rival.name += "_node_to_segment";
    rival.is_rival = true;
    rival.misses = example.misses;
    for (const std::string& pair : example.pairs) rival.settings.push_back("contact/" + pair + "/formulation/type=node to segment");
    runs.push_back(rival);
  }
  return runs;
}

}  // namespace

const std::vector<PaperRun>& paper_runs() {
  const std::vector<std::string> elastic{friction, fine, contact_fields, at_end}, frictionless{no_friction, fine, contact_fields, at_end};
  const std::vector<std::string> soft{"variables/F=12500", fine, "stepping/step=1/200", contact_fields, at_end};
  static const std::vector<PaperRun> runs = with_rivals({
      {{"patch_test", "patch_test", {elastic_fields, at_end}}, {"interface"}, uneven},
      {{"patch_test_plastic", "patch_test_plastic", {plastic_fields, at_end}}, {"interface"}, uneven},
      {{"block_pile", "block_pile", {plastic_fields, at_end}}, {"first", "second", "third"}, slipping},
      {{"block_pile_axisymmetric", "block_pile_axisymmetric", {plastic_fields, at_end}}, {"first", "second", "third"}, slipping},
      {{"hertz_elastic", "hertz_elastic", elastic}, {"interface"}, oscillating},
      {{"hertz_elastic_frictionless", "hertz_elastic", frictionless}, {}, ""},
      {{"hertz_elastic_as_printed", "hertz_elastic_as_printed", elastic}, {"interface"}, oscillating},
      {{"hertz_elastic_as_printed_frictionless", "hertz_elastic_as_printed", frictionless}, {}, ""},
      {{"hertz_plastic", "hertz_plastic", {fine, contact_fields, at_end}}, {"interface"}, oscillating},
      {{"hertz_plastic_as_printed", "hertz_elastic_as_printed", soft}, {"interface"}, oscillating},
      {{"conical_extrusion", "conical_extrusion", {contact_fields, at_end}}, {"wall"}, ""},
  });
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
