#pragma once
// The lines of *NODE and *ELEMENT.

#include "readers/abaqus/abaqus_context.hpp"
#include "readers/abaqus/abaqus_model.hpp"

namespace mortise {

/// Adds nodes and elements to a scope, and those of one keyword to the set that it names.
class AbaqusMeshLines {
 public:
  AbaqusMeshLines(AbaqusContext& context, AbaqusModel& model) : context_(context), model_(model) {}

  void begin_nodes(const AbaqusKeyword& keyword, AbaqusScope& scope);
  /// Returns false, with an error, if the type of the elements is not read.
  bool begin_elements(const AbaqusKeyword& keyword, AbaqusScope& scope);
  /// A data line behind either. Nodes of an element may go on over lines: it ends when it has all of them.
  void read(std::string_view line) { is_nodes_ ? read_node(line) : left_out_ != nullptr ? read_left_out(line) : read_element(line); }
  /// Behind the last data line.
  void end();

 private:
  void read_node(std::string_view line);
  void read_element(std::string_view line);
  void read_left_out(std::string_view line);
  void require_indices(std::size_t count, const char* what);
  std::size_t group() const { return static_cast<std::size_t>(group_); }

  AbaqusContext& context_;
  AbaqusModel& model_;
  AbaqusScope* scope_ = nullptr;
  bool is_nodes_ = true;
  std::string set_;  ///< that the keyword names
  AbaqusSpot set_spot_;
  std::int32_t first_ = 0;  ///< node or cell behind the keyword

  std::string type_name_;
  std::size_t nodes_of_type_ = 0, elements_ = 0;
  std::int32_t group_ = 0;
  bool is_surface_ = false;

  std::int64_t* left_out_ = nullptr;  ///< number of elements of this type, which are not read; null: they are
  bool in_element_ = false;           ///< that has not all of its nodes
  std::int32_t element_ = 0;
  AbaqusSpot element_spot_;
  std::vector<std::int32_t> element_nodes_;
};

}  // namespace mortise
