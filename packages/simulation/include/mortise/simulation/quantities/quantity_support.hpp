#pragma once
// Common functions of the kinds of quantities: names of bodies and pairs, sums over ranks, the slave surface with its pressures.

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mortise/simulation/quantities/quantity_kinds.hpp"

namespace mortise {

const std::vector<std::pair<std::string, Component>>& component_names();

/// An evaluator without a memory: `function` of the context.
template <class Function>
std::unique_ptr<QuantityEvaluator> evaluator_of(Function function) {
  class Evaluator final : public QuantityEvaluator {
   public:
    explicit Evaluator(Function function) : function_(std::move(function)) {}
    double evaluate(const QuantityContext& context) override { return function_(context); }

   private:
    const Function function_;
  };
  return std::make_unique<Evaluator>(std::move(function));
}

/// Sum and largest over all ranks. Collective.
/// Throws InputError for a scene without inertia.
void require_inertia(const QuantityContext& context);

/// Throws InputError for a scene without temperature.
void require_temperature(const QuantityContext& context);

/// a . b over the nodes of a body, or of all. Collective.
double sum_over_body(const QuantityContext& context, const std::optional<LocalOrdinal>& body, const Vector& a, const Vector& b);

/// Values that differ by less, over their size, are taken for equal where one of them is chosen: round-off does not decide.
inline constexpr double same_but_for_round_off = 1e-9;

double sum_over_ranks(const Mesh& mesh, double mine);
double largest_over_ranks(const Mesh& mesh, double mine);

/// Throws InputError where `component` is z in 2D.
void require_component(const QuantityContext& context, Component component);

/// Index of a body. Throws InputError at the name's place.
LocalOrdinal find_body(const QuantityContext& context, const Located<std::string>& name);
/// The same; an empty name is no body.
std::optional<LocalOrdinal> find_optional_body(const QuantityContext& context, const Located<std::string>& name);

/// Index of a pair; an empty name is the only pair. Throws InputError at the name's place.
std::size_t find_pair(const QuantityContext& context, const Located<std::string>& name);
/// Index of a pair as find_pair(), for quantities of lines: also throws in 3D.
std::size_t find_pair_of_plane(const QuantityContext& context, const Located<std::string>& name);

/// The parameter "measure".
void describe_measure(Parameters& parameters, TractionMeasure& measure);

/// A slave facet, or half of a quadratic one, with the pressures of its ends, in the order of travel. It stands where the geometry of its pair is
/// (current or reference configuration).
struct PressedFacet {
  std::array<std::array<double, 2>, 2> position{};
  std::array<double, 2> pressure{}, shear{}, shear_bound{};
  std::array<std::array<double, 2>, 2> traction{};  ///< [end] components of z
  std::array<bool, 2> closed{};
  double length() const;
};

/// The slave facets of a pair, quadratic ones in halves between their nodes, each on exactly one rank. Collective. Tractions per undeformed area are
/// z_j D_j / A_j with D_j = int phi_j dgamma.
std::vector<PressedFacet> pressed_facets(const QuantityContext& context, std::size_t pair, TractionMeasure measure = TractionMeasure::pair);

}  // namespace mortise
