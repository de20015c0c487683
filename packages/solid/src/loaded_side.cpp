#include "loaded_side.hpp"

#include <algorithm>
#include <stdexcept>

#include "load_support.hpp"
#include "mortise/shape/line2.hpp"
#include "mortise/shape/line3.hpp"
#include "mortise/shape/quadrature.hpp"
#include "mortise/shape/quadrilateral4.hpp"
#include "mortise/shape/quadrilateral8.hpp"
#include "mortise/shape/triangle3.hpp"
#include "mortise/shape/triangle6.hpp"

namespace mortise {
namespace {

template <class Line>
std::vector<SidePoint> line_points(int points) {
  std::vector<SidePoint> rule;
  for (const LinePoint& at : gauss_legendre(points)) {
    SidePoint& point = rule.emplace_back();
    const auto N = Line::values(at.xi), gradient = Line::gradients(at.xi);
    std::copy(N.begin(), N.end(), point.N.begin());
    for (int a = 0; a < Line::nodes; ++a) point.gradient[a][0] = gradient[a];
    point.weight = at.weight;
  }
  return rule;
}

template <class Cell>
std::vector<SidePoint> cell_points(int points) {
  std::vector<SidePoint> rule;
  for (const CellPoint& at : cell_rule(Cell::shape, points)) {
    SidePoint& point = rule.emplace_back();
    const auto N = Cell::values(at.template position<2>());
    const auto gradient = Cell::gradients(at.template position<2>());
    std::copy(N.begin(), N.end(), point.N.begin());
    std::copy(gradient.begin(), gradient.end(), point.gradient.begin());
    point.weight = at.weight;
  }
  return rule;
}

const std::vector<SidePoint>& side_rule(CellShape side) {
  static const auto line2 = line_points<Line2>(3), line3 = line_points<Line3>(4);
  static const auto triangle3 = cell_points<Triangle3>(7), triangle6 = cell_points<Triangle6>(7);
  static const auto quadrilateral4 = cell_points<Quadrilateral4>(9), quadrilateral8 = cell_points<Quadrilateral8>(16);
  switch (side) {
    case CellShape::line2:
      return line2;
    case CellShape::line3:
      return line3;
    case CellShape::triangle3:
      return triangle3;
    case CellShape::triangle6:
      return triangle6;
    case CellShape::quadrilateral4:
      return quadrilateral4;
    case CellShape::quadrilateral8:
      return quadrilateral8;
    default:
      throw std::logic_error("a 3D cell is no side");
  }
}

}  // namespace

SidePosition LoadedSide::at(const SidePoint& point, const Mesh& mesh, const double* displacement) const {
  SidePosition result;
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    Eigen::Vector3d x = Eigen::Map<const Eigen::Vector3d>(mesh.coordinates[nodes[a]].data());
    if (displacement != nullptr)
      for (int i = 0; i < dimension; ++i) x(i) += displacement[dimension * nodes[a] + i];
    result.position += point.N[a] * x;
    for (int i = 0; i < dimension - 1; ++i) result.tangents[i] += point.gradient[a][i] * x;
  }
  if (dimension == 2) result.tangents[1] = Eigen::Vector3d::UnitZ();
  result.area = result.tangents[0].cross(result.tangents[1]);
  return result;
}

std::vector<LoadedSide> sides_at_owned_nodes(const Mesh& mesh, const Located<std::string>& set) {
  std::vector<LoadedSide> sides;
  look_up(mesh, [&] {
    for (const Side& side : require_side_set(mesh, set).sides) {
      const auto nodes = mesh.side_nodes(side);
      if (std::none_of(nodes.begin(), nodes.end(), [&](LocalOrdinal node) { return node < mesh.owned_count(); })) continue;
      sides.push_back({{nodes.begin(), nodes.end()}, mesh.dimension, &side_rule(topology(mesh.blocks[side.block].shape).side)});
    }
  });
  return sides;
}

}  // namespace mortise
