#pragma once
// Objects of the HDF5 library, as one rank has them.

#include <hdf5.h>

#include <string>

namespace mortise {

/// Closes an HDF5 object when it goes out of scope.
class Hdf5Handle {
 public:
  Hdf5Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Hdf5Handle() {
    if (id_ >= 0) close_(id_);
  }
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;
  operator hid_t() const { return id_; }
  bool good() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// Access of one rank that opens a file by itself. The library's locks are off: files in the making have names that nobody reads, and finished ones
/// do not change.
Hdf5Handle hdf5_access();

/// Last error message of the HDF5 library: the words of the operating system if there are any, or else the deepest cause. To be asked before any
/// other call of the library.
std::string hdf5_reason();

}  // namespace mortise
