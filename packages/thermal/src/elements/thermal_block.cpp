#include "elements/thermal_block.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "elements/heat_trouble.hpp"
#include "mortise/core/guarded_value.hpp"

namespace mortise {
namespace {

/// A function with its value, as messages show them, and why it has none.
std::string shown(const char* name, const std::string& source, const HeatTrouble& trouble, const std::string& reason) {
  return fmt::format("{} {} is {:g}{}", name, source, trouble.value, reason.empty() ? "" : fmt::format(" ({})", reason));
}

std::string shown(const char* name, const TemperatureFunction& function, const HeatTrouble& trouble) {
  std::string reason;
  if (function.expression) value_or_nan(*function.expression, {trouble.temperature}, &reason);
  return shown(name, function.source(), trouble, reason);
}

}  // namespace

StepFailure failure_of(const HeatTrouble& trouble, const ThermalBlockContext& context, LocalOrdinal element, double time) {
  const Mesh& mesh = *context.space.mesh();
  const auto& X = trouble.position;
  const std::string place = fmt::format("element {} at ({:.6g}) of the reference configuration", context.block.element_ids[element],
                                        fmt::join(X.begin(), X.begin() + mesh.dimension, ", "));
  const std::string& body = mesh.body_of(context.block).name;
  const ThermalProperties& properties = *context.properties;
  if (trouble.kind == HeatTrouble::Kind::inverted)
    return {FailureKind::inverted_element, fmt::format("body \"{}\": {} is turned inside out, det F = {:.3g}", body, place, trouble.value)};
  std::string what, allowed;
  if (trouble.kind == HeatTrouble::Kind::conductivity) {
    what = shown("conductivity", properties.conductivity, trouble);
    allowed = ">= 0 and finite";
  } else if (trouble.kind == HeatTrouble::Kind::specific_heat) {
    what = shown("specific heat", properties.specific_heat, trouble);
    allowed = "> 0 and finite";
  } else {
    std::string reason;
    value_or_nan(*properties.source, {time, X[0], X[1], X[2], trouble.temperature}, &reason);
    what = shown("heat source", fmt::format("\"{}\"", properties.source->source()), trouble, reason);
    allowed = "finite";
  }
  return {FailureKind::input, fmt::format("body \"{}\": the {} at the temperature {:g} in {}; allowed: {}; change the function where it is not so",
                                          body, what, trouble.temperature, place, allowed)};
}

std::unique_ptr<ThermalBlock> make_thermal_block(const ThermalBlockContext& context) {
  const CellTopology& cell = topology(context.block.shape);
  if (cell.dimension == 2) return make_plane_block(context);
  return cell.nodes == cell.corners ? make_linear_space_block(context) : make_quadratic_space_block(context);
}

}  // namespace mortise
