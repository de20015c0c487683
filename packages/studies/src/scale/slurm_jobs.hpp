#pragma once
// Runs of a series as jobs of Slurm: what is written for them, and what they leave.

#include <string>
#include <vector>

#include "scale/scale_prediction.hpp"
#include "scale/scale_record.hpp"

namespace mortise {

/// Files of the jobs in the directory of a series.
struct JobFiles {
  explicit JobFiles(std::string directory) : directory_(std::move(directory)) {}

  std::string jobs() const { return directory_ + "/jobs"; }
  std::string scene() const { return jobs() + "/scene"; }  ///< copy of the scene for which they were written
  std::string script(const ScalePoint& point) const { return jobs() + "/" + point.name() + ".sh"; }
  std::string log(const ScalePoint& point) const { return jobs() + "/" + point.name() + ".log"; }
  std::string id(const ScalePoint& point) const { return jobs() + "/" + point.name() + ".id"; }  ///< number of the job that was submitted last
  /// Of one repeat: "started" as it begins, "said" what it prints, "exit" its exit code at the end.
  std::string of_repeat(const ScalePoint& point, int repeat, const std::string& what) const;
  std::string results(const ScalePoint& point, int repeat) const;

 private:
  std::string directory_;
};

/// The job script of a point. Repeats that have ended well are not run again.
std::string job_script(const ScaleOptions& options, const ScalePoint& point, const ScalePrediction& prediction, const MachineFile& machine,
                       const JobFiles& files);

/// The script that submits the points that neither have finished nor are in the queue.
std::string submit_script(const ScaleOptions& options, const std::vector<ScalePoint>& points, const JobFiles& files);

/// Takes what the jobs of a point have left: results, or its state and the reason.
void take_jobs(const ScaleOptions& options, ScalePoint& point, const JobFiles& files);

}  // namespace mortise
