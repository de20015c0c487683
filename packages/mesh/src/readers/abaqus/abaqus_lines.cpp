#include "readers/abaqus/abaqus_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>

namespace mortise {
namespace {

constexpr std::size_t deepest_include = 20, most_includes = 10000;

std::string canonical(const std::string& path) {
  std::error_code none;
  const auto found = std::filesystem::weakly_canonical(path, none);
  return found.empty() ? path : found.string();
}

}  // namespace

AbaqusLines::AbaqusLines(const std::string& path, FileErrors& errors) : errors_(errors), files_{path} {
  stack_.push_back({std::make_unique<ByteStream>(path), 0, canonical(path)});
  stack_.back().stream->skip_byte_order_mark();
}

bool AbaqusLines::next(std::string_view& line) {
  constexpr std::string_view blanks = " \t\f\v\r";
  while (!stack_.empty()) {
    const Open& open = stack_.back();
    spot_ = {open.file, static_cast<std::int32_t>(std::min<std::int64_t>(open.stream->line(), std::numeric_limits<std::int32_t>::max()))};
    if (!open.stream->next_line(line)) {
      stack_.pop_back();
      continue;
    }
    if (line.find('\0') != std::string_view::npos) errors_.stop(place(spot_), "a byte 0 stands in this line: the file is no text");
    if (line.substr(0, 2) == "**") continue;
    const std::size_t first = line.find_first_not_of(blanks);
    if (first == std::string_view::npos) continue;
    line = line.substr(first, line.find_last_not_of(blanks) - first + 1);
    if (line.substr(0, 2) != "**") return true;
  }
  return false;
}

void AbaqusLines::include(const std::string& name, AbaqusSpot from) {
  if (name.empty()) errors_.stop(place(from), "INPUT= names no file");
  if (stack_.size() > deepest_include) errors_.stop(place(from), fmt::format("files include one another more than {} deep", deepest_include));
  if (files_.size() > most_includes) errors_.stop(place(from), fmt::format("more than {} files are included", most_includes));
  const std::string path = (std::filesystem::path(files_[static_cast<std::size_t>(from.file)]).parent_path() / name).string();
  const std::string real = canonical(path);
  if (std::any_of(stack_.begin(), stack_.end(), [&](const Open& open) { return open.canonical == real; }))
    errors_.stop(place(from), fmt::format("\"{}\" includes itself", path));
  try {
    stack_.push_back({std::make_unique<ByteStream>(path), static_cast<std::int32_t>(files_.size()), real});
    stack_.back().stream->skip_byte_order_mark();
  } catch (const FileError& error) {
    errors_.stop(place(from), error.what());
  }
  files_.push_back(path);
}

}  // namespace mortise
