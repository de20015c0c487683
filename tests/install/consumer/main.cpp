// An application of its own that uses the contact library alone: a square's bottom pressed onto the top of another, both known as facets only.

#include <Tpetra_Core.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <cmath>

#include "mortise/contact/contact_system.hpp"
#include "mortise/core/dof_map.hpp"

int main(int argc, char** argv) {
  using namespace mortise;
  Tpetra::ScopeGuard scope(&argc, &argv);
  const auto comm = Tpetra::getDefaultComm();
  const auto nodes = rcp(new const Map(4, comm->getRank() == 0 ? 4 : 0, 0, comm));
  const auto dofs = make_dof_map(*nodes, 2);
  const auto reference = rcp(new MultiVector(nodes, 2)), fixed = rcp(new MultiVector(nodes, 2));
  const double x[4] = {0.0, 1.0, 1.0, 0.0};
  for (int node = 0; node < 4 && comm->getRank() == 0; ++node) reference->replaceLocalValue(node, 0, x[node]);
  ContactPair pair;
  pair.name = "pair";
  pair.youngs_modulus = 1.0;
  if (comm->getRank() == 0) {
    pair.slave = {{0, 1}};
    pair.master = {{2, 3}};
  }
  ContactSystem contact(nodes, dofs, reference, fixed, {}, {pair}, Timers());
  Vector d(dofs), z(contact.multiplier_map()), force(dofs);
  contact.start_step(d, std::vector<char>(nodes->getNodeNumElements(), 1), z);
  contact.add_contact_force(z, force);
  const auto resultant = contact.resultant(0, z);
  // The surfaces touch: both nodes start closed at 1e-6 E, so the slave is pushed up by 1e-6 over a length of 1.
  const bool right = contact.norms(z).active == 2 && std::abs(resultant[1] - 1e-6) < 1e-18 && force.normInf() > 0.0;
  return right ? 0 : 1;
}
