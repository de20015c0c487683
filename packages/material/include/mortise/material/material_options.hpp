#pragma once
// Materials by their parameters. Code that only passes a material on needs no law.

#include <variant>

#include "mortise/core/parameters.hpp"
#include "mortise/material/elastic_constants.hpp"
#include "mortise/material/thermomechanical_properties.hpp"

namespace mortise {

struct Hencky;
struct NeoHooke;
struct CiarletNeoHooke;
struct StVenantKirchhoff;
struct SmallStrainLinear;
struct FiniteJ2;

/// Every law there is; materials.hpp defines them. Element loops are instantiated for each of them.
using Law = std::variant<Hencky, NeoHooke, CiarletNeoHooke, StVenantKirchhoff, SmallStrainLinear, FiniteJ2>;

/// A material by its parameters.
struct MaterialOptions : Described {
  double youngs_modulus = 1.0;  ///< [stress]
  double poissons_ratio = 0.3;
  double density = 0.0;  ///< [mass / volume] of the reference configuration
  ThermomechanicalProperties thermal;

  /// Declares "young's modulus", "poisson's ratio", "density" and the list "thermomechanics".
  void describe(Parameters& parameters) override;

  /// Declares the entries of the list "thermomechanics".
  virtual void describe_thermomechanics(Parameters& parameters);

  ElasticConstants elastic_constants() const { return {youngs_modulus, poissons_ratio}; }

  /// The law with this material's parameters.
  virtual Law law() const = 0;
};

/// All laws by name.
const Registry<MaterialOptions>& material_registry();

}  // namespace mortise
