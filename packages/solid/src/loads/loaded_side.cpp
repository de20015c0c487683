#include "mortise/solid/loaded_side.hpp"

#include <algorithm>
#include <stdexcept>

#include "loads/load_support.hpp"
#include "mortise/solid/bodies.hpp"

namespace mortise {
namespace {

template <class Cell>
std::vector<SidePoint> make_side_rule() {
  std::vector<SidePoint> rule;
  for (const CellPoint& at : Cell::rule(Cell::side_points)) {
    SidePoint& point = rule.emplace_back();
    const auto xi = at.template position<Cell::dimension>();
    const auto N = Cell::values(xi);
    const auto gradient = Cell::gradients(xi);
    std::copy(N.begin(), N.end(), point.N.begin());
    for (int a = 0; a < Cell::nodes; ++a) std::copy(gradient[a].begin(), gradient[a].end(), point.gradient[a].begin());
    point.weight = at.weight;
  }
  return rule;
}

const std::vector<SidePoint>& side_rule(CellShape side) {
  return visit_cell(side, [](auto cell) -> const std::vector<SidePoint>& {
    using Cell = decltype(cell);
    if constexpr (Cell::dimension < 3) {
      static const auto rule = make_side_rule<Cell>();
      return rule;
    }
    throw std::logic_error("a 3D cell is no side");
  });
}

}  // namespace

SidePosition LoadedSide::at(const SidePoint& point, const Mesh& mesh, const FieldView<const double>& displacement) const {
  SidePosition result;
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    Eigen::Vector3d x = Eigen::Map<const Eigen::Vector3d>(mesh.coordinates[nodes[a]].data());
    if (displacement.values != nullptr)
      for (int i = 0; i < dimension; ++i) x(i) += displacement(nodes[a], i);
    result.position += point.N[a] * x;
    for (int i = 0; i < dimension - 1; ++i) result.tangents[i] += point.gradient[a][i] * x;
  }
  if (dimension == 2) result.tangents[1] = Eigen::Vector3d::UnitZ();
  result.area = result.tangents[0].cross(result.tangents[1]);
  return result;
}

double depth(Kinematics kinematics, double thickness, double radius) {
  if (kinematics == Kinematics::three_dimensional) return 1.0;
  return kinematics == Kinematics::axisymmetric ? 2.0 * EIGEN_PI * radius : thickness;
}

double reference_area(const Bodies& bodies, const LoadedSide& side, const SidePoint& point) {
  const SidePosition at = side.at(point, *bodies.mesh(), {});
  return point.weight * at.area.norm() * bodies.depth(at.position[0]);
}

LoadedSide side_of(const Mesh& mesh, const Side& side) {
  const auto nodes = mesh.side_nodes(side);
  return {{nodes.begin(), nodes.end()}, mesh.dimension, &side_rule(mesh.side_shape(side))};
}

LoadedSide side_of(const Mesh& mesh, const SurfaceFacet& facet) {
  const auto shape = [&] {
    if (mesh.dimension == 2) return facet.size() == 2 ? CellShape::line2 : CellShape::line3;
    switch (facet.size()) {
      case 3:
        return CellShape::triangle3;
      case 4:
        return CellShape::quadrilateral4;
      case 6:
        return CellShape::triangle6;
      case 8:
        return CellShape::quadrilateral8;
      default:
        throw std::logic_error("a facet of no shape");
    }
  }();
  LoadedSide side{{}, mesh.dimension, &side_rule(shape)};
  for (const GlobalOrdinal node : facet) side.nodes.push_back(mesh.local_nodes->getLocalElement(node));
  return side;
}

std::vector<LoadedSide> owned_sides(const Mesh& mesh, const Located<std::string>& set) {
  std::vector<LoadedSide> sides;
  look_up(mesh, [&] {
    const SideSet& all = require_side_set(mesh, set);
    for (LocalOrdinal n = 0; n < all.owned; ++n) sides.push_back(side_of(mesh, all.sides[n]));
  });
  return sides;
}

std::vector<LoadedSide> sides_at_owned_nodes(const Mesh& mesh, const Located<std::string>& set) {
  std::vector<LoadedSide> sides;
  look_up(mesh, [&] {
    for (const Side& side : require_side_set(mesh, set).sides) {
      LoadedSide one = side_of(mesh, side);
      if (std::none_of(one.nodes.begin(), one.nodes.end(), [&](LocalOrdinal node) { return node < mesh.owned_count(); })) continue;
      sides.push_back(std::move(one));
    }
  });
  return sides;
}

}  // namespace mortise
