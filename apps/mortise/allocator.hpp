#pragma once
// Settings that make this process keep the memory that it has freed.

namespace mortise {

/// Freed memory stays with the process, and large pieces come from it as well. Without this every Newton iteration gives its matrices back to the
/// system and takes them again, page by page.
void keep_freed_memory();

}  // namespace mortise
