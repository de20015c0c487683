// Errors of one rank are thrown on all of them.

#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>

#include "mortise/core/dof_map.hpp"
#include "mortise/core/error.hpp"
#include "mortise/core/trilinos_versions.hpp"

namespace mortise {
namespace {

TEST(Errors, OfOneRankAreThrownOnAll) {
  const auto comm = Tpetra::getDefaultComm();
  const int last = comm->getSize() - 1;
  std::optional<StepFailure> failure;
  EXPECT_NO_THROW(throw_if_any(*comm, failure));
  if (comm->getRank() == last) failure = StepFailure(FailureKind::projection, "rank " + std::to_string(last));
  try {
    throw_if_any(*comm, failure);
    FAIL();
  } catch (const StepFailure& thrown) {
    EXPECT_EQ(thrown.kind(), FailureKind::projection);
    EXPECT_EQ(std::string(thrown.what()), "rank " + std::to_string(last));
  }
}

TEST(Errors, DiagnosticsAreCollectedWithoutRepeats) {
  const auto comm = Tpetra::getDefaultComm();
  std::vector<Diagnostic> mine;
  EXPECT_NO_THROW(throw_if_any(*comm, mine));
  mine.push_back({{"scene.xml", 3, "contact"}, "said by all"});
  mine.push_back({{"scene.xml", 4, ""}, "said by rank " + std::to_string(comm->getRank())});
  try {
    throw_if_any(*comm, mine);
    FAIL();
  } catch (const InputError& thrown) {
    ASSERT_EQ(static_cast<int>(thrown.diagnostics().size()), 1 + comm->getSize());
    EXPECT_EQ(to_string(thrown.diagnostics()[0]), "scene.xml:3: error: contact: said by all");
    EXPECT_EQ(thrown.diagnostics().back().message, "said by rank " + std::to_string(comm->getSize() - 1));
  }
}

TEST(DofMap, KeepsTheComponentsOfANodeTogether) {
  const auto comm = Tpetra::getDefaultComm();
  const auto dofs = make_dof_map(Map(7, 0, comm), 2);
  EXPECT_EQ(dofs->getGlobalNumElements(), 14u);
  for (std::size_t i = 0; i < local_id_count(*dofs); i += 2) EXPECT_EQ(dofs->getGlobalElement(i) + 1, dofs->getGlobalElement(i + 1));
}

}  // namespace
}  // namespace mortise
