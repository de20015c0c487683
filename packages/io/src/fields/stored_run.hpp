#pragma once
// Files of a FieldWriter in a directory, read back on one rank.

#include <functional>
#include <string>
#include <vector>

#include "fields/field_files.hpp"
#include "mortise/shape/cell.hpp"

namespace mortise {

/// Elements of one shape and body that follow one another.
struct StoredBlock {
  std::string name;  ///< of the body; from its second block on with a number
  int body = 0;
  CellShape shape{};
  long long first = 0;  ///< id of the first element
  long long elements = 0;
};

/// Mesh and steps below a directory. Throws FileError for what is missing or damaged.
class StoredRun {
 public:
  /// Reads names, sizes and the description in each step's file.
  explicit StoredRun(std::string directory);

  std::string path(const std::string& name) const { return directory_ + "/" + name; }
  long long nodes() const { return nodes_; }
  long long elements() const { return elements_; }
  int dimension() const { return dimension_; }                        ///< 3 if there are solids
  const std::vector<StoredBlock>& blocks() const { return blocks_; }  ///< by ids
  const std::vector<StoredStep>& steps() const { return steps_; }

  /// visit(block, nodes of one element or of several that follow one another in it, in XDMF's order, the first of them by its id) in the order of
  /// ids.
  using Visitor = std::function<void(std::size_t block, const std::vector<long long>& nodes, long long first_id)>;
  void visit_elements(const Visitor& visit) const;

 private:
  void read_mesh();
  void name_blocks();
  void read_steps();
  void check_rows(const StoredStep& step) const;

  std::string directory_;
  long long nodes_ = 0, elements_ = 0;
  int dimension_ = 2;
  std::vector<StoredBlock> blocks_;
  std::vector<StoredStep> steps_;
};

/// Rows that are read or written at a time.
constexpr long long chunk_rows = 1 << 16;

}  // namespace mortise
