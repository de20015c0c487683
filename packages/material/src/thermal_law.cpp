#include "mortise/material/thermal_law.hpp"

#include <stdexcept>
#include <string>
#include <type_traits>

#include "thermal_elastic_law.hpp"
#include "thermal_j2_law.hpp"

namespace mortise {

std::unique_ptr<const ThermalLaw> make_thermal_law(const MaterialOptions& material, bool plane_stress, double share_at_start) {
  return std::visit(
      [&](const auto& law) -> std::unique_ptr<const ThermalLaw> {
        using Kind = std::decay_t<decltype(law)>;
        if constexpr (Kind::plane_stress)
          if (plane_stress) return std::make_unique<ThermalElasticLaw<Kind, true>>(material, share_at_start);
        if (plane_stress) throw std::invalid_argument(std::string("the material \"") + Kind::name + "\" has no plane stress form");
        if constexpr (has_history<Kind>)
          return std::make_unique<ThermalJ2Law>(material, share_at_start);
        else
          return std::make_unique<ThermalElasticLaw<Kind, false>>(material, share_at_start);
      },
      material.law());
}

}  // namespace mortise
