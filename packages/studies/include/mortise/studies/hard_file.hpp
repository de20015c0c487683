#pragma once
// Ledger files: hard cases and what is expected of them.

#include <optional>
#include <string>
#include <vector>

#include "mortise/core/parameters.hpp"
#include "mortise/studies/study_file.hpp"

namespace mortise {

/// Expectation of a figure of a run: `value` within `bound`, or between `low` and `high`. All are expressions.
struct HardExpectation {
  Located<std::string> figure;  ///< empty: the quantity with the name of the entry
  Located<std::string> value, bound;
  Located<std::string> low, high;
  void describe(Parameters& parameters);
};

/// A run whose quantities expectations are measured against.
struct HardCompanion {
  Located<std::string> scene;  ///< empty: that of the case, with its settings below its own
  AssignmentList settings;
  bool follows_axes = true;  ///< true if values of the case's axes are set here too
  void describe(Parameters& parameters);
};

/// Stops that are true.
struct HardStop {
  Located<std::string> reason;  ///< regular expression that the last failure's text has to match somewhere; empty: no stop is true
  std::vector<double> codes{3};
  bool required = false;  ///< true if coming to the end is wrong
  void describe(Parameters& parameters);
};

/// One case: a scene, or a sweep over some of its values.
struct HardCase {
  Located<std::string> scene;
  std::string hard, expectation, source;  ///< sentences of the ledger
  AssignmentList settings;
  std::vector<Named<StudyAxis>> axes;
  std::vector<Named<HardCompanion>> companions;
  std::vector<Named<HardExpectation>> expected;
  Located<std::string> always;  ///< expression of t, variables and quantities that holds after each step; empty: none
  HardStop stop;
  bool every_ranks = true;  ///< true if it is run on all numbers of ranks that are asked for, not on the first one alone
  void describe(Parameters& parameters);
};

/// A ledger file's content.
struct HardFile {
  double time_limit = 60.0;  ///< seconds of each run; settings may say another
  std::vector<Named<HardCase>> cases;
  void describe(Parameters& parameters);
};

}  // namespace mortise
