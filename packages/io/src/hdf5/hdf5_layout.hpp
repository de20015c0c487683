#pragma once
// HDF5 files of which the library writes the metadata alone, into memory.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "files/file_descriptor.hpp"
#include "hdf5/hdf5_handle.hpp"

namespace mortise {

/// A file that the HDF5 library lays out in memory: superblock, headers and attributes, and places for values, which others write to the disk. Once a
/// write of the library has failed, the library can neither close the file nor end without a crash. Here its writes cannot fail.
class Hdf5Layout {
 public:
  Hdf5Layout();
  ~Hdf5Layout();
  Hdf5Layout(const Hdf5Layout&) = delete;
  Hdf5Layout& operator=(const Hdf5Layout&) = delete;

  /// The library's handle of the file; negative if it could not be made or was closed.
  hid_t file() const { return file_; }

  /// Closes the library's file and writes its metadata to `file`, which then has the size that the library wants. Returns why it could not.
  std::optional<std::string> close(const FileDescriptor& file);

 private:
  struct Driver;  ///< between the library and the members below

  struct Piece {
    std::uintmax_t offset = 0;
    std::string bytes;
  };
  std::vector<Piece> pieces_;  ///< in the order of writing; a later one may lie over earlier ones
  std::uintmax_t size_ = 0;
  hid_t file_ = -1;
};

}  // namespace mortise
