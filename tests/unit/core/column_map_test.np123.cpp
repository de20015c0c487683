// Column maps with further columns: the old local ids stay.

#include "mortise/core/column_map.hpp"

#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>
#include <Tpetra_Map.hpp>

#include "mortise/core/trilinos_versions.hpp"

namespace mortise {
namespace {

TEST(ColumnMap, KeepsItsColumnsAndAppendsOthersOnceInOrder) {
  const auto comm = Tpetra::getDefaultComm();
  const GlobalOrdinal first = 3 * comm->getRank();  // ranks share columns
  const auto unknown = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  const std::vector<GlobalOrdinal> own{first + 5, first + 2};
  const Map columns(unknown, own.data(), 2, 0, comm);
  const auto more = with_further_columns(columns, {first + 9, first + 2, first + 7, first + 9});
  const auto ids = local_ids(*more);
  EXPECT_EQ(std::vector<GlobalOrdinal>(ids.begin(), ids.end()), (std::vector<GlobalOrdinal>{first + 5, first + 2, first + 7, first + 9}));
  const auto same = with_further_columns(columns, {});
  EXPECT_TRUE(same->isSameAs(columns));
}

}  // namespace
}  // namespace mortise
