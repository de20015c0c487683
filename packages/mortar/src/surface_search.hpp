#pragma once
// Which master facets of any rank lie near each slave facet of this rank (2D).

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "mortise/core/types.hpp"

namespace mortise {

/// A facet as it travels between ranks: the ids and positions of its nodes.
struct PlacedFacet {
  std::array<GlobalOrdinal, 2> nodes{};
  std::array<std::array<double, 2>, 2> x{};
};

/// Distance of two line segments a_0 a_1 and b_0 b_1; 0 if they cross.
double segment_distance(const std::array<Eigen::Vector2d, 2>& a, const std::array<Eigen::Vector2d, 2>& b);

/// Collective: for each slave facet the master facets, of all ranks, within its radius, in ascending order of node ids.
/// Only one box per rank is known everywhere; master facets travel to the ranks whose box they meet.
/// @param radius  [slave] > 0
std::vector<std::vector<PlacedFacet>> facets_within(const Communicator& comm, const std::vector<PlacedFacet>& slave,
                                                    const std::vector<double>& radius, const std::vector<PlacedFacet>& master);

/// A straight line through a slave node along its unit normal.
struct NormalLine {
  Eigen::Vector2d x, normal;
};

/// Collective: for each line the distance along its normal (negative: behind x) of the nearest master facet, of all ranks and however far, that
/// faces the normal and that the line meets; no value if there is none. Master facets travel as in facets_within().
std::vector<std::optional<double>> distances_along_normals(const Communicator& comm, const std::vector<NormalLine>& lines,
                                                           const std::vector<PlacedFacet>& master);

}  // namespace mortise
