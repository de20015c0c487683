#pragma once
// Text files that grow line by line and can be continued.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "mortise/core/types.hpp"

namespace mortise {

class FileDescriptor;

/// Appends lines on rank 0. They are with the operating system when append() returns: they outlive the program, however that ends. sync() brings them
/// to the disk, so that they outlive a loss of power. A line that cannot be written whole is not written at all. Members are collective and throw
/// FileError on all ranks.
class LineFile {
 public:
  /// Replaces the file.
  /// @param header  its first line, with its end; empty: it has none
  LineFile(RCP<const Communicator> comm, std::string path, const std::string& header = "");

  /// Adds to a file that is there, of which the first `continue_at` bytes are kept: a size() of the writer that began it. The file is cut by cut() or
  /// the first append(). FileError if the file is shorter, begins with another header, is a symbolic link, or if a line goes on there.
  LineFile(RCP<const Communicator> comm, std::string path, const std::string& header, std::uintmax_t continue_at);
  ~LineFile();
  LineFile(const LineFile&) = delete;
  LineFile& operator=(const LineFile&) = delete;

  /// Cuts off what is not kept.
  void cut();

  /// Lines with their ends; only rank 0's count.
  void append(const std::string& lines);

  /// Bytes of the file, the same on all ranks.
  std::uintmax_t size() const;

  /// Returns when all lines are on the disk.
  void sync() const;

  const std::string& path() const { return path_; }
  const RCP<const Communicator>& comm() const { return comm_; }

 private:
  std::optional<std::string> check(const std::string& header);

  RCP<const Communicator> comm_;
  std::string path_;
  std::unique_ptr<FileDescriptor> file_;
  std::uintmax_t size_ = 0;  ///< of complete lines, on rank 0
  bool is_cut_ = true;       ///< nothing stands behind them
};

}  // namespace mortise
