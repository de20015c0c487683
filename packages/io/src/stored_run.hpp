#pragma once
// What a FieldWriter left in a directory, read back on one rank.

#include <functional>
#include <string>
#include <vector>

#include "field_files.hpp"
#include "mortise/shape/cell.hpp"

namespace mortise {

/// A body of a stored mesh.
struct StoredBody {
  std::string name;
  CellShape shape{};
  long long elements = 0;
};

/// Mesh and steps below a directory. Throws FileError for what is missing or damaged.
class StoredRun {
 public:
  /// Reads names, sizes and what each step's file says of itself.
  explicit StoredRun(std::string directory);

  std::string path(const std::string& name) const { return directory_ + "/" + name; }
  long long nodes() const { return nodes_; }
  long long elements() const { return elements_; }
  int dimension() const { return dimension_; }  ///< 3 if there are solids
  const std::vector<StoredBody>& bodies() const { return bodies_; }
  const std::vector<StoredStep>& steps() const { return steps_; }

  /// visit(body, nodes of one element or of several that follow one another in the body, the first of them by its id) in the order of ids.
  using Visitor = std::function<void(int body, const std::vector<long long>& nodes, long long first_id)>;
  void visit_elements(const Visitor& visit) const;

 private:
  void read_mesh();
  void read_steps();
  void check_rows(const StoredStep& step) const;

  std::string directory_;
  long long nodes_ = 0, elements_ = 0;
  int dimension_ = 2;
  std::vector<StoredBody> bodies_;
  std::vector<StoredStep> steps_;
};

/// Rows that are read or written at a time.
constexpr long long chunk_rows = 1 << 16;

}  // namespace mortise
