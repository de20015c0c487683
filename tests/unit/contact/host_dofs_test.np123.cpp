// Hosts with their own numbering, other fields among the dofs, and without those that are prescribed.
#include "linearised_cases.hpp"

namespace mortise {
namespace {

using namespace test;

class HostDofs : public ::testing::TestWithParam<int> {};

/// Contact at one iterate, with either numbering.
struct Linearised {
  Linearised(const Case& one, HostNumbering numbering) : fixture(one.surfaces, Tpetra::getDefaultComm(), numbering) {}

  void evaluate(const Vector& d, const Vector& before, const MultiVector* prescribed, const MultiVector* prescribed_before) {
    const ContactSystem& contact = *fixture.contact;
    const auto of = [](const Vector& dofs, const MultiVector* nodes) { return nodes ? NodalDisplacement(dofs, *nodes) : NodalDisplacement(dofs); };
    Vector guess(contact.multiplier_map());
    const ContactHistory history = contact.start_step(contact.initial_history(of(before, prescribed_before)), of(before, prescribed_before), guess);
    z = fixture.multipliers(pressure);
    const DifferentiatedContact first = contact.differentiate(of(d, prescribed), history);
    at = first.with(updated(contact, first.laws(*z), history));
    laws = at->laws(*z);
  }

  Fixture fixture;
  RCP<Vector> z;
  std::optional<DifferentiatedContact> at;
  std::optional<ContactLaws> laws;
};

RCP<MultiVector> on_nodes(const Fixture& fixture, const Vector& by_nodes, int dimension) {
  const auto result = rcp(new MultiVector(fixture.nodes, static_cast<std::size_t>(dimension)));
  const auto from = by_nodes.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t dof = 0; dof < from.extent(0); ++dof)
    result->replaceLocalValue(static_cast<LocalOrdinal>(dof) / dimension, dof % static_cast<std::size_t>(dimension), from(dof, 0));
  return result;
}

// Forces, conditions, blocks, the condensed system and what it recovers are those of the usual numbering at the rows and columns that there are.
TEST_P(HostDofs, GetTheSystemOfTheUsualNumbering) {
  const Case one = cases()[GetParam()];
  SCOPED_TRACE(one.name);
  Linearised usual(one, HostNumbering::by_nodes), host(one, HostNumbering::interleaved);
  const int dimension = one.surfaces.dimension;
  const auto d = Fixture::vector(usual.fixture.dofs, [](GlobalOrdinal id) { return 0.01 * wiggle(id); });
  const auto before = Fixture::vector(usual.fixture.dofs, [](GlobalOrdinal id) { return 0.01 * std::sin(3.1 * static_cast<double>(id) + 0.2); });
  usual.evaluate(*d, *before, nullptr, nullptr);
  const auto prescribed = on_nodes(usual.fixture, *d, dimension), prescribed_before = on_nodes(usual.fixture, *before, dimension);
  host.evaluate(*host.fixture.numbered(*d), *host.fixture.numbered(*before), prescribed.get(), prescribed_before.get());

  std::vector<GlobalOrdinal> usual_ids, host_ids;  // of the displacements that are unknowns of either
  for (const GlobalOrdinal id : Fixture::all_ids(*usual.fixture.dofs))
    if (host.fixture.number(id) != NodalField::none) {
      usual_ids.push_back(id);
      host_ids.push_back(host.fixture.number(id));
    }
  const auto usual_z = Fixture::all_ids(*usual.fixture.contact->multiplier_map()), host_z = Fixture::all_ids(*host.fixture.contact->multiplier_map());
  ASSERT_EQ(usual_z.size(), host_z.size());
  const auto expect_equal = [](const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, const char* what) {
    EXPECT_LE((a - b).norm(), 1e-13 * a.norm()) << what;
  };
  /// A block without the rows and columns that only one of the two has.
  const auto block = [](const Matrix& matrix, const std::vector<GlobalOrdinal>& rows, const std::vector<GlobalOrdinal>& columns) {
    std::vector<GlobalOrdinal> all = columns;
    for (const GlobalOrdinal id : Fixture::all_ids(*matrix.getDomainMap()))
      if (std::find(columns.begin(), columns.end(), id) == columns.end()) all.push_back(id);
    return Eigen::MatrixXd(Fixture::dense(matrix, rows, all).leftCols(static_cast<Eigen::Index>(columns.size())));
  };

  Vector usual_C(usual.fixture.contact->multiplier_map()), host_C(host.fixture.contact->multiplier_map());
  Vector usual_force(usual.fixture.dofs), host_force(host.fixture.dofs);
  usual.laws->complementarity(usual_C);
  host.laws->complementarity(host_C);
  usual.laws->add_force(usual_force);
  host.laws->add_force(host_force);
  expect_equal(Fixture::dense(usual_C, usual_z), Fixture::dense(host_C, host_z), "C");
  expect_equal(Fixture::dense(usual_force, usual_ids), Fixture::dense(host_force, host_ids), "f_c");

  const ContactLinearisation usual_linear = usual.at->linearise(*usual.laws), host_linear = host.at->linearise(*host.laws);
  const SaddlePointBlocks usual_blocks = usual_linear.saddle_point_blocks(), host_blocks = host_linear.saddle_point_blocks();
  expect_equal(block(*usual_blocks.B, usual_ids, usual_z), block(*host_blocks.B, host_ids, host_z), "B");
  expect_equal(block(*usual_blocks.C_d, usual_z, usual_ids), block(*host_blocks.C_d, host_z, host_ids), "C_d");
  expect_equal(block(*usual_blocks.C_z, usual_z, usual_z), block(*host_blocks.C_z, host_z, host_z), "C_z");

  const auto system = [](const Linearised& side) {
    return side.fixture.springs(side.fixture.contact->graph(*side.at, [&] { return side.fixture.bulk; }));
  };
  const RCP<Matrix> usual_K = system(usual), host_K = system(host);
  usual_linear.add_stiffness(*usual_K);
  host_linear.add_stiffness(*host_K);
  expect_equal(block(*usual_K, usual_ids, usual_ids), block(*host_K, host_ids, host_ids), "K + C~");
  if (usual.fixture.contact->keeps_multipliers()) return;

  const auto r = Fixture::vector(usual.fixture.dofs, [](GlobalOrdinal id) { return 5.0 * wiggle(7 * id + 3); });
  Vector usual_rhs(*r, Teuchos::Copy), host_rhs(*host.fixture.numbered(*r), Teuchos::Copy);
  const NodeElimination usual_condensed = usual_linear.condense(*usual_K, usual_rhs), host_condensed = host_linear.condense(*host_K, host_rhs);
  expect_equal(block(*usual_K, usual_ids, usual_ids), block(*host_K, host_ids, host_ids), "condensed K");
  expect_equal(Fixture::dense(usual_rhs, usual_ids), Fixture::dense(host_rhs, host_ids), "condensed rhs");

  // Prescribed dofs do not move.
  const auto increment = Fixture::vector(
      usual.fixture.dofs, [&](GlobalOrdinal id) { return host.fixture.number(id) == NodalField::none ? 0.0 : 0.02 * wiggle(3 * id + 1); });
  Vector usual_new(usual.fixture.contact->multiplier_map()), host_new(host.fixture.contact->multiplier_map());
  usual_condensed.recover(*increment, usual_new);
  host_condensed.recover(*host.fixture.numbered(*increment), host_new);
  expect_equal(Fixture::dense(usual_new, usual_z), Fixture::dense(host_new, host_z), "z");
}

INSTANTIATE_TEST_SUITE_P(Cases, HostDofs, ::testing::ValuesIn(indices(false)), test_name);

}  // namespace
}  // namespace mortise
