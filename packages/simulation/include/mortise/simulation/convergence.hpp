#pragma once
// What sequences of ever finer runs say: orders, limits, times to an accuracy.

#include <optional>
#include <vector>

namespace mortise {

/// Slope p of the line that fits log(error) over log(h) best; values that are not positive and finite are left out. None with less than two
/// different h.
std::optional<double> fitted_order(const std::vector<double>& h, const std::vector<double>& error);

/// Where a sequence from coarse to fine tends to.
struct Extrapolation {
  double limit = 0.0;
  std::optional<double> order;  ///< of q(h) = limit + c h^order; none: the limit is the finest value
  double uncertainty = 0.0;     ///< of a limit without order: how far the last two values are apart
};

/// Richardson's limit h -> 0, from the last two values if the order is given, else from the last three. These may also
///   - agree to 1e-10 of their size, which is what Newton's method leaves: their differences have no order, the finest value is the limit;
///   - oscillate, or come to rest faster than h^20: the finest value is the limit, as uncertain as the last two values are apart.
/// None if they are too few or not finite, or if mesh sizes do not fall. None also if the values go one way and their steps do not die out as h^order
/// would.
std::optional<Extrapolation> extrapolate(const std::vector<double>& h, const std::vector<double>& value, std::optional<double> order);

/// A time to an accuracy.
struct TimeToError {
  double seconds = 0.0;
  bool at_most = false;  ///< the coarsest run is good enough already
};

/// When the runs of a curve, from coarse to fine, have come below `target` for good: between the last one above it and the next linear in the
/// logarithms. None if the finest is above it. Values that are not finite are left out.
std::optional<TimeToError> time_to_error(double target, const std::vector<double>& seconds, const std::vector<double>& error);

/// Indices of the runs that no other is better than, in time and in error, by time. Values that are not finite are left out.
std::vector<std::size_t> pareto_front(const std::vector<double>& seconds, const std::vector<double>& error);

/// Of one value or more.
double median(std::vector<double> values);

}  // namespace mortise
