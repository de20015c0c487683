#pragma once

namespace mortise {

/// x, y or z of 0, 1 or 2.
inline const char* component_name(int component) { return component == 0 ? "x" : component == 1 ? "y" : "z"; }

}  // namespace mortise
