#pragma once
// The runs of a ledger.

#include <string>
#include <vector>

#include "mortise/input/expression.hpp"
#include "mortise/studies/hard.hpp"
#include "mortise/studies/hard_file.hpp"
#include "mortise/studies/study_points.hpp"

namespace mortise {

/// A scene with settings.
struct HardRun {
  std::string scene, text;  ///< file and content
  StudyPoint point;
};

/// One line of the ledger: a case, or a combination of the values of a sweep's axes.
struct HardLine {
  std::size_t number = 0;  ///< of the case in the plan
  std::string label;       ///< of the combination; empty: the case has no axes
  HardRun run;
  std::vector<HardRun> companions;  ///< in the case's order
};

/// Runs to be made.
struct HardPlan {
  std::vector<Named<HardCase>> cases;
  std::vector<HardLine> lines;  ///< case by case

  const Named<HardCase>& case_of(const HardLine& line) const { return cases[line.number]; }
};

/// Reads the ledger and its scenes and keeps the cases that the options choose. Throws FileError, InputError with all that is wrong.
HardPlan read_hard(const Communicator& comm, const HardOptions& options);

/// Files that a ledger leaves beside the directories of its cases.
const std::vector<std::string>& hard_pages();

/// Name of the directory of a run on so many ranks, in that of its line.
std::string run_name(int ranks);

/// Names and values that expressions of a line may use besides the scene's variables.
struct HardNames {
  std::vector<std::string> names;
  std::vector<double> values;
  void add(const std::string& name, double value) { names.push_back(name), values.push_back(value); }
};

/// Value of an expression. Not a number where a name's value is none. Throws InputError at its place if it means nothing.
double evaluate(const Located<std::string>& source, const Symbols& symbols, const HardNames& names);

}  // namespace mortise
