#include "mortise/studies/convergence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace mortise {
namespace {

bool positive(double value) { return std::isfinite(value) && value > 0.0; }

}  // namespace

FittedOrder fitted_order(const std::vector<double>& h, const std::vector<double>& error) {
  std::vector<double> x, y;
  double coarser_h = std::numeric_limits<double>::infinity(), coarser_error = coarser_h;
  for (std::size_t i = 0; i < h.size(); ++i) {
    if (!positive(h[i]) || !std::isfinite(error[i])) continue;
    if (!(h[i] < coarser_h)) return {{}, "mesh sizes do not fall"};
    // Round-off need not fall, but what has come down to it stays there.
    const double above = std::max(error[i], round_off);
    if (!(above < coarser_error || (above == round_off && coarser_error == round_off))) return {{}, "errors do not fall"};
    coarser_h = h[i], coarser_error = above;
    if (above > round_off) x.push_back(std::log(h[i])), y.push_back(std::log(error[i]));
  }
  if (x.size() < 2) return {{}, std::isfinite(coarser_h) ? "fewer than two errors above round-off" : "no errors"};
  const double count = static_cast<double>(x.size());
  const double mean_x = std::accumulate(x.begin(), x.end(), 0.0) / count, mean_y = std::accumulate(y.begin(), y.end(), 0.0) / count;
  double xx = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) xx += (x[i] - mean_x) * (x[i] - mean_x), xy += (x[i] - mean_x) * (y[i] - mean_y);
  return {xy / xx, ""};
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
    if (*most - *least <= round_off * std::max(std::abs(*least), std::abs(*most))) return finest;
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

std::vector<std::size_t> within_for_good(double bound, const std::vector<double>& error) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < error.size(); ++i) {
    if (!std::isfinite(error[i])) continue;
    if (error[i] > bound)
      found.clear();
    else
      found.push_back(i);
  }
  return found;
}

std::optional<TimeToError> time_to_error(double target, const std::vector<double>& seconds, const std::vector<double>& error) {
  std::vector<double> t, e;
  for (std::size_t i = 0; i < error.size(); ++i)
    if (std::isfinite(error[i]) && positive(seconds[i])) t.push_back(seconds[i]), e.push_back(std::max(error[i], std::numeric_limits<double>::min()));
  const std::vector<std::size_t> good = within_for_good(target, e);
  if (good.empty()) return {};
  const std::size_t first = good.front();
  const bool confirmed = good.size() > 1;
  if (first == 0) return TimeToError{t[0], true, confirmed};
  const double fraction = std::log(e[first - 1] / target) / std::log(e[first - 1] / e[first]);
  return TimeToError{t[first - 1] * std::pow(t[first] / t[first - 1], fraction), false, confirmed};
}

std::optional<CheapestRun> cheapest_run(double error, const std::vector<double>& seconds, const std::vector<double>& errors,
                                        const std::vector<std::vector<std::size_t>>& families) {
  std::optional<CheapestRun> cheapest;
  for (const auto& family : families) {
    std::vector<double> of_family;
    for (const std::size_t i : family) of_family.push_back(errors[i]);
    const std::vector<std::size_t> good = within_for_good(error, of_family);
    for (const std::size_t at : good) {
      const CheapestRun found{family[at], at != good.back()};
      if (!std::isfinite(seconds[found.run])) continue;
      const bool better = !cheapest || (found.confirmed != cheapest->confirmed ? found.confirmed : seconds[found.run] < seconds[cheapest->run]);
      if (better) cheapest = found;
    }
  }
  return cheapest;
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
