#include "mortise/material/materials.hpp"

namespace mortise {
namespace {

template <class Kind>
struct OptionsOf {
  using type = ElasticMaterialOptions<Kind>;
};
template <>
struct OptionsOf<FiniteJ2> {
  using type = FiniteJ2Options;
};

/// One entry for each alternative of Law.
template <class... Laws>
Registry<MaterialOptions> make_registry(const std::variant<Laws...>*) {
  Registry<MaterialOptions> registry;
  (registry.add<typename OptionsOf<Laws>::type>(Laws::name, Laws::sentence), ...);
  return registry;
}

}  // namespace

void MaterialOptions::describe(Parameters& parameters) {
  parameters.add("young's modulus", youngs_modulus, Says("Young's modulus at zero strain").unit("stress").above(0.0).required());
  parameters.add("poisson's ratio", poissons_ratio, Says("Poisson's ratio at zero strain").unit("-").above(-1.0).below(0.5).required());
  parameters.add("density", density, Says("mass per reference volume").unit("mass / volume").at_least(0.0));
}

namespace {
/// The list "hardening" of a material.
struct HardeningList {
  Choice<HardeningOptions>& hardening;
  void describe(Parameters& parameters) {
    parameters.choose(hardening, hardening_registry(), "kind of the curve of yield stress over the accumulated plastic strain alpha");
  }
};
}  // namespace

void FiniteJ2Options::describe(Parameters& parameters) {
  MaterialOptions::describe(parameters);
  HardeningList list{hardening};
  parameters.list("hardening", list, "the yield stress as a function of the accumulated plastic strain alpha");
}

const Registry<MaterialOptions>& material_registry() {
  static const Registry<MaterialOptions> registry = make_registry(static_cast<const Law*>(nullptr));
  return registry;
}

}  // namespace mortise
