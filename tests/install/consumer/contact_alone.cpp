// An application that takes contact and nothing else: gaps, forces and bounds of friction at given displacements and multipliers. The law of friction
// is its own code.

#include <cmath>
#include <cstdio>
#include <exception>

#include "blocks.hpp"

namespace host {

bool near(const char* what, double value, double expected) {
  const bool right = std::abs(value - expected) <= 1e-12 * std::abs(expected);
  if (!right) std::printf("%s is %.15g, expected %.15g\n", what, value, expected);
  return right;
}

int run() {
  constexpr double depth = 0.01, pressure = 7.0;
  const auto coefficient = [](double p) { return 0.2 + 0.1 * std::exp(-p / 10.0); };
  const Blocks blocks(2);
  ContactPair pair = blocks.pair(0.0);
  const auto coulomb = std::make_shared<CoulombFriction>();
  coulomb->coefficient = ScalarFunction([coefficient](const std::vector<double>& of) { return coefficient(of[0]); }, "0.2 + 0.1 exp(-p / 10)");
  pair.options.friction = {"coulomb", coulomb, {}};
  const ContactSystem contact(blocks.nodes, blocks.dofs, blocks.reference, blocks.fixed, {}, {pair}, Timers());

  Vector d(blocks.dofs), z(contact.multiplier_map());
  const ContactHistory history = contact.initial_history(d);
  for (const GlobalOrdinal id : local_ids(*blocks.dofs))
    if (id % 2 == 1 && blocks.block_of(id / 2) == 1) d.replaceGlobalValue(id, -depth);
  for (const GlobalOrdinal id : local_ids(*contact.multiplier_map()))
    if (id % 2 == 1) z.replaceGlobalValue(id, -pressure);  // ids follow those of the dofs, of which there are two a node

  const ContactLaws laws = contact.evaluate(d, history).laws(z);
  bool all_right = near("the contact force", std::abs(resultant(laws, 0)[1]), pressure * width);
  for (const ContactNodeState& node : node_states(laws, 0))
    all_right &= node.closed && near("the gap", node.gap, -depth) && near("the bound", node.shear_bound, coefficient(pressure) * pressure);
  return all_right ? 0 : 1;
}

}  // namespace host

int main(int argc, char** argv) {
  Tpetra::ScopeGuard scope(&argc, &argv);
  try {
    return host::run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
