#include "mortise/io/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <Teuchos_CommHelpers.hpp>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "mortise/core/error.hpp"

namespace mortise {

void throw_if_any_file_error(const Communicator& comm, const std::string& what, const std::string& path, const std::optional<std::string>& reason) {
  const int mine = reason ? comm.getRank() : comm.getSize();
  int first = mine;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MIN, mine, Teuchos::outArg(first));
  if (first == comm.getSize()) return;
  std::string text = reason.value_or("");
  int length = static_cast<int>(text.size());
  Teuchos::broadcast(comm, first, Teuchos::outArg(length));
  text.resize(length);
  Teuchos::broadcast(comm, first, length, text.data());
  throw FileError(fmt::format("{} {}: {}", what, path, text));
}

std::optional<std::string> replace_file(const std::string& path, const std::string& content) {
  const std::string temporary = path + ".part";
  std::error_code none;
  std::filesystem::remove(temporary, none);  // it might be a link to a file elsewhere
  errno = 0;
  {
    std::ofstream stream(temporary, std::ios::binary | std::ios::trunc);
    stream << content;
    stream.close();
    if (!stream) {
      const std::string reason = errno != 0 ? std::strerror(errno) : "it cannot be written";
      std::error_code ignored;
      std::filesystem::remove(temporary, ignored);
      return reason;
    }
  }
  std::error_code error;
  std::filesystem::rename(temporary, path, error);
  if (!error) return {};
  std::error_code ignored;
  std::filesystem::remove(temporary, ignored);
  return error.message();
}

std::optional<std::string> replace_end_of_file(const std::string& path, std::uintmax_t offset, const std::string& content) {
  const int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (file < 0) return std::strerror(errno);
  const auto begin = static_cast<off_t>(offset);
  const auto write = [&](const std::string& end) -> std::optional<std::string> {
    for (std::size_t done = 0; done < end.size();) {
      const ssize_t written = ::pwrite(file, end.data() + done, end.size() - done, begin + static_cast<off_t>(done));
      if (written < 0 && errno != EINTR) return std::strerror(errno);
      if (written > 0) done += static_cast<std::size_t>(written);
    }
    if (::ftruncate(file, begin + static_cast<off_t>(end.size())) != 0) return std::strerror(errno);
    return {};
  };
  std::error_code error;
  std::string former(std::filesystem::file_size(path, error) - offset, '\0');
  std::optional<std::string> reason;
  if (error || ::pread(file, former.data(), former.size(), begin) != static_cast<ssize_t>(former.size()))
    reason = error ? error.message() : std::strerror(errno);
  else if ((reason = write(content)))
    write(former);
  ::close(file);
  return reason;
}

void write_file(const Communicator& comm, const std::string& path, const std::function<std::string()>& content) {
  std::optional<std::string> reason;
  if (comm.getRank() == 0) reason = replace_file(path, content());
  throw_if_any_file_error(comm, "cannot write", path, reason);
}

void write_json(const Communicator& comm, const std::string& path, const nlohmann::ordered_json& json) {
  // Names from a scene may hold any bytes: those that are no UTF-8 are replaced rather than thrown at.
  write_file(comm, path, [&] { return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n"; });
}

}  // namespace mortise
