#include "hdf5/hdf5_rows.hpp"

#include <fmt/format.h>

#include "mortise/core/error.hpp"

namespace mortise {

Hdf5Rows::Hdf5Rows(const std::string& path, const std::string& dataset)
    : path_(path),
      name_(dataset),
      access_(hdf5_access()),
      file_(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access_), H5Fclose),
      dataset_(file_.good() ? H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT) : -1, H5Dclose) {
  if (!file_.good() || !dataset_.good()) throw FileError(fmt::format("cannot read {} of {}: {}", name_, path_, hdf5_reason()));
  const Hdf5Handle space(H5Dget_space(dataset_), H5Sclose);
  const int dimensions = H5Sget_simple_extent_ndims(space);
  hsize_t size[H5S_MAX_RANK] = {};
  if (dimensions < 1 || dimensions > 2 || H5Sget_simple_extent_dims(space, size, nullptr) < 1)
    throw FileError(fmt::format("cannot read {} of {}: it has {} dimensions, but rows have 1 or 2", name_, path_, dimensions));
  is_table_ = dimensions == 2;
  rows_ = static_cast<long long>(size[0]);
  if (is_table_) columns_ = static_cast<int>(size[1]);
}

std::vector<double> Hdf5Rows::numbers(long long first, long long count, int column) const {
  std::vector<double> values(static_cast<std::size_t>(count));
  read(first, count, column, H5T_NATIVE_DOUBLE, values.data());
  return values;
}

std::vector<long long> Hdf5Rows::whole_numbers(long long first, long long count, int column) const {
  std::vector<long long> values(static_cast<std::size_t>(count));
  read(first, count, column, H5T_NATIVE_LLONG, values.data());
  return values;
}

void Hdf5Rows::read(long long first, long long count, int column, hid_t type, void* values) const {
  if (count == 0) return;
  const hsize_t start[2] = {static_cast<hsize_t>(first), static_cast<hsize_t>(column)}, size[2] = {static_cast<hsize_t>(count), 1};
  const Hdf5Handle space(H5Dget_space(dataset_), H5Sclose), memory(H5Screate_simple(1, size, nullptr), H5Sclose);
  const bool good = H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, size, nullptr) >= 0 &&
                    H5Dread(dataset_, type, memory, space, H5P_DEFAULT, values) >= 0;
  if (!good) throw FileError(fmt::format("cannot read rows {} to {} of {} of {}: {}", first, first + count - 1, name_, path_, hdf5_reason()));
}

}  // namespace mortise
