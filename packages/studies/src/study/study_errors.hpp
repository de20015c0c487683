#pragma once
// Errors of a study's points.

#include <optional>
#include <string>
#include <vector>

#include "study/study_curves.hpp"
#include "study/study_record.hpp"

namespace mortise {

/// The errors of one quantity of the study, "not a number" where there is none.
struct StudyErrors {
  std::string name;
  std::vector<double> error, value, reference;  ///< of each point; values and references of scalars only
  std::vector<std::string> notes;               ///< remarks for a reader: orders found, references missing
};

/// The runs of a study as they ended.
struct StudyResults {
  std::vector<StudyRecord> points;
  std::optional<StudyRecord> finest;
  std::vector<double> h;  ///< of each point
};

/// Environment in which errors are measured.
struct StudyMeasuring {
  const Communicator& comm;
  const StudyPlan& plan;
  const StudyResults& results;
  const std::vector<StudyCurve>& curves;
  std::string directory;  ///< of the study

  std::string directory_of(const StudyPoint& point) const { return directory + (point.labels.empty() ? "/" : "/points/") + point.name; }
};

/// Mesh sizes by the study's expression; not a number where it takes what a run did not give.
std::vector<double> mesh_sizes(const StudyPlan& plan, const std::vector<StudyRecord>& records);

/// One for each quantity of the study, in its order. Throws FileError if a file of a run cannot be read.
std::vector<StudyErrors> study_errors(const StudyMeasuring& measuring);

/// Relative L2 differences of the displacements and of their gradients to the finest run, for the points that finished.
struct FieldErrors {
  std::vector<double> displacement, gradient;
};
FieldErrors field_errors(const StudyMeasuring& measuring);

}  // namespace mortise
