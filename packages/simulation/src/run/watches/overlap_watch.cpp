#include "run/watches/overlap_watch.hpp"

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "model/current_places.hpp"
#include "model/edge_contact.hpp"
#include "mortise/mesh/sets.hpp"
#include "mortise/mortar/quadratic_facet.hpp"
#include "surfaces/facet_kinks.hpp"
#include "surfaces/penetration.hpp"

namespace mortise {

OverlapWatch::OverlapWatch(const Model& model, const Scene& scene, std::function<void(const std::string&)> warn)
    : model_(model), scene_(scene), warn_(std::move(warn)) {
  const Mesh& mesh = *model.mesh();
  for (std::size_t p = 0; p < scene.contact.size(); ++p) {
    const ContactPairOptions& options = scene.contact[p].value;
    if (options.contact.geometry == ContactGeometry::reference) continue;  // small displacements: places are those of the reference configuration
    for (const SidesOfBody& slave : sides_by_body(mesh, require_side_set(mesh, options.slave)))
      for (const SidesOfBody& master : sides_by_body(mesh, require_side_set(mesh, options.master)))
        if (slave.body != master.body) pairs_.push_back({p, surface(slave), surface(master)});
  }
}

OverlapWatch::Surface OverlapWatch::surface(const SidesOfBody& of_body) const {
  const Mesh& mesh = *model_.mesh();
  std::map<LocalOrdinal, std::vector<Side>> around;
  for (const Side& side : of_body.set->sides) {
    const std::vector<LocalOrdinal> nodes = mesh.side_nodes(side);
    for (std::size_t a = 0; a < facet_corners(mesh.dimension, nodes.size()); ++a)
      if (nodes[a] < mesh.owned_count()) around[nodes[a]].push_back(side);
  }
  Surface result{of_body, {}};
  for (auto& [node, sides] : around) result.nodes.push_back({node, std::move(sides)});
  return result;
}

bool OverlapWatch::carries_force(const Pair& pair, const ContactLaws& laws) const {
  if (model_.edges() && model_.edges()->acts(pair.index)) return true;
  int mine = 0, any = 0;
  for (const ContactNodeState& node : node_states(laws, pair.index)) mine = mine || (node.closed && node.pressure > 0.0);
  Teuchos::reduceAll(*model_.mesh()->comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(any));
  return any != 0;
}

// Nodes lie on the surface that facets stand for, points within facets do not. The line goes along the mean of the normals, from just beside the
// node: so it passes beside the edges of facets that lie on one another.
std::vector<SurfaceProbe> OverlapWatch::probes(const Surface& surface, const PlaceOfNode& at) const {
  constexpr double beside = 1e-4;
  const Mesh& mesh = *model_.mesh();
  std::vector<SurfaceProbe> result;
  for (const SurfaceNode& node : surface.nodes) {
    const Eigen::Vector3d x = at(node.node);
    Eigen::Vector3d mean = Eigen::Vector3d::Zero(), centre = Eigen::Vector3d::Constant(std::numeric_limits<double>::max());
    for (const Side& side : node.around) {
      const FacetPlaces places = places_of(mesh, side, at);
      mean += facet_normal(mesh.dimension, places);
      const Eigen::Vector3d one = facet_centre(places);
      if (std::lexicographical_compare(one.begin(), one.end(), centre.begin(), centre.end())) centre = one;
    }
    if (mean.norm() > 0.0) result.push_back({{x + beside * (centre - x), mean.normalized(), 0}, node.node});
  }
  return result;
}

// Facets of length h that turn by the angle a from one to the next stand for an arc of radius h/a, which rises by h a / 8 above them. Where they are
// not alike it is at most twice that of the larger ones: h a / 4. More than kink_angle is a corner, which stands for nothing else.
double OverlapWatch::sagitta(const Surface& surface, const PlaceOfNode& at) const {
  const Mesh& mesh = *model_.mesh();
  double mine = 0.0, largest = 0.0;
  for (const SurfaceNode& node : surface.nodes) {
    std::vector<Eigen::Vector3d> normals;
    double length = 0.0;
    for (const Side& side : node.around) {
      normals.push_back(facet_normal(mesh.dimension, places_of(mesh, side, at)));
      length = std::max(length, side_lengths(mesh, side, at).back());
    }
    for (std::size_t a = 0; a < normals.size(); ++a)
      for (std::size_t b = 0; b < a; ++b)
        if (const double angle = std::acos(std::clamp(normals[a].dot(normals[b]), -1.0, 1.0)); angle < kink_angle)
          mine = std::max(mine, 0.25 * length * angle);
  }
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(largest));
  return largest;
}

// The sagitta is asked for where something lies within the other body: mostly nothing does.
void OverlapWatch::examine(const PlacedBodies& bodies, const ContactLaws& laws) {
  found_.clear();
  const auto& [mesh, at, boxes, length, touching] = bodies;
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    const Pair& pair = pairs_[p];
    if (carries_force(pair, laws)) continue;
    for (const bool of_slave : {true, false}) {
      const Surface &one = of_slave ? pair.slave : pair.master, &other = of_slave ? pair.master : pair.slave;
      const bool rigid = is_rigid(mesh, other.sides.body);
      std::vector<SurfaceProbe> nodes;
      for (const SurfaceProbe& probe : probes(one, at))
        if (may_penetrate(probe.point, boxes[one.sides.body], boxes[other.sides.body], rigid, touching)) nodes.push_back(probe);
      const int mine = static_cast<int>(nodes.size());
      int most = 0;
      Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(most));
      if (most == 0) continue;
      const auto own = tagged_surface(mesh, one.sides.body, *one.sides.set, SurfaceTags::own, SurfaceTags::own, at);
      const auto facing = tagged_surface(mesh, other.sides.body, *other.sides.set, SurfaceTags::front, SurfaceTags::rest, at);
      std::vector<double> depths;
      for (const Penetration& found :
           penetrations({*mesh.comm, mesh.dimension, own, facing, boxes[one.sides.body], boxes[other.sides.body], rigid, touching}, nodes))
        depths.push_back(found.kind == Penetration::Kind::overlap && found.depth > touching ? found.depth : 0.0);
      const DeepestPoint point = deepest_point(mesh, at, nodes, depths);
      if (!(point.depth > 0.0) || point.depth <= sagitta(other, at) + allowed_overlap(laws, pair.index)) continue;
      const auto& x = point.place;
      found_.push_back(
          {p, point.depth > arc_depth * longest_facet(mesh, *pair.slave.sides.set, at),
           fmt::format("contact \"{}\": node {} of the {} at ({:.6g}, {:.6g}{}) lies {:.3g} deep in the other body, and the pair carries no force",
                       scene_.contact[pair.index].name, point.node, of_slave ? "slave" : "master", x[0], x[1],
                       mesh.dimension == 3 ? fmt::format(", {:.6g}", x[2]) : "", point.depth)});
      break;
    }
  }
}

void OverlapWatch::accept(const std::function<bool(std::size_t)>& is_told) {
  accepted_.clear();
  for (const Found& found : found_) {
    accepted_ += (accepted_.empty() ? "" : "; ") + found.text;
    if (!found.is_deep || pairs_[found.pair].is_warned || is_told(pairs_[found.pair].index)) continue;
    pairs_[found.pair].is_warned = true;
    warn_(fmt::format(
        "  {}: weighted gaps are means over facets, so that contact begins too late; please make the slave finer there, or exchange slave "
        "and master",
        found.text));
  }
  found_.clear();
}

void OverlapWatch::serialize(StateArchive& archive) {
  archive.text("overlap_watch.without_force", accepted_);
  std::vector<int> warned;
  for (const Pair& pair : pairs_) warned.push_back(pair.is_warned ? 1 : 0);
  mortise::serialize(archive, "overlap_watch.warned", warned);
  for (std::size_t p = 0; p < std::min(warned.size(), pairs_.size()); ++p) pairs_[p].is_warned = warned[p] != 0;
}

}  // namespace mortise
