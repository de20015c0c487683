#pragma once
// Kind of a given file.

#include "mortise/input/xml.hpp"

namespace mortise {

enum class FileKind { scene, point, study, ledger };

/// @throws InputError for a file that is plainly of another kind: it has the list that only the other kind has. The message names the command for it.
void refuse_other_kinds(const XmlList& root, FileKind expected);

}  // namespace mortise
