#include "model/report_corners.hpp"

#include <fmt/format.h>

#include <set>

namespace mortise {
namespace {

const char* described(CornerRule rule) {
  switch (rule) {
    case CornerRule::master_normal:
      return "the master's (master normal)";
    case CornerRule::nearest_facet:
      return "that of the facet nearest to the master (nearest facet)";
    default:
      return "the average of the facets' (averaged)";
  }
}

}  // namespace

void report_corners(const ContactSystem& contact, const ContactEvaluation& at_start, RunLog& log) {
  std::set<std::size_t> second_passes;  // told with the first ones
  for (std::size_t pair = 0; pair < contact.pairs(); ++pair)
    if (const auto second = contact.second_pass(pair)) second_passes.insert(*second);
  for (std::size_t pair = 0; pair < contact.pairs(); ++pair) {
    if (second_passes.count(pair) > 0) continue;
    const CornerReport corners = mortise::corners(at_start, pair);
    if (corners.kinks == 0) continue;
    log.info(fmt::format("  contact {}: the slave surface has {} node{} at convex edges or corners; the normal there is {}{}",
                         contact.pair_name(pair), corners.kinks, corners.kinks == 1 ? "" : "s", described(corners.rule),
                         corners.as_asked ? "" : ", the rule for this formulation and geometry"));
  }
}

}  // namespace mortise
