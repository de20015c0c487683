#pragma once
// Properties of a file that the library of Exodus II takes for granted.

#include <string>

namespace mortise {

/// Looks at the signature, the attributes and the variables of a file before Exodus' library does: it copies attributes and whole variables into
/// places whose size it takes from elsewhere.
/// @throws FileError if the file cannot be opened, InputError with what is not as the format has it
void check_exodus_file(const std::string& path);

}  // namespace mortise
