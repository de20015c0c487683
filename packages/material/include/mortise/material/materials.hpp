#pragma once
// All laws, and how a material's parameters become one. A new law: its own header, its line here, and its name in `Law`.

#include "mortise/material/ciarlet_neo_hooke.hpp"
#include "mortise/material/finite_j2.hpp"
#include "mortise/material/hencky.hpp"
#include "mortise/material/history.hpp"
#include "mortise/material/material_options.hpp"
#include "mortise/material/neo_hooke.hpp"
#include "mortise/material/small_strain_linear.hpp"
#include "mortise/material/st_venant_kirchhoff.hpp"

namespace mortise {

/// Options of a law that needs elastic constants only.
template <class Kind>
struct ElasticMaterialOptions : MaterialOptions {
  Law law() const override { return Kind(elastic_constants()); }
};

/// Options of J2 plasticity: elastic constants and a hardening law.
struct FiniteJ2Options : MaterialOptions {
  Choice<HardeningOptions> hardening;
  void describe(Parameters& parameters) override;
  void describe_thermomechanics(Parameters& parameters) override;
  /// Without a valid hardening law, which reading has reported, that of perfect plasticity.
  Law law() const override { return FiniteJ2(elastic_constants(), hardening.options ? hardening.options->hardening() : Hardening()); }
};

}  // namespace mortise
