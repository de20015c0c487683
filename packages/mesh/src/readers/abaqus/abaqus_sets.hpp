#pragma once
// Members of the sets of one scope: nodes, or elements, by index.

#include <functional>
#include <string>
#include <unordered_map>
#include <vector>

#include "readers/abaqus/abaqus_model.hpp"
#include "readers/label_table.hpp"

namespace mortise {

/// Finds what items of sets mean. Sets may name sets that stand before them. A label that stands twice is that of the first member.
class AbaqusSets {
 public:
  /// Sets of an instance, and what has to be added to its indices.
  struct OfInstance {
    const AbaqusSets* sets = nullptr;
    std::int32_t offset = 0;
  };
  using Instances = std::unordered_map<std::string, OfInstance>;  ///< by their names in capital letters
  /// Adds the nodes of the set of elements that an item names.
  using AppendNodes = std::function<void(const AbaqusSetItem& item, std::vector<std::int32_t>& to)>;

  /// Members of an item, or why there are none.
  struct Appended {
    bool found = true;          ///< else an error was added
    std::int64_t left_out = 0;  ///< members that are elements that are not read
  };

  /// `first` is the index of the first member of each group of cells; {0} for nodes. `left_out`: further labels, of elements that are not read. The
  /// scope, its sets, the lines and the errors outlive this.
  AbaqusSets(const char* kind, const AbaqusScope& scope, const AbaqusNames<AbaqusSet>& sets, const std::vector<std::int64_t>& labels,
             const std::vector<std::int64_t>& left_out, std::vector<std::int32_t> first, const AbaqusLines& lines, FileErrors& errors);

  /// Finds the members of all sets. Returns notes for users.
  std::vector<std::string> resolve(const Instances& instances, const AppendNodes& nodes_of_elements = {});
  /// Of the set with this index; in the order of the file, or ascending where it names other sets.
  const std::vector<std::int32_t>& members(std::size_t set) const { return members_[set]; }
  /// Number of the elements of the set that are not read.
  std::int64_t left_out(std::size_t set) const { return left_out_of_sets_[set]; }
  const LabelTable& table() const { return table_; }
  /// Adds the members of an item of a surface.
  Appended append(const AbaqusSetItem& item, const Instances& instances, std::vector<std::int32_t>& to) const {
    return append(item, instances, members_.size(), {}, to);
  }

 private:
  Appended append(const AbaqusSetItem& item, const Instances& instances, std::size_t before, const AppendNodes& nodes_of_elements,
                  std::vector<std::int32_t>& to) const;
  Appended append_of_instance(const AbaqusSetItem& item, const Instances& instances, std::vector<std::int32_t>& to) const;

  const char* kind_;
  const AbaqusScope& scope_;
  const AbaqusNames<AbaqusSet>& sets_;
  std::vector<std::int32_t> first_;
  const AbaqusLines& lines_;
  FileErrors& errors_;
  LabelTable table_, left_out_;
  std::vector<std::int32_t> first_of_label_;  ///< [members] the first with the same label; empty: none stands twice
  std::size_t count_;
  std::vector<std::vector<std::int32_t>> members_;
  std::vector<std::int64_t> left_out_of_sets_;
};

}  // namespace mortise
