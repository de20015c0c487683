#include "run/coarse_slave.hpp"

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
constexpr int nodes_of_one_place(int dimension) { return dimension == 2 ? 2 : 4; }

/// A slave facet beside a closed node, as all ranks know it.
struct Place {
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
std::vector<Place> on_all_ranks(const Communicator& comm, const std::vector<Place>& mine) {
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
  std::vector<Place> all;
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

std::optional<std::string> too_coarse(const Model& model, const Scene& scene, std::size_t p, const PlaceOfNode& at, const ContactLaws& laws) {
  const Mesh& mesh = *model.mesh();
  const ContactPairOptions& options = scene.contact[p].value;
  const Formulation& formulation = *options.contact.formulation.options;
  if (!formulation.coupling()->integrates_facets() || options.contact.geometry == ContactGeometry::reference) return std::nullopt;
  std::vector<char> closed(static_cast<std::size_t>(mesh.owned_count()), 0);
  double counted[2] = {0.0, 0.0}, all[2] = {};  // nodes that carry force, and the largest pressure
  for (const ContactNodeState& node : node_states(laws, p)) {
    if (!node.closed || !node.carries || !(node.pressure > 0.0)) continue;
    closed[node.owned_node] = 1;
    counted[0] += 1.0;
    counted[1] = std::max(counted[1], node.pressure);
  }
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_SUM, counted[0], Teuchos::outArg(all[0]));
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MAX, counted[1], Teuchos::outArg(all[1]));
  if (all[0] == 0.0 || all[0] > nodes_of_one_place(mesh.dimension)) return std::nullopt;

  const SideSet &slave = require_side_set(mesh, options.slave), &master = require_side_set(mesh, options.master);
  const std::vector<char> is_closed = on_local_nodes(mesh, Import(mesh.owned_nodes, mesh.local_nodes), closed);
  std::vector<Place> mine;
  for (LocalOrdinal s = 0; s < slave.owned; ++s) {
    const std::vector<LocalOrdinal> nodes = mesh.side_nodes(slave.sides[s]);
    if (std::none_of(nodes.begin(), nodes.end(), [&](LocalOrdinal node) { return is_closed[node]; })) continue;
    const FacetPlaces facet = places_of(mesh, slave.sides[s], at);
    Place place{facet_centre(facet), facet_normal(mesh.dimension, facet), 0.0, side_lengths(mesh, slave.sides[s], at).back()};
    for (const Eigen::Vector3d& x : facet) place.radius = std::max(place.radius, (x - place.centre).norm());
    mine.push_back(place);
  }
  const std::vector<Place> places = on_all_ranks(*mesh.comm, mine);

  // How far the master turns over all of these facets: twice the largest angle from the mean.
  std::vector<Eigen::Vector3d> normals;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero(), mean;
  for (LocalOrdinal s = 0; s < master.owned; ++s) {
    const FacetPlaces facet = places_of(mesh, master.sides[s], at);
    const Eigen::Vector3d normal = facet_normal(mesh.dimension, facet);
    if (std::none_of(places.begin(), places.end(), [&](const Place& place) { return place.is_opposite(mesh.dimension, facet, normal); })) continue;
    normals.push_back(normal);
    sum += normal;
  }
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_SUM, 3, sum.data(), mean.data());
  if (!(mean.norm() > 0.0)) return std::nullopt;
  double off = 0.0, turn = 0.0, length = 0.0;
  for (const Eigen::Vector3d& normal : normals) off = std::max(off, 2.0 * std::acos(std::clamp(normal.dot(mean.normalized()), -1.0, 1.0)));
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MAX, off, Teuchos::outArg(turn));
  for (const Place& place : places) length = std::max(length, place.length);
  const double side_by_side = std::pow(static_cast<double>(places.size()), 1.0 / (mesh.dimension - 1));
  const double of_one = turn / side_by_side, given = all[1] / softer_modulus(model, slave, master);
  if (!(2.0 * weighing * of_one > given)) return std::nullopt;
  const Eigen::Vector3d& x = std::min_element(places.begin(), places.end(), [](const Place& one, const Place& other) {
                               return std::lexicographical_compare(one.centre.begin(), one.centre.end(), other.centre.begin(), other.centre.end());
                             })->centre;
  return fmt::format(
      "contact \"{}\": its force acts on {:.0f} slave {} at facets of length {:.3g} near ({:.6g}, {:.6g}{}), over one of which the master turns by "
      "{:.2g} "
      "degrees: weighted gaps see the master off its place by about {:.2g}, where a facet gives way by {:.2g}; so approach and pressure are wrong by "
      "as "
      "much as they are; please make the slave finer there",
      scene.contact[p].name, all[0], all[0] == 1.0 ? "node" : "nodes", length, x[0], x[1], mesh.dimension == 3 ? fmt::format(", {:.6g}", x[2]) : "",
      of_one * 180.0 / M_PI, weighing * of_one * length, given * length);
}

}  // namespace

std::vector<std::string> slaves_too_coarse(const Model& model, const Scene& scene, const Vector& displacement, const ContactLaws& laws) {
  const PlaceOfNode at = current_places(*model.bodies(), displacement);
  std::vector<std::string> lines;
  for (std::size_t p = 0; p < scene.contact.size(); ++p)
    if (auto line = too_coarse(model, scene, p, at, laws)) lines.push_back(std::move(*line));
  return lines;
}

}  // namespace mortise
