#include "model/contact_at_start.hpp"

#include <fmt/format.h>

#include <Tpetra_Vector.hpp>
#include <cmath>

#include "model/report_corners.hpp"
#include "scene/roles.hpp"

namespace mortise {
namespace {

/// Excess of the peak from which on the log mentions it.
constexpr double noticeable = 0.2;
/// Depth of an overlap over what it was before slave nodes were moved.
constexpr double noticeable_rise = 1.1;

/// Says which surface is the slave where that was left open, and warns of slaves that are stiffer and finer. Collective.
void report_roles(const Mesh& mesh, const Scene& scene, RunLog& log) {
  for (const auto& pair : scene.contact) {
    const Located<std::string>&slave = pair.value.slave, &master = pair.value.master;
    const SurfaceTraits of_slave = surface_traits(mesh, scene, slave), of_master = surface_traits(mesh, scene, master);
    if (pair.value.roles == ContactRoles::automatic)
      log.info(fmt::format("  contact {}: the slave is \"{}\": {}", pair.name, slave.value, better_slave(of_slave, of_master).reason));
    if (pair.value.contact.formulation.options->two_pass()) continue;
    const double excess = excess_of_peak(of_slave, of_master, mesh.dimension);
    if (excess < noticeable) continue;
    log.warning(
        fmt::format("contact {}: the slave \"{}\" is {:.3g} times as stiff as \"{}\" and its facets are {:.3g} times as fine: few of its nodes "
                    "bear the force, and peaks of pressure may be too high by about {:.0f} %; please {}, or make the master finer",
                    pair.name, slave.value, of_slave.modulus / of_master.modulus, master.value, of_master.facet / of_slave.facet, 100.0 * excess,
                    pair.value.reason.empty() ? "exchange slave and master (\"roles\": \"automatic\" does)"
                                              : "name the pair in \"contact\" with slave and master exchanged"));
  }
}

std::string what_becomes_of_overlap(const ContactPairOptions& options) {
  std::string text = "the first step pushes them apart";
  if (options.start.taken_up_at) text = fmt::format("they are pushed apart until t = {:.6g}", *options.start.taken_up_at);
  if (options.contact.clearance) text += ", as far as their clearance asks for it";
  return text;
}

constexpr const char* round_advice = "\"facets\" = \"round\" takes the surfaces as smooth ones";

// An arc with the sagitta s over each facet is 2/3 s from its chords on average: gaps between conforming arcs are off by 2/3 of the difference of
// both. The gap of the larger one varies along the facet by its sagitta.
void report_arcs(const Named<ContactPairOptions>& options, const PairAtStart& pair, RunLog& log) {
  constexpr double noticeable_share = 0.1;  // of the gap
  const auto& [slave, master] = pair.arcs;
  const double left = slave + master;
  if (!(left > 0.0) || pair.facet_gaps) return;
  const std::string text = fmt::format(
      "contact {}: facets leave up to {:.3g} of the slave's arcs and {:.3g} of the master's: mean gaps are off by {:.2g}, those of single nodes by "
      "up to "
      "{:.2g}",
      options.name, slave, master, 2.0 / 3.0 * std::abs(slave - master), left);
  if (*pair.gap > 0.0 && left > noticeable_share * *pair.gap) {
    const double share = std::sqrt(noticeable_share * *pair.gap / left);
    log.warning(
        fmt::format("{}, beside a clearance of {:.3g}; pressures are wrong with them; {}, and so would facets of at most {:.3g} (slave) and "
                    "{:.3g} (master), or quadratic elements",
                    text, *pair.gap, round_advice, share * pair.facets[0], share * pair.facets[1]));
  } else {
    log.info("  " + text);
  }
}

void report_pair(const Named<ContactPairOptions>& options, const PairAtStart& pair, int dimension, RunLog& log) {
  if (!options.value.reason.empty())
    log.info(fmt::format("  contact {}: the slave is \"{}\": {}", options.name, options.value.slave.value, options.value.reason));
  if (options.value.start.mesh == MeshAtStart::adjusted)
    log.info(fmt::format("  contact {}: {} slave nodes were moved onto the master, by up to {:.3g}", options.name, pair.adjusted.first,
                         pair.adjusted.second));
  if (options.value.start.mesh == MeshAtStart::adjusted && pair.overlap.depth > noticeable_rise * pair.overlap_as_meshed)
    log.warning(fmt::format(
        "contact {}: after slave nodes were moved onto the master, the surfaces overlap by {:.3g}, before it by {:.3g}: nodes of a "
        "hollow slave are moved onto chords of the master, and its own chords cut deeper; please exchange slave and master, so that the round "
        "side is the slave, or mesh both with the same points",
        options.name, pair.overlap.depth, pair.overlap_as_meshed));
  if (pair.overlap.depth > 0.0) {
    const std::string text = fmt::format("contact {}: the surfaces overlap by up to {:.3g} at the start, deepest at {}; {}{}", options.name,
                                         pair.overlap.depth, to_string(dimension, pair.overlap), what_becomes_of_overlap(options.value),
                                         pair.reach ? fmt::format("; the search reach is {:.3g} instead of {:.3g}", *pair.reach, pair.longest) : "");
    if (pair.overlap.depth > pair.longest)
      log.warning(fmt::format("{}. That is more than the longest facet, {:.3g}: please make sure that it is meant", text, pair.longest));
    else
      log.info("  " + text);
    if (const double left = pair.arcs[0] + pair.arcs[1]; left > 0.0 && pair.overlap.depth <= left && !pair.facet_gaps)
      log.warning(
          fmt::format("contact {}: facets leave up to {:.3g} of the slave's arcs and {:.3g} of the master's, so that the overlap may be of the "
                      "meshes alone, and strains both; {}",
                      options.name, pair.arcs[0], pair.arcs[1], round_advice));
  } else if (pair.gap) {
    log.info(fmt::format("  contact {}: the surfaces {}{}", options.name, *pair.gap > 0.0 ? fmt::format("begin {:.3g} apart", *pair.gap) : "touch",
                         pair.reach ? fmt::format("; the search reach is {:.3g} instead of {:.3g}", *pair.reach, pair.longest) : ""));
    report_arcs(options, pair, log);
  }
  if (pair.facet_gaps)
    log.info(fmt::format("  contact {}: facets are taken as round: gaps change by {:.3g} to {:.3g}", options.name, (*pair.facet_gaps)[0],
                         (*pair.facet_gaps)[1]));
}

// Collective.
void report_corners_of(const Model& model, RunLog& log) {
  const Vector start(model.bodies()->space().dofs());
  try {
    report_corners(*model.contact(), model.contact()->evaluate(start, model.contact()->initial_history(start)), log);
  } catch (const StepFailure&) {  // the first step says so
  }
}

}  // namespace

void report_contact_at_start(const Model& model, const Scene& scene, RunLog& log) {
  const SurfacesAtStart& start = model.surfaces_at_start();
  const int dimension = model.mesh()->dimension;
  report_roles(*model.mesh(), scene, log);
  for (std::size_t pair = 0; pair < start.pairs.size(); ++pair) report_pair(scene.contact[pair], start.pairs[pair], dimension, log);
  for (const StrayOverlap& stray : start.strays)
    log.warning(fmt::format("bodies '{}' and '{}' {}, at {}, and no contact pair connects them: they pass through one another", stray.first,
                            stray.second,
                            stray.overlap.depth > 0.0 ? fmt::format("overlap by up to {:.3g} at the start", stray.overlap.depth)
                                                      : std::string("lie one wholly inside the other"),
                            to_string(dimension, stray.overlap)));
  if (model.contact()) report_corners_of(model, log);
}

}  // namespace mortise
