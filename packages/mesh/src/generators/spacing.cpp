#include "mortise/mesh/spacing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <stdexcept>

#include "generators/describe_cells.hpp"

namespace mortise {
namespace {

/// 1 + q + ... + q^(n-1).
double geometric_sum(double q, int n) {
  const double log_q = std::log(q);
  return std::abs(n * log_q) < 1e-12 ? n : std::expm1(n * log_q) / std::expm1(log_q);
}

/// Runs that start with the smallest cell at a line's start: equal cells on the refined length, then growing ones. Of more than most_cells cells the
/// first run alone.
std::vector<Spacing::Run> refined_runs(double length, double smallest, double refined, double growth) {
  refined = std::min(std::max(refined, smallest), length);
  if (refined / smallest > most_cells) return {{most_cells + 1, refined, 1.0}};
  const int equal = std::max(1, static_cast<int>(std::ceil(refined / smallest - 1e-9)));
  const double cell = refined / equal, rest = length - refined;
  std::vector<Spacing::Run> runs{{equal, refined, 1.0}};
  if (rest <= 1e-9 * length) {
    runs.front().length = length;
    return runs;
  }
  // The fewest cells n with cell (g + g^2 + ... + g^n) >= rest; then the growth q <= g with equality.
  int n = 1;
  while (n <= most_cells && cell * growth * geometric_sum(growth, n) < rest) ++n;
  if (n > most_cells) return {{n, rest, 1.0}};
  if (cell * n >= rest) {  // not even equal cells fit: make them a little smaller
    runs.push_back({n, rest, 1.0});
    return runs;
  }
  const auto excess = [&](double q) { return cell * q * geometric_sum(q, n) - rest; };
  double q = growth;
  if (excess(growth) > 0.0) {
    std::uintmax_t iterations = 200;
    const auto [low, high] = boost::math::tools::toms748_solve(excess, 1.0, growth, boost::math::tools::eps_tolerance<double>(50), iterations);
    q = 0.5 * (low + high);
  }
  runs.push_back({n, rest, q});
  return runs;
}

std::vector<Spacing::Run> reversed_runs(std::vector<Spacing::Run> runs) {
  std::reverse(runs.begin(), runs.end());
  for (auto& run : runs) run.growth = 1.0 / run.growth;
  return runs;
}

std::vector<Spacing::Run> joined(std::vector<Spacing::Run> first, const std::vector<Spacing::Run>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

/// `cells` cells, the last `ratio` times as long as the first.
Spacing::Run graded_run(int cells, double ratio) { return {cells, 1.0, cells > 1 ? std::pow(ratio, 1.0 / (cells - 1)) : 1.0}; }

/// Symmetric about the middle, the sizes from there on 1, q, q^2, ... `ratio` is that of the outermost to the middle cell.
std::vector<Spacing::Run> symmetric_runs(int cells, double ratio) {
  const int half = cells / 2;
  if (cells % 2 == 0) {
    const std::vector<Spacing::Run> outward{graded_run(half, ratio)};
    return joined(reversed_runs(outward), outward);
  }
  if (half == 0) return {{1, 1.0, 1.0}};
  const double q = std::pow(ratio, 1.0 / half);
  const std::vector<Spacing::Run> outward{{half, q * geometric_sum(q, half), q}};
  return joined(joined(reversed_runs(outward), {{1, 1.0, 1.0}}), outward);
}

}  // namespace

Spacing::Spacing(std::vector<Run> runs) : runs_(std::move(runs)) {
  double length = 0.0;
  for (const auto& run : runs_) {
    if (run.cells < 1 || !(run.length > 0.0) || !(run.growth > 0.0)) throw std::invalid_argument("a run of cells needs cells, length and growth > 0");
    cells_ += run.cells;
    length += run.length;
  }
  if (runs_.empty()) throw std::invalid_argument("a spacing needs a run of cells");
  for (auto& run : runs_) run.length /= length;
}

double Spacing::position(int i) const {
  if (i <= 0) return 0.0;
  if (i >= cells_) return 1.0;
  double start = 0.0;
  for (const auto& run : runs_) {
    // s_i = s_0 + l (1 + q + ... + q^(i-1)) / (1 + q + ... + q^(n-1))
    if (i <= run.cells) return start + run.length * geometric_sum(run.growth, i) / geometric_sum(run.growth, run.cells);
    start += run.length;
    i -= run.cells;
  }
  return 1.0;
}

Spacing Spacing::reversed() const { return Spacing(reversed_runs(runs_)); }

void GradingOptions::describe(Parameters& parameters) {
  parameters.add("toward", toward, {{"start", FineEnd::start}, {"end", FineEnd::end}, {"middle", FineEnd::middle}, {"both ends", FineEnd::both_ends}},
                 Says("where the smallest cells are; start is left, bottom, inner or the start angle"));
  parameters.add("ratio", ratio, Says("size of the largest cell over that of the smallest").unit("-").at_least(1.0));
  parameters.add("smallest cell", smallest_cell, Says("size of the smallest cells; given, it decides the number of cells").unit("length").above(0.0));
  parameters.add("refined length", refined_length,
                 Says("length from the fine end on that has cells of the smallest size").unit("length").at_least(0.0));
  parameters.add("growth", growth, Says("largest ratio of one cell to the one before beyond the refined length").unit("-").above(1.0).at_most(10.0));
  if (smallest_cell && ratio != 1.0) parameters.error("ratio", "give either \"ratio\" (with a number of cells) or \"smallest cell\"");
}

Spacing GradingOptions::spacing(double length, int cells, const Place& place) const {
  if (smallest_cell) {
    const bool two_sided = toward == FineEnd::middle || toward == FineEnd::both_ends;
    const double reach = two_sided ? 0.5 * length : length;
    if (*smallest_cell > reach)
      throw InputError(place, fmt::format("\"smallest cell\" {} is larger than the {} that it has to fit into", *smallest_cell, reach));
    const auto runs = refined_runs(reach, *smallest_cell, refined_length, growth);
    if (runs.front().cells > most_cells)
      throw InputError(place, fmt::format("\"smallest cell\" {:g} asks for more than {} cells on a length of {:g}; please make it larger",
                                          *smallest_cell, most_cells, length));
    switch (toward) {
      case FineEnd::start:
        return Spacing(runs);
      case FineEnd::end:
        return Spacing(reversed_runs(runs));
      case FineEnd::middle:
        return Spacing(joined(reversed_runs(runs), runs));
      case FineEnd::both_ends:
        return Spacing(joined(runs, reversed_runs(runs)));
    }
  }
  if (cells < 1) throw InputError(place, "give the number of cells in each direction, or a \"smallest cell\" in its grading");
  switch (toward) {
    case FineEnd::start:
      return Spacing({graded_run(cells, ratio)});
    case FineEnd::end:
      return Spacing({graded_run(cells, 1.0 / ratio)});
    case FineEnd::middle:
      return Spacing(symmetric_runs(cells, ratio));
    case FineEnd::both_ends:
      return Spacing(symmetric_runs(cells, 1.0 / ratio));
  }
  return Spacing(cells);
}

}  // namespace mortise
