#include "mortise/mortar/near_edges.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <tuple>

#include "exchange/exchange.hpp"
#include "mortise/mortar/line_crossings.hpp"

namespace mortise {
namespace {

namespace geometry = boost::geometry;
using TreePoint = geometry::model::point<double, 3, geometry::cs::cartesian>;
using TreeBox = geometry::model::box<TreePoint>;

TreePoint tree_point(const Eigen::Vector3d& x) { return {x[0], x[1], x[2]}; }
TreeBox tree_box(const Box3& box) { return {tree_point(box.low), tree_point(box.high)}; }

/// A piece as it travels.
struct SentPiece {
  std::array<double, 13> values{};
  std::array<GlobalOrdinal, 2> nodes{};
};

SentPiece sent(const EdgePiece& piece) {
  SentPiece result{{}, piece.nodes};
  double* to = result.values.data();
  for (const auto* points : {&piece.ends, &piece.beside})
    for (const Eigen::Vector3d& x : *points) to = std::copy(x.data(), x.data() + 3, to);
  *to = piece.compliance;
  return result;
}

EdgePiece received(const SentPiece& from) {
  EdgePiece piece;
  piece.nodes = from.nodes;
  for (int e = 0; e < 2; ++e) {
    piece.ends[static_cast<std::size_t>(e)] = Eigen::Map<const Eigen::Vector3d>(&from.values[static_cast<std::size_t>(3 * e)]);
    piece.beside[static_cast<std::size_t>(e)] = Eigen::Map<const Eigen::Vector3d>(&from.values[static_cast<std::size_t>(6 + 3 * e)]);
  }
  piece.compliance = from.values[12];
  return piece;
}

Box3 box_of(const EdgePiece& piece) {
  Box3 box;
  for (const Eigen::Vector3d& x : piece.ends) box.enclose(x);
  return box;
}

double to_segment(const Eigen::Vector3d& x, const EdgePiece& piece) {
  const Eigen::Vector3d along = piece.ends[1] - piece.ends[0];
  const double s = std::clamp((x - piece.ends[0]).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (piece.ends[0] + s * along - x).norm();
}

/// The box of the pieces of each rank, empty where there are none. Collective.
std::vector<Box3> boxes_of_ranks(const Communicator& comm, const Box3& mine) {
  std::vector<double> own, all(6 * static_cast<std::size_t>(comm.getSize()));
  for (int i = 0; i < 3; ++i) own.insert(own.end(), {mine.low[i], mine.high[i]});
  Teuchos::gatherAll(comm, 6, own.data(), static_cast<int>(all.size()), all.data());
  std::vector<Box3> boxes(static_cast<std::size_t>(comm.getSize()));
  for (std::size_t r = 0; r < boxes.size(); ++r)
    for (Eigen::Index i = 0; i < 3; ++i) {
      boxes[r].low[i] = all[6 * r + 2 * static_cast<std::size_t>(i)];
      boxes[r].high[i] = all[6 * r + 2 * static_cast<std::size_t>(i) + 1];
    }
  return boxes;
}

}  // namespace

// The least of the distances of the four ends to the other segment, and of the lines where their nearest points lie within both segments.
double distance(const EdgePiece& one, const EdgePiece& other) {
  double least =
      std::min({to_segment(one.ends[0], other), to_segment(one.ends[1], other), to_segment(other.ends[0], one), to_segment(other.ends[1], one)});
  const Eigen::Vector3d a = one.ends[1] - one.ends[0], b = other.ends[1] - other.ends[0], w = other.ends[0] - one.ends[0];
  const double aa = a.dot(a), ab = a.dot(b), bb = b.dot(b), determinant = aa * bb - ab * ab;
  if (!(determinant > 1e-12 * aa * bb)) return least;
  const double s = (w.dot(a) * bb - w.dot(b) * ab) / determinant, t = (w.dot(a) * ab - w.dot(b) * aa) / determinant;
  if (s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0) least = std::min(least, (w + t * b - s * a).norm());
  return least;
}

std::vector<NearPieces> near_pieces(const Communicator& comm, const std::vector<EdgePiece>& slaves, const std::vector<EdgePiece>& masters,
                                    double reach) {
  Box3 mine;
  std::vector<std::pair<TreeBox, std::size_t>> entries;
  for (std::size_t s = 0; s < slaves.size(); ++s) {
    const Box3 box = box_of(slaves[s]).widened(reach);
    mine.enclose(box.low);
    mine.enclose(box.high);
    entries.emplace_back(tree_box(box), s);
  }
  const std::vector<Box3> boxes = boxes_of_ranks(comm, mine);
  std::vector<NearPieces> found;
  if (std::all_of(boxes.begin(), boxes.end(), [](const Box3& box) { return box.empty(); })) return found;
  std::vector<std::vector<SentPiece>> send(boxes.size());
  for (const EdgePiece& piece : masters)
    for (std::size_t r = 0; r < boxes.size(); ++r)
      if (!boxes[r].empty() && boxes[r].meets(box_of(piece))) send[r].push_back(sent(piece));
  const geometry::index::rtree<std::pair<TreeBox, std::size_t>, geometry::index::rstar<16>> tree(entries);
  std::vector<std::pair<TreeBox, std::size_t>> hits;
  for (const auto& part : all_to_all(comm, send))
    for (const SentPiece& one : part) {
      const EdgePiece master = received(one);
      hits.clear();
      tree.query(geometry::index::intersects(tree_box(box_of(master))), std::back_inserter(hits));
      for (const auto& [box, s] : hits)
        if (distance(slaves[s], master) <= reach) found.push_back({s, master});
    }
  std::sort(found.begin(), found.end(),
            [](const NearPieces& a, const NearPieces& b) { return std::tie(a.slave, a.master.nodes) < std::tie(b.slave, b.master.nodes); });
  return found;
}

}  // namespace mortise
