#include "files/directory_marker.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "files/directory_lock.hpp"
#include "mortise/io/files.hpp"

namespace mortise {
namespace {

namespace fs = std::filesystem;

constexpr const char* signature = "# Made by mortise, which may replace or remove what is listed here, and nothing else in this directory.";
const std::string holds_line = "# holds: ", source_line = "# of: ", unfinished = ".part";

bool begins_with(const std::string& text, const std::string& begin) { return text.compare(0, begin.size(), begin) == 0; }

/// Type of the file at a path itself, without following a link.
fs::file_type type_of(const fs::path& path) {
  std::error_code error;
  return fs::symlink_status(path, error).type();
}

bool is_there(const fs::path& path) {
  const fs::file_type type = type_of(path);
  return type != fs::file_type::not_found && type != fs::file_type::none;
}

/// Files that belong to the marker.
std::vector<std::string> own_files() { return {marker_name, marker_name + unfinished, lock_name}; }

/// True if a directory holds only files that belong to a marker.
bool is_vacant(const fs::path& directory) {
  const auto own = own_files();
  std::error_code error;
  for (fs::directory_iterator entry(directory, error), end; !error && entry != end; entry.increment(error))
    if (std::find(own.begin(), own.end(), entry->path().filename().string()) == own.end()) return false;
  return !error;
}

/// True if a listed name is that of a file: the names are equal, or the file's has digits where the listed one has `*`.
bool is_of(const std::string& listed, const std::string& name) {
  const std::size_t star = listed.find('*');
  if (star == std::string::npos || listed == name) return listed == name;
  const std::size_t behind = listed.size() - star - 1;
  return name.size() > star + behind && name.compare(0, star, listed, 0, star) == 0 &&
         name.compare(name.size() - behind, behind, listed, star + 1, behind) == 0 &&
         std::all_of(name.begin() + static_cast<std::ptrdiff_t>(star), name.end() - static_cast<std::ptrdiff_t>(behind),
                     [](unsigned char c) { return std::isdigit(c) != 0; });
}

/// The names that a listed one stands for: itself, or those of a series that are there.
std::vector<std::string> named_by(const std::string& directory, const std::string& listed) {
  if (listed.find('*') == std::string::npos) return {listed};
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(directory, error), end; !error && entry != end; entry.increment(error)) {
    std::string name = entry->path().filename().string();
    if (name.size() > unfinished.size() && name.compare(name.size() - unfinished.size(), unfinished.size(), unfinished) == 0)
      name.resize(name.size() - unfinished.size());
    if (is_of(listed, name)) names.push_back(name);
  }
  return names;
}

std::optional<std::string> remove_file(const fs::path& path) {
  std::error_code error;
  fs::remove(path, error);
  return error ? std::optional(fmt::format("{}: {}", path.string(), error.message())) : std::nullopt;
}

/// Removes a directory with what its marker lists. `stays`: it holds other things too.
std::optional<std::string> remove_marked(const fs::path& directory, bool& stays) {
  std::optional<std::string> reason;
  auto marker = read_marker(directory.string(), reason);
  if (!reason && marker) {
    reason = remove_listed(directory.string(), marker->names);
    if (!reason) reason = write_marker(directory.string(), *marker);
  }
  if (reason) return reason;
  stays = !is_vacant(directory);
  if (stays) return {};
  for (const auto& name : own_files())
    if ((reason = remove_file(directory / name))) return reason;
  return remove_file(directory);
}

}  // namespace

std::optional<std::string> sync_listed(const std::string& directory, const DirectoryMarker& marker) {
  for (const auto& name : marker.names) {
    const fs::path path = fs::path(directory) / name;
    if (type_of(path) != fs::file_type::directory) continue;
    std::optional<std::string> reason;
    const auto found = read_marker(path.string(), reason);
    if (!reason && found) reason = sync_listed(path.string(), *found);
    if (reason) return reason;
  }
  if (auto reason = sync_file((fs::path(directory) / marker_name).string())) return reason;
  return sync_directory(directory);
}

bool is_plain_name(const std::string& name) {
  const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
  const auto own = own_files();
  return !name.empty() && name.size() <= 255 && name != "." && name != ".." && name.front() != '#' && name.find('/') == std::string::npos &&
         std::none_of(name.begin(), name.end(), is_control) && std::find(own.begin(), own.end(), name) == own.end();
}

bool DirectoryMarker::lists(const std::string& name) const {
  return std::any_of(names.begin(), names.end(), [&](const std::string& one) { return is_of(one, name) || is_of(one + unfinished, name); });
}

std::optional<DirectoryMarker> read_marker(const std::string& directory, std::optional<std::string>& reason) {
  const fs::path path = fs::path(directory) / marker_name;
  if (!is_there(path)) return {};
  const auto refuse = [&](const std::string& why) {
    reason = fmt::format("{} {}; please move it away, or choose another directory", path.string(), why);
    return std::nullopt;
  };
  if (type_of(path) != fs::file_type::regular) return refuse("is no regular file");
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line) || line != signature) return refuse("does not begin as a list of what this program made");
  DirectoryMarker marker;
  while (std::getline(file, line)) {
    if (begins_with(line, holds_line))
      marker.holds = line.substr(holds_line.size());
    else if (begins_with(line, source_line))
      marker.source = line.substr(source_line.size());
    else if (is_plain_name(line))
      marker.names.push_back(line);
    else
      return refuse(fmt::format("lists \"{}\", which is no name of a file in its directory", line));
  }
  return marker;
}

std::optional<std::string> write_marker(const std::string& directory, const DirectoryMarker& marker, Survives survives) {
  std::string text = std::string(signature) + "\n";
  if (!marker.holds.empty()) text += holds_line + marker.holds + "\n";
  if (!marker.source.empty()) text += source_line + marker.source + "\n";
  for (const auto& name : marker.names) text += name + "\n";
  return replace_file((fs::path(directory) / marker_name).string(), text, survives);
}

bool is_foreign(const std::string& directory, const DirectoryMarker& marker, const std::string& name) {
  if (name.find('*') != std::string::npos) {
    const std::vector<std::string> series = named_by(directory, name);
    return std::any_of(series.begin(), series.end(), [&](const std::string& one) { return is_foreign(directory, marker, one); });
  }
  const fs::path path = fs::path(directory) / name;
  if (!is_there(path)) return false;
  if (!marker.lists(name)) return true;
  return type_of(path) == fs::file_type::directory && !is_there(path / marker_name) && !is_vacant(path);
}

bool is_made(const std::string& directory, const std::string& listed) {
  const std::vector<std::string> names = named_by(directory, listed);
  return std::any_of(names.begin(), names.end(), [&](const std::string& one) { return is_there(fs::path(directory) / one); });
}

std::optional<std::string> busy_below(const std::string& directory, const std::vector<std::string>& names) {
  for (const auto& name : names) {
    const fs::path path = fs::path(directory) / name;
    if (type_of(path) != fs::file_type::directory) continue;
    std::optional<std::string> reason;
    const auto marker = read_marker(path.string(), reason);
    if (reason) return reason;
    if (!marker) continue;
    if (const auto holder = lock_holder(path.string())) return fmt::format("{}: {}", path.string(), *holder);
    if (auto below = busy_below(path.string(), marker->names)) return below;
  }
  return {};
}

std::optional<std::string> remove_listed(const std::string& directory, std::vector<std::string>& names) {
  std::vector<std::string> kept, all;
  for (const auto& listed : names)
    for (const auto& name : named_by(directory, listed)) all.push_back(name);
  for (const auto& name : all) {
    const fs::path path = fs::path(directory) / name, part = path.string() + unfinished;
    std::optional<std::string> reason;
    bool stays = false;
    if (type_of(path) == fs::file_type::directory)
      reason = remove_marked(path, stays);
    else
      reason = remove_file(path);
    if (!reason && type_of(part) != fs::file_type::directory) reason = remove_file(part);
    if (reason) return reason;
    if (stays) kept.push_back(name);
  }
  names = kept;
  return {};
}

}  // namespace mortise
