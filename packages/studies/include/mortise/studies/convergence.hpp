#pragma once
// Results of sequences of ever finer runs: orders, limits, times to an accuracy.

#include <optional>
#include <string>
#include <vector>

namespace mortise {

/// Relative errors up to this one are round-off: what Newton's method leaves.
constexpr double round_off = 1e-10;

/// An order of convergence, or why there is none.
struct FittedOrder {
  std::optional<double> order;
  std::string reason;  ///< "errors do not fall"; empty with an order
};

/// Slope p of the line that fits log(error) over log(h) best, of runs from coarse to fine. Values that are not finite are left out, and so are errors
/// that are round-off. No order if mesh sizes or errors do not fall from run to run, or if fewer than two errors are left.
FittedOrder fitted_order(const std::vector<double>& h, const std::vector<double>& error);

/// Where a sequence from coarse to fine tends to.
struct Extrapolation {
  double limit = 0.0;
  std::optional<double> order;  ///< of q(h) = limit + c h^order; none: the limit is the finest value
  double uncertainty = 0.0;     ///< of a limit without order: how far the last two values are apart
};

/// Richardson's limit h -> 0, from the last two values if the order is given, else from the last three. These may also
///   - agree to round-off of their size: their differences have no order, the finest value is the limit;
///   - oscillate, or come to rest faster than h^20: the finest value is the limit, as uncertain as the last two values are apart.
/// None if they are too few or not finite, or if mesh sizes do not fall. None also if the values go one way and their steps do not die out as h^order
/// would.
std::optional<Extrapolation> extrapolate(const std::vector<double>& h, const std::vector<double>& value, std::optional<double> order);

/// Indices of the runs from which on all errors are within the bound, from coarse to fine; errors that are not finite are left out. No finer run
/// confirms the last of them.
std::vector<std::size_t> within_for_good(double bound, const std::vector<double>& error);

/// A time to an accuracy.
struct TimeToError {
  double seconds = 0.0;
  bool at_most = false;    ///< the coarsest run is good enough already
  bool confirmed = false;  ///< a finer run than the first that is good enough is so too
};

/// When the runs of a curve, from coarse to fine, have come below `target` for good: between the last one above it and the next linear in the
/// logarithms. None if the finest is above it. Values that are not finite are left out.
std::optional<TimeToError> time_to_error(double target, const std::vector<double>& seconds, const std::vector<double>& error);

/// The run to take for an error.
struct CheapestRun {
  std::size_t run = 0;
  bool confirmed = false;  ///< a finer run of its family is within the error too
};

/// Of all runs from which on their family stays within the error, the one that took least time. One that no finer run confirms counts only where
/// there is no other: an error may be small because it changes its sign.
/// @param families  indices of runs that differ in how fine they are alone, from coarse to fine
std::optional<CheapestRun> cheapest_run(double error, const std::vector<double>& seconds, const std::vector<double>& errors,
                                        const std::vector<std::vector<std::size_t>>& families);

/// Indices of the runs that no other is better than, in time and in error, by time. Values that are not finite are left out.
std::vector<std::size_t> pareto_front(const std::vector<double>& seconds, const std::vector<double>& error);

/// Of one value or more.
double median(std::vector<double> values);

}  // namespace mortise
