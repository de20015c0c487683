#pragma once
// An Exodus II file that is open, whose dimensions and variables have been looked at.

#include <cstdint>
#include <string>
#include <vector>

namespace mortise {

/// Closes itself. An error of the library is thrown as an InputError that names the file and what was read.
class ExodusFile {
 public:
  /// @throws FileError if it cannot be opened, InputError if it is no Exodus file or one whose variables are not as the format has them
  explicit ExodusFile(std::string path);
  ~ExodusFile();
  ExodusFile(const ExodusFile&) = delete;
  ExodusFile& operator=(const ExodusFile&) = delete;

  int id() const { return id_; }
  std::int64_t dimension() const { return dimension_; }  ///< number of coordinates
  std::int64_t nodes() const { return nodes_; }
  std::int64_t elements() const { return elements_; }
  std::int64_t blocks() const { return blocks_; }
  std::int64_t node_sets() const { return node_sets_; }
  std::int64_t side_sets() const { return side_sets_; }

  /// Refuses the file with a message.
  [[noreturn]] void refuse(const std::string& message) const;
  /// Refuses the file where a call of the library reports an error (below 0); `what` it was to read.
  void require(int status, const std::string& what) const;
  /// Component 0 (x), 1 or 2 of nodes `first` (from 0) and on.
  void read_coordinates(std::int64_t first, std::int64_t count, int component, double* values) const;
  /// The numbers by which the file calls its blocks or sets: `kind` of the library, and how many there are.
  std::vector<std::int64_t> ids(int kind, std::int64_t count, const std::string& what) const;
  /// The name of a block or set; empty if it has none.
  std::string name(int kind, std::int64_t id) const;

 private:
  std::string path_;
  int id_ = -1;
  std::int64_t dimension_ = 0, nodes_ = 0, elements_ = 0, blocks_ = 0, node_sets_ = 0, side_sets_ = 0;
};

}  // namespace mortise
