#include "corner_watch.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "current_places.hpp"
#include "mortise/mesh/sets.hpp"
#include "mortise/mortar/quadratic_facet.hpp"
#include "penetration.hpp"

namespace mortise {
namespace {

// A corner of the master in the middle of a slave facet of length h, a depth d behind it, with sides that leave the facet at the angle b: the gap is
// x tan b - d at the distance x. With phi = (2 - 3 s) on either facet of a node the weighted gap is
//   h/2 (h tan b / 4 - d)  of the facet itself,   h/2 (h tan b / 2 - d)  of the one beside it;
// both nodes are open until d = 3/8 h tan b, and as soon as they carry force the corner stays that deep. Facets that stand for an arc turn by less
// than 30 degrees, so that b < 15 degrees and d < 3/8 tan(15 degrees) h = 0.1 h. More takes a corner.
constexpr double kink = 30.0 * M_PI / 180.0;
const double allowed_depth = 0.375 * std::tan(0.5 * kink);  ///< over the facet's length

Eigen::Vector3d normal_of(int dimension, const FacetPlaces& x) {
  const std::size_t corners = facet_corners(dimension, x.size());
  Eigen::Vector3d normal;
  if (dimension == 2)
    normal = {x[1][1] - x[0][1], x[0][0] - x[1][0], 0.0};
  else
    normal = corners == 3 ? (x[1] - x[0]).cross(x[2] - x[0]) : (x[2] - x[0]).cross(x[3] - x[1]);
  return normal.normalized();
}

Eigen::Vector3d centre_of(const FacetPlaces& x) {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : x) centre += point / static_cast<double>(x.size());
  return centre;
}

}  // namespace

CornerWatch::CornerWatch(const Model& model, const Scene& scene, std::function<void(const std::string&)> warn)
    : model_(model), scene_(scene), warn_(std::move(warn)) {
  const Mesh& mesh = *model.mesh();
  for (std::size_t p = 0; p < scene.contact.size(); ++p) {
    const ContactPairOptions& options = scene.contact[p].value;
    if (options.contact.formulation.options->two_pass()) continue;  // master nodes have gaps of their own
    const SideSet &slave = require_side_set(mesh, options.slave), &master = require_side_set(mesh, options.master);
    Pair pair{p, slave, body_of(mesh, slave), body_of(mesh, master), {}, {}};
    if (pair.slave_body == pair.master_body) continue;
    const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
    pair.facets = rcp(new Map(invalid, static_cast<std::size_t>(slave.owned), 0, mesh.comm));
    std::map<LocalOrdinal, std::vector<Side>> around;
    for (const Side& side : master.sides) {
      const std::vector<LocalOrdinal> nodes = mesh.side_nodes(side);
      for (std::size_t a = 0; a < facet_corners(mesh.dimension, nodes.size()); ++a)
        if (nodes[a] < mesh.owned_count()) around[nodes[a]];
    }
    for (const Side& side : whole_surface(mesh, pair.master_body).sides)
      for (const LocalOrdinal node : mesh.side_nodes(side))
        if (const auto found = around.find(node); found != around.end()) found->second.push_back(side);
    for (const auto& [node, sides] : around) pair.candidates.push_back({node, sides});
    pairs_.push_back(std::move(pair));
  }
}

// Convex nodes at which the surface turns by more than the angle of an arc, with the mean of their facets' normals.
std::vector<SurfaceProbe> CornerWatch::corners(const Pair& pair, const PlaceOfNode& at, const Box3& slave_box, double touching) const {
  const Mesh& mesh = *model_.mesh();
  std::vector<SurfaceProbe> result;
  for (const Candidate& candidate : pair.candidates) {
    const Eigen::Vector3d x = at(candidate.node);
    if (!slave_box.holds(x)) continue;
    std::vector<Eigen::Vector3d> normals, centres;
    for (const Side& side : candidate.around) {
      const FacetPlaces places = places_of(mesh, side, at);
      normals.push_back(normal_of(mesh.dimension, places));
      centres.push_back(centre_of(places));
    }
    bool is_corner = false;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (std::size_t a = 0; a < normals.size(); ++a) {
      mean += normals[a];
      for (std::size_t b = 0; b < a; ++b)
        is_corner = is_corner || (normals[a].dot(normals[b]) < std::cos(kink) && (centres[b] - x).dot(normals[a]) < -touching);
    }
    if (is_corner && mean.norm() > 0.0) result.push_back({{x, mean.normalized(), 0}, candidate.node});
  }
  return result;
}

// From the corner back through its own body: the first facet of the slave that the line leaves by is the one that it lies in.
std::optional<CornerWatch::Found> CornerWatch::deepest(std::size_t p, const std::vector<SurfaceProbe>& corners, const PlaceOfNode& at,
                                                       const std::vector<Box3>& boxes, double touching, const Vector& multipliers) const {
  const Mesh& mesh = *model_.mesh();
  const Pair& pair = pairs_[p];
  constexpr int own = -1;
  std::vector<TaggedFacet> facets = tagged_surface(mesh, pair.master_body, whole_surface(mesh, pair.master_body), own, own, at);
  for (LocalOrdinal s = 0; s < pair.slave.owned; ++s)
    facets.push_back({places_of(mesh, pair.slave.sides[s], at), static_cast<int>(pair.facets->getGlobalElement(s))});
  std::vector<LineSegment> lines;
  for (const SurfaceProbe& corner : corners) lines.push_back({corner.point.x, -corner.point.normal, touching, boxes[pair.master_body].diagonal()});
  std::vector<double> depth(corners.size(), 0.0);
  std::vector<GlobalOrdinal> facet(corners.size(), -1);
  const auto found = crossings(*mesh.comm, mesh.dimension, facets, lines);
  for (std::size_t c = 0; c < corners.size(); ++c) {
    if (found[c].empty() || found[c].front().tag == own || !found[c].front().leaves) continue;
    depth[c] = found[c].front().s;
    facet[c] = found[c].front().tag;
  }
  std::set<GlobalOrdinal> wanted(facet.begin(), facet.end());
  wanted.erase(-1);
  double mine = static_cast<double>(wanted.size()), any = 0.0;
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(any));
  if (any == 0.0) return std::nullopt;

  // Of the slave's facets: their lengths, and whether a node of them is closed.
  std::vector<char> closed(static_cast<std::size_t>(mesh.owned_count()), 0);
  for (const ContactNodeState& node : model_.contact()->node_states(pair.index, multipliers))
    closed[node.owned_node] = node.closed && node.pressure > 0.0;
  const std::vector<char> is_closed = on_local_nodes(mesh, Import(mesh.owned_nodes, mesh.local_nodes), closed);
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
      if ((values(place, 1) != 0.0) == carries && share > allowed_depth) relative[c] = share;
    }
    const DeepestPoint point = deepest_point(mesh, at, corners, relative);
    if (!(point.depth > 0.0)) continue;
    double length = 0.0, all = 0.0;
    for (std::size_t c = 0; c < corners.size(); ++c)
      if (mesh.local_nodes->getGlobalElement(corners[c].node) == point.node) length = values(met->getLocalElement(facet[c]), 0);
    Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MAX, length, Teuchos::outArg(all));
    const auto& x = point.place;
    return Found{
        p, carries,
        fmt::format("contact \"{}\": node {} of the master at ({:.6g}, {:.6g}{}), a corner, lies {:.3g} deep in a slave facet of length {:.3g}{}",
                    scene_.contact[pair.index].name, point.node, x[0], x[1], mesh.dimension == 3 ? fmt::format(", {:.6g}", x[2]) : "",
                    point.depth * all, all, carries ? "" : " whose nodes carry no force")};
  }
  return std::nullopt;
}

void CornerWatch::examine(const Vector& displacement, const Vector& multipliers) {
  found_.clear();
  if (pairs_.empty()) return;
  const Mesh& mesh = *model_.mesh();
  const double touching = touching_depth * model_.size().length;
  const PlaceOfNode at = current_places(*model_.bodies(), displacement);
  const std::vector<Box3> boxes = body_boxes(mesh, at);
  std::vector<std::vector<SurfaceProbe>> corners_of;
  std::vector<double> mine, all(pairs_.size());
  for (const Pair& pair : pairs_)
    mine.push_back(static_cast<double>(corners_of.emplace_back(corners(pair, at, boxes[pair.slave_body], touching)).size()));
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MAX, static_cast<int>(mine.size()), mine.data(), all.data());
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    if (all[p] == 0.0) continue;
    if (auto found = deepest(p, corners_of[p], at, boxes, touching, multipliers)) found_.push_back(std::move(*found));
  }
}

void CornerWatch::accept() {
  accepted_.clear();
  for (const Found& found : found_) {
    if (!found.carries) accepted_ += (accepted_.empty() ? "" : "; ") + found.text;
    if (pairs_[found.pair].is_warned) continue;
    pairs_[found.pair].is_warned = true;
    warn_(fmt::format("  {}: weighted gaps are means over facets, so that {}; please make the slave finer there, or exchange slave and master",
                      found.text, found.carries ? "the bodies come nearer than they may" : "contact begins too late"));
  }
  found_.clear();
}

}  // namespace mortise
