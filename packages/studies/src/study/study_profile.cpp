#include "mortise/studies/study_profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "mortise/core/error.hpp"
#include "shared/text_table.hpp"

namespace mortise {
namespace {

/// Value at s, approached from the side of `toward`, on which it is 0 beyond the end.
double value(const TractionProfile& profile, double s, double toward) {
  const auto& x = profile.arc_length;
  if (x.size() < 2 || toward < x.front() || toward > x.back()) return 0.0;
  const auto next = std::clamp<std::ptrdiff_t>(std::upper_bound(x.begin(), x.end(), toward) - x.begin(), 1, x.size() - 1);
  const double length = x[next] - x[next - 1];
  const double fraction = length > 0.0 ? (s - x[next - 1]) / length : 0.0;
  return profile.traction[next - 1] + fraction * (profile.traction[next] - profile.traction[next - 1]);
}

/// int (a - b)^2 ds: between neighbouring points of either, both are linear.
double squared_difference(const TractionProfile& a, const TractionProfile& b) {
  std::vector<double> cuts = a.arc_length;
  cuts.insert(cuts.end(), b.arc_length.begin(), b.arc_length.end());
  std::sort(cuts.begin(), cuts.end());
  double sum = 0.0;
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    const double low = cuts[i - 1], high = cuts[i], middle = 0.5 * (low + high);
    const double first = value(a, low, middle) - value(b, low, middle), last = value(a, high, middle) - value(b, high, middle);
    sum += (high - low) / 3.0 * (first * first + first * last + last * last);
  }
  return sum;
}

const TractionProfile* find(const std::vector<TractionProfile>& profiles, const TractionProfile& wanted) {
  const auto found =
      std::find_if(profiles.begin(), profiles.end(), [&](const auto& one) { return one.pair == wanted.pair && one.part == wanted.part; });
  return found == profiles.end() ? nullptr : &*found;
}

}  // namespace

std::vector<TractionProfile> read_profiles(const std::string& path, const std::string& column) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  const std::vector<std::string> names = cells_of(line);
  const auto index = [&](const std::string& name) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) throw FileError(fmt::format("{}: no column \"{}\"", path, name));
    return static_cast<std::size_t>(found - names.begin());
  };
  const std::size_t time = index("time"), pair = index("pair"), part = index("part"), arc_length = index("arc_length"), traction = index(column);
  std::vector<TractionProfile> profiles;
  std::string last_time;
  while (std::getline(file, line)) {
    const std::vector<std::string> cells = cells_of(line);
    if (cells.size() != names.size()) throw FileError(fmt::format("{}: a row of {} values for {} columns", path, cells.size(), names.size()));
    if (cells[time] != last_time) profiles.clear();
    last_time = cells[time];
    if (profiles.empty() || profiles.back().pair != cells[pair] || profiles.back().part != cells[part])
      profiles.push_back({cells[pair], cells[part], {}, {}});
    try {
      profiles.back().arc_length.push_back(std::stod(cells[arc_length]));
      profiles.back().traction.push_back(std::stod(cells[traction]));
    } catch (const std::logic_error&) {
      throw FileError(fmt::format("{}: not a number in \"{}\"", path, line));
    }
  }
  return profiles;
}

double profile_difference(const std::vector<TractionProfile>& profiles, const std::vector<TractionProfile>& reference) {
  double difference = 0.0, size = 0.0;
  for (const TractionProfile& one : reference) {
    const TractionProfile* other = find(profiles, one);
    size += squared_difference(one, {});
    difference += squared_difference(one, other ? *other : TractionProfile{});
  }
  for (const TractionProfile& one : profiles)
    if (!find(reference, one)) difference += squared_difference(one, {});
  return std::sqrt(difference / size);
}

}  // namespace mortise
