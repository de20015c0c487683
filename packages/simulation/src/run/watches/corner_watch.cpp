#include "run/watches/corner_watch.hpp"

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "model/current_places.hpp"
#include "model/edge_contact.hpp"
#include "mortise/mesh/sets.hpp"
#include "mortise/mortar/quadratic_facet.hpp"
#include "surfaces/facet_kinks.hpp"
#include "surfaces/penetration.hpp"

namespace mortise {
namespace {

// A corner of the master lies behind the middle of a slave facet of length h, by a depth d. Its sides leave the facet at the angle b: the gap is
// x tan b - d at the distance x. With phi = (2 - 3 s) on either facet of a node the weighted gap is, in two parts,
//   h/2 (h tan b / 4 - d)  of the facet itself,   h/2 (h tan b / 2 - d)  of the one beside it.
// Both nodes are open until d = 3/8 h tan b. As soon as they carry force the corner stays that deep. Facets that stand for an arc turn by less than
// 30 degrees, so that b < 15 degrees and d < 3/8 tan(15 degrees) h = 0.1 h: arc_depth. More takes a corner.

// A corner of the slave stands a depth d behind the master. Its facets leave the master at the angle b: the gap is x sin b - d at the distance x.
// With dual weights 2 - 3 s a facet gives  h (h sin b (1 - 1) - d (2 - 3/2)) = -h d / 2:  the node closes at once. With standard weights 1 - s it
// gives
//   h (h sin b / 6 - d / 2).
// The node is open until  d = h sin b / 3,  on rectangles  d = (h_x sin b_x + h_y sin b_y) / 3,  at most sqrt(2) h sin b / 3. As soon as it carries
// force the corner stays that deep. As above b < 15 degrees unless there is a corner.
double allowed_of_slave(int dimension) { return std::sin(0.5 * kink_angle) / 3.0 * (dimension == 3 ? std::sqrt(2.0) : 1.0); }

/// True if gaps are weighed with the slave's shape functions.
bool has_standard_weights(const ContactOptions& options) {
  const SharedCoupling coupling = options.formulation.options->coupling();
  return coupling->integrates_facets() && !coupling->has_dual_gap(options.mortar.gap_weighting);
}

std::string corner_at(const Mesh& mesh, const DeepestPoint& point, const std::string& side) {
  const auto& x = point.place;
  return fmt::format("node {} of the {} at ({:.6g}, {:.6g}{}), a corner", point.node, side, x[0], x[1],
                     mesh.dimension == 3 ? fmt::format(", {:.6g}", x[2]) : "");
}

}  // namespace

CornerWatch::CornerWatch(const Model& model, const Scene& scene, std::function<void(const std::string&)> warn)
    : model_(model), scene_(scene), warn_(std::move(warn)) {
  const Mesh& mesh = *model.mesh();
  for (std::size_t p = 0; p < scene.contact.size(); ++p) {
    const ContactPairOptions& options = scene.contact[p].value;
    if (options.contact.formulation.options->two_pass()) continue;  // master nodes have gaps of their own
    for (const SidesOfBody& slave : sides_by_body(mesh, require_side_set(mesh, options.slave)))
      for (const SidesOfBody& master : sides_by_body(mesh, require_side_set(mesh, options.master))) {
        if (slave.body == master.body) continue;
        sides_.insert(sides_.end(), {slave, master});
        Pair pair{p, *slave.set, slave.body, master.body, {}, *master.set, {}, {}};
        const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
        pair.facets = rcp(new Map(invalid, static_cast<std::size_t>(slave.set->owned), 0, mesh.comm));
        pair.of_master = candidates(*master.set, master.body);
        if (has_standard_weights(options.contact)) pair.of_slave = candidates(*slave.set, slave.body);
        pairs_.push_back(std::move(pair));
      }
  }
}

// Its own nodes: this rank has all facets around them.
std::vector<CornerWatch::Candidate> CornerWatch::candidates(const SideSet& set, std::size_t body) const {
  const Mesh& mesh = *model_.mesh();
  std::map<LocalOrdinal, Candidate> found;
  for (const Side& side : set.sides) {
    const std::vector<LocalOrdinal> nodes = mesh.side_nodes(side);
    for (std::size_t a = 0; a < facet_corners(mesh.dimension, nodes.size()); ++a)
      if (nodes[a] < mesh.owned_count()) found.try_emplace(nodes[a], Candidate{nodes[a], {}, {}}).first->second.of_pair.push_back(side);
  }
  for (const Side& side : whole_surface(mesh, body).sides)
    for (const LocalOrdinal node : mesh.side_nodes(side))
      if (const auto at = found.find(node); at != found.end()) at->second.around.push_back(side);
  std::vector<Candidate> result;
  for (auto& [node, candidate] : found) result.push_back(std::move(candidate));
  return result;
}

// Convex nodes at which the surface turns by more than the angle of an arc, with the mean of their facets' normals.
std::vector<CornerWatch::Corner> CornerWatch::corners(const std::vector<Candidate>& candidates, const PlacedBodies& bodies,
                                                      const Box3& other_box) const {
  const auto& [mesh, at, boxes, model_length, touching] = bodies;
  std::vector<Corner> result;
  for (const Candidate& candidate : candidates) {
    const Eigen::Vector3d x = at(candidate.node);
    if (!other_box.holds(x)) continue;
    std::vector<Eigen::Vector3d> normals, centres;
    for (const Side& side : candidate.around) {
      const FacetPlaces places = places_of(mesh, side, at);
      normals.push_back(facet_normal(mesh.dimension, places));
      centres.push_back(facet_centre(places));
    }
    bool is_corner = false;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (std::size_t a = 0; a < normals.size(); ++a) {
      mean += normals[a];
      for (std::size_t b = 0; b < a; ++b)
        is_corner = is_corner || (normals[a].dot(normals[b]) < std::cos(kink_angle) && (centres[b] - x).dot(normals[a]) < -touching);
    }
    if (is_corner && mean.norm() > 0.0) result.push_back({{{x, mean.normalized(), 0}, candidate.node}, &candidate});
  }
  return result;
}

std::vector<SurfaceProbe> CornerWatch::probes_of(const std::vector<Corner>& corners) {
  std::vector<SurfaceProbe> probes;
  for (const Corner& corner : corners) probes.push_back(corner.probe);
  return probes;
}

// From the corner back through its own body: the first facet of the slave that the line leaves by is the one that it lies in.
std::optional<CornerWatch::Found> CornerWatch::deepest_of_master(std::size_t p, const std::vector<Corner>& corners, const PlacedBodies& bodies,
                                                                 const ContactLaws& laws) const {
  const auto& [mesh, at, boxes, model_length, touching] = bodies;
  const Pair& pair = pairs_[p];
  constexpr int own = -1;
  std::vector<TaggedFacet> facets = tagged_surface(mesh, pair.master_body, whole_surface(mesh, pair.master_body), own, own, at);
  for (LocalOrdinal s = 0; s < pair.slave.owned; ++s)
    facets.push_back({places_of(mesh, pair.slave.sides[s], at), static_cast<int>(pair.facets->getGlobalElement(s))});
  std::vector<LineSegment> lines;
  for (const Corner& corner : corners)
    lines.push_back({corner.probe.point.x, -corner.probe.point.normal, touching, boxes[pair.master_body].diagonal()});
  const double allowed = allowed_overlap(laws, pair.index);
  std::vector<double> depth(corners.size(), 0.0);
  std::vector<GlobalOrdinal> facet(corners.size(), -1);
  const auto found = crossings(*mesh.comm, mesh.dimension, facets, lines);
  for (std::size_t c = 0; c < corners.size(); ++c) {
    if (found[c].empty() || found[c].front().tag == own || !found[c].front().leaves) continue;
    depth[c] = std::max(0.0, found[c].front().s * std::abs(found[c].front().along) - allowed);
    facet[c] = found[c].front().tag;
  }
  std::set<GlobalOrdinal> wanted(facet.begin(), facet.end());
  wanted.erase(-1);
  double mine = static_cast<double>(wanted.size()), any = 0.0;
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(any));
  if (any == 0.0) return std::nullopt;

  // Of the slave's facets: their lengths, and whether a node of them is closed.
  const std::vector<char> is_closed = closed(pair, laws);
  MultiVector of_facets(pair.facets, 2);
  {
    const auto values = of_facets.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (LocalOrdinal s = 0; s < pair.slave.owned; ++s) {
      const std::vector<LocalOrdinal> nodes = mesh.side_nodes(pair.slave.sides[s]);
      values(s, 0) = side_lengths(mesh, pair.slave.sides[s], at).back();
      values(s, 1) = std::any_of(nodes.begin(), nodes.end(), [&](LocalOrdinal node) { return is_closed[node]; });
    }
  }
  const std::vector<GlobalOrdinal> ids(wanted.begin(), wanted.end());
  const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  const RCP<const Map> met = rcp(new Map(invalid, ids.data(), static_cast<LocalOrdinal>(ids.size()), 0, mesh.comm));
  MultiVector of_met(met, 2);
  of_met.doImport(of_facets, Import(pair.facets, met), Tpetra::INSERT);
  const auto values = of_met.getLocalViewHost(Tpetra::Access::ReadOnly);

  for (const bool carries : {false, true}) {
    std::vector<double> relative(corners.size(), 0.0);
    for (std::size_t c = 0; c < corners.size(); ++c) {
      if (facet[c] < 0) continue;
      const LocalOrdinal place = met->getLocalElement(facet[c]);
      const double share = depth[c] / values(place, 0);
      if ((values(place, 1) != 0.0) == carries && share > arc_depth) relative[c] = share;
    }
    const DeepestPoint point = deepest_point(mesh, at, probes_of(corners), relative);
    if (!(point.depth > 0.0)) continue;
    double length = 0.0, all = 0.0;
    for (std::size_t c = 0; c < corners.size(); ++c)
      if (mesh.local_nodes->getGlobalElement(corners[c].probe.node) == point.node) length = values(met->getLocalElement(facet[c]), 0);
    Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MAX, length, Teuchos::outArg(all));
    return Found{p, carries,
                 fmt::format("contact \"{}\": {}, lies {:.3g} deep in a slave facet of length {:.3g}{}", scene_.contact[pair.index].name,
                             corner_at(mesh, point, "master"), point.depth * all, all, carries ? "" : " whose nodes carry no force")};
  }
  return std::nullopt;
}

std::vector<char> CornerWatch::closed(const Pair& pair, const ContactLaws& laws) const {
  const Mesh& mesh = *model_.mesh();
  std::vector<char> owned(static_cast<std::size_t>(mesh.owned_count()), 0);
  for (const ContactNodeState& node : node_states(laws, pair.index)) owned[node.owned_node] = node.closed && node.pressure > 0.0;
  return on_local_nodes(mesh, Import(mesh.owned_nodes, mesh.local_nodes), owned);
}

// From the corner back through its own body, out of the master. Its facets' nodes are on this rank.
std::optional<CornerWatch::Found> CornerWatch::deepest_of_slave(std::size_t p, const std::vector<Corner>& corners, const PlacedBodies& bodies,
                                                                const ContactLaws& laws) const {
  const auto& [mesh, at, boxes, model_length, touching] = bodies;
  const Pair& pair = pairs_[p];
  std::vector<SurfaceProbe> probes = probes_of(corners);
  const auto own = tagged_surface(mesh, pair.slave_body, pair.slave, SurfaceTags::own, SurfaceTags::own, at);
  const auto other = tagged_surface(mesh, pair.master_body, pair.master, SurfaceTags::front, SurfaceTags::rest, at);
  const auto found = penetrations(
      {*mesh.comm, mesh.dimension, own, other, boxes[pair.slave_body], boxes[pair.master_body], is_rigid(mesh, pair.master_body), touching}, probes);
  const std::vector<char> is_closed = closed(pair, laws);
  const double allowed = allowed_overlap(laws, pair.index);
  std::vector<double> length(corners.size(), 0.0), share[2] = {length, length};  // [carries]
  for (std::size_t c = 0; c < corners.size(); ++c) {
    if (found[c].kind != Penetration::Kind::overlap) continue;
    bool carries = false;
    for (const Side& side : corners[c].candidate->of_pair) {
      length[c] = std::max(length[c], side_lengths(mesh, side, at).back());
      for (const LocalOrdinal node : mesh.side_nodes(side)) carries = carries || is_closed[node];
    }
    const double depth = found[c].depth - allowed;
    if (depth > allowed_of_slave(mesh.dimension) * length[c]) share[carries ? 1 : 0][c] = depth / length[c];
  }
  for (const bool carries : {false, true}) {
    const DeepestPoint point = deepest_point(mesh, at, probes, share[carries ? 1 : 0]);
    if (!(point.depth > 0.0)) continue;
    double mine = 0.0, all = 0.0;
    for (std::size_t c = 0; c < corners.size(); ++c)
      if (mesh.local_nodes->getGlobalElement(probes[c].node) == point.node) mine = length[c];
    Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(all));
    return Found{
        p, carries,
        fmt::format("contact \"{}\": {} between facets of length {:.3g}, lies {:.3g} deep in the master, where dual weights would hold it off{}",
                    scene_.contact[pair.index].name, corner_at(mesh, point, "slave"), all, point.depth * all,
                    carries ? "" : ", and these facets' nodes carry no force")};
  }
  return std::nullopt;
}

void CornerWatch::examine(const PlacedBodies& bodies, const ContactLaws& laws) {
  found_.clear();
  if (pairs_.empty()) return;
  const Mesh& mesh = bodies.mesh;
  const std::vector<Box3>& boxes = bodies.boxes;
  std::vector<std::vector<Corner>> of_master, of_slave;
  std::vector<double> mine, all(2 * pairs_.size());
  for (const Pair& pair : pairs_) {
    mine.push_back(static_cast<double>(of_master.emplace_back(corners(pair.of_master, bodies, boxes[pair.slave_body])).size()));
    // A rigid surface may have no inside that its box holds.
    const Box3& master_box = boxes[is_rigid(mesh, pair.master_body) ? pair.slave_body : pair.master_body];
    mine.push_back(static_cast<double>(of_slave.emplace_back(corners(pair.of_slave, bodies, master_box)).size()));
  }
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MAX, static_cast<int>(mine.size()), mine.data(), all.data());
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    if (all[2 * p] > 0.0)
      if (auto found = deepest_of_master(p, of_master[p], bodies, laws)) found_.push_back(std::move(*found));
    if (all[2 * p + 1] > 0.0)
      if (auto found = deepest_of_slave(p, of_slave[p], bodies, laws)) found_.push_back(std::move(*found));
  }
}

bool CornerWatch::has_warned(std::size_t pair) const {
  return std::any_of(pairs_.begin(), pairs_.end(), [&](const Pair& one) { return one.index == pair && one.is_warned; });
}

void CornerWatch::accept() {
  accepted_.clear();
  for (const Found& found : found_) {
    const bool edges_act = model_.edges() && model_.edges()->acts(pairs_[found.pair].index);
    if (!found.carries && !edges_act) accepted_ += (accepted_.empty() ? "" : "; ") + found.text;
    if (pairs_[found.pair].is_warned) continue;
    pairs_[found.pair].is_warned = true;
    warn_(fmt::format("  {}: weighted gaps are means over facets, so that {}; please make the slave finer there, or exchange slave and master",
                      found.text, found.carries ? "the bodies come nearer than they may" : "contact begins too late"));
  }
  found_.clear();
}

void CornerWatch::serialize(StateArchive& archive) {
  archive.text("corner_watch.without_force", accepted_);
  std::vector<int> warned;
  for (const Pair& pair : pairs_) warned.push_back(pair.is_warned ? 1 : 0);
  mortise::serialize(archive, "corner_watch.warned", warned);
  for (std::size_t p = 0; p < std::min(warned.size(), pairs_.size()); ++p) pairs_[p].is_warned = warned[p] != 0;
}

}  // namespace mortise
