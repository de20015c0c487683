#include "hdf5/hdf5_file.hpp"

#include <fcntl.h>

#include <Teuchos_CommHelpers.hpp>
#include <filesystem>

#include "mortise/io/files.hpp"

namespace mortise {
namespace {

constexpr std::size_t value_size = 8;  // of double and long long
static_assert(sizeof(double) == value_size && sizeof(long long) == value_size);

std::optional<std::string> hdf5_reason_unless(bool good) { return good ? std::nullopt : std::optional(hdf5_reason()); }

}  // namespace

Hdf5File::Hdf5File(RCP<const Communicator> comm, std::string path) : comm_(std::move(comm)), path_(std::move(path)), part_(path_ + ".part") {
  std::optional<std::string> reason;
  if (comm_->getRank() == 0) reason = file_.open(part_, O_WRONLY | O_CREAT | O_TRUNC);
  throw_if_any_file_error(*comm_, "cannot write", path_, reason);  // from here on there is a file
  if (comm_->getRank() != 0) {
    reason_ = file_.open(part_, O_WRONLY);
  } else {
    layout_.emplace();
    reason_ = hdf5_reason_unless(layout_->file() >= 0);
  }
}

Hdf5File::~Hdf5File() {
  std::error_code ignored;
  if (comm_->getRank() == 0 && !complete_) std::filesystem::remove(part_, ignored);
}

void Hdf5File::agree(const std::optional<std::string>& reason) { throw_if_any_file_error(*comm_, "cannot write", path_, reason_ ? reason_ : reason); }

std::optional<std::string> Hdf5File::make_dataset(const std::string& name, GlobalOrdinal rows, int columns, hid_t type, long long& offset) const {
  const hsize_t size[2] = {static_cast<hsize_t>(rows), static_cast<hsize_t>(columns)};
  const Hdf5Handle space(H5Screate_simple(columns == 1 ? 1 : 2, size, nullptr), H5Sclose);
  const Hdf5Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose), creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(links, 1);
  H5Pset_obj_track_times(creation, false);  // the same values make the same file at any time
  H5Pset_alloc_time(creation, H5D_ALLOC_TIME_EARLY);
  H5Pset_fill_time(creation, H5D_FILL_TIME_NEVER);
  const Hdf5Handle dataset(H5Dcreate2(layout_->file(), name.c_str(), type, space, links, creation, H5P_DEFAULT), H5Dclose);
  if (!dataset.good()) return hdf5_reason();
  const haddr_t place = H5Dget_offset(dataset);
  if (place == HADDR_UNDEF && rows > 0) return "the HDF5 library gives its values no place";
  offset = static_cast<long long>(place);
  return {};
}

void Hdf5File::write(const std::string& name, GlobalOrdinal rows, GlobalOrdinal first, int columns, const std::vector<double>& values) {
  write(name, rows, first, columns, values.size(), values.data(), H5T_NATIVE_DOUBLE);
}

void Hdf5File::write(const std::string& name, GlobalOrdinal rows, GlobalOrdinal first, int columns, const std::vector<long long>& values) {
  write(name, rows, first, columns, values.size(), values.data(), H5T_NATIVE_LLONG);
}

void Hdf5File::write(const std::string& name, GlobalOrdinal rows, GlobalOrdinal first, int columns, std::size_t count, const void* values,
                     hid_t type) {
  long long offset = 0;
  agree(comm_->getRank() == 0 && !reason_ ? make_dataset(name, rows, columns, type, offset) : std::nullopt);
  Teuchos::broadcast(*comm_, 0, Teuchos::outArg(offset));
  agree(file_.write(values, count * value_size, static_cast<std::uintmax_t>(offset) + value_size * first * columns));
}

std::optional<std::string> Hdf5File::make_attribute(const std::string& object, const std::string& name, const Attribute& value) const {
  const auto* text = std::get_if<std::string>(&value);
  const Hdf5Handle type(H5Tcopy(text != nullptr ? H5T_C_S1 : std::holds_alternative<double>(value) ? H5T_NATIVE_DOUBLE : H5T_NATIVE_LLONG), H5Tclose);
  if (text != nullptr) {
    H5Tset_size(type, std::max<std::size_t>(text->size(), 1));
    H5Tset_strpad(type, H5T_STR_NULLPAD);
    H5Tset_cset(type, H5T_CSET_UTF8);
  }
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Handle attribute(H5Acreate_by_name(layout_->file(), object.c_str(), name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                             H5Aclose);
  if (!attribute.good()) return hdf5_reason();
  const void* bytes = text != nullptr ? text->c_str() : std::visit([](const auto& one) -> const void* { return &one; }, value);
  return hdf5_reason_unless(H5Awrite(attribute, type, bytes) >= 0);
}

void Hdf5File::attribute(const std::string& object, const std::string& name, const Attribute& value) {
  if (comm_->getRank() == 0 && !reason_) reason_ = make_attribute(object, name, value);
}

void Hdf5File::close(const std::function<std::optional<std::string>(const std::string& part)>& before_naming) {
  std::optional<std::string> reason;
  if (comm_->getRank() == 0 && !reason_) reason = layout_->close(file_);
  if (auto late = file_.close(); !reason) reason = late;
  agree(reason);
  if (before_naming) agree(before_naming(part_));
  std::error_code error;
  if (comm_->getRank() == 0) std::filesystem::rename(part_, path_, error);
  agree(error ? std::optional(error.message()) : std::nullopt);
  complete_ = true;
}

}  // namespace mortise
