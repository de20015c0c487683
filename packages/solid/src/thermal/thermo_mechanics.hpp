#pragma once
// Mechanics of one element whose law knows the temperature: forces, heat and their derivatives by both fields.

#include <memory>
#include <tuple>

#include "elements/element_kernel.hpp"
#include "mortise/material/thermal_law.hpp"
#include "mortise/solid/element_loop.hpp"

namespace mortise {

/// Trouble, with where the law was asked.
struct ThermalTrouble : ElementTrouble {
  ThermalPoint at{};
};

/// f = integral of tau : grad eta dV0 in the rows of displacements, r_a = -integral of N_a H dV0 in those of the temperature. F-bar takes the
/// temperature of the centre for the thermal strain, as it takes the volume change there: both are then constant, and no pressure is left that only
/// one of them can follow.
template <class Cell, Kinematics kinematics, ElementFormulation formulation>
class ThermoMechanics {
 public:
  using Geometry = ElementGeometry<Cell, kinematics == Kinematics::axisymmetric>;
  static constexpr int nodes = Cell::nodes, dimension = Cell::dimension, point_count = Geometry::stiffness_points;
  static constexpr bool f_bar = formulation == ElementFormulation::f_bar;
  using Motion = Deformation<Geometry>;
  using Reads = std::tuple<Motion, FieldValue<1>>;
  using Points = ElementPoints<Geometry, point_count, Reads>;
  using Components = ComponentsOf<kinematics>;
  using StiffnessSum = ElementTangent<Geometry, Components, f_bar>;

  /// Sums in the rows of displacements, for ElementSums.
  struct Forces {
    static constexpr int components = dimension;
    using Residual = std::array<double, components * nodes>;
    using Tangent = typename StiffnessSum::Stiffness;
    using Coupling = FieldCoupling<nodes, dimension, 1>;
  };
  /// Sums in the rows of the temperature.
  struct Heat {
    static constexpr int components = 1;
    using Residual = std::array<double, nodes>;
    using Tangent = NodalBlocks<nodes, 1>;
    using Coupling = FieldCoupling<nodes, 1, dimension>;
  };

  explicit ThermoMechanics(const ThermalLaw& law) : law_(law) {}

  /// `memory(q)`: the numbers that point q remembers. Heat is left out for laws that do not heat. In trouble nothing of use is added.
  template <class Memory, class ForceSums, class HeatSums>
  ThermalTrouble add(const Points& points, const Memory& memory, double time_step, ForceSums& forces, HeatSums& heat) const {
    const bool heats = law_.heats();
    auto centre = centre_of(points);
    if constexpr (f_bar) {
      const Motion& motion = std::get<0>(centre.fields);
      if (!(motion.determinant > 0.0)) return {{ElementTrouble::Kind::inverted, -1, motion.determinant}};
      motion.push_forward(centre);
    }
    [[maybe_unused]] auto stiffness = [&] {
      if constexpr (ForceSums::with_tangent)
        return StiffnessSum(centre, forces.tangent);
      else
        return 0;
    }();
    for (int q = 0; q < point_count; ++q) {
      auto at = points[q];
      const Motion& motion = std::get<0>(at.fields);
      if (!law_.small_strain()) {
        if (!(motion.determinant > 0.0)) return {{ElementTrouble::Kind::inverted, q, motion.determinant}};
        motion.push_forward(at);
      }
      const ThermalPoint asked = asked_at(at, centre, time_step);
      // As in Mechanics: f = integral of sigma(F_law) : grad eta det F dV0.
      double weight = at.weight;
      if constexpr (f_bar) weight *= motion.determinant / std::get<0>(centre.fields).determinant;
      if constexpr (ForceSums::with_tangent) {
        const ThermalResponse response = law_.respond(asked, memory(q));
        if (const ThermalTrouble trouble = trouble_of(q, motion, asked, response)) return trouble;
        add_point_force<Geometry>(at, response.stress, weight, forces.residual);
        stiffness.add(at, StressAndTangent<Components>{response.stress, components_of<Components>(response.tangent)}, weight);
        add_force_by_temperature(at, centre, response, weight, forces.coupling);
        if (heats) add_heat(at, centre, response, heat);
      } else {
        const ThermalForces response = law_.forces(asked, memory(q));
        if (const ThermalTrouble trouble = trouble_of(q, motion, asked, response)) return trouble;
        add_point_force<Geometry>(at, response.stress, weight, forces.residual);
        if (heats)
          for (int a = 0; a < nodes; ++a) heat.residual[a] -= at.weight * at.N[a] * response.heat;
      }
    }
    if constexpr (ForceSums::with_tangent) stiffness.finish();
    return {};
  }

  /// Integral of H dV0.
  template <class Memory>
  double heat(const Points& points, const Memory& memory, double time_step) const {
    const auto centre = centre_of(points);
    double sum = 0.0;
    for (int q = 0; q < point_count; ++q) {
      const auto at = points[q];
      sum += at.weight * law_.forces(asked_at(at, centre, time_step), memory(q)).heat;
    }
    return sum;
  }

  /// Gives the points the state from which the first step starts.
  template <class Memory>
  void begin(const Points& points, const Memory& memory) const {
    const auto centre = centre_of(points);
    for (int q = 0; q < point_count; ++q) law_.begin(asked_at(points[q], centre, Bodies::without_rates), memory(q));
  }

  /// What the points remember if the step that ends here is accepted.
  template <class Memory>
  void commit(const Points& points, const Memory& memory) const {
    const auto centre = centre_of(points);
    for (int q = 0; q < point_count; ++q) law_.update(asked_at(points[q], centre, Bodies::without_rates), memory(q));
  }

  /// Point q for output.
  MaterialPoint material_point(int q, const Points& points, const double* memory) const {
    const auto centre = centre_of(points);
    const auto at = points[q];
    const Motion& motion = std::get<0>(at.fields);
    MaterialPoint result;
    set_place(q, points, result);
    const ThermalOutput output = law_.output(asked_at(at, centre, Bodies::without_rates), memory);
    result.deformation_gradient = output.F;
    result.volume_ratio = law_.small_strain() ? 1.0 : motion.determinant * output.thickness;
    double law_volume_ratio = result.volume_ratio;
    if constexpr (f_bar) law_volume_ratio = std::get<0>(centre.fields).determinant;
    result.cauchy_stress = output.stress / law_volume_ratio;
    result.energy = output.energy;
    result.equivalent_plastic_strain = output.equivalent_plastic_strain;
    result.plastic_work = output.plastic_work;
    return result;
  }

 private:
  static auto centre_of([[maybe_unused]] const Points& points) {
    if constexpr (f_bar)
      return points.centre();
    else
      return typename StiffnessSum::Centre{};
  }

  template <class Point, class Centre>
  static ThermalPoint asked_at(const Point& at, [[maybe_unused]] const Centre& centre, double time_step) {
    ThermalPoint asked;
    asked.F = deformation_gradient_of_law<kinematics, f_bar>(std::get<0>(at.fields), centre);
    asked.temperature = asked.expansion_temperature = std::get<1>(at.fields).value[0];
    if constexpr (f_bar) asked.expansion_temperature = std::get<1>(centre.fields).value[0];
    asked.time_step = time_step;
    return asked;
  }

  static ThermalTrouble trouble_of(int q, const Motion& motion, const ThermalPoint& asked, const ThermalForces& forces) {
    if (!forces.stress.allFinite() || !std::isfinite(forces.heat)) return {{ElementTrouble::Kind::no_stress, q, motion.determinant}, asked};
    if (!(forces.thickness > 0.0)) return {{ElementTrouble::Kind::inverted, q, motion.determinant * forces.thickness}, asked};
    return {};
  }

  /// Shape functions of the temperature of expansion.
  template <class Point, class Centre>
  static const std::array<double, nodes>& shape_of_expansion([[maybe_unused]] const Point& at, [[maybe_unused]] const Centre& centre) {
    if constexpr (f_bar)
      return centre.N;
    else
      return at.N;
  }

  /// K += weight G^T (d tau / d theta_e N_b(theta_e) + d tau / d theta N_b).
  template <class Point, class Centre>
  static void add_force_by_temperature(const Point& at, const Centre& centre, const ThermalResponse& response, double weight,
                                       typename Forces::Coupling& coupling) {
    typename Forces::Residual by_expansion{}, by_temperature{};
    add_point_force<Geometry>(at, response.stress_by_expansion, weight, by_expansion);
    add_point_force<Geometry>(at, response.stress_by_temperature, weight, by_temperature);
    const auto& N = shape_of_expansion(at, centre);
    for (std::size_t row = 0; row < by_expansion.size(); ++row)
      for (int b = 0; b < nodes; ++b) coupling.entries[row][b] += by_expansion[row] * N[b] + by_temperature[row] * at.N[b];
  }

  /// Rows of the temperature with the derivatives of H. F-bar sees L + (1/n) (tr L_0 - tr L) I, see ElementTangent.
  template <class Point, class Centre, class HeatSums>
  static void add_heat(const Point& at, [[maybe_unused]] const Centre& centre, const ThermalResponse& response, HeatSums& heat) {
    const Matrix3& h = response.heat_by_gradient;
    std::array<std::array<double, dimension>, nodes> by_displacement{};
    [[maybe_unused]] const double n = kinematics == Kinematics::plane_strain ? 2.0 : 3.0;
    [[maybe_unused]] const double spherical = (h(0, 0) + h(1, 1) + (n == 3.0 ? h(2, 2) : 0.0)) / n;
    for (int b = 0; b < nodes; ++b)
      for (int k = 0; k < dimension; ++k) {
        double& change = by_displacement[b][k];
        for (int l = 0; l < dimension; ++l) change += h(k, l) * at.gradient[b][l];
        if constexpr (Geometry::axisymmetric)
          if (k == 0) change += h(2, 2) * at.hoop[b];
        if constexpr (f_bar) {
          change += spherical * (centre.gradient[b][k] - at.gradient[b][k]);
          if constexpr (Geometry::axisymmetric)
            if (k == 0) change += spherical * (centre.hoop[b] - at.hoop[b]);
        }
      }
    const auto& N = shape_of_expansion(at, centre);
    for (int a = 0; a < nodes; ++a) {
      const double share = -at.weight * at.N[a];
      heat.residual[a] += share * response.heat;
      for (int b = 0; b < nodes; ++b) {
        heat.tangent(a, 0, b, 0) += share * (response.heat_by_expansion * N[b] + response.heat_by_temperature * at.N[b]);
        for (int k = 0; k < dimension; ++k) heat.coupling(a, 0, b, k) += share * by_displacement[b][k];
      }
    }
  }

  const ThermalLaw& law_;
};

}  // namespace mortise
