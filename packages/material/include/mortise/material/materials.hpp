#pragma once
// The list of laws, and materials as a scene describes them. A new law: its own header, and its name in `Law` below.

#include <variant>

#include "mortise/core/parameters.hpp"
#include "mortise/material/ciarlet_neo_hooke.hpp"
#include "mortise/material/finite_j2.hpp"
#include "mortise/material/hencky.hpp"
#include "mortise/material/history.hpp"
#include "mortise/material/neo_hooke.hpp"
#include "mortise/material/small_strain_linear.hpp"
#include "mortise/material/st_venant_kirchhoff.hpp"

namespace mortise {

/// Every law there is. Element loops are instantiated for each of them.
using Law = std::variant<Hencky, NeoHooke, CiarletNeoHooke, StVenantKirchhoff, SmallStrainLinear, FiniteJ2>;

/// A material of a scene.
struct MaterialOptions : Described {
  double youngs_modulus = 1.0;  ///< [stress]
  double poissons_ratio = 0.3;
  double density = 0.0;  ///< [mass / volume] of the reference configuration

  /// Declares "young's modulus", "poisson's ratio", "density".
  void describe(Parameters& parameters) override;

  ElasticConstants elastic_constants() const { return {youngs_modulus, poissons_ratio}; }

  /// The law with this material's parameters.
  virtual Law law() const = 0;
};

/// Options of a law that needs elastic constants only.
template <class Kind>
struct ElasticMaterialOptions : MaterialOptions {
  Law law() const override { return Kind(elastic_constants()); }
};

/// Options of J2 plasticity: elastic constants and a hardening law.
struct FiniteJ2Options : MaterialOptions {
  Choice<HardeningOptions> hardening;
  void describe(Parameters& parameters) override;
  /// Without a valid hardening law, which reading has reported, that of perfect plasticity.
  Law law() const override { return FiniteJ2(elastic_constants(), hardening.options ? hardening.options->hardening() : Hardening()); }
};

/// All laws by name.
const Registry<MaterialOptions>& material_registry();

}  // namespace mortise
