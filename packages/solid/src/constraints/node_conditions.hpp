#pragma once
// Conditions on the displacement of one node along any directions.

#include <Eigen/Core>
#include <vector>

namespace mortise {

/// Conditions n_m . d = g_m, solved for as many components of d as they determine.
struct SolvedConditions {
  /// d_component = sum_i of_i d_i + sum_m weights_m g_m
  struct Component {
    int component = 0;
    Eigen::RowVectorXd of;       ///< [dim] 0 for components that are solved for
    Eigen::RowVectorXd weights;  ///< [conditions]
  };
  std::vector<Component> components;       ///< ascending
  std::vector<Eigen::RowVectorXd> checks;  ///< [conditions each] weights with which the g_m have to add up to 0
};

/// By Gauss-Jordan elimination with complete pivoting, so that no |of_i| is larger than 1 by more than round-off where one condition is solved for.
/// @param normals  [conditions x dim] unit vectors n_m
SolvedConditions solve_conditions(const Eigen::MatrixXd& normals);

}  // namespace mortise
