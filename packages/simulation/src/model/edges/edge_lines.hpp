#pragma once
// Pieces of edges that are near one another, put together to lines.

#include <map>
#include <utility>
#include <vector>

#include "mortise/mortar/edge_crossing.hpp"

namespace mortise {

/// Ids of the ends of a piece, ascending.
using PieceKey = std::pair<GlobalOrdinal, GlobalOrdinal>;

/// A slave piece and a master piece that are near one another.
struct EdgeCell {
  PieceKey slave, master;
  double stiffness = 0.0, sign = 1.0, area = 0.0;  ///< WedgeContact, for pieces that run from their first to their second node
};

/// Of nodes of edges those that follow on either side, -1: none.
using EdgeNeighbours = std::map<GlobalOrdinal, std::pair<GlobalOrdinal, GlobalOrdinal>>;

/// An edge by the ids of its nodes, with those that tangents are taken between.
struct NodeLine {
  std::vector<GlobalOrdinal> nodes;
  std::vector<std::pair<GlobalOrdinal, GlobalOrdinal>> tangent;
};

/// Two edges, before their nodes have places.
struct LinePair {
  NodeLine slave, master;
  Eigen::MatrixXd stiffness;  ///< [slave nodes x master nodes]
  double sign = 1.0;
  double area = 0.0;  ///< the largest of the cells
};

/// Cells that are next to one another along both edges belong to the same two lines.
std::vector<LinePair> lines_of(const std::vector<EdgeCell>& cells, const EdgeNeighbours& slave, const EdgeNeighbours& master);

}  // namespace mortise
