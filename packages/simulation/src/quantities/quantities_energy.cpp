// Energies and works.

#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "mortise/simulation/quantities/quantity_support.hpp"

namespace mortise {

void Energy::describe(Parameters& parameters) {
  parameters.add("of", of,
                 {{"stored", Of::stored},
                  {"plastic work", Of::plastic_work},
                  {"friction", Of::friction},
                  {"external work", Of::external_work},
                  {"internal work", Of::internal_work}},
                 "stored in the bodies, spent on plastic flow, dissipated by friction of all pairs (of first order in the step where slip begins or "
                 "turns round), or the work since the start of loads and supports, "
                 "or of the internal forces");
  parameters.add("body", body, "body whose stored energy or plastic work is meant; empty: all");
  if (of != Of::stored && of != Of::plastic_work && !body.value.empty())
    parameters.error("body", "only stored energy and plastic work are those of a body; please remove \"body\"");
}

void Energy::prepare(const QuantityContext& context) {
  body_ = find_optional_body(context, body);
  work_ = 0.0;
  force_ = rcp(new Vector(context.bodies.dofs()));
  displacement_ = rcp(new Vector(context.bodies.dofs()));
}

// What a work is done by, on all owned dofs. From outside act loads, and supports on prescribed dofs. Reference points act on their followers, and
// there their work is counted. A point that is carried round by an angle a with a moment M would do M a. Its followers do M sin a along the chords of
// their ways, as do all other nodes of the body. With r = f_int - f_ext + f_c the internal forces are r + f_ext - f_c, and what supports and points
// do is r. Friction takes what its forces on both sides do not give back: f_c of the shear tractions alone.
RCP<Vector> Energy::force(const QuantityContext& context) const {
  const auto result = rcp(new Vector(context.bodies.dofs()));
  const auto add_contact_force = [&](const Vector& multipliers) { context.laws->evaluation().add_force(multipliers, *result); };
  if (of == Of::friction) {
    add_contact_force(*context.laws->evaluation().shear_tractions(context.laws->multipliers()));
    return result;
  }
  if (of == Of::internal_work) {
    if (context.contact != nullptr) add_contact_force(context.laws->multipliers());
    result->update(1.0, *context.reaction, 1.0, *context.external_force, -1.0);
  } else {
    result->assign(*context.external_force);
    const auto reaction = context.reaction->getLocalViewHost(Tpetra::Access::ReadOnly);
    const auto values = result->getLocalViewHost(Tpetra::Access::ReadWrite);
    for (const auto* dofs : {context.prescribed, context.following})
      for (std::size_t n = 0; dofs != nullptr && n < dofs->size(); ++n) values((*dofs)[n], 0) += reaction((*dofs)[n], 0);
  }
  const Mesh& mesh = context.mesh();
  const auto values = result->getLocalViewHost(Tpetra::Access::ReadWrite);
  for (const ReferencePoint& point : mesh.reference_points)
    for (const LocalOrdinal node : {point.node, point.rotation_node})
      for (int i = 0; i < mesh.dimension && node >= 0 && node < mesh.owned_count(); ++i) values(mesh.dimension * node + i, 0) = 0.0;
  return result;
}

double Energy::evaluate(const QuantityContext& context) {
  if (of == Of::stored || of == Of::plastic_work) {
    const auto energies =
        of == Of::stored ? context.bodies.stored_energies(*context.local_displacement) : context.bodies.plastic_works(*context.local_displacement);
    return body_ ? energies[*body_] : std::accumulate(energies.begin(), energies.end(), 0.0);
  }
  if (of == Of::friction && context.contact == nullptr) return 0.0;
  const RCP<Vector> now = force(context);
  Vector change(*context.displacement, Teuchos::Copy);
  change.update(-1.0, *displacement_, 1.0);
  force_->update(0.5, *now, 0.5);
  work_ += force_->dot(change);
  force_ = now;
  displacement_->assign(*context.displacement);
  return work_;
}

void EnergyError::describe(Parameters& parameters) {
  parameters.add("against", against, {{"internal work", Against::internal_work}, {"stored and plastic", Against::stored_and_plastic}},
                 "what external work less friction is compared with: work of the internal forces, or stored energy and plastic work");
}

void EnergyError::prepare(const QuantityContext& context) {
  external_.of = Energy::Of::external_work;
  spent_.clear();
  const auto add = [&](Energy::Of of) { spent_.emplace_back().of = of; };
  add(Energy::Of::friction);
  if (against == Against::internal_work) {
    add(Energy::Of::internal_work);
  } else {
    add(Energy::Of::stored);
    add(Energy::Of::plastic_work);
  }
  external_.prepare(context);
  for (Energy& energy : spent_) energy.prepare(context);
}

double EnergyError::evaluate(const QuantityContext& context) {
  const double external = external_.evaluate(context);
  double difference = external, largest = std::abs(external);
  for (Energy& energy : spent_) {
    const double value = energy.evaluate(context);
    difference -= value;
    largest = std::max(largest, std::abs(value));
  }
  return largest > 0.0 ? difference / largest : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace mortise
