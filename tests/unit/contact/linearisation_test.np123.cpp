// The linearised contact against central differences.
#include "linearised_cases.hpp"

namespace mortise {
namespace {

using namespace test;

class Linearisation : public ::testing::TestWithParam<int> {};

TEST_P(Linearisation, AgreesWithCentralDifferences) {
  const Case one = cases()[GetParam()];
  SCOPED_TRACE(one.name);
  const ContactNorms norms = expect_linearisation_of_differences(one.surfaces);
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
}

INSTANTIATE_TEST_SUITE_P(Cases, Linearisation, ::testing::ValuesIn(indices(false)), test_name);

/// Cases with friction and current geometry: only there is a slip measured against couplings.
std::vector<int> with_measured_slip() {
  std::vector<int> result;
  const std::vector<Case> all = cases();
  for (const int i : indices(false))
    if (all[i].surfaces.options.friction.options->acts() && all[i].surfaces.options.geometry == ContactGeometry::current) result.push_back(i);
  return result;
}

class FirstCover : public ::testing::TestWithParam<int> {};

TEST_P(FirstCover, AgreesWithCentralDifferences) {
  const Case one = cases()[GetParam()];
  SCOPED_TRACE(one.name);
  const ContactNorms norms = expect_linearisation_of_differences(one.surfaces, true);
  if (one.name.find("mostly stick") != std::string::npos) {
    EXPECT_GT(norms.sticking, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, FirstCover, ::testing::ValuesIn(with_measured_slip()), test_name);

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
