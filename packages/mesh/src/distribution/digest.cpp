#include "mortise/mesh/digest.hpp"

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>
#include <cstdint>
#include <cstring>

namespace mortise {
namespace {

/// FNV-1a of 64 bits, byte by byte.
class Fnv {
 public:
  template <class Word>
  Fnv& add(Word word) {
    static_assert(sizeof(Word) == 8);
    std::uint64_t bits = 0;
    std::memcpy(&bits, &word, sizeof(bits));
    for (int byte = 0; byte < 8; ++byte) value_ = (value_ ^ ((bits >> (8 * byte)) & 0xffU)) * 0x100000001b3U;
    return *this;
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325U;
};

}  // namespace

// A sum does not ask for an order.
std::string mesh_digest(const Mesh& mesh) {
  std::uint64_t mine = 0;
  const auto id = [&](LocalOrdinal node) { return static_cast<long long>(mesh.local_nodes->getGlobalElement(node)); };
  for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node) {
    Fnv hash;
    hash.add(id(node));
    for (const double x : mesh.coordinates[static_cast<std::size_t>(node)]) hash.add(x);
    mine += hash.value();
  }
  for (std::size_t block = 0; block < mesh.blocks.size(); ++block)
    for (LocalOrdinal element = 0; element < mesh.blocks[block].owned; ++element) {
      Fnv hash;
      hash.add(static_cast<long long>(block)).add(static_cast<long long>(mesh.blocks[block].element_ids[static_cast<std::size_t>(element)]));
      for (int a = 0; a < mesh.blocks[block].nodes_per_element; ++a) hash.add(id(mesh.blocks[block].nodes(element)[a]));
      mine += hash.value();
    }
  // Sums of halves, which do not overflow.
  const long long halves[2] = {static_cast<long long>(mine >> 32), static_cast<long long>(mine & 0xffffffffU)};
  long long sums[2] = {0, 0};
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_SUM, 2, halves, sums);
  return fmt::format("{:016x}", (static_cast<std::uint64_t>(sums[0]) << 32) + static_cast<std::uint64_t>(sums[1]));
}

}  // namespace mortise
