#include "model/edges/edge_search.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>
#include <algorithm>
#include <cmath>
#include <set>

#include "model/edges/edge_lines.hpp"
#include "mortise/mesh/sets.hpp"
#include "surfaces/penetration.hpp"

namespace mortise {
namespace {

constexpr std::size_t beside = 3;  ///< pieces on either side of a crossing to which it may glide in a step

/// Lists of numbers of all ranks, one after the other. Collective. For what is small.
std::vector<double> on_all_ranks(const Communicator& comm, const std::vector<double>& mine) {
  const int own = static_cast<int>(mine.size()), ranks = comm.getSize();
  std::vector<int> sizes(static_cast<std::size_t>(ranks));
  Teuchos::gatherAll(comm, 1, &own, ranks, sizes.data());
  const int most = *std::max_element(sizes.begin(), sizes.end());
  if (most == 0) return {};
  std::vector<double> sent(mine), received(static_cast<std::size_t>(most) * sizes.size()), result;
  sent.resize(static_cast<std::size_t>(most), 0.0);
  Teuchos::gatherAll(comm, most, sent.data(), static_cast<int>(received.size()), received.data());
  for (std::size_t r = 0; r < sizes.size(); ++r) {
    const auto from = received.begin() + static_cast<std::ptrdiff_t>(r) * most;
    result.insert(result.end(), from, from + sizes[r]);
  }
  return result;
}

/// Ids of nodes are whole numbers, which a double holds to 2^53.
GlobalOrdinal id_of(double value) { return static_cast<GlobalOrdinal>(std::llround(value)); }

/// The gap of the lines that two pieces lie on.
double gap_of_lines(const EdgePiece& slave, const EdgePiece& master, double sign) {
  const Eigen::Vector3d normal = (slave.ends[1] - slave.ends[0]).cross(master.ends[1] - master.ends[0]).normalized();
  return sign * normal.dot(master.ends[0] - slave.ends[0]);
}

/// A cell with what tells of two edges that do not cross yet how they lie.
struct FoundCell {
  EdgeCell cell;
  double distance = 0.0, gap = 0.0;
};

constexpr std::size_t numbers_of_cell = 9;

std::vector<FoundCell> cells_on_all_ranks(const Communicator& comm, const std::vector<EdgePiece>& slaves, const std::vector<EdgePiece>& masters,
                                          double reach) {
  std::vector<double> mine;
  for (const NearPieces& near : near_pieces(comm, slaves, masters, reach)) {
    const EdgePiece& slave = slaves[near.slave];
    const WedgeContact wedges = wedge_contact(slave, near.master);
    if (!(wedges.stiffness > 0.0)) continue;
    for (const GlobalOrdinal node : {slave.nodes[0], slave.nodes[1], near.master.nodes[0], near.master.nodes[1]})
      mine.push_back(static_cast<double>(node));
    mine.insert(mine.end(),
                {wedges.stiffness, wedges.sign, distance(slave, near.master), gap_of_lines(slave, near.master, wedges.sign), wedges.area});
  }
  std::vector<FoundCell> cells;
  const std::vector<double> all = on_all_ranks(comm, mine);
  for (std::size_t at = 0; at + numbers_of_cell <= all.size(); at += numbers_of_cell) {
    const double* v = &all[at];
    cells.push_back({{{id_of(v[0]), id_of(v[1])}, {id_of(v[2]), id_of(v[3])}, v[4], v[5], v[8]}, v[6], v[7]});
  }
  std::sort(cells.begin(), cells.end(),
            [](const FoundCell& a, const FoundCell& b) { return std::tie(a.cell.slave, a.cell.master) < std::tie(b.cell.slave, b.cell.master); });
  return cells;
}

/// Pieces of a line and the columns of its stiffness near a crossing.
void narrow(EdgeLine& line, std::size_t first, std::size_t last) {
  line.nodes = {line.nodes.begin() + static_cast<std::ptrdiff_t>(first), line.nodes.begin() + static_cast<std::ptrdiff_t>(last) + 1};
  line.tangent = {line.tangent.begin() + static_cast<std::ptrdiff_t>(first), line.tangent.begin() + static_cast<std::ptrdiff_t>(last) + 1};
}

EdgePair near_crossings(const EdgePair& pair, const std::vector<EdgeCrossing>& crossings) {
  std::size_t low[2] = {pair.slave.nodes.size(), pair.master.nodes.size()}, high[2] = {0, 0};
  for (const EdgeCrossing& crossing : crossings)
    for (const int side : {0, 1}) {
      const std::size_t at = side == 0 ? crossing.slave : crossing.master, last = (side == 0 ? pair.slave : pair.master).nodes.size() - 1;
      low[side] = std::min(low[side], at - std::min(at, beside));
      high[side] = std::max(high[side], std::min(last, at + 1 + beside));
    }
  EdgePair result = pair;
  narrow(result.slave, low[0], high[0]);
  narrow(result.master, low[1], high[1]);
  result.stiffness = pair.stiffness.block(static_cast<Eigen::Index>(low[0]), static_cast<Eigen::Index>(low[1]),
                                          static_cast<Eigen::Index>(high[0] - low[0] + 1), static_cast<Eigen::Index>(high[1] - low[1] + 1));
  return result;
}

}  // namespace

std::vector<Eigen::Vector3d> places_on_all_ranks(const Mesh& mesh, const std::vector<GlobalOrdinal>& nodes, const PlaceOfNode& at) {
  std::vector<double> mine(3 * nodes.size(), 0.0), all(mine.size());
  for (std::size_t n = 0; n < nodes.size(); ++n)
    if (const LocalOrdinal node = mesh.owned_nodes->getLocalElement(nodes[n]); node >= 0) Eigen::Map<Eigen::Vector3d>(&mine[3 * n] + 0) = at(node);
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), all.data());
  std::vector<Eigen::Vector3d> places;
  for (std::size_t n = 0; n < nodes.size(); ++n) places.emplace_back(&all[3 * n]);
  return places;
}

EdgeSearch::EdgeSearch(const Mesh& mesh, const Scene& scene, const std::vector<double>& compliances, const std::vector<double>& reaches)
    : mesh_(mesh), compliances_(compliances) {
  if (mesh.dimension != 3) return;
  for (std::size_t p = 0; p < scene.contact.size(); ++p) {
    const ContactPairOptions& options = scene.contact[p].value;
    if (options.contact.geometry == ContactGeometry::reference) continue;
    const auto surface = [&](const SidesOfBody& sides) {
      Surface result{sides.body, sharp_edges(mesh, sides.body, *sides.set), {}};
      for (const EdgeNode& node : result.edges.nodes) result.node.emplace(mesh.local_nodes->getGlobalElement(node.node), node);
      return result;
    };
    for (const SidesOfBody& slave : sides_by_body(mesh, require_side_set(mesh, options.slave)))
      for (const SidesOfBody& master : sides_by_body(mesh, require_side_set(mesh, options.master))) {
        if (slave.body == master.body) continue;
        Pair pair{p, reaches[p], surface(slave), surface(master)};
        const double mine[2] = {static_cast<double>(pair.slave.edges.pieces.size()), static_cast<double>(pair.master.edges.pieces.size())};
        double all[2] = {};
        Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MAX, 2, mine, all);
        if (all[0] > 0.0 && all[1] > 0.0) pairs_.push_back(std::move(pair));
      }
  }
}

std::vector<EdgePiece> EdgeSearch::pieces(const Surface& surface, const PlaceOfNode& at) const {
  std::vector<EdgePiece> result;
  for (const SharpEdge& edge : surface.edges.pieces) {
    EdgePiece& piece = result.emplace_back();
    for (const std::size_t e : {0, 1}) {
      piece.nodes[e] = mesh_.local_nodes->getGlobalElement(edge.ends[e]);
      piece.ends[e] = at(edge.ends[e]);
      piece.beside[e] = at(edge.beside[e]);
    }
    piece.compliance = compliances_[static_cast<std::size_t>(edge.block)];
  }
  return result;
}

// Only what lies within one another has such a way, and there are few crossings: rank 0 asks for all.
bool EdgeSearch::ways_are_blocked(const PlacedBodies& bodies, const Pair& pair, const std::vector<EdgeCrossing>& crossings) const {
  constexpr double beside_ends = 1e-3;  // of the way: facets around the edges begin there
  std::vector<LineSegment> ways;
  for (const EdgeCrossing& crossing : crossings)
    if (crossing.gap < -bodies.touching)
      ways.push_back({crossing.on_master, crossing.normal, -beside_ends * crossing.gap, -(1.0 - beside_ends) * crossing.gap});
  if (ways.empty()) return false;
  if (mesh_.comm->getRank() > 0) ways.clear();
  std::vector<TaggedFacet> facets;
  for (const std::size_t body : {pair.slave.body, pair.master.body})
    for (TaggedFacet& facet : tagged_surface(mesh_, body, whole_surface(mesh_, body), 0, 0, bodies.at)) facets.push_back(std::move(facet));
  int mine = 0, any = 0;
  for (const auto& met : mortise::crossings(*mesh_.comm, mesh_.dimension, facets, ways)) mine = mine || !met.empty();
  Teuchos::reduceAll(*mesh_.comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(any));
  return any != 0;
}

// Where two edges cross one another by g < 0, the way from one to the other runs within both bodies. If it meets a facet, one of them is on the
// other side of a thin body. Two edges that do not cross may come to it from the side, if the lines that they lie on are apart.
EdgeSpots EdgeSearch::find(const PlacedBodies& bodies) const {
  struct Found {
    std::size_t pair;
    LinePair lines;
    double gap;
  };
  std::vector<Found> found;
  std::set<GlobalOrdinal> nodes;
  const auto own_neighbours = [&](const Surface& surface, const std::set<GlobalOrdinal>& wanted) {
    std::vector<double> mine;
    for (const GlobalOrdinal node : wanted)
      if (const auto at = surface.node.find(node); at != surface.node.end() && at->second.next[0] >= 0) {
        mine.push_back(static_cast<double>(node));
        for (const LocalOrdinal next : at->second.next) mine.push_back(static_cast<double>(mesh_.local_nodes->getGlobalElement(next)));
      }
    EdgeNeighbours neighbours;
    const std::vector<double> all = on_all_ranks(*mesh_.comm, mine);
    for (std::size_t at = 0; at + 3 <= all.size(); at += 3) neighbours.emplace(id_of(all[at]), std::pair(id_of(all[at + 1]), id_of(all[at + 2])));
    return neighbours;
  };
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    const Pair& pair = pairs_[p];
    const double margin = pair.reach;
    if (!is_rigid(mesh_, pair.slave.body) && !is_rigid(mesh_, pair.master.body) &&
        !bodies.boxes[pair.slave.body].widened(margin).meets(bodies.boxes[pair.master.body]))
      continue;
    const std::vector<FoundCell> cells = cells_on_all_ranks(*mesh_.comm, pieces(pair.slave, bodies.at), pieces(pair.master, bodies.at), pair.reach);
    if (cells.empty()) continue;
    std::set<GlobalOrdinal> of_slave, of_master;
    std::vector<EdgeCell> plain;
    for (const FoundCell& one : cells) {
      of_slave.insert({one.cell.slave.first, one.cell.slave.second});
      of_master.insert({one.cell.master.first, one.cell.master.second});
      plain.push_back(one.cell);
    }
    const EdgeNeighbours slave = own_neighbours(pair.slave, of_slave), master = own_neighbours(pair.master, of_master);
    for (LinePair& lines : lines_of(plain, slave, master)) {
      double nearest = std::numeric_limits<double>::max(), gap = 0.0;
      const std::set<GlobalOrdinal> on_line(lines.slave.nodes.begin(), lines.slave.nodes.end()),
          on_other(lines.master.nodes.begin(), lines.master.nodes.end());
      for (const FoundCell& one : cells)
        if (on_line.count(one.cell.slave.first) && on_line.count(one.cell.slave.second) && on_other.count(one.cell.master.first) &&
            on_other.count(one.cell.master.second) && one.distance < nearest)
          nearest = one.distance, gap = one.gap;
      for (const NodeLine* line : {&lines.slave, &lines.master}) {
        nodes.insert(line->nodes.begin(), line->nodes.end());
        for (const auto& [before, behind] : line->tangent) nodes.insert({before, behind});
      }
      found.push_back({p, std::move(lines), gap});
    }
  }
  EdgeSpots result;
  if (found.empty()) return result;
  result.nodes.assign(nodes.begin(), nodes.end());
  const std::vector<Eigen::Vector3d> places = places_on_all_ranks(mesh_, result.nodes, bodies.at);
  const auto place_of = [&](GlobalOrdinal node) {
    return static_cast<int>(std::lower_bound(result.nodes.begin(), result.nodes.end(), node) - result.nodes.begin());
  };
  const auto placed = [&](const NodeLine& line) {
    EdgeLine result;
    for (const GlobalOrdinal node : line.nodes) result.nodes.push_back(place_of(node));
    for (const auto& [before, behind] : line.tangent) result.tangent.push_back({place_of(before), place_of(behind)});
    return result;
  };
  for (const Found& one : found) {
    const Pair& pair = pairs_[one.pair];
    EdgePair edges{placed(one.lines.slave), placed(one.lines.master), one.lines.stiffness, one.lines.sign};
    const std::vector<EdgeCrossing> crossings = crossings_of(edges, places);
    if (crossings.empty()) {
      if (one.gap < -bodies.touching) continue;
    } else {
      if (ways_are_blocked(bodies, pair, crossings)) continue;
      edges = near_crossings(edges, crossings);
    }
    result.spots.push_back({pair.contact, pair.reach, one.lines.area, std::move(edges)});
  }
  if (result.spots.empty()) result.nodes.clear();
  return result;
}

}  // namespace mortise
