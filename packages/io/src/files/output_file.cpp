#include "mortise/io/output_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "files/directory_marker.hpp"
#include "mortise/core/error.hpp"
#include "mortise/core/names.hpp"

namespace mortise {

OutputFile output_file(const std::string& path, const std::vector<std::string>& endings) {
  const std::filesystem::path whole(path);
  const std::string name = whole.filename().string();
  const bool has_ending = std::any_of(endings.begin(), endings.end(), [&](const std::string& ending) {
    return name.size() > ending.size() && name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
  });
  if (!has_ending)
    throw InputError({}, fmt::format("\"{}\" cannot be the name of the file to write; please give one that ends in {}",
                                     without_control_characters(path), fmt::join(endings, " or ")));
  // The unfinished file has ".part" behind its name.
  if (!is_plain_name(name + ".part") || name.find('*') != std::string::npos)
    throw InputError({}, fmt::format("\"{}\" cannot be the name of a file: it begins with #, has a * or a control character, or is too long",
                                     without_control_characters(name)));
  const std::string directory = whole.parent_path().string();
  return {directory.empty() ? "." : directory, name};
}

}  // namespace mortise
