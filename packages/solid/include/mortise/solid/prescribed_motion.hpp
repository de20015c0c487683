#pragma once
// Dirichlet conditions: components of the displacement prescribed on sets of nodes.

#include <optional>
#include <string>
#include <vector>

#include "mortise/core/parameters.hpp"
#include "mortise/solid/bodies.hpp"

namespace mortise {

/// One condition. A component without a function is free. Axisymmetric: x is r, y is z.
struct BoundaryConditionOptions {
  Located<std::string> set;                                      ///< node or side set
  std::optional<ScalarFunction> x, y, z;                         ///< displacement [length]; no value: free; z only in three dimensions
  std::optional<ScalarFunction> rotation;                        ///< of a reference point of the plane [degrees], counterclockwise; no value: free
  std::array<std::optional<ScalarFunction>, 3> rotation_vector;  ///< of a reference point in 3D [degrees]; no value: free
  void describe(Parameters& parameters);
};

/// All prescribed dofs of this rank and their values over time: those of the conditions, and 0 for dofs of reference points that nothing follows.
class PrescribedMotion {
 public:
  /// Collective.
  /// @throws InputError on all ranks for
  /// * a set that does not exist,
  /// * a condition that prescribes nothing, z in 2D or a node that follows a reference point,
  /// * a dof that two conditions prescribe differently (naming both).
  PrescribedMotion(const Bodies& bodies, const std::vector<Named<BoundaryConditionOptions>>& conditions);

  /// Owned dofs (local indices in Bodies::dofs()), ascending.
  const std::vector<LocalOrdinal>& dofs() const { return dofs_; }

  /// Their values at pseudo-time `time`, in the same order. A function without a finite value is put into `failure` if that is empty (kind input),
  /// its value is NaN; nothing throws on one rank only.
  std::vector<double> values(double time, std::optional<StepFailure>& failure) const;

 private:
  struct Source {
    LocalOrdinal function;
    std::array<double, 3> position;
    double factor = 1.0;
  };
  double value(const Source& source, double time, std::optional<StepFailure>& failure) const;

  std::vector<ScalarFunction> functions_;
  std::vector<LocalOrdinal> dofs_;
  std::vector<Source> sources_;  ///< one for each dof
};

}  // namespace mortise
