#include "mortise/solid/nodal_means.hpp"

#include <Eigen/QR>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "mortise/solid/element_points.hpp"

namespace mortise {
namespace {

/// Those of the products of coordinates, named by the bits of k, that `has` tells to take.
template <std::size_t dimension, class Has>
Eigen::RowVectorXd products_of_coordinates(const std::array<double, dimension>& xi, const Has& has) {
  std::vector<double> values;
  for (unsigned k = 0; k < 1u << dimension; ++k) {
    if (!has(k)) continue;
    values.push_back(1.0);
    for (std::size_t i = 0; i < dimension; ++i)
      if ((k >> i & 1u) != 0) values.back() *= xi[i];
  }
  return Eigen::Map<const Eigen::RowVectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// The functions about the centroid that are fitted, at a reference point of a cell. Pyramids have no others than those of the rays: a strain is
/// constant along each.
template <class Cell, std::size_t dimension>
Eigen::RowVectorXd fitted_functions(const std::array<double, dimension>& xi) {
  if constexpr (std::is_base_of_v<ReferencePyramid, Cell>) {
    return products_of_coordinates(Cell::ray(xi), [](unsigned) { return true; });
  } else {
    std::array<double, dimension> from_centroid{};
    for (std::size_t i = 0; i < dimension; ++i) from_centroid[i] = xi[i] - Cell::centroid[i];
    return products_of_coordinates(from_centroid, [](unsigned k) {
      constexpr bool is_simplex = Cell::corners == Cell::dimension + 1, is_wedge = std::is_base_of_v<ReferenceWedge, Cell>;
      constexpr unsigned linear = is_simplex ? ~0u : is_wedge ? 3u : 0u;  // coordinates of which a product has one at most
      return ((k & linear) & ((k & linear) - 1)) == 0;
    });
  }
}

/// Points of the rule that stresses are computed at.
template <class Cell>
int quadrature_points([[maybe_unused]] Kinematics kinematics) {
  if constexpr (Cell::dimension == 2)
    if (kinematics == Kinematics::axisymmetric) return ElementGeometry<Cell, true>::stiffness_points;
  return ElementGeometry<Cell>::stiffness_points;
}

}  // namespace

Eigen::MatrixXd extrapolation_to_nodes(CellShape shape, Kinematics kinematics) {
  return visit_cell(shape, [&](auto cell) -> Eigen::MatrixXd {
    using Cell = decltype(cell);
    if constexpr (Cell::dimension == 1) {
      throw std::logic_error("a line is no element");
    } else {
      const auto rule = Cell::rule(quadrature_points<Cell>(kinematics));
      const Eigen::Index functions = fitted_functions<Cell>(Cell::centroid).size();
      Eigen::MatrixXd at_points(rule.size(), functions), at_nodes(Cell::nodes, functions);
      for (std::size_t q = 0; q < rule.size(); ++q)
        at_points.row(static_cast<Eigen::Index>(q)) = fitted_functions<Cell>(rule[q].template position<Cell::dimension>());
      for (int a = 0; a < Cell::nodes; ++a) at_nodes.row(a) = fitted_functions<Cell>(Cell::node_positions[a]);
      return at_nodes * at_points.completeOrthogonalDecomposition().pseudoInverse();
    }
  });
}

NodalMeans::NodalMeans(RCP<const Mesh> mesh, int components)
    : mesh_(std::move(mesh)),
      components_(components),
      sums_(static_cast<std::size_t>(components) * mesh_->owned_count(), 0.0),
      elements_(mesh_->owned_count(), 0) {}

void NodalMeans::add(const Block& block, LocalOrdinal element, int point, const Eigen::MatrixXd& extrapolation, const double* values) {
  const LocalOrdinal* nodes = block.nodes(element);
  for (int a = 0; a < block.nodes_per_element; ++a) {
    if (nodes[a] >= mesh_->owned_count()) continue;
    if (point == 0) ++elements_[nodes[a]];
    double* sum = sums_.data() + static_cast<std::size_t>(components_) * nodes[a];
    for (int c = 0; c < components_; ++c) sum[c] += extrapolation(a, point) * values[c];
  }
}

RCP<MultiVector> NodalMeans::result() const {
  const auto result = rcp(new MultiVector(mesh_->owned_nodes, components_));
  const auto view = result->getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (std::size_t node = 0; node < elements_.size(); ++node)
    for (int c = 0; c < components_; ++c) view(node, c) = elements_[node] > 0 ? sums_[components_ * node + c] / elements_[node] : 0.0;
  return result;
}

}  // namespace mortise
