#pragma once
// Members of the sets of one scope: nodes, or elements, by index.

#include <functional>
#include <string>
#include <unordered_map>
#include <vector>

#include "readers/abaqus/abaqus_model.hpp"
#include "readers/label_table.hpp"

namespace mortise {

/// Finds what items of sets mean. Sets may name sets that stand before them.
class AbaqusSets {
 public:
  /// Sets of an instance, and what has to be added to its indices.
  struct OfInstance {
    const AbaqusSets* sets = nullptr;
    std::int32_t offset = 0;
  };
  using Instances = std::unordered_map<std::string, OfInstance>;  ///< by their names in capital letters

  /// `first` is the index of the first member of each group of cells; {0} for nodes. All of these outlive this.
  AbaqusSets(const char* kind, const AbaqusScope& scope, const AbaqusNames<AbaqusSet>& sets, const std::vector<std::int64_t>& labels,
             std::vector<std::int32_t> first, const AbaqusLines& lines, FileErrors& errors);

  /// Finds the members of all sets. Returns notes for users.
  std::vector<std::string> resolve(const Instances& instances);
  /// Of the set with this index; in the order of the file, or ascending where it names other sets.
  const std::vector<std::int32_t>& members(std::size_t set) const { return members_[set]; }
  const LabelTable& table() const { return table_; }
  /// Adds the members of an item of a surface.
  void append(const AbaqusSetItem& item, const Instances& instances, std::vector<std::int32_t>& to) const {
    append(item, instances, members_.size(), to);
  }

 private:
  bool append(const AbaqusSetItem& item, const Instances& instances, std::size_t before, std::vector<std::int32_t>& to) const;

  const char* kind_;
  const AbaqusScope& scope_;
  const AbaqusNames<AbaqusSet>& sets_;
  std::vector<std::int32_t> first_;
  const AbaqusLines& lines_;
  FileErrors& errors_;
  LabelTable table_;
  std::size_t count_;
  std::vector<std::vector<std::int32_t>> members_;
};

}  // namespace mortise
