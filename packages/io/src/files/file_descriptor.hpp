#pragma once
// Files as the operating system has them: writing whole at a place, and why it failed.

#include <cstdint>
#include <optional>
#include <string>

namespace mortise {

/// An open file, closed with its scope. Members return why they failed, or nothing. No communication.
class FileDescriptor {
 public:
  FileDescriptor() = default;
  ~FileDescriptor();
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;

  /// @param flags  of open(2); a file that is made can be read and written by all that the user's mask lets
  std::optional<std::string> open(const std::string& path, int flags);
  /// Writes all bytes from `offset` on.
  std::optional<std::string> write(const void* bytes, std::size_t count, std::uintmax_t offset) const;
  /// The bytes from `offset` on; an end of the file before `count` bytes is a failure.
  std::optional<std::string> read(std::string& bytes, std::size_t count, std::uintmax_t offset) const;
  std::optional<std::string> size(std::uintmax_t& bytes) const;
  /// Cuts the file, or fills it with zeros, to this size.
  std::optional<std::string> resize(std::uintmax_t bytes) const;
  /// Returns when the content is on the disk.
  std::optional<std::string> sync() const;
  /// Some file systems say only here that a write failed.
  std::optional<std::string> close();

 private:
  int number_ = -1;
};

}  // namespace mortise
