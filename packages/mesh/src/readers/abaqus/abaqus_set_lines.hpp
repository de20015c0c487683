#pragma once
// The lines of *NSET, *ELSET and *SURFACE.

#include <set>

#include "readers/abaqus/abaqus_context.hpp"
#include "readers/abaqus/abaqus_model.hpp"

namespace mortise {

/// Adds items to the sets and surfaces of a scope. `instances` are the names, in capital letters, of the instances there are so far.
class AbaqusSetLines {
 public:
  AbaqusSetLines(AbaqusContext& context, const std::set<std::string>& instances) : context_(context), instances_(instances) {}

  void begin_set(const AbaqusKeyword& keyword, AbaqusScope& scope);
  /// Returns false, with an error, if surfaces of this type are not read.
  bool begin_surface(const AbaqusKeyword& keyword, AbaqusScope& scope);
  /// A data line behind either.
  void read(std::string_view line);

 private:
  enum class Kind { nodes, elements, surface };

  void read_instance_parameter(const AbaqusKeyword& keyword);
  void read_generated(std::string_view line, AbaqusSet& set, const char* of);
  void read_surface_line(std::string_view line);
  std::int32_t name_index(std::string_view name);
  /// A label, the name of a set, or one of these behind the name of an instance and a point.
  AbaqusSetItem item_of(std::string_view field);

  AbaqusContext& context_;
  const std::set<std::string>& instances_;
  AbaqusScope* scope_ = nullptr;
  Kind kind_ = Kind::nodes;
  std::string set_;  ///< or surface
  bool is_generated_ = false;
  std::int32_t of_instance_ = -1;
};

}  // namespace mortise
