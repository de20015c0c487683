#pragma once
// The fields that a run can write.

#include <string>
#include <vector>

#include "mortise/contact/contact_system.hpp"
#include "mortise/io/field_writer.hpp"
#include "mortise/simulation/quantities/quantity.hpp"
#include "mortise/solid/bodies.hpp"

namespace mortise {

/// Names of all fields, each with one sentence.
const std::vector<std::pair<std::string, std::string>>& field_names();

/// The state that fields are made of.
struct FieldState {
  const Bodies& bodies;
  const ContactSystem* contact;          ///< null: contact fields are zero, and the gap is too
  const Vector& displacement;            ///< owned dofs
  const Vector& local_displacement;      ///< owned dofs, then ghosts
  const ContactLaws* laws;               ///< of it at this state; null without contact
  const Vector* reaction = nullptr;      ///< owned dofs: forces of the supports, 0 where nothing is prescribed; null: all are 0
  const HeatOfStep* heat = nullptr;      ///< null, or without bodies: temperatures and fluxes are zero
  const Vector* velocity = nullptr;      ///< owned dofs; null without inertia
  const Vector* acceleration = nullptr;  ///< owned dofs; null likewise
};

/// The values of the field `name`, one of field_names().
Field make_field(const std::string& name, const FieldState& state);

}  // namespace mortise
