#pragma once
// A line for each point of a study that is run.

#include <map>
#include <string>
#include <vector>

#include "run_log.hpp"
#include "study_record.hpp"

namespace mortise {

/// Says what is run, how it ended and about how long the rest takes.
class StudyProgress {
 public:
  StudyProgress(const StudyPlan& plan, RunLog& log);
  void begin(const StudyPoint& point);
  void end(const StudyPoint& point, const StudyRecord& record);

 private:
  std::string level_of(const StudyPoint& point) const;
  std::string left() const;

  const StudyPlan& plan_;
  RunLog& log_;
  std::size_t total_, number_ = 0;
  std::map<std::string, std::vector<double>> seconds_;  ///< of all repeats, by the value of the axis "along", which decides most on the cost
};

}  // namespace mortise
