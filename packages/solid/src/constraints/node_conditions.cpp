#include "constraints/node_conditions.hpp"

#include <algorithm>
#include <cmath>

namespace mortise {
namespace {

constexpr double no_pivot = 1e-10;     // directions that differ by less are one: angles are given with more digits, and round-off is 1e-16
constexpr double no_coupling = 1e-12;  // cos(90 degrees) and the like

}  // namespace

SolvedConditions solve_conditions(const Eigen::MatrixXd& normals) {
  const Eigen::Index count = normals.rows(), dimension = normals.cols();
  Eigen::MatrixXd E(count, dimension + count);  // (n | weights)
  E << normals, Eigen::MatrixXd::Identity(count, count);
  std::vector<Eigen::Index> pivots;  // [solved] columns
  for (Eigen::Index row = 0; row < std::min(count, dimension); ++row) {
    Eigen::Index at = 0, column = 0;
    // Columns that are solved for hold zeros below.
    if (E.block(row, 0, count - row, dimension).cwiseAbs().maxCoeff(&at, &column) < no_pivot) break;
    E.row(row).swap(E.row(row + at));
    E.row(row) /= E(row, column);
    for (Eigen::Index other = 0; other < count; ++other) {
      if (other == row) continue;
      E.row(other) -= E(other, column) * E.row(row).eval();
      E(other, column) = 0.0;
    }
    pivots.push_back(column);
  }
  SolvedConditions solved;
  for (std::size_t row = 0; row < pivots.size(); ++row) {
    SolvedConditions::Component one;
    one.component = static_cast<int>(pivots[row]);
    one.of = -E.row(static_cast<Eigen::Index>(row)).head(dimension);
    for (const Eigen::Index pivot : pivots) one.of[pivot] = 0.0;
    one.of = (one.of.array().abs() < no_coupling).select(0.0, one.of);
    one.weights = E.row(static_cast<Eigen::Index>(row)).tail(count);
    solved.components.push_back(one);
  }
  std::sort(solved.components.begin(), solved.components.end(), [](const auto& a, const auto& b) { return a.component < b.component; });
  for (Eigen::Index row = static_cast<Eigen::Index>(pivots.size()); row < count; ++row) solved.checks.emplace_back(E.row(row).tail(count));
  return solved;
}

}  // namespace mortise
