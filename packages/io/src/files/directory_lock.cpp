#include "files/directory_lock.hpp"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <ctime>
#include <fstream>
#include <sstream>
#include <thread>

#include "files/directory_marker.hpp"

namespace mortise {
namespace {

/// A process that only asks whether a lock is held holds it for an instant; a process that was killed takes a while to end.
constexpr auto patience = std::chrono::milliseconds(500), pause_between_tries = std::chrono::milliseconds(20);

/// The process that holds the lock, as its file describes it.
struct LockHolder {
  std::string host;
  long process = 0;
  unsigned long long start = 0;  ///< clock ticks from the boot to the start of the process, which tells it from a later one of the same number
  std::string since;
};

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

std::optional<unsigned long long> start_of(long process) {
  std::ifstream file(fmt::format("/proc/{}/stat", process));
  std::string text;
  std::getline(file, text);
  std::istringstream words(text.substr(text.find_last_of(')') + 1));  // a name in parentheses stands before it and may hold anything
  std::string word;
  for (int i = 3; i < 22; ++i) words >> word;
  unsigned long long start = 0;
  return words >> start ? std::optional(start) : std::nullopt;
}

std::string this_holder() {
  return fmt::format("{} {} {} {:%Y-%m-%dT%H:%M:%SZ}\n", host_name(), getpid(), start_of(getpid()).value_or(0), fmt::gmtime(std::time(nullptr)));
}

std::optional<LockHolder> read_holder(int file) {
  std::array<char, 512> text{};
  const ssize_t size = pread(file, text.data(), text.size() - 1, 0);
  LockHolder holder;
  std::istringstream words(std::string(text.data(), size > 0 ? static_cast<std::size_t>(size) : 0));
  return words >> holder.host >> holder.process >> holder.start >> holder.since ? std::optional(holder) : std::nullopt;
}

bool is_alive(const LockHolder& holder) {
  if (const auto start = start_of(holder.process)) return *start == holder.start;
  return kill(static_cast<pid_t>(holder.process), 0) == 0 || errno == EPERM;
}

std::string being_written(const std::optional<LockHolder>& holder) {
  const std::string by = holder ? fmt::format("process {} on host {} since {}", holder->process, holder->host, holder->since) : "another process";
  return fmt::format("it is being written by {}; please wait, or choose another directory", by);
}

/// True if the file system has no locks, rather than one that is held.
bool has_no_locks(int error) { return error == ENOLCK || error == EOPNOTSUPP || error == ENOTSUP || error == ENOSYS; }

/// Why a lock whose file names this holder is held, where the file alone is the lock.
std::optional<std::string> held_by_name(const std::optional<LockHolder>& holder, const std::string& path) {
  if (!holder) return {};
  if (holder->host == host_name()) return is_alive(*holder) ? std::optional(being_written(holder)) : std::nullopt;
  return fmt::format("{}. If that process has ended, please remove {}", being_written(holder), path);
}

/// True if the path still leads to the open file: a process that gives a lock up removes its file.
bool is_still_at(int file, const std::string& path) {
  struct stat open_file {
  }, at_path{};
  return fstat(file, &open_file) == 0 && lstat(path.c_str(), &at_path) == 0 && open_file.st_ino == at_path.st_ino &&
         open_file.st_dev == at_path.st_dev;
}

std::optional<std::string> write_holder(int file) {
  const std::string text = this_holder();
  if (ftruncate(file, 0) == 0 && pwrite(file, text.data(), text.size(), 0) == static_cast<ssize_t>(text.size())) return {};
  return std::strerror(errno);
}

std::string lock_of(const std::string& directory) { return directory + "/" + lock_name; }

}  // namespace

std::optional<std::string> DirectoryLock::take(const std::string& directory) {
  const std::string path = lock_of(directory);
  const auto deadline = std::chrono::steady_clock::now() + patience;
  while (true) {
    const int file = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (file < 0) return fmt::format("{}: {}", path, std::strerror(errno));
    if (flock_(file, LOCK_EX | LOCK_NB) == 0) {
      if (!is_still_at(file, path)) {
        close(file);
        continue;
      }
      path_ = path, file_ = file;
      if (const auto reason = write_holder(file)) {
        release();
        return fmt::format("{}: {}", path, *reason);
      }
      return {};
    }
    const int error = errno;
    const auto holder = read_holder(file);
    close(file);
    if (has_no_locks(error)) return take_by_name(path);
    if (error != EWOULDBLOCK && error != EINTR) return fmt::format("{}: {}", path, std::strerror(error));
    if (std::chrono::steady_clock::now() > deadline) return being_written(holder);
    std::this_thread::sleep_for(pause_between_tries);
  }
}

std::optional<std::string> DirectoryLock::take_by_name(const std::string& path) {
  while (true) {
    if (const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW); file >= 0) {
      const auto holder = read_holder(file);
      close(file);
      if (auto held = held_by_name(holder, path)) return held;
    }
    unlink(path.c_str());  // stale
    const int file = open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (file < 0 && errno == EEXIST) continue;  // another one was faster
    if (file < 0) return fmt::format("{}: {}", path, std::strerror(errno));
    path_ = path, file_ = file;
    if (const auto reason = write_holder(file)) {
      release();
      return fmt::format("{}: {}", path, *reason);
    }
    return {};
  }
}

void DirectoryLock::release() {
  if (file_ < 0) return;
  if (is_still_at(file_, path_)) unlink(path_.c_str());
  close(file_);
  file_ = -1;
}

std::optional<std::string> lock_holder(const std::string& directory, DirectoryLock::Flock flock) {
  const std::string path = lock_of(directory);
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
  if (file < 0) return {};
  std::optional<std::string> held;
  if (flock(file, LOCK_SH | LOCK_NB) != 0) {
    if (errno == EWOULDBLOCK)
      held = being_written(read_holder(file));
    else if (has_no_locks(errno))
      held = held_by_name(read_holder(file), path);
  }
  close(file);
  return held;
}

}  // namespace mortise
