#pragma once
// Straight pieces of sharp edges of two surfaces that come near one another.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "mortise/core/types.hpp"

namespace mortise {

/// A straight piece of an edge between two facets.
struct EdgePiece {
  std::array<GlobalOrdinal, 2> nodes{};   ///< ids of its ends
  std::array<Eigen::Vector3d, 2> ends;    ///< positions of its ends
  std::array<Eigen::Vector3d, 2> beside;  ///< a point of each facet that is not on the edge
  double compliance = 0.0;                ///< (1 - nu^2)/E of the body; 0: rigid
};

/// Two pieces within reach of one another.
struct NearPieces {
  std::size_t slave = 0;  ///< place among the slave pieces of this rank
  EdgePiece master;       ///< of any rank
};

/// Distance of two segments.
double distance(const EdgePiece& one, const EdgePiece& other);

/// For the slave pieces of this rank the master pieces of all ranks within `reach`, in ascending order of their nodes. Master pieces travel to the
/// ranks whose box of slave pieces they meet. Collective.
std::vector<NearPieces> near_pieces(const Communicator& comm, const std::vector<EdgePiece>& slaves, const std::vector<EdgePiece>& masters,
                                    double reach);

}  // namespace mortise
