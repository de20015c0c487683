#pragma once
// Files and directories that are called after given names.

#include <map>
#include <string>
#include <vector>

#include "mortise/core/error.hpp"

namespace mortise {

/// Finds names whose files would be one: name_for_files() replaces characters, and so may make two names the same.
class DistinctFiles {
 public:
  /// A file of this name is made for something else; `whose` says for what.
  void reserve(const std::string& file, const std::string& whose) { whose_[file] = whose; }
  /// Adds a diagnostic if the file of this name is another's.
  void add(const std::string& name, const Place& place, std::vector<Diagnostic>& diagnostics);

 private:
  std::map<std::string, std::string> whose_;  ///< by file
};

}  // namespace mortise
