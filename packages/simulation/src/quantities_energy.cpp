// Stored energy and external work.

#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>

#include "quantity_support.hpp"

namespace mortise {

void Energy::describe(Parameters& parameters) {
  parameters.add("of", of, {{"stored", Of::stored}, {"friction", Of::friction}, {"external work", Of::external_work}},
                 "stored in the bodies, dissipated by friction of all pairs, or the work of loads and supports since the start");
  parameters.add("body", body, "body whose stored energy is meant; empty: all");
  if (of != Of::stored && !body.value.empty()) parameters.error("body", "only the stored energy is that of a body; please remove \"body\"");
}

void Energy::prepare(const QuantityContext& context) {
  body_ = find_optional_body(context, body);
  work_ = 0.0;
  force_ = std::make_shared<Vector>(context.bodies.dofs());
  displacement_ = std::make_shared<Vector>(context.bodies.dofs());
}

double Energy::evaluate(const QuantityContext& context) {
  if (of == Of::stored) {
    const auto energies = context.bodies.stored_energies(*context.local_displacement);
    if (body_) return energies[*body_];
    double sum = 0.0;
    for (const double energy : energies) sum += energy;
    return sum;
  }
  if (of == Of::friction) {
    double work = 0.0;
    for (std::size_t pair = 0; pair < context.pairs.size(); ++pair) work += context.contact->friction_work(pair);
    return work;
  }
  // W += 1/2 (F_old + F) . (d - d_old), F what acts from outside: loads, and supports where the displacement is prescribed.
  Vector force(*context.external_force, Teuchos::Copy), mean(*context.displacement, Teuchos::Copy);
  {
    const auto reaction = context.reaction->getLocalViewHost(Tpetra::Access::ReadOnly);
    const auto values = force.getLocalViewHost(Tpetra::Access::ReadWrite);
    for (const LocalOrdinal dof : *context.prescribed) values(dof, 0) += reaction(dof, 0);
  }
  displacement_->update(1.0, *context.displacement, -1.0);
  mean.update(0.5, force, 0.5, *force_, 0.0);
  work_ += mean.dot(*displacement_);
  force_->assign(force);
  displacement_->assign(*context.displacement);
  return work_;
}

}  // namespace mortise
