#pragma once
// From a scene file to a Scene.

#include <string>
#include <vector>

#include "mortise/core/types.hpp"
#include "mortise/input/xml.hpp"
#include "mortise/simulation/scene/scene.hpp"

namespace mortise {

/// Collective. Reads the file on rank 0 and parses it on every rank. Pairs with automatic roles come with the slave that was chosen.
/// @param settings  "path=value" each, as `--set` takes them; they replace what the file says
/// Throws FileError if it cannot be read, InputError with everything that is wrong with it.
Scene read_scene(const Communicator& comm, const std::string& file, const std::vector<std::string>& settings);

/// The scene that a parsed file describes. Throws InputError with everything that is wrong with it.
Scene make_scene(const XmlList& root);

}  // namespace mortise
