#include "model/edges/edge_lines.hpp"

#include <algorithm>
#include <numeric>
#include <set>

namespace mortise {
namespace {

PieceKey piece_of(GlobalOrdinal a, GlobalOrdinal b) { return a < b ? PieceKey{a, b} : PieceKey{b, a}; }

std::pair<GlobalOrdinal, GlobalOrdinal> neighbours_of(const EdgeNeighbours& neighbours, GlobalOrdinal node) {
  const auto found = neighbours.find(node);
  return found == neighbours.end() ? std::pair<GlobalOrdinal, GlobalOrdinal>(-1, -1) : found->second;
}

/// The node that follows `node`, on the other side than `from`; -1: none.
GlobalOrdinal beyond(const EdgeNeighbours& neighbours, GlobalOrdinal from, GlobalOrdinal node) {
  const auto [one, other] = neighbours_of(neighbours, node);
  if (one < 0) return -1;
  return one == from ? other : one;
}

/// A piece, and the ones that follow it.
std::vector<PieceKey> piece_and_next(const EdgeNeighbours& neighbours, const PieceKey& piece) {
  std::vector<PieceKey> result{piece};
  if (const GlobalOrdinal next = beyond(neighbours, piece.first, piece.second); next >= 0) result.push_back(piece_of(piece.second, next));
  if (const GlobalOrdinal next = beyond(neighbours, piece.second, piece.first); next >= 0) result.push_back(piece_of(piece.first, next));
  return result;
}

/// Pieces that follow one another, as a line. One that is closed is cut at its first node.
NodeLine line_of(const std::set<PieceKey>& pieces, const EdgeNeighbours& neighbours) {
  const PieceKey start = *pieces.begin();
  NodeLine line{{start.first, start.second}, {}};
  const auto follow = [&] {
    while (line.nodes.front() != line.nodes.back()) {
      const GlobalOrdinal next = beyond(neighbours, line.nodes[line.nodes.size() - 2], line.nodes.back());
      if (next < 0 || pieces.count(piece_of(line.nodes.back(), next)) == 0) return;
      line.nodes.push_back(next);
    }
  };
  follow();
  std::reverse(line.nodes.begin(), line.nodes.end());
  follow();
  const std::size_t last = line.nodes.size() - 1;
  for (std::size_t k = 0; k <= last; ++k) {
    const GlobalOrdinal node = line.nodes[k];
    const GlobalOrdinal before = k > 0 ? line.nodes[k - 1] : beyond(neighbours, line.nodes[1], node);
    const GlobalOrdinal behind = k < last ? line.nodes[k + 1] : beyond(neighbours, line.nodes[last - 1], node);
    line.tangent.emplace_back(before < 0 ? node : before, behind < 0 ? node : behind);
  }
  return line;
}

/// Numbers of sets that are joined.
class Union {
 public:
  explicit Union(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  std::size_t root(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) {
    const std::size_t of_a = root(a), of_b = root(b);
    parent_[std::max(of_a, of_b)] = std::min(of_a, of_b);
  }

 private:
  std::vector<std::size_t> parent_;
};

/// +1 if the line runs along the piece from its first to its second node.
double direction(const NodeLine& line, std::size_t k) { return line.nodes[k] < line.nodes[k + 1] ? 1.0 : -1.0; }

// Where the edges of some pieces turn the other way round they do not touch as the others do.
LinePair pair_of(const std::map<std::pair<PieceKey, PieceKey>, const EdgeCell*>& cells, NodeLine slave, NodeLine master) {
  LinePair result{std::move(slave), std::move(master), {}, 0.0, 0.0};
  const std::size_t rows = result.slave.nodes.size(), columns = result.master.nodes.size();
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns)), counts = sums;
  for (std::size_t k = 0; k + 1 < rows; ++k)
    for (std::size_t l = 0; l + 1 < columns; ++l) {
      const auto found =
          cells.find({piece_of(result.slave.nodes[k], result.slave.nodes[k + 1]), piece_of(result.master.nodes[l], result.master.nodes[l + 1])});
      if (found == cells.end()) continue;
      const double sign = found->second->sign * direction(result.slave, k) * direction(result.master, l);
      if (result.sign == 0.0) result.sign = sign;
      result.area = std::max(result.area, found->second->area);
      const auto row = static_cast<Eigen::Index>(k), column = static_cast<Eigen::Index>(l);
      sums.block(row, column, 2, 2).array() += sign == result.sign ? found->second->stiffness : 0.0;
      counts.block(row, column, 2, 2).array() += 1.0;
    }
  result.stiffness = (counts.array() > 0.0).select(sums.array() / counts.array().max(1.0), 0.0);
  return result;
}

}  // namespace

std::vector<LinePair> lines_of(const std::vector<EdgeCell>& cells, const EdgeNeighbours& slave, const EdgeNeighbours& master) {
  std::map<std::pair<PieceKey, PieceKey>, std::size_t> place;
  for (std::size_t c = 0; c < cells.size(); ++c) place.emplace(std::pair(cells[c].slave, cells[c].master), c);
  Union sets(cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (const PieceKey& one : piece_and_next(slave, cells[c].slave))
      for (const PieceKey& other : piece_and_next(master, cells[c].master))
        if (const auto found = place.find({one, other}); found != place.end()) sets.join(c, found->second);
  struct Members {
    std::set<PieceKey> slave, master;
    std::map<std::pair<PieceKey, PieceKey>, const EdgeCell*> cells;
  };
  std::map<std::size_t, Members> of_set;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    Members& members = of_set[sets.root(c)];
    members.slave.insert(cells[c].slave);
    members.master.insert(cells[c].master);
    members.cells.emplace(std::pair(cells[c].slave, cells[c].master), &cells[c]);
  }
  std::vector<LinePair> result;
  for (const auto& [root, members] : of_set) {
    LinePair pair = pair_of(members.cells, line_of(members.slave, slave), line_of(members.master, master));
    if (pair.stiffness.maxCoeff() > 0.0) result.push_back(std::move(pair));
  }
  return result;
}

}  // namespace mortise
