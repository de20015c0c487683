// Rows of another field in which multipliers stand: substitution of the multipliers, and the step of the whole system.
#include <TpetraExt_MatrixMatrix.hpp>

#include "linearised_cases.hpp"
#include "mortise/core/trilinos_versions.hpp"

namespace mortise {
namespace {

using namespace test;

class Substitution : public ::testing::TestWithParam<int> {};

/// Contact at an iterate of a host whose scalar field stands between the displacements.
struct Host {
  explicit Host(const TwoSurfaces& surfaces) : fixture(surfaces, Tpetra::getDefaultComm(), HostNumbering::interleaved), laws(evaluate()) {}
  ContactLaws evaluate() {
    const auto d = Fixture::vector(fixture.dofs, [](GlobalOrdinal id) { return 0.01 * wiggle(id); });
    const auto before = Fixture::vector(fixture.dofs, [](GlobalOrdinal id) { return 0.01 * std::sin(3.1 * static_cast<double>(id) + 0.2); });
    Vector guess(contact.multiplier_map());
    const ContactHistory history = fixture.first_step(*before, guess);
    const auto z = fixture.multipliers(pressure);
    const DifferentiatedContact first = contact.differentiate(*d, history);
    at = first.with(updated(contact, first.laws(*z), history));
    return at->laws(*z);
  }
  /// K of springs and C~.
  RCP<Matrix> stiffness() const {
    const RCP<Matrix> K = fixture.springs(contact.graph(*at, [&] { return fixture.bulk; }));
    at->linearise(laws).add_stiffness(*K);
    return K;
  }
  bool is_scalar(GlobalOrdinal id, int dimension) const { return id % (dimension + 1) == 0; }

  Fixture fixture;
  const ContactSystem& contact = *fixture.contact;
  std::optional<DifferentiatedContact> at;
  ContactLaws laws;
};

/// In some rows multipliers of some nodes, those of other ranks too.
RCP<Matrix> rows_of_multipliers(const RCP<const Map>& rows, const Map& multipliers, const std::function<bool(GlobalOrdinal)>& has_entries) {
  const std::vector<GlobalOrdinal> columns = Fixture::all_ids(multipliers);
  const auto G = rcp(new Matrix(rows, columns.size()));
  for (const GlobalOrdinal row : local_ids(*rows))
    for (const GlobalOrdinal column : columns) {
      const double value = 0.2 * wiggle(17 * row + 29 * column);
      if (has_entries(row) && (row + column) % 3 == 0) G->insertGlobalValues(row, 1, &value, &column);
    }
  G->fillComplete(rcp(new Map(multipliers)), rows);
  return G;
}

TEST_P(Substitution, IsTheProductWithTheRecoveredMultipliers) {
  const Case one = cases()[GetParam()];
  SCOPED_TRACE(one.name);
  const Host host(one.surfaces);
  const ContactSystem& contact = host.contact;
  const RCP<Matrix> K = host.stiffness();
  const auto rhs = Fixture::vector(host.fixture.dofs, [](GlobalOrdinal id) { return 5.0 * wiggle(7 * id + 3); });
  const NodeElimination condensed = host.at->linearise(host.laws).condense(*K, *rhs);
  // Rows that are no dofs of the system at all, and in another distribution.
  const auto rows = rcp(new Map(23, 0, contact.multiplier_map()->getComm()));
  const RCP<Matrix> G = rows_of_multipliers(rows, *contact.multiplier_map(), [](GlobalOrdinal row) { return row % 4 != 1; });
  const SubstitutedRows substituted = condensed.substitute(*G);

  const auto dd = Fixture::vector(host.fixture.dofs, [](GlobalOrdinal id) { return 0.02 * wiggle(3 * id + 1); });
  Vector z(contact.multiplier_map()), product(rows), expected(rows);
  condensed.recover(*dd, z);
  EXPECT_GT(z.norm2(), 0.0);
  G->apply(z, expected);
  substituted.of_dofs->apply(*dd, product);
  product.update(1.0, *substituted.constant, 1.0);
  product.update(-1.0, expected, 1.0);
  EXPECT_GT(substituted.constant->norm2(), 0.0);
  EXPECT_LE(product.norm2(), 1e-12 * (expected.norm2() + substituted.constant->norm2()));
  const RCP<Matrix> of_others = rows_of_multipliers(rows, *rows, [](GlobalOrdinal) { return true; });
  EXPECT_THROW(condensed.substitute(*of_others), std::logic_error);
}

// ( K + C~  B + G ) dd   rhs                        ( K + C~ + (B + G) S ) dd = rhs - (B + G) b,
// ( C_d     C_z   ) dz = -C    and what is condensed,
TEST_P(Substitution, TheStepIsThatOfTheWholeSystem) {
  const Case one = cases()[GetParam()];
  SCOPED_TRACE(one.name);
  const Host host(one.surfaces);
  const ContactSystem& contact = host.contact;
  const RCP<const Map>&dofs = host.fixture.dofs, &multipliers = contact.multiplier_map();
  const auto dof_ids = Fixture::all_ids(*dofs), z_ids = Fixture::all_ids(*multipliers);
  const Eigen::Index n = dof_ids.size(), m = z_ids.size();
  const RCP<Matrix> G = rows_of_multipliers(dofs, *multipliers, [&](GlobalOrdinal id) { return host.is_scalar(id, one.surfaces.dimension); });
  const auto r = Fixture::vector(dofs, [](GlobalOrdinal id) { return 5.0 * wiggle(7 * id + 3); });  // without f_c and G z
  const auto z = host.fixture.multipliers(pressure);

  const ContactLinearisation linearised = host.at->linearise(host.laws);
  const SaddlePointBlocks blocks = linearised.saddle_point_blocks();
  Vector total(*r, Teuchos::Copy), C(multipliers);
  host.laws.add_force(total);
  G->apply(*z, total, Teuchos::NO_TRANS, 1.0, 1.0);
  host.laws.complementarity(C);
  Eigen::MatrixXd A(n + m, n + m);
  A << Fixture::dense(*host.stiffness(), dof_ids, dof_ids), Fixture::dense(*blocks.B, dof_ids, z_ids) + Fixture::dense(*G, dof_ids, z_ids),
      Fixture::dense(*blocks.C_d, z_ids, dof_ids), Fixture::dense(*blocks.C_z, z_ids, z_ids);
  Eigen::VectorXd b(n + m);
  b << -Fixture::dense(total, dof_ids), -Fixture::dense(C, z_ids);
  const Eigen::VectorXd whole = refined_solution(A, b);

  const RCP<Matrix> K = host.stiffness();
  Vector rhs(*r, Teuchos::Copy);
  rhs.scale(-1.0);
  const NodeElimination condensed = linearised.condense(*K, rhs);
  K->fillComplete(dofs, dofs);
  const SubstitutedRows substituted = condensed.substitute(*G);
  const RCP<Matrix> joint = Tpetra::MatrixMatrix::add(1.0, false, *K, 1.0, false, *substituted.of_dofs, dofs, dofs);
  rhs.update(-1.0, *substituted.constant, 1.0);
  const Eigen::FullPivLU<Eigen::MatrixXd> factors(Fixture::dense(*joint, dof_ids, dof_ids));
  const auto solve = [&](const Vector& right, Vector& dd) {
    const Eigen::VectorXd x = factors.solve(Fixture::dense(right, dof_ids));
    Tpetra::deep_copy(
        dd, *Fixture::vector(dofs, [&](GlobalOrdinal id) { return x[std::lower_bound(dof_ids.begin(), dof_ids.end(), id) - dof_ids.begin()]; }));
  };
  Vector dd(dofs), dz(multipliers);
  condensed.solve(rhs, solve, dd, dz, G.get());
  EXPECT_LE((Fixture::dense(dd, dof_ids) - whole.head(n)).norm(), 1e-11 * whole.head(n).norm());
  EXPECT_LE((Fixture::dense(dz, z_ids) - whole.tail(m)).norm(), 1e-11 * whole.tail(m).norm());
}

INSTANTIATE_TEST_SUITE_P(Cases, Substitution, ::testing::ValuesIn(indices(true)), test_name);

}  // namespace
}  // namespace mortise
