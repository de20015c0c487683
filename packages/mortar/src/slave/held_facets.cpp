#include "slave/held_facets.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Teuchos_CommHelpers.hpp>
#include <array>

#include "exchange/exchange.hpp"

namespace mortise {
namespace {

/// The first texts of all ranks, in their order.
std::vector<std::string> first_of_all(const std::vector<std::string>& texts, const Communicator& comm) {
  std::vector<char> mine;
  for (const std::string& text : texts) mine.insert(mine.end(), text.c_str(), text.c_str() + text.size() + 1);
  std::vector<std::string> first;
  for (const auto& part : all_to_all(comm, std::vector(static_cast<std::size_t>(comm.getSize()), mine)))
    for (std::size_t begin = 0; begin < part.size() && first.size() < named_facets; begin += first.back().size() + 1)
      first.emplace_back(part.data() + begin);
  return first;
}

}  // namespace

std::optional<Diagnostic> refusal_of(const HeldFacets& mine, const Communicator& comm, const Place& place) {
  const std::array<long, 6> counts{mine.held, mine.all, mine.prescribed, mine.follow, mine.quadratic, mine.shared};
  std::array<long, 6> sums{};
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, 6, counts.data(), sums.data());
  const auto [held, all, prescribed, follow, quadratic, shared] = sums;
  if (held == 0) return {};
  const char* const how = follow == 0       ? "are prescribed"
                          : prescribed == 0 ? "follow a rigid body, a reference point or a tie"
                                            : "are prescribed or follow a rigid body, a reference point or a tie";
  if (shared > 0)
    return Diagnostic{
        place,
        fmt::format("{} of {} slave facets can carry no contact, as all {} belong to other pairs too{}; please make the mesh finer there, leave "
                    "these facets out, or give one pair all of its masters in one set; {} nodes {}",
                    held, all, quadratic > 0 ? "mid-side nodes" : "their nodes", prescribed + follow > 0 ? " or are held" : "",
                    held == 1 ? "it lies between" : "the first of them lie between", fmt::join(first_of_all(mine.nodes, comm), "; "))};
  return Diagnostic{place,
                    fmt::format("{} of {} slave facets can carry no contact, as the displacements of all {} {}; please make this side the "
                                "master, or take these facets out of it; {} nodes {}",
                                held, all, quadratic > 0 ? "mid-side nodes" : "their nodes", how,
                                held == 1 ? "it lies between" : "the first of them lie between", fmt::join(first_of_all(mine.nodes, comm), "; "))};
}

}  // namespace mortise
