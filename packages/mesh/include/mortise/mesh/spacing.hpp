#pragma once
// Where the nodes of a mesh line lie: runs of cells whose sizes grow geometrically.

#include <optional>
#include <vector>

#include "mortise/core/parameters.hpp"

namespace mortise {

/// Division of a line of length 1 into cells: runs of cells, in each of which every cell is `growth` times as long as the one before.
class Spacing {
 public:
  struct Run {
    int cells = 1;
    double length = 1.0;  ///< of the whole run, as a share of the line
    double growth = 1.0;
  };

  /// `cells` >= 1 equal cells.
  explicit Spacing(int cells = 1) : Spacing(std::vector<Run>{{cells, 1.0, 1.0}}) {}

  /// Lengths are scaled so that they sum to 1. Throws std::invalid_argument for a run without cells or without positive length or growth.
  explicit Spacing(std::vector<Run> runs);

  int cells() const { return cells_; }

  /// Position of point i in 0..cells(); 0 at the start and exactly 1 at the end.
  double position(int i) const;

  /// Position of point i/2 for even i, of the middle of a cell for odd i in 0..2 cells().
  double doubled_position(int i) const { return i % 2 == 0 ? position(i / 2) : 0.5 * (position(i / 2) + position(i / 2 + 1)); }

  /// The same cells from the other end.
  Spacing reversed() const;

 private:
  std::vector<Run> runs_;
  int cells_ = 0;
};

/// Where the smallest cells of a line are.
enum class FineEnd { start, end, middle, both_ends };

/// Grading of the cells of a line. Either their number and the ratio of the largest to the smallest cell are given, or the size of the smallest
/// cell. In the second case cells of that size fill `refined_length` from the fine end on. Each further cell is longer by at most `growth`.
struct GradingOptions {
  FineEnd toward = FineEnd::start;
  double ratio = 1.0;
  std::optional<double> smallest_cell;
  double refined_length = 0.0;
  double growth = 1.2;
  void describe(Parameters& parameters);

  /// Division of a line of length `length` (> 0) into `cells` cells; with a smallest cell, `cells` is not used.
  /// Throws InputError (at `place`) for cells < 1 without a smallest cell, and for a smallest cell above `length`.
  Spacing spacing(double length, int cells, const Place& place) const;
};

}  // namespace mortise
