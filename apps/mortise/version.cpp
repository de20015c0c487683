#include <revision.hpp>

#include "program.hpp"

namespace mortise {

std::string version_number() { return MORTISE_VERSION; }

std::string version() {
  const std::string revision = MORTISE_REVISION;
  return revision.empty() ? MORTISE_VERSION : MORTISE_VERSION " (" + revision + ")";
}

}  // namespace mortise
