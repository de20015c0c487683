// Forces of two passes: each side is slave once, and each pass carries half.

#include <gtest/gtest.h>

#include "mortise/contact/formulation/node_to_segment.hpp"
#include "two_surfaces.hpp"

namespace mortise {
namespace {

using test::Fixture;

constexpr int slaves = 6, masters = 8;
constexpr double width = 5.0;

/// A flat slave and a flat master over [0, 5] that touch; their nodes do not match.
test::TwoSurfaces flat(NodeToSegment::Passes passes) {
  test::TwoSurfaces surfaces;
  for (int i = 0; i < slaves; ++i) surfaces.slave.push_back({width * i / (slaves - 1), 0.0, 0.0});
  for (int i = 0; i < masters; ++i) surfaces.master.push_back({width * (masters - 1 - i) / (masters - 1), 0.0, 0.0});
  surfaces.fixed.assign(surfaces.size(), {});
  const auto segments = std::make_shared<NodeToSegment>();
  segments->passes = passes;
  surfaces.options.formulation.options = segments;
  surfaces.options.mortar.search_reach = 1.0;
  return surfaces;
}

struct Forces {
  std::array<double, 3> resultant{}, on_slave{}, on_master{};
};

/// With uniform tractions z on the slave nodes, and their opposite, scaled, on the master nodes.
Forces forces(NodeToSegment::Passes passes, double pressure, double master_pressure) {
  Fixture fixture(flat(passes), Tpetra::getDefaultComm());
  const ContactSystem& contact = *fixture.contact;
  const Vector d(fixture.dofs);
  const ContactEvaluation at = contact.evaluate(d, contact.initial_history(d));
  const GlobalOrdinal first = fixture.dofs->getMaxAllGlobalIndex() + 1;
  const auto z = Fixture::vector(contact.multiplier_map(), [&](GlobalOrdinal id) {
    const double down = (id - first) / 2 < slaves ? pressure : -master_pressure;
    return (id - first) % 2 == 1 ? -down : 0.1 * down;
  });
  Vector force(fixture.dofs);  // f_c is on the left side of balance: bodies feel -f_c
  at.add_force(*z, force);
  const std::vector<GlobalOrdinal> ids = Fixture::all_ids(*fixture.dofs);
  const Eigen::VectorXd all = Fixture::dense(force, ids);
  Forces result;
  result.resultant = resultant(at.laws(*z), 0);
  for (std::size_t k = 0; k < ids.size(); ++k) (ids[k] / 2 < slaves ? result.on_slave : result.on_master)[ids[k] % 2] -= all[k];
  return result;
}

TEST(TwoPasses, EachCarriesHalf) {
  const double p = 3.0, q = 5.0;
  const Forces two = forces(NodeToSegment::Passes::two, p, q);
  const double applied = 0.5 * (p + q) * width;
  EXPECT_NEAR(two.resultant[1], applied, 1e-12 * applied);
  EXPECT_NEAR(two.resultant[0], -0.1 * applied, 1e-12 * applied);
}

TEST(TwoPasses, CarryTogetherWhatOnePassDoes) {
  const double p = 3.0;
  const Forces one = forces(NodeToSegment::Passes::single, p, 0.0), two = forces(NodeToSegment::Passes::two, p, p);
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(two.resultant[i], one.resultant[i], 1e-12 * p * width);
}

TEST(TwoPasses, TheResultantIsTheForceOnTheSlaveAndItsOppositeOnTheMaster) {
  const Forces two = forces(NodeToSegment::Passes::two, 3.0, 5.0);
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(two.on_slave[i], two.resultant[i], 1e-12 * std::abs(two.resultant[1]));
    EXPECT_NEAR(two.on_master[i], -two.resultant[i], 1e-12 * std::abs(two.resultant[1]));
  }
}

}  // namespace
}  // namespace mortise
