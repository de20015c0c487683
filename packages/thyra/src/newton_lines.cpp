#include "newton_lines.hpp"

#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace mortise::detail {
namespace {

/// Longest step of a line search, over that of Newton.
constexpr double longest_step = 4.0;
constexpr double round_off = std::numeric_limits<double>::epsilon();

}  // namespace

void NewtonLines::start(RCP<const Vector> z, ContactStates states) {
  z_ = std::move(z);
  states_ = std::move(states);
  lines_.clear();
}

void NewtonLines::add(std::size_t after, NewtonLine line) {
  lines_.resize(std::min(after, lines_.size()));
  lines_.push_back(std::move(line));
}

PlaceOnLines NewtonLines::place(const Vector& d) const {
  std::size_t nearest = 0;
  double share = 0.0, least = std::numeric_limits<double>::infinity();
  const double size = d.norm2();
  Vector way(d.getMap());
  for (std::size_t i = lines_.size(); i-- > 0;) {
    const NewtonLine& line = lines_[i];
    way.update(1.0, d, -1.0, *line.d, 0.0);
    if (way.normInf() == 0.0) return {line.z, i, true};
    const double length = line.dd->norm2();
    double a = length > 0.0 ? std::clamp(way.dot(*line.dd) / (length * length), 0.0, longest_step) : 0.0;
    if (std::abs(a - 1.0) <= 1e-12 + 4.0 * round_off * size / std::max(length, std::numeric_limits<double>::min())) a = 1.0;
    way.update(-a, *line.dd, 1.0);
    const double distance = way.norm2();
    if (distance >= least) continue;
    least = distance;
    nearest = i;
    share = a;
  }
  if (lines_.empty()) return {z_, 0, true};
  const NewtonLine& line = lines_[nearest];
  const auto z = rcp(new Vector(*line.z, Teuchos::Copy));
  z->update(share, *line.dz, 1.0);
  return {z, nearest + 1, false};
}

}  // namespace mortise::detail
