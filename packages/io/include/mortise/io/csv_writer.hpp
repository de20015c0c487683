#pragma once
// Tables of comma separated values that grow row by row.

#include <fstream>
#include <string>
#include <variant>
#include <vector>

#include "mortise/core/types.hpp"

namespace mortise {

/// One entry of a row. Numbers are written with as many digits as it takes to read the same number back.
using CsvValue = std::variant<double, long long, std::string>;

/// Writes a table on rank 0. Each row is on the disk when row() returns. Members are collective and throw FileError on all ranks.
class CsvWriter {
 public:
  /// Replaces the file and writes its header line.
  CsvWriter(RCP<const Communicator> comm, std::string path, const std::vector<std::string>& columns);

  /// Only rank 0's values count; a number of them that is not that of the columns is a FileError too.
  void row(const std::vector<CsvValue>& values);

  /// The same for many rows, written at once; other ranks may pass any number.
  void rows(const std::vector<std::vector<CsvValue>>& rows);

  const std::string& path() const { return path_; }

 private:
  void write_line(const std::string& line);

  RCP<const Communicator> comm_;
  std::string path_;
  std::size_t columns_;
  std::ofstream stream_;
};

}  // namespace mortise
