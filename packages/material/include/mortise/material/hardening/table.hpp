#pragma once

#include <algorithm>
#include <vector>

#include "mortise/core/parameters.hpp"
#include "mortise/core/table.hpp"

namespace mortise {

/// Yield stresses given at accumulated plastic strains, linear in between, constant beyond the last one.
struct TableHardening {
  static constexpr const char* name = "table";
  static constexpr const char* sentence = "yield stresses at given values of alpha, linear in between, constant beyond the last";

  Table table{{0.0}, {1.0}};  ///< "times" are plastic strains, values [stress]

  void describe(Parameters& parameters) {
    auto& [strains, stresses] = table;
    parameters.add("plastic strains", strains, Says("values of alpha, ascending from 0").unit("-").required());
    parameters.add("yield stresses", stresses, Says("yield stress at each of them, never falling").unit("stress").required());
    if (strains.empty() || strains.front() != 0.0 || std::adjacent_find(strains.begin(), strains.end(), std::greater_equal<>()) != strains.end())
      parameters.error("plastic strains", "\"plastic strains\" have to start at 0 and ascend");
    if (stresses.size() != strains.size())
      parameters.error("yield stresses", "there are " + std::to_string(stresses.size()) + " \"yield stresses\" for " +
                                             std::to_string(strains.size()) + " \"plastic strains\"");
    if (stresses.empty() || !(stresses.front() > 0.0)) parameters.error("yield stresses", "\"yield stresses\" have to be larger than 0");
    if (std::adjacent_find(stresses.begin(), stresses.end(), std::greater<>()) != stresses.end())
      parameters.error("yield stresses", "\"yield stresses\" fall: softening has no unique solution and is refused");
  }
  double yield_stress(double alpha) const { return table(alpha); }
  /// Slope of the piece that starts at or contains alpha.
  double slope(double alpha) const {
    const auto& [strains, stresses] = table;
    const auto end = std::upper_bound(strains.begin(), strains.end(), alpha);
    if (end == strains.end() || end == strains.begin()) return 0.0;
    const auto i = static_cast<std::size_t>(end - strains.begin());
    return (stresses[i] - stresses[i - 1]) / (strains[i] - strains[i - 1]);
  }
  double plastic_work(double alpha) const {
    double work = 0.0, start = 0.0;
    const auto add_up_to = [&](double end) {
      work += 0.5 * (table(start) + table(end)) * (end - start);
      start = end;
    };
    for (const double strain : table.times)
      if (strain < alpha) add_up_to(strain);
    add_up_to(alpha);
    return work;
  }
};

}  // namespace mortise
