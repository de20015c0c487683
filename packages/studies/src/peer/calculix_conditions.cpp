// Boundary conditions and loads of a deck of CalculiX.

#include <fmt/format.h>

#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "mortise/core/trilinos_versions.hpp"
#include "peer/calculix_deck.hpp"

namespace mortise {
namespace {

using Values = std::vector<double>;

/// Amplitudes of histories that differ by a factor are one.
class Amplitudes {
 public:
  explicit Amplitudes(const Values& times) : times_(times) {}

  struct Scaled {
    int amplitude;
    double factor;
  };

  /// `values` are not all 0.
  Scaled add(const Values& values) {
    const double factor = *std::max_element(values.begin(), values.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
    std::string pairs;
    for (std::size_t i = 0; i < values.size(); ++i)
      pairs += fmt::format("{:.10g},{:.8f}{}", times_[i], values[i] / factor, i % 4 == 3 || i + 1 == values.size() ? "\n" : ",");
    return {numbers_.emplace(std::move(pairs), static_cast<int>(numbers_.size())).first->second, factor};
  }

  std::string text() const {
    std::string text;
    for (const auto& [pairs, number] : numbers_) text += fmt::format("*AMPLITUDE,NAME=AMPLITUDE{}\n{}", number, pairs);
    return text;
  }

 private:
  const Values& times_;
  std::map<std::string, int> numbers_;
};

/// External forces at the times, [dof][time]: those of loads that do not follow the bodies.
std::vector<Values> external_forces(const Scene& scene, const Model& model, const Values& times) {
  const Bodies& bodies = *model.bodies();
  std::vector<Values> forces(local_id_count(*bodies.space().dofs()), Values(times.size()));
  const Vector undeformed(bodies.space().local_dofs());
  for (const auto& options : scene.loads) {
    const auto load = options.value.load.options->make(model.bodies());
    for (std::size_t i = 0; i < times.size(); ++i) {
      Vector residual(bodies.space().dofs());
      std::optional<StepFailure> failure;
      load->add_residual(times[i], undeformed, residual, failure);
      if (failure) throw *failure;
      const auto values = residual.getLocalViewHost(Tpetra::Access::ReadOnly);
      for (std::size_t dof = 0; dof < forces.size(); ++dof) forces[dof][i] -= values(dof, 0);
    }
  }
  return forces;
}

std::vector<Values> prescribed_values(const Model& model, const Values& times) {
  const AffineConstraints& constraints = *model.parts().constraints;
  std::vector<Values> values(constraints.prescribed().size(), Values(times.size()));
  for (std::size_t i = 0; i < times.size(); ++i) {
    std::optional<StepFailure> failure;
    const Values now = constraints.prescribed_values(times[i], failure);
    if (failure) throw *failure;
    for (std::size_t n = 0; n < now.size(); ++n) values[n][i] = now[n];
  }
  return values;
}

bool all_zero(const Values& values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return value == 0.0; });
}

}  // namespace

std::vector<double> deck_times(const SteppingOptions& stepping) {
  Values times{0.0};
  const int steps = std::max(1, static_cast<int>(std::ceil(stepping.end_time / stepping.step - 1e-9)));
  for (int step = 1; step < steps; ++step) times.push_back(step * stepping.step);
  times.push_back(stepping.end_time);
  return times;
}

DeckConditions deck_conditions(const Scene& scene, const Model& model) {
  const Mesh& mesh = *model.mesh();
  const DeckNumbers numbers(mesh);
  const Values times = deck_times(scene.stepping);
  Amplitudes amplitudes(times);
  DeckConditions conditions;
  const auto fixed = std::back_inserter(conditions.before), moved = std::back_inserter(conditions.within);
  const auto node = [&](LocalOrdinal dof, int layer) { return numbers.node(mesh.owned_nodes->getGlobalElement(dof / numbers.dimension), layer); };

  fmt::format_to(fixed, "*BOUNDARY\n");
  if (numbers.dimension == 2) fmt::format_to(fixed, "ALL,3,3\n");
  const auto& prescribed = model.parts().constraints->prescribed();
  const auto motions = prescribed_values(model, times);
  for (std::size_t n = 0; n < prescribed.size(); ++n) {
    const int component = 1 + prescribed[n] % numbers.dimension;
    const bool still = all_zero(motions[n]);
    const Amplitudes::Scaled scaled = still ? Amplitudes::Scaled{0, 0.0} : amplitudes.add(motions[n]);
    if (!still) fmt::format_to(moved, "*BOUNDARY,AMPLITUDE=AMPLITUDE{}\n", scaled.amplitude);
    for (int layer = 0; layer < numbers.layers; ++layer)
      if (still)
        fmt::format_to(fixed, "{0},{1},{1}\n", node(prescribed[n], layer), component);
      else
        fmt::format_to(moved, "{0},{1},{1},{2:.10g}\n", node(prescribed[n], layer), component, scaled.factor);
  }
  const auto forces = external_forces(scene, model, times);
  for (std::size_t dof = 0; dof < forces.size(); ++dof) {
    if (all_zero(forces[dof])) continue;
    const Amplitudes::Scaled scaled = amplitudes.add(forces[dof]);
    fmt::format_to(moved, "*CLOAD,AMPLITUDE=AMPLITUDE{}\n", scaled.amplitude);
    for (int layer = 0; layer < numbers.layers; ++layer)
      fmt::format_to(moved, "{},{},{:.12g}\n", node(static_cast<LocalOrdinal>(dof), layer), 1 + dof % numbers.dimension,
                     scaled.factor / numbers.layers);
  }
  conditions.before = amplitudes.text() + conditions.before;
  return conditions;
}

}  // namespace mortise
