#pragma once
// Dirichlet conditions: components of the displacement prescribed on sets of nodes.

#include <array>
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
  std::vector<double> x_axis, y_axis;                            ///< directions of x and y, in the model's axes; empty: the model's axes
  void describe(Parameters& parameters);
};

/// Unit vectors along the condition's x, y and z, in the model's axes. In 2D y is x turned by +90 degrees. In 3D y is "y axis" without its part along
/// x, or any direction across x if there is none, and z = x x y.
std::array<std::array<double, 3>, 3> axes_of(const BoundaryConditionOptions& condition);

/// A component of a node that an inclined support takes away: d_(node, component) = sum_i of_i d_(node, i) + value(t).
struct InclinedComponent {
  LocalOrdinal node = 0;  ///< owned
  int component = 0;
  std::array<double, 3> of{};  ///< coefficients of the node's other components; 0 for those that are taken away or prescribed
};

/// The unit vector along which an inclined component holds its node.
std::array<double, 3> direction_of(const InclinedComponent& component);

/// All prescribed dofs of this rank and their values over time: those of the conditions, and 0 for dofs of reference points that nothing follows.
/// Conditions n_m . d = g_m(t) at a node along directions n_m that are not the axes are solved for as many components, by Gauss-Jordan elimination
/// with complete pivoting. A component that then depends on no other one is prescribed, the rest is inclined.
class PrescribedMotion {
 public:
  /// Collective.
  /// @throws InputError on all ranks for
  /// * a set that does not exist,
  /// * a condition that prescribes nothing, z in 2D or a node that follows a reference point,
  /// * axes of another dimension than the model, and axes at reference points,
  /// * a dof or a direction that conditions prescribe differently (naming them).
  PrescribedMotion(const Bodies& bodies, const std::vector<Named<BoundaryConditionOptions>>& conditions);

  /// Owned dofs (local indices in Bodies::dofs()), ascending.
  const std::vector<LocalOrdinal>& dofs() const { return dofs_; }

  /// Their values at pseudo-time `time`, in the same order. A function without a finite value is put into `failure` if that is empty (kind input),
  /// its value is NaN; nothing throws on one rank only.
  std::vector<double> values(double time, std::optional<StepFailure>& failure) const;

  /// Of owned nodes, by ascending dofs; none of these is prescribed.
  const std::vector<InclinedComponent>& inclined() const { return inclined_; }

  /// The values of inclined(), as values().
  std::vector<double> inclined_values(double time, std::optional<StepFailure>& failure) const;

 private:
  class Collected;
  struct Source {
    LocalOrdinal function;
    std::array<double, 3> position;
    double factor = 1.0;
  };
  /// Sums of sources.
  struct Sums {
    std::vector<Source> sources;
    std::vector<std::size_t> ends;  ///< [sums] one past the last source of each
  };
  double value(const Source& source, double time, std::optional<StepFailure>& failure) const;
  std::vector<double> values(const Sums& sums, double time, std::optional<StepFailure>& failure) const;

  std::vector<ScalarFunction> functions_;
  std::vector<LocalOrdinal> dofs_;
  std::vector<InclinedComponent> inclined_;
  Sums of_dofs_, of_inclined_;
};

}  // namespace mortise
