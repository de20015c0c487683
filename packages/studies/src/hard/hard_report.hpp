#pragma once
// The ledger as a table and as pages.

#include <string>
#include <vector>

#include "hard/hard_verdict.hpp"

namespace mortise {

/// A line of the ledger on one number of ranks, with what became of it.
struct HardRow {
  const HardLine* line = nullptr;
  int ranks = 1;
  HardOutcome outcome;
  HardVerdict verdict;
};

/// "61 right, 3 stopped with a true reason, 12 wrong"
std::string count_verdicts(const std::vector<HardRow>& rows);

/// ledger.csv: a row for each line and number of ranks.
void write_hard_table(const RCP<const Communicator>& comm, const std::string& path, const HardPlan& plan, const std::vector<HardRow>& rows);

/// hard-cases.md: a line a case, a table for each sweep.
std::string hard_markdown(const HardPlan& plan, const std::vector<HardRow>& rows, const std::string& version);

/// The same as a page that needs no other file.
std::string hard_html(const HardPlan& plan, const std::vector<HardRow>& rows, const std::string& version);

}  // namespace mortise
