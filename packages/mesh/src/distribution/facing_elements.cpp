#include "distribution/facing_elements.hpp"

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <functional>
#include <iterator>

namespace mortise {
namespace {

namespace geometry = boost::geometry;
using Middle = geometry::model::point<double, 3, geometry::cs::cartesian>;

struct ContactSide {
  Middle middle;
  int body = 0;
  GlobalOrdinal element = 0;
  int side = 0;
};

Middle middle_of(const BodySet& bodies, GlobalOrdinal element, int side) {
  const auto ids = bodies.element_nodes(element);
  SpatialPoint sum{};
  const auto add = [&](GlobalOrdinal node) {
    const SpatialPoint x = bodies.coordinate(node);
    std::transform(sum.begin(), sum.end(), x.begin(), sum.begin(), std::plus<>());
  };
  double count = 0.0;
  if (side == the_cell_itself) {
    count = static_cast<double>(ids.size());
    for (const GlobalOrdinal node : ids) add(node);
  } else {
    const auto& places = bodies.cell_of(element).sides[side].nodes;
    count = static_cast<double>(places.size());
    for (const int place : places) add(ids[place]);
  }
  return {sum[0] / count, sum[1] / count, sum[2] / count};
}

std::vector<ContactSide> contact_sides_of(const BodySet& bodies, const std::vector<std::vector<bool>>& is_contact) {
  std::vector<ContactSide> found;
  for (GlobalOrdinal element = 0; element < bodies.element_count(); ++element) {
    const int body = bodies.body_of_element(element);
    for (const SurfaceSide& side : bodies.surface_sides(element))
      if (is_contact[body][side.name + 1]) {
        const bool is_known = !found.empty() && found.back().element == element && found.back().side == side.side;  // by another name
        if (!is_known) found.push_back({middle_of(bodies, element, side.side), body, element, side.side});
      }
  }
  return found;
}

using Entry = std::pair<Middle, std::size_t>;
using Tree = geometry::index::rtree<Entry, geometry::index::rstar<16>>;

constexpr std::size_t none = static_cast<std::size_t>(-1);

/// For each side the nearest one of another body.
std::vector<std::size_t> nearest_of_other_bodies(const std::vector<ContactSide>& sides, int bodies) {
  std::vector<Tree> trees(static_cast<std::size_t>(bodies));
  for (std::size_t s = 0; s < sides.size(); ++s) trees[sides[s].body].insert({sides[s].middle, s});
  std::vector<std::size_t> nearest(sides.size(), none);
  for (std::size_t s = 0; s < sides.size(); ++s) {
    double least = 0.0;
    for (int body = 0; body < bodies; ++body) {
      if (body == sides[s].body || trees[body].empty()) continue;
      const Entry found = *trees[body].qbegin(geometry::index::nearest(sides[s].middle, 1));
      const double distance = geometry::comparable_distance(sides[s].middle, found.first);
      if (nearest[s] == none || distance < least) {
        least = distance;
        nearest[s] = found.second;
      }
    }
  }
  return nearest;
}

}  // namespace

std::vector<std::array<GlobalOrdinal, 2>> facing_elements(const BodySet& bodies, const std::vector<std::vector<bool>>& is_contact) {
  const std::vector<ContactSide> sides = contact_sides_of(bodies, is_contact);
  const std::vector<std::size_t> nearest = nearest_of_other_bodies(sides, bodies.size());
  std::vector<std::array<GlobalOrdinal, 2>> pairs;
  for (std::size_t s = 0; s < sides.size(); ++s)
    if (nearest[s] != none && nearest[s] > s && nearest[nearest[s]] == s) pairs.push_back({sides[s].element, sides[nearest[s]].element});
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace mortise
