#pragma once
// What sequences of ever finer runs say: orders, limits, times to an accuracy.

#include <optional>
#include <vector>

namespace mortise {

/// Slope p of the line that fits log(error) over log(h) best; values that are not positive and finite are left out. None with less than two
/// different h.
std::optional<double> fitted_order(const std::vector<double>& h, const std::vector<double>& error);

/// q(h) = limit + c h^order
struct Extrapolation {
  double limit = 0.0, order = 0.0;
};

/// Richardson's: the limit h -> 0 of a sequence from coarse to fine, from its last two values if the order is given, else from its last three.
/// None if they are too few, mesh sizes do not fall, or no order between 0 and 20 fits (values that do not approach a limit from one side).
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
