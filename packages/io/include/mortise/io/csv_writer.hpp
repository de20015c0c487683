#pragma once
// Tables of comma separated values that grow row by row.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "mortise/core/types.hpp"
#include "mortise/io/line_file.hpp"

namespace mortise {

/// One entry of a row. Numbers are written with as many digits as it takes to read the same number back.
using CsvValue = std::variant<double, long long, std::string>;

/// Writes a table on rank 0. A row is with the operating system when row() returns: it outlives the program, however that ends. The call sync()
/// brings rows to the disk, so that they outlive a loss of power. A row that cannot be written whole is not written at all. Members are collective
/// and throw FileError on all ranks.
class CsvWriter {
 public:
  /// Replaces the file and writes its header line.
  CsvWriter(RCP<const Communicator> comm, std::string path, const std::vector<std::string>& columns);

  /// Adds rows to a table that is there, of which the first `continue_at` bytes are kept: a size() of the writer that began it. FileError if the file
  /// is shorter, has other columns, is a symbolic link, or if a line goes on there.
  CsvWriter(RCP<const Communicator> comm, std::string path, const std::vector<std::string>& columns, std::uintmax_t continue_at);

  /// Cuts off what is not kept; the first row does so too.
  void cut() { lines_.cut(); }

  /// Only rank 0's values count; a number of them that is not that of the columns is a FileError too.
  void row(const std::vector<CsvValue>& values);

  /// Writes many rows at once; other ranks may pass any number.
  void rows(const std::vector<std::vector<CsvValue>>& rows);

  /// Bytes of the file, the same on all ranks.
  std::uintmax_t size() const { return lines_.size(); }

  /// Returns when all rows are on the disk.
  void sync() const { lines_.sync(); }

  const std::string& path() const { return lines_.path(); }

 private:
  LineFile lines_;
  std::size_t columns_;
};

}  // namespace mortise
