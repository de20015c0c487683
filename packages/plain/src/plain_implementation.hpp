#pragma once
// The state of contact with plain arrays, and the checks and steps that its calls share.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "agreement.hpp"
#include "checks.hpp"
#include "compressed_rows.hpp"
#include "host_system.hpp"
#include "mortise/contact/contact_system.hpp"
#include "mortise/core/trilinos_versions.hpp"
#include "mortise/plain/plain_contact.hpp"

namespace mortise {

/// Options of the model as a whole.
struct MeasureOptions {
  InterfaceMeasure measure;
  void describe(Parameters& parameters) {
    parameters.add("thickness", measure.thickness, Says("thickness of a model in 2D that is not axisymmetric").unit("length").above(0.0));
    parameters.add("axisymmetric", measure.axisymmetric, "true: the model is a section of a ring, x is the radius");
  }
};

/// Arrays of a host as vectors, and back.
Vector to_vector(const RCP<const Map>& map, Span<const double> from);
void from_vector(const Vector& from, Span<double> to);
/// [nodes x dimension]; 0 from an empty array.
MultiVector on_nodes(const RCP<const Map>& nodes, int dimension, Span<const double> from);

/// A problem where something is not right.
std::optional<Problem> unless(bool right, mortise_status status, const std::string& text);

struct PlainContact::Implementation {
  /// Collective. Throws PlainError on all ranks.
  Implementation(RCP<const Communicator> comm, const PlainModel& model, const std::string& options);

  void take(const PlainModel& model, const std::string& options);

  // What has to be so before a call.

  void check(const std::string& call, const std::optional<Problem>& mine, const std::string& alike = "") {
    const auto problem = first_of({std::exchange(pending, std::nullopt), mine});
    agreement.check(call, problem, alike);
  }

  std::optional<Problem> describing() const {
    return unless(!contact, MORTISE_WRONG_ORDER, "mortise_ready() has been called: the model does not change any more");
  }
  std::optional<Problem> is_ready() const { return unless(contact.has_value(), MORTISE_WRONG_ORDER, "call mortise_ready() before"); }
  std::optional<Problem> in_step() const {
    return first_of({is_ready(), unless(step.has_value(), MORTISE_WRONG_ORDER, "call mortise_start_step() before")});
  }
  std::optional<Problem> has_laws() const {
    return unless(laws.has_value(), MORTISE_WRONG_ORDER, "call mortise_evaluate() or mortise_differentiate() before: there is no evaluated state");
  }
  std::optional<Problem> has_derivatives() const {
    return first_of({in_step(), unless(differentiated.has_value(), MORTISE_WRONG_ORDER,
                                       "call mortise_differentiate() before: there is no state with derivatives")});
  }
  std::optional<Problem> has_condensed() const {
    return first_of({is_ready(), unless(condensed.has_value(), MORTISE_WRONG_ORDER, "call mortise_condense() before: there is no condensed system")});
  }
  std::optional<Problem> is_pair(int pair) const {
    return unless(pair >= 0 && pair < static_cast<int>(pairs.size()), MORTISE_REFUSED,
                  fmt::format("there is no pair {}; there are {}", pair, pairs.size()));
  }
  std::size_t multipliers() const { return multiplier_ids.size(); }
  std::optional<Problem> wrong_state(const PlainState& state) const {
    const std::size_t of_nodes = static_cast<std::size_t>(dimension) * local_id_count(*nodes);
    return first_of({wrong_numbers("d", state.d, local_id_count(*rows)), wrong_optional("prescribed", state.prescribed, of_nodes),
                     unless_finite("prescribed", state.prescribed)});
  }

  // Steps of the calls.

  void set_up();
  void forget_iterates();
  mortise_norms evaluate(const PlainState& state, Span<double> f, Span<double> C, bool derivatives);
  ContactLinearisation linearise();
  /// The host's solver, which may fail on one rank. Others then go on with zeros to where all of them stop.
  NodeElimination::Solve guarded(const Solve& solver, std::optional<Problem>& problem, bool& failed) const;

  /// An evaluation with derivatives and its laws.
  struct Differentiated {
    DifferentiatedContact at;
    ContactLaws laws;
  };

  RCP<const Communicator> comm;
  Agreement agreement{*comm};
  MeasureOptions measure;
  int dimension = 0;
  RCP<const Map> nodes, rows;
  std::optional<NodalField> field;
  RCP<const MultiVector> reference, fixed;
  std::vector<ContactPair> pairs;
  std::optional<Problem> pending;       ///< of refuse_next()
  std::optional<Problem> wrong_facets;  ///< the first of this rank
  std::optional<ContactSystem> contact;
  std::vector<std::int64_t> multiplier_ids, multiplier_nodes;
  std::vector<double> multiplier_weights;

  std::optional<ContactHistory> accepted, step;
  ContactStates last;  ///< of the last linearised iterate
  int round = 0;       ///< of augment() in this step
  std::optional<ContactLaws> laws;
  std::optional<Differentiated> differentiated;
  std::optional<NodeElimination> condensed;
  std::optional<HostSystem> system;
  CompressedRows condensed_rows;
  std::array<CompressedRows, 4> blocks;
};

}  // namespace mortise
