#pragma once
// One file that a command is asked to write, wherever that is.

#include <string>
#include <vector>

namespace mortise {

/// Where a file is: the directory, which may be taken as an OutputDirectory, and the name in it.
struct OutputFile {
  std::string directory;  ///< "." for a name alone
  std::string name;
};

/// Directory and name of a path. No communication; touches nothing.
/// @param endings  that the name may have, as ".png"
/// @throws InputError  the name has none of the endings or nothing before it, or is longer than a file system takes. Or it begins with #, or has
///                     control characters or a *, which have another meaning in the list of a directory's files
OutputFile output_file(const std::string& path, const std::vector<std::string>& endings);

}  // namespace mortise
