#pragma once
// Mass that couples nodes, the same in each direction.

#include <map>
#include <vector>

#include "mortise/core/types.hpp"
#include "mortise/solid/bodies.hpp"

namespace mortise {

/// M of displacements, as a matrix of nodes. Collective in all members but the accessor.
class NodalMass {
 public:
  /// @param matrix  [owned nodes squared], filled
  /// @param space   displacements first
  NodalMass(RCP<const Matrix> matrix, std::shared_ptr<const FieldSpace> space) : matrix_(std::move(matrix)), space_(std::move(space)) {}

  const Matrix& matrix() const { return *matrix_; }

  /// M v of vectors on the owned dofs; 0 in the rows of other fields.
  RCP<Vector> times(const Vector& v) const;
  /// jacobian += factor M; `jacobian` is open, and its rows hold the entries.
  void add_to(Matrix& jacobian, double factor) const;

 private:
  RCP<const Matrix> matrix_;
  std::shared_ptr<const FieldSpace> space_;
};

/// The consistent mass of all bodies, [owned nodes squared]. Collective.
RCP<const Matrix> consistent_mass(const Bodies& bodies);
/// A diagonal matrix of nodes. Collective.
RCP<const Matrix> mass_of_nodes(const RCP<const Map>& owned_nodes, const std::vector<double>& masses);

/// Rows of a mass matrix of nodes while it is made: [owned nodes] by the id of the other node.
using MassRows = std::vector<std::map<GlobalOrdinal, double>>;
/// A matrix of nodes. Collective.
RCP<const Matrix> mass_of_rows(const RCP<const Map>& owned_nodes, const MassRows& rows);

/// P^T M P. Collective.
RCP<const Matrix> mass_of_extension(const Matrix& M, const Matrix& P);

/// A matrix of nodes as one of dofs, which holds for each component of the first field. Collective.
RCP<const Matrix> for_each_component(const Matrix& of_nodes, const FieldSpace& space);

}  // namespace mortise
