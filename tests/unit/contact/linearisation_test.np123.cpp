// The linearised contact against central differences.
#include "linearised_cases.hpp"

namespace mortise {
namespace {

using namespace test;

class Linearisation : public ::testing::TestWithParam<int> {};

TEST_P(Linearisation, AgreesWithCentralDifferences) {
  const Case one = cases()[GetParam()];
  SCOPED_TRACE(one.name);
  Fixture fixture(one.surfaces, Tpetra::getDefaultComm());
  const ContactSystem& contact = *fixture.contact;
  const auto d = Fixture::vector(fixture.dofs, [](GlobalOrdinal id) { return 0.01 * wiggle(id); });
  const auto v = Fixture::vector(fixture.dofs, [](GlobalOrdinal id) { return wiggle(3 * id + 1); });
  const auto z = fixture.multipliers(pressure);
  const auto w = Fixture::vector(contact.multiplier_map(), [](GlobalOrdinal id) { return wiggle(5 * id + 2); });

  const ContactHistory started = start(fixture);
  const DifferentiatedContact evaluated = contact.differentiate(*d, started);
  const ContactHistory history = updated(contact, evaluated.laws(*z), started);
  const DifferentiatedContact at = evaluated.with(history);
  const ContactLaws laws = at.laws(*z);
  const ContactLinearisation linearised = at.linearise(laws);
  const auto system = rcp(new Matrix(contact.graph(at, [&] { return fixture.bulk; })));
  linearised.add_stiffness(*system);
  system->fillComplete(fixture.dofs, fixture.dofs);
  const auto blocks = linearised.saddle_point_blocks();
  Vector force(fixture.dofs), law(contact.multiplier_map());
  system->apply(*v, force);
  blocks.B->apply(*w, force, Teuchos::NO_TRANS, 1.0, 1.0);
  blocks.C_d->apply(*v, law);
  blocks.C_z->apply(*w, law, Teuchos::NO_TRANS, 1.0, 1.0);
  const ContactNorms norms = laws.norms(history->states);
  EXPECT_GT(norms.active, 0);
  EXPECT_LE(norms.active, static_cast<int>(one.surfaces.slave.size()));
  if (one.name.find("mixed") != std::string::npos) {
    EXPECT_GT(norms.sticking, 0);
    EXPECT_LT(norms.sticking, norms.active);
  }
  if (one.name.find("mostly stick") != std::string::npos) {
    EXPECT_GE(norms.sticking, norms.active - 1);
  }
  if (one.name.find("mostly slip") != std::string::npos) {
    EXPECT_LE(norms.sticking, 1);
  }

  const double h = 1e-6;
  Vector force_difference(fixture.dofs), law_difference(contact.multiplier_map());
  for (const double sign : {1.0, -1.0}) {
    Vector d_h(*d, Teuchos::Copy), z_h(*z, Teuchos::Copy), f(fixture.dofs), C(contact.multiplier_map());
    d_h.update(sign * h, *v, 1.0);
    z_h.update(sign * h, *w, 1.0);
    const ContactLaws moved = contact.evaluate(d_h, history).laws(z_h);
    moved.add_force(f);
    moved.complementarity(C);
    force_difference.update(sign / (2.0 * h), f, 1.0);
    law_difference.update(sign / (2.0 * h), C, 1.0);
  }
  const double force_size = force.norm2(), law_size = law.norm2();
  force_difference.update(-1.0, force, 1.0);
  law_difference.update(-1.0, law, 1.0);
  EXPECT_GT(force_size, 0.0);
  EXPECT_GT(law_size, 0.0);
  EXPECT_LE(force_difference.norm2(), 1e-6 * force_size);
  EXPECT_LE(law_difference.norm2(), 1e-6 * law_size);
}

INSTANTIATE_TEST_SUITE_P(Cases, Linearisation, ::testing::ValuesIn(indices(false)), test_name);

TEST(ReferenceGeometry, GapIsTheTransposeOfTheForce) {
  TwoSurfaces surfaces = test::arch_on_ground();
  surfaces.options.geometry = ContactGeometry::reference;
  surfaces.options.mortar.search_reach = 1.0;
  Fixture fixture(surfaces, Tpetra::getDefaultComm());
  const ContactSystem& contact = *fixture.contact;
  const Vector d(fixture.dofs);
  const DifferentiatedContact at = contact.differentiate(d, start(fixture));
  const auto z = fixture.multipliers([](std::size_t) { return 1e3; });  // all closed
  const auto blocks = at.linearise(at.laws(*z)).saddle_point_blocks();
  const auto dof_ids = Fixture::all_ids(*fixture.dofs), z_ids = Fixture::all_ids(*contact.multiplier_map());
  const Eigen::MatrixXd B = Fixture::dense(*blocks.B, dof_ids, z_ids), C_d = Fixture::dense(*blocks.C_d, z_ids, dof_ids);
  const Eigen::MatrixXd C_z = Fixture::dense(*blocks.C_z, z_ids, z_ids);
  int closed = 0;
  for (Eigen::Index j = 0; j < C_d.rows(); j += 2) {
    if (C_d.row(j).isZero(0.0)) continue;
    ++closed;
    // The normal from the tangential row of C_z; the row of C_d is -c_n times the force of a unit pressure.
    const Eigen::Vector2d normal(C_z(j + 1, j + 1), -C_z(j + 1, j));
    const Eigen::VectorXd push = B.middleCols(j, 2) * normal;
    const double factor = C_d.row(j).norm() / push.norm();
    EXPECT_LE((C_d.row(j).transpose() + factor * push).norm(), 1e-13 * C_d.row(j).norm());
  }
  EXPECT_GE(closed, 4);
}

}  // namespace
}  // namespace mortise
