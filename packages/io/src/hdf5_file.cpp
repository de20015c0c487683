#include "hdf5_file.hpp"

#include <mpi.h>

#include <Teuchos_DefaultMpiComm.hpp>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "mortise/io/files.hpp"

namespace mortise {
namespace {

/// Closes an HDF5 object when it goes out of scope.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }
  bool good() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// What the HDF5 library last complained of, its deepest cause.
std::string last_error() {
  std::string reason;
  H5Ewalk(
      H5E_DEFAULT, H5E_WALK_DOWNWARD,
      [](unsigned, const H5E_error_t* error, void* data) -> herr_t {
        auto& text = *static_cast<std::string*>(data);
        if (error->desc != nullptr && *error->desc != '\0') text = error->desc;
        return 0;
      },
      &reason);
  return reason.empty() ? "HDF5 cannot write it" : reason;
}

/// Why the operating system does not let the file be written. MPI's own words are poor ("MPI_ERR_NO_SUCH_FILE").
std::optional<std::string> why_not(const std::string& path, Hdf5File::Mode mode) {
  errno = 0;
  std::ofstream stream(path, mode == Hdf5File::Mode::create ? std::ios::binary | std::ios::trunc : std::ios::binary | std::ios::in | std::ios::out);
  if (stream) return {};
  return errno != 0 ? std::strerror(errno) : "it cannot be opened";
}

}  // namespace

Hdf5File::Hdf5File(RCP<const Communicator> comm, std::string path, Mode mode) : comm_(std::move(comm)), path_(std::move(path)) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  std::optional<std::string> reason;
  if (comm_->getRank() == 0) reason = why_not(path_, mode);
  throw_if_any_file_error(*comm_, "cannot write", path_, reason);
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_mpio(access, *Teuchos::rcp_dynamic_cast<const Teuchos::MpiComm<int>>(comm_, true)->getRawMpiComm(), MPI_INFO_NULL);
  file_ = mode == Mode::create ? H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access) : H5Fopen(path_.c_str(), H5F_ACC_RDWR, access);
  agree(file_ >= 0);
}

Hdf5File::~Hdf5File() {
  if (file_ >= 0) H5Fclose(file_);
}

void Hdf5File::agree(bool good) const {
  throw_if_any_file_error(*comm_, "cannot write", path_, good ? std::nullopt : std::optional<std::string>(last_error()));
}

void Hdf5File::make_group(const std::string& name) {
  const Handle group(H5Gcreate2(file_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  agree(group.good());
}

void Hdf5File::write(const std::string& name, GlobalOrdinal rows, GlobalOrdinal first, int columns, const std::vector<double>& values) {
  write(name, rows, first, columns, values.size(), values.data(), H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE);
}

void Hdf5File::write(const std::string& name, GlobalOrdinal rows, GlobalOrdinal first, int columns, const std::vector<long long>& values) {
  write(name, rows, first, columns, values.size(), values.data(), H5T_STD_I64LE, H5T_NATIVE_LLONG);
}

void Hdf5File::write(const std::string& name, GlobalOrdinal rows, GlobalOrdinal first, int columns, std::size_t count, const void* values,
                     hid_t stored, hid_t given) {
  const int rank = columns == 1 ? 1 : 2;
  const auto width = static_cast<hsize_t>(columns);
  const hsize_t size[2] = {static_cast<hsize_t>(rows), width}, start[2] = {static_cast<hsize_t>(first), 0}, part[2] = {count / width, width};
  const Handle space(H5Screate_simple(rank, size, nullptr), H5Sclose), memory(H5Screate_simple(rank, part, nullptr), H5Sclose);
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation, 0);  // the same values make the same file at any time
  const Handle dataset(H5Dcreate2(file_, name.c_str(), stored, space, H5P_DEFAULT, creation, H5P_DEFAULT), H5Dclose);
  agree(space.good() && memory.good() && dataset.good());
  if (count > 0) {
    H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, part, nullptr);
  } else {
    H5Sselect_none(space);
    H5Sselect_none(memory);
  }
  const Handle transfer(H5Pcreate(H5P_DATASET_XFER), H5Pclose);
  H5Pset_dxpl_mpio(transfer, H5FD_MPIO_COLLECTIVE);
  const double nothing = 0.0;
  agree(H5Dwrite(dataset, given, memory, space, transfer, count > 0 ? values : &nothing) >= 0);
}

void Hdf5File::close() {
  const hid_t file = file_;
  file_ = -1;
  const bool flushed = H5Fflush(file, H5F_SCOPE_GLOBAL) >= 0;
  agree(H5Fclose(file) >= 0 && flushed);
}

}  // namespace mortise
