#include "mortise/io/files.hpp"

#include <fmt/format.h>

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
