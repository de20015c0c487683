#pragma once
// Rows of a dataset in an HDF5 file, read some at a time on one rank.

#include <string>
#include <vector>

#include "hdf5/hdf5_handle.hpp"

namespace mortise {

/// A dataset of numbers, [rows] or [rows x columns], open for reading. Throws FileError with the file's path.
class Hdf5Rows {
 public:
  Hdf5Rows(const std::string& path, const std::string& dataset);

  long long rows() const { return rows_; }
  int columns() const { return columns_; }

  /// `count` rows of one column, from row `first` on.
  std::vector<double> numbers(long long first, long long count, int column = 0) const;
  std::vector<long long> whole_numbers(long long first, long long count, int column = 0) const;

 private:
  void read(long long first, long long count, int column, hid_t type, void* values) const;

  std::string path_, name_;
  Hdf5Handle access_, file_, dataset_;
  bool is_table_ = false;
  long long rows_ = 0;
  int columns_ = 1;
};

}  // namespace mortise
