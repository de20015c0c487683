#pragma once
// Every rank sends every rank a list of plain values, or its neighbours alone.

#include <mpi.h>

#include <Teuchos_DefaultMpiComm.hpp>
#include <map>
#include <numeric>
#include <set>
#include <type_traits>
#include <vector>

#include "mortise/core/types.hpp"

namespace mortise {

/// Collective. `send[r]` goes to rank r; returns what each rank sent here. T is copied byte by byte.
template <class T>
std::vector<std::vector<T>> all_to_all(const Communicator& comm, const std::vector<std::vector<T>>& send) {
  static_assert(std::is_trivially_copyable_v<T>);
  const auto* mpi = dynamic_cast<const Teuchos::MpiComm<int>*>(&comm);
  if (mpi == nullptr || comm.getSize() == 1) return send;
  const MPI_Comm raw = (*mpi->getRawMpiComm())();
  const std::size_t ranks = send.size();
  std::vector<int> send_counts(ranks), receive_counts(ranks), send_starts(ranks), receive_starts(ranks);
  for (std::size_t r = 0; r < ranks; ++r) send_counts[r] = static_cast<int>(send[r].size());
  MPI_Alltoall(send_counts.data(), 1, MPI_INT, receive_counts.data(), 1, MPI_INT, raw);
  std::exclusive_scan(send_counts.begin(), send_counts.end(), send_starts.begin(), 0);
  std::exclusive_scan(receive_counts.begin(), receive_counts.end(), receive_starts.begin(), 0);
  std::vector<T> outgoing, incoming(static_cast<std::size_t>(receive_starts.back() + receive_counts.back()));
  for (const auto& part : send) outgoing.insert(outgoing.end(), part.begin(), part.end());
  MPI_Datatype type;
  MPI_Type_contiguous(static_cast<int>(sizeof(T)), MPI_BYTE, &type);
  MPI_Type_commit(&type);
  MPI_Alltoallv(outgoing.data(), send_counts.data(), send_starts.data(), type, incoming.data(), receive_counts.data(), receive_starts.data(), type,
                raw);
  MPI_Type_free(&type);
  std::vector<std::vector<T>> received(ranks);
  for (std::size_t r = 0; r < ranks; ++r)
    received[r].assign(incoming.begin() + receive_starts[r], incoming.begin() + receive_starts[r] + receive_counts[r]);
  return received;
}

/// One message for each of some other ranks. `sources` are those that have this rank among theirs; returns their messages, ascending by rank. Only
/// these ranks talk to one another. T is copied byte by byte.
template <class T>
std::vector<std::vector<T>> exchange_with_neighbours(const Communicator& comm, const std::map<int, std::vector<T>>& send,
                                                     const std::set<int>& sources) {
  static_assert(std::is_trivially_copyable_v<T>);
  std::vector<std::vector<T>> received;
  const auto* mpi = dynamic_cast<const Teuchos::MpiComm<int>*>(&comm);
  if (mpi == nullptr) return received;  // one rank has no other
  const MPI_Comm raw = (*mpi->getRawMpiComm())();
  constexpr int tag = 2417;
  MPI_Datatype type;
  MPI_Type_contiguous(static_cast<int>(sizeof(T)), MPI_BYTE, &type);
  MPI_Type_commit(&type);
  std::vector<MPI_Request> requests;
  for (const auto& [rank, values] : send) MPI_Isend(values.data(), static_cast<int>(values.size()), type, rank, tag, raw, &requests.emplace_back());
  for (const int source : sources) {
    MPI_Message message;
    MPI_Status status;
    MPI_Mprobe(source, tag, raw, &message, &status);
    int count = 0;
    MPI_Get_count(&status, type, &count);
    auto& values = received.emplace_back(static_cast<std::size_t>(count));
    MPI_Mrecv(values.data(), count, type, &message, MPI_STATUS_IGNORE);
  }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  MPI_Type_free(&type);
  return received;
}

}  // namespace mortise
