#include "run/stepping/watchdog.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <mpi.h>
#include <sys/mman.h>
#include <unistd.h>

#include <Teuchos_DefaultMpiComm.hpp>
#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <exception>
#include <iostream>
#include <mutex>
#include <thread>
#include <vector>

namespace mortise {
namespace {

using namespace std::chrono_literals;

constexpr auto beat = 1s;
constexpr auto patience = 15s;  ///< a machine that is busy may keep a thread waiting for seconds

long long now() { return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

double seconds(long long nanoseconds) { return 1e-9 * static_cast<double>(nanoseconds); }

/// Memory that the ranks of a machine share, filled with zeros; null on all of them if any could not get it. A window of MPI would leave ranks
/// waiting where there is no room for its file.
void* shared_memory(MPI_Comm machine, std::size_t bytes) {
  int rank = 0;
  MPI_Comm_rank(machine, &rank);
  std::array<char, 64> name{};
  if (rank == 0) std::snprintf(name.data(), name.size(), "/mortise-%ld", static_cast<long>(getpid()));
  MPI_Bcast(name.data(), static_cast<int>(name.size()), MPI_CHAR, 0, machine);
  int file = rank == 0 ? shm_open(name.data(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600) : -1;
  int good = rank != 0 || (file >= 0 && ftruncate(file, static_cast<off_t>(bytes)) == 0) ? 1 : 0;
  MPI_Bcast(&good, 1, MPI_INT, 0, machine);
  if (good != 0 && rank != 0) file = shm_open(name.data(), O_RDWR | O_CLOEXEC, 0600);
  void* memory = good != 0 && file >= 0 ? mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0) : MAP_FAILED;
  if (file >= 0) close(file);
  good = memory != MAP_FAILED ? 1 : 0;
  MPI_Allreduce(MPI_IN_PLACE, &good, 1, MPI_INT, MPI_MIN, machine);
  if (rank == 0) shm_unlink(name.data());  // it goes with the last rank
  if (good != 0) return memory;
  if (memory != MAP_FAILED) munmap(memory, bytes);
  return nullptr;
}

}  // namespace

struct Watchdog::Implementation {
  /// Sign of life that a rank shows the others of its machine. The clock is that of the machine, the same for all processes.
  struct Sign {
    std::atomic<long long> time;  ///< nanoseconds of the steady clock
    long long process, rank;
  };
  static_assert(std::atomic<long long>::is_always_lock_free, "signs stand in memory that processes share");

  Implementation(MPI_Comm machine_, Sign* memory_, int size, long long rank)
      : machine(machine_), memory(memory_), signs(static_cast<std::size_t>(size)), missing(signs.size(), 0) {
    MPI_Comm_rank(machine, &mine);
    for (std::size_t other = 0; other < signs.size(); ++other) signs[other] = memory + other;
    Sign& own = *signs[static_cast<std::size_t>(mine)];
    own.process = getpid();
    own.rank = rank;
    own.time = now();
    MPI_Barrier(machine);
    thread = std::thread([this] { watch(); });
  }

  ~Implementation() {
    {
      const std::lock_guard lock(mutex);
      ended = true;
    }
    wake.notify_all();
    thread.join();
    munmap(memory, signs.size() * sizeof(Sign));
    // Where an exception ends the run, the other ranks may never come here.
    if (std::uncaught_exceptions() == exceptions) MPI_Comm_free(&machine);
  }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  void watch() {
    std::unique_lock lock(mutex);
    while (!wake.wait_for(lock, beat, [this] { return ended; })) {
      signs[static_cast<std::size_t>(mine)]->time = now();
      look();
    }
    signs[static_cast<std::size_t>(mine)]->time = 0;  // this rank is done: nobody is to wait for it
  }

  // Only the lowest that is awake speaks.
  void look() {
    const long long allowed = std::chrono::duration_cast<std::chrono::nanoseconds>(patience).count(), present = now();
    for (int other = 0; other < static_cast<int>(signs.size()); ++other) {
      const Sign& sign = *signs[static_cast<std::size_t>(other)];
      const long long time = sign.time, silent = time == 0 ? 0 : present - time;
      long long& since = missing[static_cast<std::size_t>(other)];
      if (other < mine && silent < allowed) return;
      if (other == mine) continue;
      if (silent >= allowed && since == 0) {
        since = time;
        std::cerr << fmt::format(
                         "warning: rank {} (process {}) has given no sign for {:.0f} s: it is stopped, swapped out or kept from running. The other "
                         "ranks wait for it. `kill -CONT {}` lets a stopped one go on",
                         sign.rank, sign.process, seconds(silent), sign.process)
                  << std::endl;
      } else if (silent < allowed && since != 0) {
        std::cerr << fmt::format("rank {} (process {}) is back after {:.0f} s", sign.rank, sign.process, seconds(present - since)) << std::endl;
        since = 0;
      }
    }
  }

  MPI_Comm machine;
  Sign* memory;  ///< [ranks of this machine]
  int mine = 0;
  int exceptions = std::uncaught_exceptions();
  std::vector<Sign*> signs;        ///< [ranks of this machine]
  std::vector<long long> missing;  ///< [ranks of this machine] last sign of those that were reported; 0: it was not
  std::mutex mutex;
  std::condition_variable wake;
  bool ended = false;
  std::thread thread;
};

Watchdog::Watchdog(const Communicator& comm) {
  const auto* mpi = dynamic_cast<const Teuchos::MpiComm<int>*>(&comm);
  if (mpi == nullptr || mpi->getSize() == 1) return;
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(*mpi->getRawMpiComm(), MPI_COMM_TYPE_SHARED, mpi->getRank(), MPI_INFO_NULL, &machine);
  int size = 1;
  MPI_Comm_size(machine, &size);
  auto* memory = size > 1 ? static_cast<Implementation::Sign*>(shared_memory(machine, size * sizeof(Implementation::Sign))) : nullptr;
  if (memory != nullptr)
    implementation_ = std::make_unique<Implementation>(machine, memory, size, mpi->getRank());
  else
    MPI_Comm_free(&machine);
}

Watchdog::~Watchdog() = default;

}  // namespace mortise
