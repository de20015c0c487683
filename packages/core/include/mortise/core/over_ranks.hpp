#pragma once
// Values gathered over all ranks, entry by entry. Collective.

#include <Teuchos_CommHelpers.hpp>
#include <type_traits>

#include "mortise/core/types.hpp"

namespace mortise {

/// Of a number, or of each entry of a std::vector or a dense Eigen matrix, of which every rank has as many.
template <class Values>
Values over_ranks(const Communicator& comm, Teuchos::EReductionType type, const Values& mine) {
  Values all = mine;
  if constexpr (std::is_arithmetic_v<Values>)
    Teuchos::reduceAll(comm, type, 1, &mine, &all);
  else
    Teuchos::reduceAll(comm, type, static_cast<int>(mine.size()), mine.data(), all.data());
  return all;
}

template <class Values>
Values sum_over_ranks(const Communicator& comm, const Values& mine) {
  return over_ranks(comm, Teuchos::REDUCE_SUM, mine);
}

template <class Values>
Values most_over_ranks(const Communicator& comm, const Values& mine) {
  return over_ranks(comm, Teuchos::REDUCE_MAX, mine);
}

template <class Values>
Values least_over_ranks(const Communicator& comm, const Values& mine) {
  return over_ranks(comm, Teuchos::REDUCE_MIN, mine);
}

}  // namespace mortise
