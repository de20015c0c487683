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

/// Seconds in which a file without a text may get one.
constexpr std::time_t being_filled = 10;

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

/// True if the file system has no hard links.
bool has_no_links(int error) { return error == EPERM || error == EOPNOTSUPP || error == ENOTSUP || error == ENOSYS; }

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

bool is_file(int file) {
  struct stat status {};
  return fstat(file, &status) == 0 && S_ISREG(status.st_mode);
}

/// Opens the file of a lock to read it. Anything but a file, such as a pipe, is not waited for.
int open_lock(const std::string& path) { return open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK); }

/// Why the lock is held, where the file alone is the lock. `is_pending`: the file is about to get its text, or to go away.
std::optional<std::string> held_at(const std::string& path, bool& is_pending) {
  is_pending = false;
  const int file = open_lock(path);
  if (file < 0) return {};
  const auto holder = read_holder(file);
  struct stat status {};
  const bool is_new = fstat(file, &status) == 0 && std::time(nullptr) - status.st_mtime < being_filled;
  close(file);
  is_pending = !holder && is_new;
  if (is_pending) return being_written(holder);
  return held_by_name(holder, path);
}

/// Makes the file of a lock from that of this process by a link, so that it comes into being with its text; without links it gets the text at once.
/// @returns the open file, or -1 with errno: EEXIST where the lock is there
int make_lock(const std::string& mine, int file, const std::string& path) {
  if (link(mine.c_str(), path.c_str()) == 0) return file;
  if (!has_no_links(errno)) return -1;
  const int made = open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0666);
  if (made < 0 || !write_holder(made)) return made;
  const int reason = errno;
  close(made);
  unlink(path.c_str());
  errno = reason;
  return -1;
}

std::string lock_of(const std::string& directory) { return directory + "/" + lock_name; }

}  // namespace

std::optional<std::string> DirectoryLock::take(const std::string& directory) {
  const std::string path = lock_of(directory);
  const auto deadline = std::chrono::steady_clock::now() + patience;
  while (true) {
    int file = open(path.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    const bool is_mine = file < 0 && errno == ENOENT;
    if (is_mine) file = open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (is_mine && file < 0 && errno == EEXIST) continue;  // another one was faster
    if (file < 0) return fmt::format("{}: {}", path, std::strerror(errno));
    if (!is_file(file)) {
      close(file);
      return fmt::format("{} is no file; please remove it", path);
    }
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
    if (has_no_locks(error) && is_mine && is_still_at(file, path)) unlink(path.c_str());  // it has no text
    close(file);
    if (has_no_locks(error)) return take_by_name(path);
    if (error != EWOULDBLOCK && error != EINTR) return fmt::format("{}: {}", path, std::strerror(error));
    if (std::chrono::steady_clock::now() > deadline) return being_written(holder);
    std::this_thread::sleep_for(pause_between_tries);
  }
}

// A stale file is removed by the process that holds the guard, a directory. It looks at the file again before it removes it. Nobody else removes
// stale files, so the file that is removed is the one that was looked at.
std::optional<std::string> DirectoryLock::take_by_name(const std::string& path) {
  const std::string mine = fmt::format("{}.{}.{}", path, host_name(), getpid()), guard = path + ".guard";
  const auto deadline = std::chrono::steady_clock::now() + patience;
  const int file = open(mine.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0666);
  if (file < 0) return fmt::format("{}: {}", mine, std::strerror(errno));
  const auto give_up = [&](const std::string& reason) {
    unlink(mine.c_str());
    close(file);
    return reason;
  };
  if (const auto reason = write_holder(file)) return give_up(fmt::format("{}: {}", mine, *reason));
  while (true) {
    if (const int lock = make_lock(mine, file, path); lock >= 0) {
      unlink(mine.c_str());
      if (lock != file) close(file);
      path_ = path, file_ = lock;
      return {};
    }
    if (errno != EEXIST) return give_up(fmt::format("{}: {}", path, std::strerror(errno)));
    const bool is_late = std::chrono::steady_clock::now() > deadline;
    bool is_pending = false;
    if (auto held = held_at(path, is_pending)) {
      if (!is_pending || is_late) return give_up(*held);
      std::this_thread::sleep_for(pause_between_tries);
    } else if (mkdir(guard.c_str(), 0777) == 0) {
      held = held_at(path, is_pending);
      if (!held) unlink(path.c_str());
      rmdir(guard.c_str());
    } else if (is_late) {
      return give_up(fmt::format("{} and {} are left of processes that have ended; please remove both", path, guard));
    } else {
      std::this_thread::sleep_for(pause_between_tries);
    }
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
  const int file = open_lock(path);
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
