#pragma once
// Contact with plain arrays, for programs in C++ whose sources know no Trilinos. mortise.h has all of it for C: what arrays hold is said there.

#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "mortise/plain/mortise.h"
#include "mortise/plain/span.hpp"

namespace mortise {

/// A call that is refused. Thrown on every rank.
class PlainError : public std::runtime_error {
 public:
  /// `message` says where and what would be right.
  PlainError(mortise_status status, const std::string& message) : std::runtime_error(message), status_(status) {}
  /// Its kind, for programs.
  mortise_status status() const { return status_; }

 private:
  mortise_status status_;
};

/// Nodes and rows of this rank, as mortise_create() takes them.
struct PlainModel {
  int dimension = 0;                   ///< 2 or 3
  Span<const std::int64_t> node_ids;   ///< [nodes]
  Span<const double> positions;        ///< [nodes x dimension]
  Span<const std::int64_t> node_rows;  ///< [nodes x dimension], -1: no unknown
  Span<const std::int32_t> marks;      ///< [nodes x dimension]; empty: all 0
  Span<const std::int64_t> row_ids;    ///< [rows]
};

/// A state of the model.
struct PlainState {
  Span<const double> d;           ///< [rows]
  Span<const double> prescribed;  ///< [nodes x dimension]; empty: these do not move
  Span<const double> z;           ///< [multipliers]
};

/// A matrix as a host has it, in compressed rows of global columns.
struct PlainMatrix {
  Span<const std::int64_t> starts;   ///< [rows + 1]
  Span<const std::int64_t> columns;  ///< [starts[rows]]
  Span<const double> values;         ///< [starts[rows]]
};

/// Contact of a model: each member does what the function of mortise.h with its name does. Spans may be empty where mortise.h allows null.
/// All members throw, on every rank, a PlainError for misuse, and what Mortise::contact throws: an InputError for a model that it refuses, a
/// StepFailure for a state that it cannot evaluate. Collective in all members but add_facets(), count_nodes() and the accessors.
class PlainContact {
 public:
  /// dd = A^-1 right. What it throws becomes a PlainError on every rank.
  using Solve = std::function<void(Span<const double> right, Span<double> dd)>;

  /// On a communicator, which is duplicated. The arrays of the model are copied.
  PlainContact(MPI_Comm comm, const PlainModel& model, const std::string& options = "");
  /// On this process alone. MPI need not be initialised.
  explicit PlainContact(const PlainModel& model, const std::string& options = "");
  ~PlainContact();
  PlainContact(const PlainContact&) = delete;
  PlainContact& operator=(const PlainContact&) = delete;

  /// Makes the next collective call fail on every rank. For doors to other languages, which find more that is wrong. Not collective.
  void refuse_next(mortise_status status, const std::string& message);

  /// Adds a pair and gives its number.
  int add_pair(const std::string& name, double youngs_modulus, const std::string& options = "");
  /// Adds the second pass of a pair and gives its number. Its sides are to be those of `of`, exchanged.
  int add_second_pass(int of);
  void add_facets(int pair, mortise_side side, int nodes_per_facet, Span<const std::int64_t> nodes);  ///< throws on this rank alone
  void ready();                                                                                       ///< after it the model does not change

  std::size_t rows() const;                                   ///< of the system, on this rank
  std::size_t nodes() const;                                  ///< of this rank
  int dimension() const;                                      ///< 2 or 3
  const std::vector<std::int64_t>& multiplier_ids() const;    ///< [multipliers]; empty before ready()
  const std::vector<std::int64_t>& multiplier_nodes() const;  ///< [multipliers]
  const std::vector<double>& multiplier_weights() const;      ///< [multipliers]

  /// Begins a step, or undoes one. Sets guesses in `z`; `state.z` is not read.
  void start_step(const PlainState& state, Span<double> z);
  /// Forces f and conditions C, without derivatives. Either may be empty.
  mortise_norms evaluate(const PlainState& state, Span<double> f, Span<double> C);
  /// As evaluate(), with derivatives.
  mortise_norms differentiate(const PlainState& state, Span<double> f, Span<double> C);
  /// A block of derivatives, valid until the next call for it.
  mortise_matrix jacobian(mortise_block block);
  /// The condensed matrix, valid until the next call; `rhs` becomes its right-hand side.
  mortise_matrix condense(const PlainMatrix& K, Span<double> rhs);
  /// Newton's step by the host's linear solver.
  void solve(Span<const double> right, const Solve& solver, Span<double> dd, Span<double> dz);
  /// The multipliers that follow from dd alone.
  void recover(Span<const double> dd, Span<double> z);
  /// Updates the start of augmented Lagrange multipliers.
  mortise_augmentation augment();
  /// Takes the last evaluated state for the end of the step.
  void accept();
  /// Slave nodes of this rank. Not collective.
  std::size_t count_nodes(int pair) const;
  /// States of these nodes, [count_nodes(pair)].
  void report(int pair, Span<mortise_node> report);

  /// What this rank has of the accepted history.
  std::vector<unsigned char> store();
  /// Goes on from it, in the state in which it was stored.
  void restore(Span<const unsigned char> bytes, const PlainState& state);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace mortise
