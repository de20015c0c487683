#pragma once
// Contact tractions along slave surfaces, compared between runs.

#include <string>
#include <utility>
#include <vector>

namespace mortise {

/// A traction over the arc length, linear between points. One for each pair and each part of its slave surface, in the file's order.
struct TractionProfile {
  std::string pair, part;
  std::vector<double> arc_length, traction;
};

/// The profiles of the last time in a profiles.csv.
/// @param column  "pressure" or "shear"
/// Throws FileError if it is no such table.
std::vector<TractionProfile> read_profiles(const std::string& path, const std::string& column);

/// (sum int (p - p_ref)^2 ds / sum int p_ref^2 ds)^(1/2) over all pairs and parts, p being 0 beyond the ends of a profile. Not a number if the
/// reference is nothing.
double profile_difference(const std::vector<TractionProfile>& profiles, const std::vector<TractionProfile>& reference);

}  // namespace mortise
