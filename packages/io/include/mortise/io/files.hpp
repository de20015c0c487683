#pragma once
// Files that one rank writes for all: failures surface on every rank.

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "mortise/core/types.hpp"

namespace mortise {

/// Collective: if any rank holds a reason, every rank throws FileError "<what> <path>: <reason>" with the reason of the lowest such rank.
void throw_if_any_file_error(const Communicator& comm, const std::string& what, const std::string& path, const std::optional<std::string>& reason);

/// Survival of what is written: of the end of the program, which the operating system grants, or of a loss of power as well.
enum class Survives { end_of_program, loss_of_power };

/// Writes `content` to `path` by way of a temporary file beside it that is renamed, so that no reader ever sees half a file. No communication.
/// Returns why it could not.
std::optional<std::string> replace_file(const std::string& path, const std::string& content, Survives survives = Survives::end_of_program);

/// Replaces what stands from byte `offset` of `path` to its end by `content`, in one write. If that fails, the file has its former end again. No
/// communication. Returns why it could not.
std::optional<std::string> replace_end_of_file(const std::string& path, std::uintmax_t offset, const std::string& content);

/// Returns when what is in the file is on the disk: it then outlives a loss of power, and not only the program. No communication. Returns why it
/// could not.
std::optional<std::string> sync_file(const std::string& path);

/// Brings the names in a directory to the disk: files that were made, renamed or removed there. No communication. Returns why it could not.
std::optional<std::string> sync_directory(const std::string& path);

/// `replace_file` for all ranks: rank 0 writes what `content` gives there. Collective. Throws FileError on all ranks.
void write_file(const Communicator& comm, const std::string& path, const std::function<std::string()>& content);

/// Writes `json`, indented by two, on rank 0; names in their order, numbers in full precision, those that are not finite as null. Collective. Throws
/// FileError on all ranks.
void write_json(const Communicator& comm, const std::string& path, const nlohmann::ordered_json& json);

}  // namespace mortise
