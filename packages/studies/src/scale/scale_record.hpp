#pragma once
// One point of a series of runs on growing numbers of ranks.

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "mortise/simulation/scene/scene.hpp"
#include "mortise/studies/scale.hpp"
#include "scale/scale_phases.hpp"

namespace mortise {

/// A number of ranks, and what was found there.
struct ScalePoint {
  std::string series;  ///< strong or weak
  int ranks = 1;
  std::vector<std::string> settings;
  std::string directory;  ///< of the results

  bool finished = false;
  std::string state = "missing";        ///< finished, failed, running, waiting or missing
  std::string said;                     ///< why it did not finish
  double dofs = 0.0, memory_mib = 0.0;  ///< memory of all ranks
  double newton_iterations = 0.0, linear_iterations = 0.0, imbalance = 1.0;
  double seconds = 0.0;        ///< of the fastest repeat, mean over the ranks as summary.json has them
  std::vector<double> phases;  ///< [scale_phases] seconds of the same
  double bandwidth = 0.0;      ///< of as many processes [bytes / s]; 0: unknown

  std::vector<double> repeats;  ///< seconds of each

  /// "strong_4": name of its directory.
  std::string name() const { return series + "_" + std::to_string(ranks); }
  /// False for a later point of a weak series with at most as many unknowns as its first: it shows no weak scaling.
  bool has_grown(const ScalePoint& first) const;
  /// 1, but for what this point has more or fewer unknowns than its share of the first point's.
  double size_ratio(const ScalePoint& first) const;
  /// Efficiency on so many ranks: (t_1 / t_p) / p in the strong series; t_1 / t_p for as many unknowns per rank in the weak one. NaN if unknown, or
  /// if the unknowns of a weak series did not grow.
  double efficiency(const ScalePoint& first, double seconds_here, double seconds_first) const;
};

/// 1, 2, 4 ... and the most.
std::vector<int> rank_counts(int most);

/// Points of the strong series, and of the weak one if options have it, without their directories. Throws InputError for a variable that is not
/// there.
std::vector<ScalePoint> planned_points(const Scene& scene, const ScaleOptions& options);

/// Takes what a run left in a directory, if it came to its end with this exit code; else the point has failed and says `said`. Of several repeats the
/// fastest counts. Returns whether it came to its end.
bool take_run(ScalePoint& point, const std::string& directory, int code, const std::string& said);

/// Runs the point `repeats` times in its directory. Throws FileError if that cannot be had.
void run_scale_point(const RCP<const Communicator>& comm, const ScaleOptions& options, ScalePoint& point);

/// scale.json.
nlohmann::ordered_json scale_json(const ScaleOptions& options, const std::vector<ScalePoint>& points);

/// scale.csv.
void write_scale_table(const RCP<const Communicator>& comm, const std::string& path, const std::vector<ScalePoint>& points);

}  // namespace mortise
