// The half width of the part of a contact zone that sticks.

#include <algorithm>
#include <array>
#include <cmath>

#include "mortise/shape/quadrature.hpp"
#include "mortise/simulation/quantities/quantity_support.hpp"

namespace mortise {
namespace {

/// 2 sqrt(int s (x - m)^2 ds / int s ds). Here s = rho - |z_tau| is what is left of the friction bound, and m is its middle. In Cattaneo's and
/// Mindlin's solution s is a Hertzian distribution of just that half width. [length]
struct StickHalfWidth : PairQuantity {
  TractionMeasure measure = TractionMeasure::pair;

  void describe(Parameters& parameters) override {
    PairQuantity::describe(parameters);
    describe_measure(parameters, measure);
  }

  std::unique_ptr<QuantityEvaluator> make_evaluator(const QuantityContext& context) const override {
    return evaluator_of([measure = measure, of_pair = find_pair_of_plane(context, pair)](const QuantityContext& at) {
      // s is linear and x is linear on a facet: s x^2 is a cubic, which two points integrate exactly. Moments of order 0, 1, 2.
      static const auto rule = gauss_legendre(2);
      std::array<double, 3> moments{};
      for (const PressedFacet& facet : pressed_facets(at, of_pair, measure))
        for (const LinePoint& point : rule) {
          const std::array<double, 2> N{0.5 * (1.0 - point.xi), 0.5 * (1.0 + point.xi)};
          double x = 0.0, s = 0.0;
          for (int end = 0; end < 2; ++end) {
            x += N[end] * facet.position[end][0];
            s += N[end] * std::max(0.0, facet.shear_bound[end] - std::abs(facet.shear[end]));
          }
          s *= 0.5 * facet.length() * point.weight;
          for (int k = 0; k < 3; ++k) moments[k] += s * std::pow(x, k);
        }
      for (double& moment : moments) moment = sum_over_ranks(at.mesh(), moment);
      if (!(moments[0] > 0.0)) return 0.0;
      const double middle = moments[1] / moments[0];
      return 2.0 * std::sqrt(std::max(0.0, moments[2] / moments[0] - middle * middle));
    });
  }
};

}  // namespace

void add_stick_half_width(Registry<Quantity>& kinds) {
  kinds.add<StickHalfWidth>("stick half width", "half width of the sticking zone, from the second moment of the unused part of the friction bound");
}

}  // namespace mortise
