#include "hdf5/hdf5_layout.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

namespace mortise {

/// A virtual file driver of the HDF5 library. Its functions are those of H5FD_class_t.
struct Hdf5Layout::Driver {
  struct File {
    H5FD_t base{};  // first, as the library takes a pointer to it for one to the whole
    Hdf5Layout* layout = nullptr;
    haddr_t end_of_addresses = 0;
  };
  static File& of(H5FD_t* file) { return *reinterpret_cast<File*>(file); }
  static const File& of(const H5FD_t* file) { return *reinterpret_cast<const File*>(file); }

  static H5FD_t* open(const char*, unsigned, hid_t access, haddr_t) {
    const auto* layout = static_cast<Hdf5Layout* const*>(H5Pget_driver_info(access));
    return layout == nullptr ? nullptr : &(new File{{}, *layout, 0})->base;
  }
  static herr_t close(H5FD_t* file) {
    delete &of(file);
    return 0;
  }
  static herr_t query(const H5FD_t*, unsigned long* features) {
    *features = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_AGGREGATE_SMALLDATA;
    return 0;
  }
  static haddr_t end_of_addresses(const H5FD_t* file, H5FD_mem_t) { return of(file).end_of_addresses; }
  static herr_t set_end_of_addresses(H5FD_t* file, H5FD_mem_t, haddr_t address) {
    of(file).end_of_addresses = address;
    return 0;
  }
  static haddr_t end_of_file(const H5FD_t* file, H5FD_mem_t) { return of(file).layout->size_; }
  static herr_t read(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t address, std::size_t count, void* buffer) {
    std::memset(buffer, 0, count);
    for (const Piece& piece : of(file).layout->pieces_) {
      const haddr_t begin = std::max<haddr_t>(address, piece.offset), end = std::min<haddr_t>(address + count, piece.offset + piece.bytes.size());
      if (begin < end) std::memcpy(static_cast<char*>(buffer) + (begin - address), piece.bytes.data() + (begin - piece.offset), end - begin);
    }
    return 0;
  }
  static herr_t write(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t address, std::size_t count, const void* buffer) {
    Hdf5Layout& layout = *of(file).layout;
    layout.pieces_.push_back({address, std::string(static_cast<const char*>(buffer), count)});
    layout.size_ = std::max<std::uintmax_t>(layout.size_, address + count);
    return 0;
  }
  static herr_t truncate(H5FD_t* file, hid_t, hbool_t) {
    of(file).layout->size_ = of(file).end_of_addresses;
    return 0;
  }

  /// The driver as the library knows it.
  static hid_t id() {
    static const hid_t registered = [] {
      static H5FD_class_t driver{};
      driver.name = "mortise layout";
      driver.maxaddr = static_cast<haddr_t>(std::numeric_limits<std::int64_t>::max());
      driver.fc_degree = H5F_CLOSE_WEAK;
      driver.fapl_size = sizeof(Hdf5Layout*);
      driver.open = open;
      driver.close = close;
      driver.query = query;
      driver.get_eoa = end_of_addresses;
      driver.set_eoa = set_end_of_addresses;
      driver.get_eof = end_of_file;
      driver.read = read;
      driver.write = write;
      driver.truncate = truncate;
      const H5FD_mem_t one_list_of_free_space[] = H5FD_FLMAP_DICHOTOMY;
      std::copy(std::begin(one_list_of_free_space), std::end(one_list_of_free_space), driver.fl_map);
      return H5FDregister(&driver);
    }();
    return registered;
  }
};

Hdf5Layout::Hdf5Layout() {
  const Hdf5Handle access = hdf5_access(), creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  const Hdf5Layout* self = this;
  H5Pset_driver(access, Driver::id(), &self);
  H5Pset_obj_track_times(creation, false);                                              // the same values make the same file at any time
  H5Pset_link_creation_order(creation, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);  // readers find datasets in the order of writing
  file_ = H5Fcreate("in memory", H5F_ACC_TRUNC, creation, access);
}

Hdf5Layout::~Hdf5Layout() {
  if (file_ >= 0) H5Fclose(file_);
}

std::optional<std::string> Hdf5Layout::close(const FileDescriptor& file) {
  if (H5Fclose(std::exchange(file_, -1)) < 0) return hdf5_reason();
  for (const Piece& piece : pieces_)
    if (auto reason = file.write(piece.bytes.data(), piece.bytes.size(), piece.offset)) return reason;
  return file.resize(size_);
}

}  // namespace mortise
