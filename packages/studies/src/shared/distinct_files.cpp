#include "shared/distinct_files.hpp"

#include <fmt/format.h>

#include "mortise/core/names.hpp"

namespace mortise {

void DistinctFiles::add(const std::string& name, const Place& place, std::vector<Diagnostic>& diagnostics) {
  const std::string file = name_for_files(name), quoted = fmt::format("\"{}\"", name);
  const auto [known, is_new] = whose_.insert({file, quoted});
  if (!is_new && known->second != quoted)
    diagnostics.push_back(
        {place, fmt::format("{} and {} would share the name \"{}\" among the files; please rename one of them", known->second, quoted, file)});
}

}  // namespace mortise
