// Conditions on the change of gaps: who may close in a step, and what its conditions see.

#include <gtest/gtest.h>

#include "mortise/contact/contact_report.hpp"
#include "two_surfaces.hpp"

namespace mortise {
namespace {

using test::Fixture;

TEST(GapRate, NodesThatTouchedKeepTheirGapsAndOthersStayOpen) {
  test::TwoSurfaces surfaces = test::arch_on_ground();
  surfaces.has_conditions_on_rate = true;
  const Fixture fixture(surfaces, Tpetra::getDefaultComm());
  const ContactSystem& contact = *fixture.contact;
  const Vector d(fixture.dofs);
  const auto pressed = fixture.multipliers([](std::size_t) { return 100.0; });
  const ContactHistory history = contact.initial_history(d);
  const ContactLaws laws = contact.evaluate(d, history).laws(*pressed);
  int here[2] = {0, 0}, all[2];
  for (const ContactNodeState& node : node_states(laws, 0)) {
    if (!(node.covered > 0.0)) continue;
    EXPECT_EQ(node.closed, node.gap <= 0.0) << node.node;
    ++here[node.closed ? 1 : 0];
  }
  Teuchos::reduceAll(*fixture.dofs->getComm(), Teuchos::REDUCE_SUM, 2, here, all);
  EXPECT_GT(all[0], 0);  // some were open
  EXPECT_GT(all[1], 0);
  EXPECT_LE(laws.norms(history->states).gap, 1e-15);  // none has changed

  // Where the slave goes down by 0.01, gaps change by that, whatever they were.
  const auto down = Fixture::vector(
      fixture.dofs, [&](GlobalOrdinal id) { return id % 2 == 1 && id / 2 < static_cast<GlobalOrdinal>(surfaces.slave.size()) ? -0.01 : 0.0; });
  const ContactLaws moved = contact.evaluate(*down, history).laws(*pressed);
  const double change = moved.norms(history->states).gap;
  EXPECT_GT(change, 0.005);
  EXPECT_LT(change, 0.02);
  // The state that is accepted there is what the next step sees.
  const ContactHistory next = contact.commit(moved);
  EXPECT_LE(contact.evaluate(*down, next).laws(*pressed).norms(next->states).gap, 1e-15);
}

}  // namespace
}  // namespace mortise
