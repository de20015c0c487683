#pragma once
// The runs of a study.

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "mortise/core/types.hpp"
#include "mortise/input/expression.hpp"
#include "mortise/studies/peer.hpp"
#include "mortise/studies/study_file.hpp"

namespace mortise {

/// One run: a combination of one value of each axis, or the finest run.
struct StudyPoint {
  std::string name;                 ///< "n=4,element=Q4_F-bar": a directory
  std::vector<std::string> labels;  ///< one for each axis; none: the finest run
  std::vector<std::string> titles;  ///< labels for people: "n = 4" where the label alone is a bare value
  std::vector<Assignment> settings;
  int ranks = 1;
  Peer peer = Peer::none;                                       ///< the program that runs it instead of this one
  Located<std::string> penalty;                                 ///< of its contact, as penalty_multiple() takes it; empty for peers without
  double time_limit = std::numeric_limits<double>::infinity();  ///< seconds of wall time of each run

  // Properties of the scene with these settings.
  std::string formulation, element;
  bool axisymmetric = false;
  std::vector<std::string> quantities;
  Symbols symbols;

  /// "path=value" each, as `--set` takes them.
  std::vector<std::string> words() const;
  /// "Q4 F-bar, n = 4"; "finest"
  std::string label() const;
};

/// A study that can be run.
struct StudyPlan {
  StudyFile file;
  std::string scene_text;
  std::vector<std::vector<std::string>> labels;  ///< of each axis
  std::vector<StudyPoint> points;                ///< the last axis runs fastest
  std::optional<StudyPoint> finest;
  std::size_t series = 0, along = 0;  ///< indices of axes
};

/// Reads a study, with `settings`, "path=value" each, replacing its values, and its scene. Throws FileError if the study cannot be read, InputError
/// with everything that is wrong with it and with the scene under the settings of its runs.
StudyPlan read_study(const Communicator& comm, const std::string& path, const std::vector<std::string>& settings = {});

/// All combinations of the axes' values without the excluded ones; diagnostics get labels that no axis has.
std::vector<StudyPoint> study_points(const StudyFile& study, std::vector<Diagnostic>& diagnostics);

/// Value of the expression of a study, of variables, quantities and `dofs`, at a point. Not a number where a quantity has no value.
/// @param values  of point.quantities, in their order
/// Throws InputError at `source`'s place if it cannot be evaluated.
double evaluate(const Located<std::string>& source, const StudyPoint& point, const std::vector<double>& values, double dofs);

}  // namespace mortise
