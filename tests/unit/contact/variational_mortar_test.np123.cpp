// Forces that are the gaps' derivatives: what follows for their work, their resultant and their moment.

#include <gtest/gtest.h>

#include <optional>

#include "formulations.hpp"
#include "two_surfaces.hpp"

namespace mortise {
namespace {

using test::Fixture;
using test::TwoSurfaces;

/// A pair in a state with gaps and penetrations, and the forces of pressures at all its slave nodes.
struct Pressed {
  std::unique_ptr<Fixture> fixture;
  RCP<Vector> d;
  std::optional<ContactHistory> history;
  std::optional<ContactEvaluation> contact;  // at d
  std::vector<GlobalOrdinal> ids;            // dofs
  Eigen::VectorXd force;                     // [dofs]

  explicit Pressed(TwoSurfaces surfaces) {
    surfaces.options.mortar.search_reach = 1.0;
    fixture = std::make_unique<Fixture>(surfaces, Tpetra::getDefaultComm());
    d = Fixture::vector(fixture->dofs, [](GlobalOrdinal id) { return 0.01 * std::sin(12.9898 * static_cast<double>(id) + 0.7); });
    ids = Fixture::all_ids(*fixture->dofs);
    history = fixture->contact->initial_history(*d);
    contact = fixture->contact->evaluate(*d, *history);
    Vector f(fixture->dofs);
    contact->add_force(*pressures(), f);
    force = Fixture::dense(f, ids);
  }

  static double pressure(GlobalOrdinal node) { return 2.0 + std::cos(1.7 * static_cast<double>(node)); }
  /// z = p n
  RCP<Vector> pressures() const {
    const auto z = rcp(new Vector(fixture->contact->multiplier_map()));
    const GlobalOrdinal offset = fixture->dofs->getMaxAllGlobalIndex() + 1;
    for (const ContactNodeState& node : node_states(contact->laws(*z), 0))
      for (int i = 0; i < 2; ++i) z->replaceGlobalValue(offset + 2 * node.node + i, pressure(node.node) * node.normal[static_cast<std::size_t>(i)]);
    return z;
  }
  /// sum_j p_j g_j over all ranks.
  double potential(const Vector& at) const {
    double mine = 0.0, all = 0.0;
    const Vector none(fixture->contact->multiplier_map());
    for (const ContactNodeState& node : node_states(fixture->contact->evaluate(at, *history).laws(none), 0))
      mine += pressure(node.node) * node.gap * node.weight;
    Teuchos::reduceAll(*fixture->dofs->getComm(), Teuchos::REDUCE_SUM, mine, Teuchos::outArg(all));
    return all;
  }
  /// Moment of the forces about the origin, at positions X + d.
  double moment(const TwoSurfaces& surfaces) const {
    const Eigen::VectorXd u = Fixture::dense(*d, ids);
    double sum = 0.0;
    for (std::size_t n = 0; n < surfaces.size(); ++n) {
      const test::Point& X = n < surfaces.slave.size() ? surfaces.slave[n] : surfaces.master[n - surfaces.slave.size()];
      const auto dof = static_cast<Eigen::Index>(2 * n);
      sum += (X[0] + u[dof]) * force[dof + 1] - (X[1] + u[dof + 1]) * force[dof];
    }
    return sum;
  }
};

TwoSurfaces with(TwoSurfaces surfaces, const std::shared_ptr<Formulation>& formulation) {
  surfaces.options.formulation.options = formulation;
  return surfaces;
}

std::vector<TwoSurfaces> surfaces() {
  const TwoSurfaces linear = test::arch_on_ground();
  return {linear, test::quadratic(linear, true, true), test::quadratic(linear, false, true)};
}

// f . v = -d(sum p g) / dv, the work of an axisymmetric pair too. Differences over 2h: h^2 of third derivatives and 1e-16 / h.
TEST(VariationalMortar, ForcesDoTheWorkOfTheGaps) {
  for (TwoSurfaces pair : surfaces())
    for (const bool axisymmetric : {false, true}) {
      pair.measure.axisymmetric = axisymmetric;
      const Pressed pressed(with(pair, std::make_shared<VariationalMortar>()));
      const auto v = Fixture::vector(pressed.fixture->dofs, [](GlobalOrdinal id) { return std::sin(5.1 * static_cast<double>(id) + 0.3); });
      const double h = 1e-6;
      double slope = 0.0;
      for (const double sign : {1.0, -1.0}) {
        Vector at(*pressed.d, Teuchos::Copy);
        at.update(sign * h, *v, 1.0);
        slope += sign * pressed.potential(at) / (2.0 * h);
      }
      EXPECT_GT(std::abs(slope), 0.1);
      EXPECT_NEAR(pressed.force.dot(Fixture::dense(*v, pressed.ids)), -slope, 1e-7 * pressed.force.norm());
    }
}

// A gap does not change when everything is moved or turned: forces and moments sum to nothing, to the round-off of some hundred terms of the size of
// the largest. Those of standard mortar have the moment of p n over the mean gap vector, which is not along n on a curved surface.
TEST(VariationalMortar, HasNoResultantAndNoMoment) {
  for (const TwoSurfaces& pair : surfaces()) {
    const Pressed pressed(with(pair, std::make_shared<VariationalMortar>())), standard(with(pair, std::make_shared<StandardMortar>()));
    const double largest = pressed.force.cwiseAbs().maxCoeff(), length = 5.1;
    for (int i = 0; i < 2; ++i) EXPECT_LT(std::abs(pressed.force(Eigen::seqN(i, pressed.force.size() / 2, 2)).sum()), 1e-13 * largest);
    EXPECT_LT(std::abs(pressed.moment(pair)), 1e-13 * largest * length);
    EXPECT_GT(std::abs(standard.moment(pair)), 1e-6 * largest * length);
  }
}

// The resultant of the slave side is the sum of the rows of its nodes.
TEST(VariationalMortar, ResultantIsTheSumOverTheSlaveSide) {
  for (const TwoSurfaces& pair : surfaces()) {
    const Pressed pressed(with(pair, std::make_shared<VariationalMortar>()));
    const auto resultant = mortise::resultant(pressed.contact->laws(*pressed.pressures()), 0);
    const auto slaves = static_cast<Eigen::Index>(pair.slave.size());
    for (int i = 0; i < 2; ++i)
      EXPECT_NEAR(resultant[static_cast<std::size_t>(i)], -pressed.force(Eigen::seqN(i, slaves, 2)).sum(),
                  1e-13 * pressed.force.cwiseAbs().maxCoeff());
  }
}

std::string refusal(const TwoSurfaces& surfaces) {
  try {
    Fixture fixture(surfaces, Tpetra::getDefaultComm());
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(VariationalMortar, IsRefusedInSpaceAndWithFrozenNormals) {
  EXPECT_NE(refusal(with(test::dome_on_waves(), std::make_shared<VariationalMortar>())).find("variational mortar is not available in 3D; use dual"),
            std::string::npos);
  TwoSurfaces frozen = with(test::arch_on_ground(), std::make_shared<VariationalMortar>());
  EXPECT_EQ(refusal(frozen), "");
  frozen.options.mortar.linearisation = Linearisation::frozen_normals;
  EXPECT_NE(refusal(frozen).find("\"frozen normals\", take \"exact\""), std::string::npos);
}

}  // namespace
}  // namespace mortise
