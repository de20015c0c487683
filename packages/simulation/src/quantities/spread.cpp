// Spread of stresses.

#include <algorithm>
#include <functional>
#include <limits>
#include <vector>

#include "mortise/simulation/quantities/quantity_support.hpp"

namespace mortise {
namespace {

/// @param chosen  [bodies] whose points are compared
double stress_spread(const QuantityContext& at, const std::vector<char>& chosen) {
  const Mesh& mesh = at.mesh();
  Matrix3 mean = Matrix3::Zero();
  double volume = 0.0;
  const auto visit = [&](const std::function<void(const MaterialPoint&)>& visitor) {
    at.bodies.visit_points(*at.local_displacement, [&](const MaterialPoint& point) {
      if (chosen[mesh.blocks[point.block].body]) visitor(point);
    });
  };
  visit([&](const MaterialPoint& point) {
    const double weight = point.weight * point.volume_ratio;
    mean += weight * point.cauchy_stress;
    volume += weight;
  });
  volume = sum_over_ranks(mesh, volume);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) mean(i, j) = sum_over_ranks(mesh, mean(i, j)) / volume;
  double deviation = 0.0;
  visit([&](const MaterialPoint& point) { deviation = std::max(deviation, (point.cauchy_stress - mean).cwiseAbs().maxCoeff()); });
  const double scale = mean.cwiseAbs().maxCoeff();
  deviation = largest_over_ranks(mesh, deviation);
  return scale > 0.0 ? deviation / scale : std::numeric_limits<double>::quiet_NaN();
}

/// max |sigma_ij - mean sigma_ij| / max |mean sigma_kl| over all quadrature points, all components (33 as well); the mean is weighted by volume.
struct Spread : Quantity {
  Located<std::vector<std::string>> bodies;  ///< empty: all

  void describe(Parameters& parameters) override { parameters.add("bodies", bodies, "bodies whose stresses are compared; empty: all"); }

  std::unique_ptr<QuantityEvaluator> make_evaluator(const QuantityContext& context) const override {
    std::vector<char> chosen(context.mesh().bodies.size(), bodies.value.empty() ? 1 : 0);
    for (const auto& body : bodies.value) chosen[find_body(context, {body, bodies.place})] = 1;
    return evaluator_of([chosen](const QuantityContext& at) { return stress_spread(at, chosen); });
  }
};

}  // namespace

void add_spread(Registry<Quantity>& kinds) {
  kinds.add<Spread>("spread", "max|sigma_ij - mean sigma_ij| / max|mean sigma_kl| over all quadrature points");
}

}  // namespace mortise
