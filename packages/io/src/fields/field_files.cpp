#include "fields/field_files.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>

#include "hdf5/hdf5_handle.hpp"

namespace mortise {
namespace {

const std::string step_begin = fields_directory + "/step-", step_end = ".h5";

const std::array<FieldKind, 4> field_kinds{FieldKind::scalar, FieldKind::vector, FieldKind::symmetric_tensor, FieldKind::integer};
const std::array<Field::Center, 2> field_centers{Field::Center::node, Field::Center::cell};

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

std::string without_part(const std::string& name) { return ends_with(name, part_ending) ? name.substr(0, name.size() - part_ending.size()) : name; }

bool read_attribute(hid_t object, const char* name, hid_t type, void* value) {
  const Hdf5Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  return attribute.good() && H5Aread(attribute, type, value) >= 0;
}

/// Empty if there is no such text.
std::string text_attribute(hid_t object, const char* name) {
  const Hdf5Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  if (!attribute.good()) return {};
  const Hdf5Handle type(H5Aget_type(attribute), H5Tclose);
  std::string text(H5Tget_size(type), '\0');
  if (H5Tis_variable_str(type) > 0 || H5Aread(attribute, type, text.data()) < 0) return {};
  return text;
}

/// The value whose word this is, into `found`.
template <class Values, class Value>
bool find_word(const Values& values, const std::string& word, Value& found) {
  for (const Value value : values)
    if (attribute_text(value) == word) return found = value, true;
  return false;
}

herr_t add_field(hid_t file, const char* name, const H5L_info_t*, void* data) {
  StoredField field{name, {}, {}};
  const Hdf5Handle dataset(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose);
  if (!dataset.good() || !find_word(field_kinds, text_attribute(dataset, "kind"), field.kind) ||
      !find_word(field_centers, text_attribute(dataset, "center"), field.center))
    return -1;
  static_cast<StoredStep*>(data)->fields.push_back(field);
  return 0;
}

}  // namespace

std::string step_file(int step) { return fmt::format("{}{:06}{}", step_begin, step, step_end); }

std::optional<int> step_of_file(const std::string& name) {
  int step = 0;
  if (name.size() <= step_begin.size()) return {};
  std::from_chars(name.data() + step_begin.size(), name.data() + name.size(), step);
  return step >= 0 && name == step_file(step) ? std::optional(step) : std::nullopt;
}

bool is_field_file(const std::string& name) {
  const std::string complete = without_part(name);
  return complete == mesh_file || step_of_file(complete).has_value();
}

std::string attribute_text(FieldKind kind) {
  switch (kind) {
    case FieldKind::scalar:
      return "scalar";
    case FieldKind::vector:
      return "vector";
    case FieldKind::symmetric_tensor:
      return "symmetric tensor";
    case FieldKind::integer:
      break;
  }
  return "integer";
}

std::string attribute_text(Field::Center center) { return center == Field::Center::node ? "node" : "cell"; }

std::optional<std::string> read_step(const std::string& path, StoredStep& step) {
  const Hdf5Handle access = hdf5_access(), file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access), H5Fclose);
  if (!file.good()) return hdf5_reason();
  if (!read_attribute(file, "step", H5T_NATIVE_INT, &step.step) || !read_attribute(file, "time", H5T_NATIVE_DOUBLE, &step.time))
    return "it has no attributes \"step\" and \"time\"";
  step.fields.clear();
  if (H5Literate(file, H5_INDEX_CRT_ORDER, H5_ITER_INC, nullptr, add_field, &step) < 0)
    return "it holds a dataset without the attributes \"kind\" and \"center\"";
  return {};
}

std::optional<std::string> read_rows(const std::string& path, const std::vector<std::string>& datasets, std::vector<long long>& rows) {
  const Hdf5Handle access = hdf5_access(), file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access), H5Fclose);
  if (!file.good()) return hdf5_reason();
  for (const std::string& name : datasets) {
    const Hdf5Handle dataset(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose);
    if (!dataset.good()) return hdf5_reason();
    const Hdf5Handle space(H5Dget_space(dataset), H5Sclose);
    hsize_t size[H5S_MAX_RANK] = {};
    if (H5Sget_simple_extent_dims(space, size, nullptr) < 1) return fmt::format("its dataset \"{}\" has no rows", name);
    rows.push_back(static_cast<long long>(size[0]));
  }
  return {};
}

}  // namespace mortise
