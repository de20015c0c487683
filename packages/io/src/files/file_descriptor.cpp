#include "files/file_descriptor.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace mortise {
namespace {

std::optional<std::string> system_reason(bool good) { return good ? std::nullopt : std::optional<std::string>(std::strerror(errno)); }

}  // namespace

FileDescriptor::~FileDescriptor() {
  if (number_ >= 0) ::close(number_);
}

std::optional<std::string> FileDescriptor::open(const std::string& path, int flags) {
  number_ = ::open(path.c_str(), flags | O_CLOEXEC, 0666);
  return system_reason(number_ >= 0);
}

std::optional<std::string> FileDescriptor::write(const void* bytes, std::size_t count, std::uintmax_t offset) const {
  for (std::size_t done = 0; done < count;) {
    const ssize_t written = ::pwrite(number_, static_cast<const char*>(bytes) + done, count - done, static_cast<off_t>(offset + done));
    if (written < 0 && errno != EINTR) return std::strerror(errno);
    if (written > 0) done += static_cast<std::size_t>(written);
  }
  return {};
}

std::optional<std::string> FileDescriptor::read(std::string& bytes, std::size_t count, std::uintmax_t offset) const {
  bytes.resize(count);
  for (std::size_t done = 0; done < count;) {
    const ssize_t found = ::pread(number_, bytes.data() + done, count - done, static_cast<off_t>(offset + done));
    if (found < 0 && errno != EINTR) return std::strerror(errno);
    if (found == 0) return "it ends too early";
    if (found > 0) done += static_cast<std::size_t>(found);
  }
  return {};
}

std::optional<std::string> FileDescriptor::size(std::uintmax_t& bytes) const {
  struct stat status {};
  if (::fstat(number_, &status) != 0) return std::strerror(errno);
  bytes = static_cast<std::uintmax_t>(status.st_size);
  return {};
}

std::optional<std::string> FileDescriptor::resize(std::uintmax_t bytes) const {
  return system_reason(::ftruncate(number_, static_cast<off_t>(bytes)) == 0);
}

std::optional<std::string> FileDescriptor::sync() const { return system_reason(::fdatasync(number_) == 0); }

std::optional<std::string> FileDescriptor::close() { return system_reason(::close(std::exchange(number_, -1)) == 0); }

}  // namespace mortise
