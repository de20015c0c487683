#pragma once
// A parallel HDF5 file: groups and datasets written in slabs.

#include <hdf5.h>

#include <optional>
#include <string>
#include <vector>

#include "mortise/core/types.hpp"

namespace mortise {

/// An open file. All members are collective and throw FileError on all ranks. Closing is explicit, so that its failure is not lost.
class Hdf5File {
 public:
  enum class Mode { create, append };
  Hdf5File(RCP<const Communicator> comm, std::string path, Mode mode);
  ~Hdf5File();
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;

  void make_group(const std::string& name);

  /// A dataset [rows x columns] (columns = 1: one-dimensional); this rank writes the rows from `first` on that `values` holds.
  void write(const std::string& name, GlobalOrdinal rows, GlobalOrdinal first, int columns, const std::vector<double>& values);
  void write(const std::string& name, GlobalOrdinal rows, GlobalOrdinal first, int columns, const std::vector<long long>& values);

  /// Everything is on the disk afterwards.
  void close();

 private:
  void write(const std::string& name, GlobalOrdinal rows, GlobalOrdinal first, int columns, std::size_t count, const void* values, hid_t stored,
             hid_t given);
  void agree(bool good) const;

  RCP<const Communicator> comm_;
  std::string path_;
  hid_t file_ = -1;
};

}  // namespace mortise
