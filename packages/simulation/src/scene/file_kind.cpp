#include "mortise/simulation/scene/file_kind.hpp"

#include <fmt/format.h>

#include "mortise/core/error.hpp"

namespace mortise {
namespace {

struct KindOfFile {
  const char *name, *list, *command;  ///< list: one that files of no other kind have, and that files of this kind need
};

constexpr KindOfFile kinds_of_files[] = {
    {"a scene", "bodies", "run"}, {"a point file", "path", "point"}, {"a study", "axes", "study"}, {"a ledger of hard cases", "cases", "hard"}};

}  // namespace

void refuse_other_kinds(const XmlList& root, FileKind expected) {
  const KindOfFile& wanted = kinds_of_files[static_cast<std::size_t>(expected)];
  if (root.list(wanted.list)) return;
  for (const KindOfFile& other : kinds_of_files)
    if (root.list(other.list))
      throw InputError(root.place, fmt::format("this is {}, not {}: it has the list \"{}\"; please call mortise {} {}", other.name, wanted.name,
                                               other.list, other.command, root.place.file));
}

}  // namespace mortise
