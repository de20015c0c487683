#pragma once
// The keywords of Abaqus and CalculiX that are not read: which there are, and which of them would change the mesh.

#include <optional>
#include <string>

namespace mortise {

/// A keyword of Abaqus or CalculiX that says nothing of nodes, elements and sets, as their manuals write it. Names are in capital letters and without
/// blanks. As in CalculiX an S may stand behind it, and its last words may be missing. Nothing: there is no such keyword.
std::optional<std::string> keyword_without_mesh(const std::string& name);

/// True if a keyword makes or moves nodes or elements in a way that is not read.
bool is_refused_keyword(const std::string& name);

/// Message on a keyword that is neither read nor known: what may have been meant.
std::string unknown_keyword(const std::string& name);

}  // namespace mortise
