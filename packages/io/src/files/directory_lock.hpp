#pragma once
// One writer at a time in a directory.

#include <sys/file.h>

#include <optional>
#include <string>

namespace mortise {

/// Lock of a directory, for one process. The kernel releases it when the process ends, however it ends. Its file `.mortise.lock` names the process
/// for others to read. Where the file system has no such locks, the file alone is the lock: one that names a process of this host that has ended is
/// stale.
class DirectoryLock {
 public:
  using Flock = int (*)(int file, int operation);

  /// Holds nothing. `flock` is the system's; a test gives another.
  explicit DirectoryLock(Flock flock = ::flock) : flock_(flock) {}
  ~DirectoryLock() { release(); }
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;

  /// Takes the lock of an existing directory. Returns why it could not: who holds it, since when, and what to do.
  std::optional<std::string> take(const std::string& directory);
  /// Removes the file and gives the lock up; nothing if none is held.
  void release();

 private:
  std::optional<std::string> take_by_name(const std::string& path);

  Flock flock_;
  std::string path_;
  int file_ = -1;
};

/// Why another process may not write to the directory now: someone holds its lock. None if nobody does. Takes nothing.
std::optional<std::string> lock_holder(const std::string& directory, DirectoryLock::Flock flock = ::flock);

}  // namespace mortise
