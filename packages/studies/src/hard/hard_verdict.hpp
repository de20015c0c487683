#pragma once
// Verdict on a run of the ledger.

#include <limits>
#include <string>
#include <vector>

#include "hard/hard_outcome.hpp"

namespace mortise {

enum class Verdict {
  right,    ///< it came to its end with what is expected, or stopped as is required
  stopped,  ///< it stopped with a true reason, before anything wrong was accepted
  wrong
};

/// "right", "stopped with a true reason", "wrong"
std::string to_string(Verdict verdict);

/// A figure beside what it has to be.
struct HardFigure {
  std::string name;
  double value = std::numeric_limits<double>::quiet_NaN();
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  bool near = false;  ///< low and high lie about a value that is expected

  bool ok() const { return value >= low && value <= high; }
  /// Distance beyond the middle of its range, over half of the range; with one bound 0 or infinity.
  double excess() const;
  /// Half of the range; of one bound, its size.
  double room() const;
  /// "0.5 within 0.01", "0.4 to 0.6", "at most 0.6"
  std::string allowed() const;
};

/// Judgement of a run.
struct HardVerdict {
  Verdict verdict = Verdict::wrong;
  std::vector<HardFigure> figures;  ///< of all expectations, in their order
  std::string why;                  ///< of a run that is wrong, or the text of the stop

  /// The figure that is worst; none: nothing was measured.
  const HardFigure* worst() const;
};

/// Judges a run by its case. `companions` in the case's order.
HardVerdict judge(const Named<HardCase>& one, const HardLine& line, const HardOutcome& outcome, const std::vector<HardOutcome>& companions);

/// Judges a run beside the same on another number of ranks: figures have to agree to 1e-6 of their size, or to a thousandth of what is allowed.
void compare_ranks(const HardVerdict& first, int first_ranks, HardVerdict& other);

}  // namespace mortise
