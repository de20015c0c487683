#pragma once
// Study files: which runs of one scene are compared, and what their errors are measured against.

#include <optional>
#include <string>
#include <vector>

#include "mortise/core/parameters.hpp"

namespace mortise {

/// Values that are varied, each with a label and the settings it makes. Either `setting` and `values`, or `choices`.
struct StudyAxis {
  Located<std::string> setting;
  Located<std::vector<std::string>> values;
  std::vector<Named<AssignmentList>> choices;
  void describe(Parameters& parameters);
  /// Both forms as choices, by their labels.
  std::vector<Named<AssignmentList>> labelled() const;
};

/// Measure of a run's distance from its reference.
enum class StudyMeasure {
  relative_difference,   ///< |q - q_ref| / |q_ref| of a quantity of the scene
  itself,                ///< |q|: the scene's quantity is an error already
  pressure_profile,      ///< ||p - p_ref|| / ||p_ref||, L2 along the arc length of the slave surfaces, at the end
  shear_profile,         ///< ||t - t_ref|| / ||t_ref|| of the shear traction, as the pressure profile
  displacement,          ///< ||u - u_ref|| / ||u_ref||, L2 over the bodies, at the end
  displacement_gradient  ///< ||grad u - grad u_ref|| / ||grad u_ref||, relative H1 seminorm
};

/// Where the reference comes from.
enum class StudyReference { exact, finest, richardson };

/// One error, a column of study.csv: `error_<name>`.
struct StudyQuantity {
  StudyMeasure measure = StudyMeasure::relative_difference;
  Located<std::string> quantity;  ///< of the scene; empty: the name of the entry
  StudyReference reference = StudyReference::exact;
  Located<std::string> value;   ///< exact reference: an expression of the scene's variables and quantities
  std::optional<double> order;  ///< Richardson; no value: found from the three finest levels
  void describe(Parameters& parameters);

  bool is_profile() const { return measure == StudyMeasure::pressure_profile || measure == StudyMeasure::shear_profile; }
  bool is_field() const { return measure == StudyMeasure::displacement || measure == StudyMeasure::displacement_gradient; }
  bool of_scalar() const { return !is_profile() && !is_field(); }
  bool needs_finest() const { return !of_scalar() || (measure == StudyMeasure::relative_difference && reference == StudyReference::finest); }
  bool extrapolated() const { return measure == StudyMeasure::relative_difference && reference == StudyReference::richardson; }
};

/// A study file's content.
struct StudyFile {
  std::string name;  ///< of the file's outermost list

  Located<std::string> scene;  ///< relative to the study file
  AssignmentList settings;
  std::vector<Named<StudyAxis>> axes;
  std::vector<Named<AssignmentList>> exclude;
  Located<std::string> h;  ///< expression of a point's variables and quantities and of dofs
  std::vector<Named<StudyQuantity>> quantities;
  AssignmentList finest;               ///< settings of the reference run, none: there is no such run
  Located<std::string> series, along;  ///< names of axes
  int repeats = 1;
  std::optional<double> time_limit;  ///< seconds of each run; a point's settings may say another
  std::vector<double> targets{0.01, 0.001};

  StudyFile() { h.value = "1/sqrt(dofs)"; }
  void describe(Parameters& parameters);
};

}  // namespace mortise
