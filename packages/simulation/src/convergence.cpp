#include "mortise/simulation/convergence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace mortise {
namespace {

bool positive(double value) { return std::isfinite(value) && value > 0.0; }

}  // namespace

std::optional<double> fitted_order(const std::vector<double>& h, const std::vector<double>& error) {
  std::vector<double> x, y;
  for (std::size_t i = 0; i < h.size(); ++i)
    if (positive(h[i]) && positive(error[i])) x.push_back(std::log(h[i])), y.push_back(std::log(error[i]));
  if (x.size() < 2) return {};
  const double count = static_cast<double>(x.size());
  const double mean_x = std::accumulate(x.begin(), x.end(), 0.0) / count, mean_y = std::accumulate(y.begin(), y.end(), 0.0) / count;
  double xx = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) xx += (x[i] - mean_x) * (x[i] - mean_x), xy += (x[i] - mean_x) * (y[i] - mean_y);
  if (!(xx > 1e-20 * count)) return {};
  return xy / xx;
}

std::optional<Extrapolation> extrapolate(const std::vector<double>& h, const std::vector<double>& value, std::optional<double> order) {
  const std::size_t n = h.size(), needed = order ? 2 : 3;
  if (n < needed) return {};
  for (std::size_t i = n - needed; i < n; ++i)
    if (!positive(h[i]) || !std::isfinite(value[i]) || (i > n - needed && !(h[i] < h[i - 1]))) return {};
  const double last = value[n - 1] - value[n - 2];
  if (!order) {
    const Extrapolation finest{value[n - 1], {}, std::abs(last)};
    const auto [least, most] = std::minmax_element(value.end() - 3, value.end());
    if (*most - *least <= 1e-10 * std::max(std::abs(*least), std::abs(*most))) return finest;
    // (q2 - q1) / (q3 - q2) = (h1^p - h2^p) / (h2^p - h3^p), the right side of which rises with p.
    const double wanted = (value[n - 2] - value[n - 3]) / last;
    const double coarse = std::log(h[n - 3] / h[n - 2]), fine = std::log(h[n - 2] / h[n - 1]);
    const auto ratio = [&](double p) { return std::expm1(p * coarse) / -std::expm1(-p * fine); };
    double low = 1e-6, high = 20.0;
    if (wanted < 0.0 || wanted >= ratio(high)) return finest;
    if (!(ratio(low) < wanted)) return {};
    for (int i = 0; i < 100; ++i) {
      const double middle = 0.5 * (low + high);
      (ratio(middle) < wanted ? low : high) = middle;
    }
    order = 0.5 * (low + high);
  }
  return Extrapolation{value[n - 1] + last / std::expm1(*order * std::log(h[n - 2] / h[n - 1])), order};
}

std::optional<TimeToError> time_to_error(double target, const std::vector<double>& seconds, const std::vector<double>& error) {
  std::vector<double> t, e;
  for (std::size_t i = 0; i < error.size(); ++i)
    if (std::isfinite(error[i]) && positive(seconds[i])) t.push_back(seconds[i]), e.push_back(std::max(error[i], std::numeric_limits<double>::min()));
  if (e.empty() || e.back() > target) return {};
  std::size_t first = e.size() - 1;
  while (first > 0 && e[first - 1] <= target) --first;
  if (first == 0) return TimeToError{t[0], true};
  const double fraction = std::log(e[first - 1] / target) / std::log(e[first - 1] / e[first]);
  return TimeToError{t[first - 1] * std::pow(t[first] / t[first - 1], fraction), false};
}

std::vector<std::size_t> pareto_front(const std::vector<double>& seconds, const std::vector<double>& error) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < error.size(); ++i)
    if (std::isfinite(error[i]) && std::isfinite(seconds[i])) order.push_back(i);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return seconds[a] != seconds[b] ? seconds[a] < seconds[b] : error[a] != error[b] ? error[a] < error[b] : a < b;
  });
  std::vector<std::size_t> front;
  for (const std::size_t i : order)
    if (front.empty() || error[i] < error[front.back()]) front.push_back(i);
  return front;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

}  // namespace mortise
