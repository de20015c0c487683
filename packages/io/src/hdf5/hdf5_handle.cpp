#include "hdf5/hdf5_handle.hpp"

#include <algorithm>

namespace mortise {

Hdf5Handle hdf5_access() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // the reason goes into an exception
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_file_locking(access, false, true);
  return {access, H5Pclose};
}

std::string hdf5_reason() {
  std::string reason;
  H5Ewalk(
      H5E_DEFAULT, H5E_WALK_DOWNWARD,
      [](unsigned, const H5E_error_t* error, void* data) -> herr_t {
        auto& text = *static_cast<std::string*>(data);
        if (error->desc != nullptr && *error->desc != '\0') text = error->desc;
        return 0;
      },
      &reason);
  const std::string before = "error message = '";
  if (const auto begin = reason.find(before); begin != std::string::npos) {
    reason.erase(0, begin + before.size());
    reason.erase(std::min(reason.find('\''), reason.size()));
  }
  return reason.empty() ? "the HDF5 library gives no reason" : reason;
}

}  // namespace mortise
