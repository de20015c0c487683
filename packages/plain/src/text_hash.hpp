#pragma once

#include <cstddef>
#include <cstdint>

namespace mortise {

/// A number that is made of all bytes (FNV-1a): equal bytes give equal ones, other bytes hardly ever.
inline std::uint64_t text_hash(const void* bytes, std::size_t size) {
  std::uint64_t hash = 14695981039346656037u;
  for (std::size_t i = 0; i < size; ++i) hash = (hash ^ static_cast<const unsigned char*>(bytes)[i]) * 1099511628211u;
  return hash;
}

}  // namespace mortise
