#pragma once
// The HDF5 files of fields: their names, and the description in a step's file.

#include <optional>
#include <string>
#include <vector>

#include "mortise/io/field_writer.hpp"

namespace mortise {

inline const std::string fields_directory = "fields", mesh_file = fields_directory + "/mesh.h5", part_ending = ".part";

/// fields/step-000012.h5, with more digits where a number has them.
std::string step_file(int step);

/// The step whose file has this name, or nothing; `name` begins with the directory.
std::optional<int> step_of_file(const std::string& name);

/// True if a writer of fields makes a file of this name, complete or in the making.
bool is_field_file(const std::string& name);

/// A field without its values.
struct StoredField {
  std::string name;
  Field::Center center = Field::Center::node;
  FieldKind kind = FieldKind::scalar;
};

/// Description in a step's file: attributes `step` and `time` of the file, `kind` and `center` of each dataset.
struct StoredStep {
  int step = 0;
  double time = 0.0;
  std::vector<StoredField> fields;  ///< in the order in which they were written
};

/// The words of attributes.
std::string attribute_text(FieldKind kind);
std::string attribute_text(Field::Center center);

/// Reads a step's file on this rank alone. Returns why it could not.
std::optional<std::string> read_step(const std::string& path, StoredStep& step);

/// The numbers of rows of datasets of a file, on this rank alone. Returns why it could not read them.
std::optional<std::string> read_rows(const std::string& path, const std::vector<std::string>& datasets, std::vector<long long>& rows);

}  // namespace mortise
