#pragma once
// Errors with a place.

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "mortise/core/types.hpp"

namespace mortise {

/// Where something was said: file, line (1-based; 0 if unknown) and path of list names, e.g. "contact/die".
struct Place {
  std::string file;  ///< as it was named; empty: unknown
  int line = 0;      ///< from 1; 0: unknown
  std::string path;  ///< names of lists, separated by "/"; empty: the outermost list
};

/// One thing that is wrong with the input.
struct Diagnostic {
  Place place;          ///< where it stands
  std::string message;  ///< the error, the allowed values, the remedy
};

/// A given text as messages show it: whole, or if it is long its beginning and its length: `1 + 1 + ... (10000 characters)`.
std::string shortened(const std::string& text);

/// "block.in:14: error: contact/die: unknown parameter ...". Text of the message between quotes is shortened.
std::string to_string(const Diagnostic& diagnostic);

/// Everything that is wrong with the input, found in one go; what() is all of it, one line each.
class InputError : public std::runtime_error {
 public:
  /// All of `diagnostics`; none where everything has been said elsewhere.
  explicit InputError(std::vector<Diagnostic> diagnostics);
  /// One of them.
  InputError(Place place, std::string message);
  /// One for each thing that is wrong.
  const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }

 private:
  std::vector<Diagnostic> diagnostics_;
};

/// A file that cannot be read or written.
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Why a step (one Newton solve) has to be undone.
enum class FailureKind {
  inverted_element,  ///< det F <= 0 or det F0 <= 0
  material,          ///< a law that found no stress
  inverted_facet,    ///< a surface facet without length or normal
  projection,        ///< a projection that has no solution
  lost_contact,      ///< closed nodes that moved beyond the reach of their master surface
  linear_solver,     ///< true residual of a linear solve too large, or a singular matrix
  not_finite,        ///< NaN or Inf
  input,             ///< a given function that has no value to go on with; the text has its place
  line_search,       ///< no step along the Newton direction makes the residual smaller
  diverged,
  too_many_iterations,
  cycling_active_set,
  out_of_memory,  ///< the memory needed next would not fit; no smaller step helps
  augmentation,   ///< augmented Lagrange multipliers that did not settle
  unstable,       ///< an equilibrium that is not stable, far from the last state
  step_error      ///< a step of time that is too long for its tolerances
};
std::string to_string(FailureKind kind);

/// A step that cannot be finished; the load stepper undoes it and takes a smaller one. Thrown on every rank or on none.
class StepFailure : public std::runtime_error {
 public:
  /// `message` says where and how far off, for people.
  StepFailure(FailureKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  /// Why, for programs.
  FailureKind kind() const { return kind_; }

 private:
  FailureKind kind_;
};

/// Collective: if any rank holds a failure, every rank throws the one of the lowest such rank.
void throw_if_any(const Communicator& comm, const std::optional<StepFailure>& failure);

/// Collective: if any rank holds diagnostics, every rank throws all of them (in rank order, without repeats).
void throw_if_any(const Communicator& comm, const std::vector<Diagnostic>& diagnostics);

}  // namespace mortise
