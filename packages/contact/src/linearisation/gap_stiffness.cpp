// Derivatives of those forces that are themselves derivatives of the gaps.

#include <Tpetra_Vector.hpp>
#include <algorithm>

#include "linearisation/condensation.hpp"

namespace mortise::detail {

// With p = z_j . n_j and z' = z_j - p n_j the force of a multiplier is  f_m = -p dg_j/dx_m + c_jm z'. So at fixed z
//   df_m = -p d(dg_j/dx_m) - dg_j/dx_m (z_j . dn_j) + dc_jm z' - c_jm ( n_j (z_j . dn_j) + p dn_j ).
// Its third term comes from the facets, by add_stiffness().
void add_gap_stiffness(const EvaluatedLaws& laws, std::size_t p, SystemScatter& scatter, Matrix& system) {
  const PairEvaluation& pair = laws.contact->pairs[p];
  const int dimension = pair.dimension();
  const NodePositions& positions = scatter.positions(p);
  std::vector<LocalOrdinal> columns;
  std::vector<double> values, pressures;
  const auto take_columns = [&](const std::vector<LocalOrdinal>& nodes) {
    columns.clear();
    for (const LocalOrdinal node : nodes)
      for (int i = 0; i < dimension; ++i) columns.push_back(positions.column[dimension * node + i]);
    values.resize(columns.size());
  };
  for (std::size_t s = 0; s < pair.slave_nodes().size(); ++s) {
    const SpatialVector& zs = laws.multipliers[p][s].z;
    pressures.push_back(pair.gap_pressure(s, zs));
    if (zs.isZero(0.0)) continue;
    const NodeRow& row = pair.row(s);
    const std::vector<LocalOrdinal>& coupled = pair.coupled_nodes(s);
    const Eigen::RowVectorXd turn = zs.transpose() * row.dnormal;
    const Eigen::MatrixXd change = row.normal * turn + pressures.back() * row.dnormal;
    take_columns(coupled);
    for (const LocalOrdinal node : pair.loaded_nodes(s)) {
      const auto c = static_cast<std::size_t>(std::lower_bound(coupled.begin(), coupled.end(), node) - coupled.begin());
      const double coefficient = node == pair.slave_nodes()[s].local_node ? row.D : row.coefficients[c];
      for (int i = 0; i < dimension; ++i) {
        Eigen::Map<Eigen::RowVectorXd>(values.data(), turn.size()) = -row.dgap[dimension * c + i] * turn - coefficient * change.row(i);
        scatter.add(system, positions, node, i, columns, values);
      }
    }
  }
  for (const GapCurvature& facet : pair.pair().gap_curvatures(*laws.contact->positions, *pair.geometry(), pair.history(), pressures)) {
    take_columns(facet.columns);
    for (std::size_t r = 0; r < columns.size(); ++r) {
      const auto row = static_cast<Eigen::Index>(r);
      Eigen::Map<Eigen::RowVectorXd>(values.data(), facet.hessian.cols()) = -facet.hessian.row(row);
      scatter.add(system, positions, facet.columns[r / dimension], static_cast<int>(r) % dimension, columns, values);
    }
  }
}

}  // namespace mortise::detail
