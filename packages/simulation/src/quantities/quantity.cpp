#include "mortise/simulation/quantities/quantity.hpp"

namespace mortise {

// Each adds the kind that its file defines.
using AddQuantity = void(Registry<Quantity>& kinds);
AddQuantity add_reaction, add_rotation, add_contact_force, add_momentum_imbalance, add_extremum, add_mean, add_spread, add_point_displacement,
    add_error_norm, add_half_width, add_stick_half_width, add_contact_traction, add_contact_radius, add_peak_pressure, add_contact_length,
    add_contact_area, add_pressure_variation, add_active_count, add_formula, add_over_time, add_energy, add_energy_error, add_momentum,
    add_angular_momentum, add_impulse, add_connector, add_point_temperature, add_heat_flow, add_stored_heat, add_friction_heat, add_dissipated_heat,
    add_heat_balance;

const Registry<Quantity>& quantity_registry() {
  static const Registry<Quantity> registry = [] {
    Registry<Quantity> kinds;
    for (AddQuantity* add :
         {add_reaction,       add_rotation,           add_contact_force,  add_momentum_imbalance, add_extremum,           add_mean,
          add_spread,         add_point_displacement, add_error_norm,     add_half_width,         add_stick_half_width,   add_contact_traction,
          add_contact_radius, add_peak_pressure,      add_contact_length, add_contact_area,       add_pressure_variation, add_active_count,
          add_formula,        add_over_time,          add_energy,         add_energy_error,       add_momentum,           add_angular_momentum,
          add_impulse, add_connector, add_point_temperature, add_heat_flow, add_stored_heat, add_friction_heat, add_dissipated_heat, add_heat_balance})
      add(kinds);
    return kinds;
  }();
  return registry;
}

}  // namespace mortise
