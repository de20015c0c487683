#include "system/active_set_hash.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <cstdint>

namespace mortise::detail {
namespace {

// The finaliser of SplitMix64 (Steele, Lea, Flood 2014): every bit of the key reaches every bit of the result.
std::uint64_t mix(std::uint64_t key) {
  key += 0x9e3779b97f4a7c15ull;
  key = (key ^ (key >> 30)) * 0xbf58476d1ce4e5b9ull;
  key = (key ^ (key >> 27)) * 0x94d049bb133111ebull;
  return key ^ (key >> 31);
}

}  // namespace

std::array<long long, 2> active_set_hash(const ContactSystem& contact, const ContactStates& states, const Communicator& comm) {
  std::array<long long, 2> mine{}, all{};
  for (std::size_t pair = 0; pair < states.size(); ++pair) {
    const std::vector<GlobalOrdinal> nodes = contact.slave_ids(pair);
    for (std::size_t s = 0; s < nodes.size(); ++s) {
      const ContactState state = states[pair].states[s];
      if (state == ContactState::open) continue;
      const std::uint64_t hash = mix(static_cast<std::uint64_t>(nodes[s]) ^ mix(2 * pair + (state == ContactState::stick ? 1 : 0)));
      mine[0] += static_cast<long long>(hash >> 32);
      mine[1] += static_cast<long long>(hash & 0xffffffffull);
    }
  }
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, 2, mine.data(), all.data());
  return all;
}

}  // namespace mortise::detail
