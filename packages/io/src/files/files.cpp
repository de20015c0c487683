#include "mortise/io/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "files/file_descriptor.hpp"
#include "mortise/core/error.hpp"

namespace mortise {
namespace {

std::optional<std::string> opened_and_synced(const std::string& path, int flags) {
  FileDescriptor file;
  if (auto reason = file.open(path, flags)) return reason;
  return file.sync();
}

}  // namespace

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

std::optional<std::string> replace_file(const std::string& path, const std::string& content, Survives survives) {
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
  const bool is_for_disk = survives == Survives::loss_of_power;
  std::optional<std::string> reason;
  if (is_for_disk) reason = sync_file(temporary);  // else the new name may come to the disk before what is in the file
  std::error_code error;
  if (!reason) std::filesystem::rename(temporary, path, error);
  if (error) reason = error.message();
  if (!reason) return is_for_disk ? sync_directory(std::filesystem::absolute(path).parent_path().string()) : std::nullopt;
  std::error_code ignored;
  std::filesystem::remove(temporary, ignored);
  return reason;
}

std::optional<std::string> replace_end_of_file(const std::string& path, std::uintmax_t offset, const std::string& content) {
  FileDescriptor file;
  std::uintmax_t size = 0;
  std::string former;
  if (auto reason = file.open(path, O_RDWR)) return reason;
  if (auto reason = file.size(size)) return reason;
  if (size < offset) return fmt::format("it has {} bytes, {} are to be kept", size, offset);
  if (auto reason = file.read(former, size - offset, offset)) return reason;
  auto reason = file.write(content.data(), content.size(), offset);
  if (!reason && offset + content.size() < size) reason = file.resize(offset + content.size());
  if (reason) {
    file.write(former.data(), former.size(), offset);
    file.resize(size);
  }
  return reason;
}

std::optional<std::string> sync_file(const std::string& path) { return opened_and_synced(path, O_RDONLY); }

std::optional<std::string> sync_directory(const std::string& path) { return opened_and_synced(path, O_RDONLY | O_DIRECTORY); }

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
