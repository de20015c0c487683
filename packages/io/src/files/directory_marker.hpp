#pragma once
// List of the files that the program made in a directory, kept in a file there.

#include <optional>
#include <string>
#include <vector>

#include "mortise/io/files.hpp"

namespace mortise {

constexpr const char* marker_name = ".mortise";
constexpr const char* lock_name = ".mortise.lock";

/// The file `.mortise` of a directory: names of files and directories that the program made there. One `*` in a name stands for any digits: a series
/// of files is listed once.
struct DirectoryMarker {
  std::string holds;   ///< kind of results; empty: any
  std::string source;  ///< file that they are of, relative to the directory; empty: none
  std::vector<std::string> names;

  /// True if `name` is listed, or is the unfinished form ("x.part") of a name that is.
  bool lists(const std::string& name) const;
};

/// Reads the marker of a directory; none if there is none. `reason` says why one that is there is no good: it is no regular file, it is not of this
/// program, it lists what cannot be a name.
std::optional<DirectoryMarker> read_marker(const std::string& directory, std::optional<std::string>& reason);

/// Replaces the marker at once. Returns why it could not.
std::optional<std::string> write_marker(const std::string& directory, const DirectoryMarker& marker, Survives survives = Survives::end_of_program);

/// True if `name` is there and nothing says that the program made it. A directory that is listed has to have a marker of its own, or to be empty.
bool is_foreign(const std::string& directory, const DirectoryMarker& marker, const std::string& name);

/// True if the file that a list calls `listed` is there; of a series any of its files.
bool is_made(const std::string& directory, const std::string& listed);

/// Why what is listed cannot be removed as a whole: someone writes below. Touches nothing.
std::optional<std::string> busy_below(const std::string& directory, const std::vector<std::string>& names);

/// Removes only what is listed, and in directories only what their markers list. Follows no symbolic link. Leaves in `names` those of directories
/// that stay, as they hold what is not listed. Returns why something could not be removed.
std::optional<std::string> remove_listed(const std::string& directory, std::vector<std::string>& names);

/// Brings the list of a directory to the disk, with its names, and so those of the directories that it lists. Returns why it could not.
std::optional<std::string> sync_listed(const std::string& directory, const DirectoryMarker& marker);

/// True if this can be the name of a file in a directory, and a line of a marker.
bool is_plain_name(const std::string& name);

}  // namespace mortise
