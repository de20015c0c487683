#pragma once
// An HDF5 file that all ranks write together and that no reader sees before it is complete.

#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "files/file_descriptor.hpp"
#include "hdf5/hdf5_layout.hpp"
#include "mortise/core/types.hpp"

namespace mortise {

/// A file in the making. It has the name `path`.part until close() renames it; without close() it is removed. Members are collective and throw
/// FileError on all ranks.
///
/// The library's parallel driver waits for other ranks within its calls, as when metadata is flushed. A rank that fails there leaves the others
/// waiting without end. So rank 0 alone calls the library, which lays out the file. Each rank writes its rows to the place that the library chose.
/// Ranks communicate only to agree, after what can fail is done.
class Hdf5File {
 public:
  using Attribute = std::variant<double, long long, std::string>;

  /// Replaces what has the name `path`.part.
  Hdf5File(RCP<const Communicator> comm, std::string path);
  ~Hdf5File();
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;

  /// A dataset [rows x columns] (columns = 1: one-dimensional), with the groups above it. This rank writes the rows from `first` on that `values`
  /// holds.
  void write(const std::string& name, GlobalOrdinal rows, GlobalOrdinal first, int columns, const std::vector<double>& values);
  void write(const std::string& name, GlobalOrdinal rows, GlobalOrdinal first, int columns, const std::vector<long long>& values);

  /// An attribute of the dataset or group `object`; "/" is the file. A failure is thrown by the next of the other members.
  void attribute(const std::string& object, const std::string& name, const Attribute& value);

  /// The file is complete and has its name afterwards. It is with the operating system; sync_file() brings it to the disk.
  /// @param before_naming  called on every rank once the file is complete and has the name `path`.part; a reason that it returns is thrown
  void close(const std::function<std::optional<std::string>(const std::string& part)>& before_naming = {});

 private:
  void write(const std::string& name, GlobalOrdinal rows, GlobalOrdinal first, int columns, std::size_t count, const void* values, hid_t type);
  void agree(const std::optional<std::string>& reason);
  // On rank 0:
  std::optional<std::string> make_dataset(const std::string& name, GlobalOrdinal rows, int columns, hid_t type, long long& offset) const;
  std::optional<std::string> make_attribute(const std::string& object, const std::string& name, const Attribute& value) const;

  RCP<const Communicator> comm_;
  std::string path_, part_;
  std::optional<Hdf5Layout> layout_;   ///< on rank 0
  FileDescriptor file_;                ///< where each rank writes its rows
  std::optional<std::string> reason_;  ///< of an attribute that could not be written
  bool complete_ = false;
};

}  // namespace mortise
