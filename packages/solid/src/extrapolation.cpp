#include "extrapolation.hpp"

#include <Eigen/QR>

#include "element_kernel.hpp"

namespace mortise {
namespace {

/// The polynomials about the centroid at a reference point: products of the coordinates that the bits of k name. Simplices have those with one at
/// most.
template <class Cell, class Position>
Eigen::RowVectorXd fitted_polynomials(const Position& xi) {
  constexpr bool is_simplex = Cell::corners == Cell::dimension + 1;
  Eigen::RowVectorXd values(static_cast<int>(Cell::corners));
  for (int k = 0, column = 0; k < 1 << Cell::dimension; ++k) {
    if (is_simplex && (k & (k - 1)) != 0) continue;
    double product = 1.0;
    for (int i = 0; i < Cell::dimension; ++i)
      if ((k >> i & 1) != 0) product *= xi[i] - Cell::centroid[i];
    values(column++) = product;
  }
  return values;
}

}  // namespace

Eigen::MatrixXd extrapolation_to_nodes(ElementType element, Kinematics kinematics) {
  return visit_element(element, [&](const auto& entry) -> Eigen::MatrixXd {
    using Cell = typename std::decay_t<decltype(entry)>::Cell;
    const auto rule = Cell::rule(quadrature_points<Cell>(kinematics));
    Eigen::MatrixXd at_points(rule.size(), Cell::corners), at_nodes(Cell::nodes, Cell::corners);
    for (std::size_t q = 0; q < rule.size(); ++q)
      at_points.row(static_cast<Eigen::Index>(q)) = fitted_polynomials<Cell>(rule[q].template position<Cell::dimension>());
    for (int a = 0; a < Cell::nodes; ++a) at_nodes.row(a) = fitted_polynomials<Cell>(Cell::node_positions[a]);
    return at_nodes * at_points.completeOrthogonalDecomposition().pseudoInverse();
  });
}

}  // namespace mortise
