// The initial guess of a step: which nodes start closed.

#include <gtest/gtest.h>

#include "formulations.hpp"
#include "two_surfaces.hpp"

namespace mortise {
namespace {

using test::Fixture;
using test::TwoSurfaces;

/// With dual mortar and with each other formulation.
class StartRule : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(All, StartRule, ::testing::Range(-1, static_cast<int>(test::other_formulations().size())));

TEST_P(StartRule, ClosesNodesThatTouchAndSeedsUnheldBodies) {
  TwoSurfaces flat;
  if (GetParam() >= 0) flat.options.formulation.options = test::other_formulations()[GetParam()].options;
  for (int i = 0; i < 5; ++i) flat.slave.push_back({1.0 * i, 0.0, 0.0});
  for (int i = 0; i < 4; ++i) flat.master.push_back({4.0 * (3 - i) / 3.0, 0.0, 0.0});
  flat.fixed.assign(flat.size(), {});
  Fixture fixture(flat, Tpetra::getDefaultComm());
  const std::vector<char> held(fixture.nodes->getNodeNumElements(), 0), unheld(held.size(), 1);
  Vector d(fixture.dofs), z(fixture.contact->multiplier_map());
  fixture.contact->start_step(d, held, z);
  EXPECT_EQ(fixture.contact->norms(z).active, 5);

  // Lifted by 0.05 h: nothing touches; only a body that nothing else holds is seeded.
  const GlobalOrdinal slave_dofs = 10;
  const auto lifted = Fixture::vector(fixture.dofs, [&](GlobalOrdinal id) { return id < slave_dofs && id % 2 == 1 ? 0.05 : 0.0; });
  z.putScalar(0.0);
  fixture.contact->start_step(*lifted, held, z);
  EXPECT_EQ(fixture.contact->norms(z).active, 0);
  fixture.contact->start_step(*lifted, unheld, z);
  EXPECT_EQ(fixture.contact->norms(z).active, 5);

  // Tilted and lifted beyond 0.1 h: at least the nearest node.
  const auto tilted = Fixture::vector(fixture.dofs, [&](GlobalOrdinal id) { return id < slave_dofs && id % 2 == 1 ? 0.2 + 0.02 * id : 0.0; });
  z.putScalar(0.0);
  fixture.contact->start_step(*tilted, unheld, z);
  EXPECT_GE(fixture.contact->norms(z).active, 1);
  EXPECT_LE(fixture.contact->norms(z).active, 2);
}

}  // namespace
}  // namespace mortise
