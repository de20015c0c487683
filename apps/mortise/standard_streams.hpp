#pragma once
// Standard input, output and errors of this process.

namespace mortise {

/// Opens /dev/null where a standard stream is closed. Whoever closes one wants nothing of it. The next file that is opened would take its number: a
/// message would be written into results. Comes before anything is opened.
void open_closed_streams();

}  // namespace mortise
