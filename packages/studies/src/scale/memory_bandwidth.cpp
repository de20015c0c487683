#include "scale/memory_bandwidth.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <vector>

namespace mortise {
namespace {

constexpr std::size_t entries = 8u << 20;  // 64 MiB for each of three vectors
constexpr int repeats = 5;

using Clock = std::chrono::steady_clock;

/// One process: says that it is ready, waits for the start, then writes the bandwidth of its best repeat.
[[noreturn]] void measure(int start, int result) noexcept {
  std::vector<double> a(entries, 0.0), b(entries, 1.0), c(entries, 2.0);
  double best = 0.0;
  char go;
  if (write(result, &best, sizeof best) != static_cast<ssize_t>(sizeof best)) _exit(1);
  if (read(start, &go, 1) != 0) _exit(1);  // nobody writes: the end of the file is the start
  for (int repeat = 0; repeat < repeats; ++repeat) {
    const double scale = 0.5 + repeat;
    const auto begin = Clock::now();
    for (std::size_t i = 0; i < entries; ++i) a[i] = b[i] + scale * c[i];
    const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    if (a[entries / 2] != 1.0 + 2.0 * scale) _exit(1);
    best = std::max(best, 3.0 * sizeof(double) * entries / seconds);
  }
  _exit(write(result, &best, sizeof best) == static_cast<ssize_t>(sizeof best) ? 0 : 1);
}

bool read_number(int from, double& number) { return read(from, &number, sizeof number) == static_cast<ssize_t>(sizeof number); }

}  // namespace

double triad_bandwidth(int processes) {
  struct Child {
    pid_t id;
    int result;
  };
  std::array<int, 2> start, result;
  if (pipe2(start.data(), O_CLOEXEC) != 0) return 0.0;
  std::vector<Child> children;
  for (int p = 0; p < processes && pipe2(result.data(), O_CLOEXEC) == 0; ++p) {
    const pid_t id = fork();
    if (id == 0) {
      close(start[1]);
      measure(start[0], result[1]);
    }
    close(result[1]);
    if (id > 0)
      children.push_back({id, result[0]});
    else
      close(result[0]);
  }
  close(start[0]);
  bool well = static_cast<int>(children.size()) == processes;
  double sum = 0.0, one = 0.0;
  for (const Child& child : children) well = read_number(child.result, one) && well;
  close(start[1]);
  for (const Child& child : children) {
    well = read_number(child.result, one) && well;
    sum += one;
    close(child.result);
    waitpid(child.id, nullptr, 0);
  }
  return well ? sum : 0.0;
}

}  // namespace mortise
