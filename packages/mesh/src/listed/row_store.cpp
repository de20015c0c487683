#include "mortise/mesh/row_store.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <algorithm>
#include <limits>

namespace mortise {
namespace {

/// Numbers of a message: MPI counts in int.
int message_size(std::size_t count) {
  if (count > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw std::runtime_error("one rank's share of a mesh file is too large for a message; please take more ranks");
  return static_cast<int>(count);
}

template <class Word>
void send_all(const Communicator& comm, const std::vector<Word>& words, int rank) {
  const int count = message_size(words.size());
  Teuchos::send(comm, count, rank);
  if (count > 0) Teuchos::send(comm, count, words.data(), rank);
}

template <class Word>
std::vector<Word> receive_all(const Communicator& comm, int rank) {
  int count = 0;
  Teuchos::receive(comm, rank, &count);
  std::vector<Word> words(static_cast<std::size_t>(count));
  if (count > 0) Teuchos::receive(comm, rank, count, words.data());
  return words;
}

}  // namespace

template <class T>
std::size_t RowStore<T>::find(GlobalOrdinal id) const {
  const auto found = std::lower_bound(ids_.begin(), ids_.end(), id);
  if (found == ids_.end() || *found != id) throw std::logic_error("a row of a mesh file that this rank did not fetch");
  return static_cast<std::size_t>(found - ids_.begin());
}

template <class T>
void RowStore<T>::fetch(const Communicator& comm, const std::vector<GlobalOrdinal>& ids) {
  if (comm.getSize() == 1) return;
  if (comm.getRank() != 0) {
    send_all(comm, ids, 0);
    const auto lengths = receive_all<int>(comm, 0);
    values_ = receive_all<T>(comm, 0);
    ids_ = ids;
    offsets_.assign(1, 0);
    for (const int length : lengths) offsets_.push_back(offsets_.back() + length);
    is_whole_ = false;
    return;
  }
  for (int rank = 1; rank < comm.getSize(); ++rank) {
    const auto wanted = receive_all<GlobalOrdinal>(comm, rank);
    std::vector<int> lengths;
    std::vector<T> values;
    for (const GlobalOrdinal id : wanted) {
      const Row<T> found = row(id);
      lengths.push_back(static_cast<int>(found.size()));
      values.insert(values.end(), found.begin(), found.end());
    }
    send_all(comm, lengths, rank);
    send_all(comm, values, rank);
  }
}

template class RowStore<std::int32_t>;
template class RowStore<double>;

}  // namespace mortise
