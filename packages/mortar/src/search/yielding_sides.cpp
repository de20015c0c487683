// Two sides of the master meet at a convex corner, such as the flat face and the wall of a punch. A smooth slave facet that leaves the flat face at
// the angle theta is seen by both. Once theta is above 3 degrees, lines along its normals run up to the wall, however far away that is. With the
// abscissa s beyond the corner the gap is then
//   g = 0 (s < 0),   g = s / sin theta (s > 0),
// which is not linear. The dual functions find the gap at a node of linear gaps only, so this one holds the facet's closed node deep in the flat
// face. And the facet's cover jumps to 1 where theta passes 3 degrees, and with it ties, weights and forces: no solution stands on either side of
// that.
//
// So a side yields to the one that faces the facet better. It yields where lines along the facet's normals run up to it at more than 60 degrees to
// its own normal: there the gap is more than twice the distance. A wedge that stands in a facet with both of its sides is touched with both. A
// surface that goes on smoothly can touch a side only where it is turned towards it. Where it ends, or has a corner, a point may touch a side at any
// angle: nothing yields.

#include "search/yielding_sides.hpp"

#include <boost/math/constants/constants.hpp>
#include <cmath>

namespace mortise {
namespace {

/// Turn of the master above which a node of it is a corner, as for the slave.
constexpr double sharp = 30.0 * boost::math::double_constants::degree;

/// -n . n_m = distance over gap below which a side yields.
constexpr double least_facing = 0.5;

/// From a to b, to the left.
double turn_between(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)); }

}  // namespace

// The surface turns to the left at a convex corner. Facets beyond the one at the corner are of its side.
std::vector<char> yielding_facets(const Facet<LocalOrdinal>& slave, const std::vector<Facet<LocalOrdinal>>& masters, const Positions<2>& x) {
  const auto along = [&](const Facet<LocalOrdinal>& facet) { return Eigen::Vector2d((x[facet[1]] - x[facet[0]]).normalized()); };
  const Eigen::Vector2d t = along(slave);
  const std::size_t count = masters.size();
  std::vector<Eigen::Vector2d> directions;
  std::vector<double> facing;  // -n . n_m = -t . t_m
  for (const Facet<LocalOrdinal>& facet : masters) {
    directions.push_back(along(facet));
    facing.push_back(-t.dot(directions.back()));
  }
  std::vector<char> yields(count, 0);
  const auto yield = [&](std::size_t facet) {
    const bool is_new = yields[facet] == 0 && facing[facet] < least_facing;
    if (is_new) yields[facet] = 1;
    return is_new;
  };
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t first = 0; first < count; ++first)
      for (std::size_t second = 0; second < count; ++second) {
        if (first == second || masters[first][1] != masters[second][0]) continue;
        const double turn = turn_between(directions[first], directions[second]);
        if (turn > sharp)
          changed |= yield(facing[first] < facing[second] ? first : second);
        else if (turn > -sharp && yields[first] != yields[second])
          changed |= yield(yields[first] != 0 ? second : first);
      }
  }
  return yields;
}

bool any_may_yield(const std::vector<PlacedFacet<2>>& masters, double turn) {
  const auto along = [](const PlacedFacet<2>& facet) { return Eigen::Vector2d(facet.points()[1] - facet.points()[0]); };
  for (const PlacedFacet<2>& first : masters)
    for (const PlacedFacet<2>& second : masters)
      if (first.nodes[1] == second.nodes[0] && turn_between(along(first), along(second)) > sharp - turn) return true;
  return false;
}

}  // namespace mortise
