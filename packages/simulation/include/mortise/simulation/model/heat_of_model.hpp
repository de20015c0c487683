#pragma once
// Heat of a model: its bodies, what flows, and what was booked.

#include <memory>
#include <string>
#include <vector>

#include "mortise/nonlinear/contribution.hpp"
#include "mortise/thermal/prescribed_temperatures.hpp"
#include "mortise/thermal/thermal_bodies.hpp"

namespace mortise {

class BookedHeat;
class BulkContribution;
class ContactHeatBook;

/// Null members are of what the scene does not name.
struct HeatOfModel {
  std::shared_ptr<const ThermalBodies> bodies;               ///< null: the scene has no temperature
  std::shared_ptr<const PrescribedTemperatures> prescribed;  ///< with bodies
  std::shared_ptr<BulkContribution> bulk;                    ///< null: deformation does not heat
  std::shared_ptr<BookedHeat> stored;                        ///< null: a steady analysis
  std::shared_ptr<BookedHeat> conduction;                    ///< with bodies
  std::vector<std::shared_ptr<BookedHeat>> sources;          ///< of volumes and, by their names, of surfaces
  std::shared_ptr<ContactHeatBook> contact;                  ///< null: no pair conducts, and no friction heats
};

}  // namespace mortise
