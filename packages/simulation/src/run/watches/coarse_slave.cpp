#include "run/watches/coarse_slave.hpp"

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Import.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "model/current_places.hpp"
#include "mortise/mesh/sets.hpp"
#include "mortise/mortar/quadratic_facet.hpp"
#include "surfaces/body_surfaces.hpp"
#include "surfaces/facet_kinks.hpp"

namespace mortise {
namespace {

// A master of radius R touches a slave node between facets of length h: the gap is x^2/(2R) - d. With dual weights 2 - 3 s on either side its mean is
//   2 h (h^2/(2R) (2/3 - 3/4) - d/2) = 0   at   d = -h^2/(12 R):
// the node carries force before the master has come down to it. With standard weights 1 - s it is  2 h (h^2/(2R)/12 - d/2),  and the master sinks in
// by h^2/(12 R). That is h theta/12, theta = h/R the angle that the master turns by over a facet. The facet itself gives way by about p h/E, and with
// dual weights the approach is p h/E - h theta/12. So for
//   theta/12 > p/E - theta/12
// it is wrong by more than itself. A half width a of Hertz' contact, E/(1 - nu^2) a^2 pi/(4 R h) = p, is then less than half of h. A force that acts
// on more nodes than those of one place is wider.
constexpr double weighing = 1.0 / 12.0;
constexpr int most_in_one_place(int dimension) { return dimension == 2 ? 2 : 4; }

/// A slave facet beside a closed node, as all ranks know it.
struct OnSurface {
  Eigen::Vector3d centre, normal;
  double radius = 0.0, length = 0.0;

  // Also of a facet that is longer than this one.
  bool is_opposite(int dimension, const FacetPlaces& facet, const Eigen::Vector3d& facing) const {
    if (!(facing.dot(normal) < 0.0)) return false;
    const Eigen::Vector3d middle = facet_centre(facet);
    for (std::size_t a = 0; a <= facet_corners(dimension, facet.size()); ++a) {
      const Eigen::Vector3d x = (a == 0 ? middle : Eigen::Vector3d(0.5 * (middle + facet[a - 1]))) - centre;
      const double above = x.dot(normal);
      if (std::abs(above) < length && (x - above * normal).norm() < radius) return true;
    }
    return false;
  }
};

// Few facets: those of at most four nodes.
std::vector<OnSurface> on_all_ranks(const Communicator& comm, const std::vector<OnSurface>& mine) {
  constexpr int numbers = 8;
  const int own = static_cast<int>(mine.size());
  int most = 0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, own, Teuchos::outArg(most));
  std::vector<double> sent(static_cast<std::size_t>(numbers * most), 0.0), received(sent.size() * static_cast<std::size_t>(comm.getSize()));
  for (std::size_t f = 0; f < mine.size(); ++f) {
    double* values = &sent[numbers * f];
    Eigen::Map<Eigen::Vector3d>(values + 0) = mine[f].centre;
    Eigen::Map<Eigen::Vector3d>(values + 3) = mine[f].normal;
    values[6] = mine[f].radius;
    values[7] = mine[f].length;
  }
  std::vector<OnSurface> all;
  if (most == 0) return all;
  Teuchos::gatherAll(comm, static_cast<int>(sent.size()), sent.data(), static_cast<int>(received.size()), received.data());
  for (std::size_t at = 0; at < received.size(); at += numbers)
    if (const double* values = &received[at]; values[7] > 0.0)
      all.push_back({Eigen::Map<const Eigen::Vector3d>(values), Eigen::Map<const Eigen::Vector3d>(values + 3), values[6], values[7]});
  return all;
}

/// Of the elements on either side. Collective.
double softer_modulus(const Model& model, const SideSet& one, const SideSet& other) {
  double mine = std::numeric_limits<double>::max(), least = mine;
  for (const SideSet* set : {&one, &other})
    for (const Side& side : set->sides)
      if (const auto& properties = model.bodies()->properties()[side.block]; !properties.is_rigid())
        mine = std::min(mine, properties.material->youngs_modulus);
  Teuchos::reduceAll(*model.mesh()->comm, Teuchos::REDUCE_MIN, mine, Teuchos::outArg(least));
  return least;
}

/// Slave facets around nodes that act, and what the master does over one of them.
struct CoarsePlace {
  Eigen::Vector3d x;    ///< of a facet
  double length = 0.0;  ///< of the longest facet
  double turn = 0.0;    ///< angle that the master turns by over one facet
};

bool has_weighted_gaps(const Model& model, const ContactPairOptions& options) {
  const Formulation& formulation = *options.contact.formulation.options;
  return model.contact() && formulation.coupling()->integrates_facets() && options.contact.geometry == ContactGeometry::current;
}

/// @param acts  [owned nodes] of the slave: those of one place, if there are any
/// Collective.
std::optional<CoarsePlace> coarse_place(const Model& model, const ContactPairOptions& options, const PlaceOfNode& at, const std::vector<char>& acts) {
  const Mesh& mesh = *model.mesh();
  const SideSet &slave = require_side_set(mesh, options.slave), &master = require_side_set(mesh, options.master);
  const std::vector<char> does_act = on_local_nodes(mesh, Import(mesh.owned_nodes, mesh.local_nodes), acts);
  std::vector<OnSurface> mine;
  for (LocalOrdinal s = 0; s < slave.owned; ++s) {
    const std::vector<LocalOrdinal> nodes = mesh.side_nodes(slave.sides[s]);
    if (std::none_of(nodes.begin(), nodes.end(), [&](LocalOrdinal node) { return does_act[node]; })) continue;
    const FacetPlaces facet = places_of(mesh, slave.sides[s], at);
    OnSurface place{facet_centre(facet), facet_normal(mesh.dimension, facet), 0.0, side_lengths(mesh, slave.sides[s], at).back()};
    for (const Eigen::Vector3d& x : facet) place.radius = std::max(place.radius, (x - place.centre).norm());
    mine.push_back(place);
  }
  const std::vector<OnSurface> places = on_all_ranks(*mesh.comm, mine);

  // Turn of the master over all of these facets: twice the largest angle from the mean.
  std::vector<Eigen::Vector3d> normals;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero(), mean;
  for (LocalOrdinal s = 0; s < master.owned; ++s) {
    const FacetPlaces facet = places_of(mesh, master.sides[s], at);
    const Eigen::Vector3d normal = facet_normal(mesh.dimension, facet);
    if (std::none_of(places.begin(), places.end(), [&](const OnSurface& place) { return place.is_opposite(mesh.dimension, facet, normal); })) continue;
    normals.push_back(normal);
    sum += normal;
  }
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_SUM, 3, sum.data(), mean.data());
  if (!(mean.norm() > 0.0)) return std::nullopt;
  double off = 0.0, turn = 0.0, length = 0.0;
  for (const Eigen::Vector3d& normal : normals) off = std::max(off, 2.0 * std::acos(std::clamp(normal.dot(mean.normalized()), -1.0, 1.0)));
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MAX, off, Teuchos::outArg(turn));
  for (const OnSurface& place : places) length = std::max(length, place.length);
  const double side_by_side = std::pow(static_cast<double>(places.size()), 1.0 / (mesh.dimension - 1));
  const Eigen::Vector3d& x = std::min_element(places.begin(), places.end(), [](const OnSurface& one, const OnSurface& other) {
                               return std::lexicographical_compare(one.centre.begin(), one.centre.end(), other.centre.begin(), other.centre.end());
                             })->centre;
  return CoarsePlace{x, length, turn / side_by_side};
}

/// Nodes of a pair that act in one place: none if there are too many for that, over all ranks. Collective.
template <class Acts>
std::vector<char> nodes_of_one_place(const Mesh& mesh, const std::vector<ContactNodeState>& states, const Acts& acts, double& count) {
  std::vector<char> result(static_cast<std::size_t>(mesh.owned_count()), 0);
  double mine = 0.0;
  for (const ContactNodeState& node : states)
    if (node.carries && acts(node)) result[static_cast<std::size_t>(node.owned_node)] = 1, mine += 1.0;
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_SUM, mine, Teuchos::outArg(count));
  if (count == 0.0 || count > most_in_one_place(mesh.dimension)) result.clear();
  return result;
}

std::string where(const Mesh& mesh, const CoarsePlace& place) {
  const Eigen::Vector3d& x = place.x;
  return fmt::format("facets of length {:.3g} near ({:.6g}, {:.6g}{}), over one of which the master turns by {:.2g} degrees", place.length, x[0],
                     x[1], mesh.dimension == 3 ? fmt::format(", {:.6g}", x[2]) : "", place.turn * 180.0 / M_PI);
}

bool presses(const ContactNodeState& node) { return node.closed && node.pressure > 0.0; }

double largest_pressure(const Model& model, const std::vector<ContactNodeState>& states) {
  double mine = 0.0, all = 0.0;
  for (const ContactNodeState& node : states)
    if (node.carries && presses(node)) mine = std::max(mine, node.pressure);
  Teuchos::reduceAll(*model.mesh()->comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(all));
  return all;
}

/// Error message on a pair in a solution; empty: nothing is wrong. Collective.
std::string too_coarse(const Model& model, const Named<ContactPairOptions>& pair, const PlaceOfNode& at, const std::vector<ContactNodeState>& states,
                       double pressure, double time) {
  const Mesh& mesh = *model.mesh();
  double count = 0.0;
  const std::vector<char> acts = nodes_of_one_place(mesh, states, presses, count);
  if (acts.empty()) return {};
  const std::optional<CoarsePlace> place = coarse_place(model, pair.value, at, acts);
  if (!place) return {};
  const double given = pressure / softer_modulus(model, require_side_set(mesh, pair.value.slave), require_side_set(mesh, pair.value.master));
  if (!(2.0 * weighing * place->turn > given)) return {};
  return fmt::format(
      "contact \"{}\": at t = {:.6g} its force acts on {:.0f} slave {} at {}: weighted gaps see the master off its place by about {:.2g}, where a "
      "facet "
      "gives way by {:.2g}; so approach and pressure are wrong by as much as they are; please make the slave finer there",
      pair.name, time, count, count == 1.0 ? "node" : "nodes", where(mesh, *place), weighing * place->turn * place->length, given * place->length);
}

}  // namespace

CoarseSlaveWatch::CoarseSlaveWatch(const Model& model, const Scene& scene, std::function<void(const std::string&)> warn)
    : model_(model), scene_(scene), warn_(std::move(warn)), hardest_(scene.contact.size()) {}

// The error of a facet in the approach does not depend on the force: it matters where the pair presses hardest. A light touch on the way there
// is wrong by a part of that alone.
void CoarseSlaveWatch::accept(const SemiSmoothSystem& system, const SystemEvaluation& accepted) {
  std::optional<PlaceOfNode> at;
  for (std::size_t p = 0; p < hardest_.size(); ++p) {
    if (!has_weighted_gaps(model_, scene_.contact[p].value)) continue;
    const std::vector<ContactNodeState> states = node_states(accepted.contact_laws(), p);
    const double pressure = largest_pressure(model_, states);
    if (!(pressure > hardest_[p].pressure)) continue;
    if (!at) at = current_places(*model_.bodies(), *system.unknowns(accepted.x()));
    hardest_[p] = {pressure, too_coarse(model_, scene_.contact[p], *at, states, pressure, accepted.context().time)};
  }
}

std::optional<StepFailure> CoarseSlaveWatch::end(const SemiSmoothSystem& system, const EndOfSteps& end) {
  if (end.last == nullptr) return std::nullopt;
  const PlaceOfNode at = current_places(*model_.bodies(), *system.unknowns(end.last->x()));
  for (std::size_t p = 0; p < hardest_.size(); ++p) {
    if (!has_weighted_gaps(model_, scene_.contact[p].value)) continue;
    std::string line = hardest_[p].words;
    if (line.empty()) {
      const std::vector<ContactNodeState> states = node_states(end.last->contact_laws(), p);
      if (const double pressure = largest_pressure(model_, states); pressure > 0.0)
        line = too_coarse(model_, scene_.contact[p], at, states, pressure, end.last->context().time);
    }
    if (!line.empty()) warn_(line);
  }
  return std::nullopt;
}

void CoarseSlaveWatch::serialize(StateArchive& archive) {
  std::vector<double> pressures;
  for (const Hardest& one : hardest_) pressures.push_back(one.pressure);
  mortise::serialize(archive, "coarse_slave.pressure", pressures);
  for (std::size_t p = 0; p < hardest_.size(); ++p) {
    archive.text(fmt::format("coarse_slave.words.{}", p), hardest_[p].words);
    if (p < pressures.size()) hardest_[p].pressure = pressures[p];
  }
}

// Nodes that open and close in turn are closed in one iterate and lie behind the master in the next.
FailureExplanation CoarseSlaveWatch::explain(const SemiSmoothSystem& system, const FailedTry& failed) {
  const FailureKind kind = failed.failure.kind();
  if (!failed.linearised || (kind != FailureKind::cycling_active_set && kind != FailureKind::too_many_iterations)) return {};
  const Mesh& mesh = *model_.mesh();
  const SystemEvaluation evaluation = system.evaluate(*failed.linearised->x, failed.linearised->context);
  const PlaceOfNode at = current_places(*model_.bodies(), *system.unknowns(evaluation.x()));
  for (std::size_t p = 0; p < scene_.contact.size(); ++p) {
    const auto& pair = scene_.contact[p];
    if (!has_weighted_gaps(model_, pair.value)) continue;
    double count = 0.0;
    const auto acts = nodes_of_one_place(
        mesh, node_states(evaluation.contact_laws(), p), [](const ContactNodeState& node) { return node.closed || node.gap < 0.0; }, count);
    if (acts.empty()) continue;
    const std::optional<CoarsePlace> place = coarse_place(model_, pair.value, at, acts);
    if (!place || place->turn < kink_angle) continue;
    return {fmt::format(
        "contact \"{}\": the slave is too coarse for the master's curvature: contact is sought at {:.0f} slave {} at {}; weighted gaps are means "
        "over "
        "facets, which there may close where they ought to open; please make the slave finer there, or take the curved side as the slave",
        pair.name, count, count == 1.0 ? "node" : "nodes", where(mesh, *place))};
  }
  return {};
}

}  // namespace mortise
