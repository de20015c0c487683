#include "mortise/material/materials.hpp"

namespace mortise {
namespace {

/// One entry for each alternative of Law.
template <class... Laws>
Registry<MaterialOptions> make_registry(const std::variant<Laws...>*) {
  Registry<MaterialOptions> registry;
  (registry.add<ElasticMaterialOptions<Laws>>(Laws::name, Laws::sentence), ...);
  return registry;
}

}  // namespace

void MaterialOptions::describe(Parameters& parameters) {
  parameters.add("young's modulus", youngs_modulus, Says("Young's modulus at zero strain").unit("stress").above(0.0).required());
  parameters.add("poisson's ratio", poissons_ratio, Says("Poisson's ratio at zero strain").unit("-").above(-1.0).below(0.5).required());
  parameters.add("density", density, Says("mass per reference volume").unit("mass / volume").at_least(0.0));
}

const Registry<MaterialOptions>& material_registry() {
  static const Registry<MaterialOptions> registry = make_registry(static_cast<const Law*>(nullptr));
  return registry;
}

}  // namespace mortise
