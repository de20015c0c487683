#include "mortise/plain/plain_contact.hpp"

#include <fmt/format.h>

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "agreement.hpp"
#include "checks.hpp"
#include "communicator.hpp"
#include "compressed_rows.hpp"
#include "history_bytes.hpp"
#include "host_system.hpp"
#include "mortise/contact/contact_report.hpp"
#include "mortise/contact/contact_system.hpp"
#include "mortise/core/over_ranks.hpp"
#include "options.hpp"

namespace mortise {
namespace {

/// Options of the model as a whole.
struct MeasureOptions {
  InterfaceMeasure measure;
  void describe(Parameters& parameters) {
    parameters.add("thickness", measure.thickness, Says("thickness of a model in 2D that is not axisymmetric").unit("length").above(0.0));
    parameters.add("axisymmetric", measure.axisymmetric, "true: the model is a section of a ring, x is the radius");
  }
};

/// A map of the ids of this rank, which no other rank may have.
RCP<const Map> map_of(const char* name, Span<const std::int64_t> ids, const RCP<const Communicator>& comm) {
  const std::vector<GlobalOrdinal> all(ids.begin(), ids.end());
  const auto count = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  const auto map = rcp(new const Map(count, all.data(), static_cast<LocalOrdinal>(all.size()), 0, comm));
  if (!map->isOneToOne())
    throw PlainError(MORTISE_REFUSED, fmt::format("mortise_create: \"{}\" holds an id that another rank has too; each belongs to one rank", name));
  return map;
}

Vector to_vector(const RCP<const Map>& map, Span<const double> from) {
  Vector result(map);
  const auto view = result.getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (std::size_t i = 0; i < from.size(); ++i) view(i, 0) = from[i];
  return result;
}

void from_vector(const Vector& from, Span<double> to) {
  const auto view = from.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t i = 0; i < to.size(); ++i) to[i] = view(i, 0);
}

MultiVector on_nodes(const RCP<const Map>& nodes, int dimension, Span<const double> from) {
  const auto columns = static_cast<std::size_t>(dimension);
  MultiVector result(nodes, columns);
  const auto view = result.getLocalViewHost(Tpetra::Access::ReadWrite);
  for (std::size_t k = 0; k < from.size(); ++k) view(k / columns, k % columns) = from[k];
  return result;
}

std::optional<Problem> unless(bool right, mortise_status status, const std::string& text) {
  return right ? std::nullopt : std::optional(Problem{status, text});
}

}  // namespace

struct PlainContact::Implementation {
  Implementation(RCP<const Communicator> comm, const PlainModel& model, const std::string& options) : comm(std::move(comm)) {
    agreement.check("mortise_create", wrong_model(model), fmt::format("{} {}", model.dimension, options));
    agreement.run([&] { take(model, options); });
  }

  void take(const PlainModel& model, const std::string& options) {
    read_options(measure, options, "options");
    dimension = model.dimension;
    nodes = map_of("node_ids", model.node_ids, comm);
    rows = map_of("row_ids", model.row_ids, comm);
    field.emplace("displacement", nodes, dimension, std::vector<GlobalOrdinal>(model.node_rows.begin(), model.node_rows.end()));
    reference = rcp(new MultiVector(on_nodes(nodes, dimension, model.positions)));
    std::vector<double> marks(model.node_rows.size());
    for (std::size_t k = 0; k < marks.size(); ++k)
      marks[k] = model.node_rows[k] == NodalField::none ? 1.0 : model.marks.empty() ? 0.0 : model.marks[k];
    fixed = rcp(new MultiVector(on_nodes(nodes, dimension, marks)));
    system.emplace(rows);
  }

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
    const std::size_t of_nodes = static_cast<std::size_t>(dimension) * nodes->getNodeNumElements();
    return first_of({wrong_numbers("d", state.d, rows->getNodeNumElements()), wrong_optional("prescribed", state.prescribed, of_nodes),
                     unless_finite("prescribed", state.prescribed)});
  }

  // Steps of the calls.

  void set_up() {
    for (std::size_t p = 0; p < pairs.size(); ++p)
      if (pairs[p].options.formulation.options->two_pass() && !pairs[p].second_pass_of &&
          std::none_of(pairs.begin(), pairs.end(), [&](const ContactPair& one) { return one.second_pass_of == p; }))
        throw PlainError(MORTISE_REFUSED, fmt::format("mortise_ready: the formulation of \"{}\" has two passes; add the second one by "
                                                      "mortise_add_second_pass()",
                                                      pairs[p].name));
    contact.emplace(*field, rows, reference, fixed, measure.measure, pairs, Timers());
    const GlobalOrdinal first = rows->getMaxAllGlobalIndex() + 1;
    for (const GlobalOrdinal id : contact->multiplier_map()->getNodeElementList()) {
      multiplier_ids.push_back(id);
      multiplier_nodes.push_back((id - first) / dimension);
    }
    multiplier_weights.resize(multipliers());
    from_vector(*contact->weights(), multiplier_weights);
  }

  void forget_iterates() {
    laws.reset();
    differentiated.reset();
    condensed.reset();
  }

  mortise_norms evaluate(const PlainState& state, Span<double> f, Span<double> C, bool derivatives) {
    check(derivatives ? "mortise_differentiate" : "mortise_evaluate",
          first_of({in_step(), wrong_state(state), wrong_numbers("z", state.z, multipliers()), wrong_optional("f", f, rows->getNodeNumElements()),
                    wrong_optional("C", C, multipliers())}));
    laws.reset();
    if (derivatives) differentiated.reset();
    ContactNorms norms;
    agreement.run([&] {
      const Vector d = to_vector(rows, state.d), z = to_vector(contact->multiplier_map(), state.z);
      const MultiVector prescribed = on_nodes(nodes, dimension, state.prescribed);
      const NodalDisplacement at(d, prescribed);
      if (derivatives) {
        auto evaluation = contact->differentiate(at, *step, &last);
        laws = evaluation.laws(z);
        differentiated = Differentiated{std::move(evaluation), *laws};
      } else {
        laws = contact->evaluate(at, *step).laws(z);
      }
      Vector force(rows), conditions(contact->multiplier_map());
      laws->add_force(force);
      laws->complementarity(conditions);
      from_vector(force, f);
      from_vector(conditions, C);
      norms = laws->norms(last);
    });
    return {norms.gap, norms.complementarity, norms.force, norms.active, norms.sticking, norms.changed};
  }

  ContactLinearisation linearise() {
    last = differentiated->laws.states();
    return differentiated->at.linearise(differentiated->laws);
  }

  // The host's solver may fail on one rank. Others then go on with zeros to where all of them stop.
  NodeElimination::Solve guarded(const Solve& solver, std::optional<Problem>& problem, bool& failed) const {
    return [&solver, &problem, &failed, this](const Vector& right, Vector& dd) {
      std::vector<double> solution(rows->getNodeNumElements(), 0.0);
      const auto view = right.getLocalViewHost(Tpetra::Access::ReadOnly);
      if (!failed) {
        try {
          solver({view.data(), solution.size()}, solution);
          if (const auto wrong = unless_finite("dd", solution))
            problem = Problem{MORTISE_SOLVE_FAILED, "the linear solver gives what is not finite: " + wrong->text};
        } catch (...) {
          problem = Problem{MORTISE_SOLVE_FAILED, "the linear solver has failed: " + problem_of_exception().text};
        }
        failed = most_over_ranks(*comm, problem ? 1 : 0) > 0;
      }
      if (failed) std::fill(solution.begin(), solution.end(), 0.0);
      Tpetra::deep_copy(dd, to_vector(rows, solution));
    };
  }

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

PlainContact::PlainContact(MPI_Comm comm, const PlainModel& model, const std::string& options)
    : implementation_(std::make_unique<Implementation>(duplicate(comm), model, options)) {}

PlainContact::PlainContact(const PlainModel& model, const std::string& options)
    : implementation_(std::make_unique<Implementation>(this_process(), model, options)) {}

PlainContact::~PlainContact() = default;

void PlainContact::refuse_next(mortise_status status, const std::string& message) { implementation_->pending = Problem{status, message}; }

int PlainContact::add_pair(const std::string& name, double youngs_modulus, const std::string& options) {
  Implementation& self = *implementation_;
  const bool repeated = std::any_of(self.pairs.begin(), self.pairs.end(), [&](const ContactPair& one) { return one.name == name; });
  self.check("mortise_add_pair",
             first_of({self.describing(), unless(!name.empty(), MORTISE_REFUSED, "the name of the pair is empty"),
                       unless(!repeated, MORTISE_REFUSED, fmt::format("there is a pair \"{}\" already", name)),
                       unless(std::isfinite(youngs_modulus) && youngs_modulus > 0.0, MORTISE_REFUSED,
                              fmt::format("Young's modulus of \"{}\" is {}; it has to be above 0", name, youngs_modulus))}),
             fmt::format("{}\n{}\n{}", name, youngs_modulus, options));
  ContactPair pair;
  pair.name = name;
  pair.youngs_modulus = youngs_modulus;
  self.agreement.run([&] { read_options(pair.options, options, name); });
  self.pairs.push_back(std::move(pair));
  return static_cast<int>(self.pairs.size()) - 1;
}

int PlainContact::add_second_pass(int of) {
  Implementation& self = *implementation_;
  const auto two_passes = [&] {
    const ContactPair& first = self.pairs[static_cast<std::size_t>(of)];
    const bool there =
        std::any_of(self.pairs.begin(), self.pairs.end(), [&](const ContactPair& one) { return one.second_pass_of == static_cast<std::size_t>(of); });
    return unless(first.options.formulation.options->two_pass() && !first.second_pass_of && !there, MORTISE_REFUSED,
                  fmt::format("\"{}\" has no second pass, or has it already", first.name));
  };
  auto problem = first_of({self.describing(), self.is_pair(of)});
  if (!problem) problem = two_passes();
  self.check("mortise_add_second_pass", problem, std::to_string(of));
  ContactPair pair = self.pairs[static_cast<std::size_t>(of)];
  pair.name += ", second pass";
  pair.slave.clear();
  pair.master.clear();
  pair.second_pass_of = static_cast<std::size_t>(of);
  self.pairs.push_back(std::move(pair));
  return static_cast<int>(self.pairs.size()) - 1;
}

void PlainContact::add_facets(int pair, mortise_side side, int nodes_per_facet, Span<const std::int64_t> nodes) {
  Implementation& self = *implementation_;
  const auto problem = first_of({self.describing(), self.is_pair(pair),
                                 unless(side == MORTISE_SLAVE || side == MORTISE_MASTER, MORTISE_REFUSED, fmt::format("there is no side {}", side)),
                                 wrong_facets(self.dimension, nodes_per_facet, nodes)});
  if (problem) {
    if (!self.wrong_facets) self.wrong_facets = problem;
    throw PlainError(problem->status, "mortise_add_facets: " + problem->text);
  }
  ContactPair& to = self.pairs[static_cast<std::size_t>(pair)];
  for (const std::int64_t* first = nodes.begin(); first != nodes.end(); first += nodes_per_facet)
    (side == MORTISE_SLAVE ? to.slave : to.master).emplace_back(first, first + nodes_per_facet);
}

void PlainContact::ready() {
  Implementation& self = *implementation_;
  self.check("mortise_ready", first_of({self.describing(), self.wrong_facets,
                                        unless(!self.pairs.empty(), MORTISE_WRONG_ORDER, "call mortise_add_pair() before: there is no pair")}));
  self.agreement.run([&] { self.set_up(); });
}

std::size_t PlainContact::rows() const { return implementation_->rows->getNodeNumElements(); }
std::size_t PlainContact::nodes() const { return implementation_->nodes->getNodeNumElements(); }
int PlainContact::dimension() const { return implementation_->dimension; }
const std::vector<std::int64_t>& PlainContact::multiplier_ids() const { return implementation_->multiplier_ids; }
const std::vector<std::int64_t>& PlainContact::multiplier_nodes() const { return implementation_->multiplier_nodes; }
const std::vector<double>& PlainContact::multiplier_weights() const { return implementation_->multiplier_weights; }

void PlainContact::start_step(const PlainState& state, Span<double> z) {
  Implementation& self = *implementation_;
  self.check("mortise_start_step",
             first_of({self.is_ready(), self.wrong_state(state), wrong_numbers("z", {z.data(), z.size()}, self.multipliers())}));
  self.step.reset();
  self.forget_iterates();
  self.agreement.run([&] {
    const Vector d = to_vector(self.rows, state.d);
    const MultiVector prescribed = on_nodes(self.nodes, self.dimension, state.prescribed);
    const NodalDisplacement at(d, prescribed);
    Vector guess = to_vector(self.contact->multiplier_map(), {z.data(), z.size()});
    const ContactHistory accepted = self.accepted ? *self.accepted : self.contact->initial_history(at);
    const ContactHistory begun = self.contact->start_step(self.contact->with_clearances(accepted, 0.0), at, guess);
    from_vector(guess, z);
    self.last = begun->states;
    self.round = 0;
    self.step = begun;
  });
}

mortise_norms PlainContact::evaluate(const PlainState& state, Span<double> f, Span<double> C) {
  return implementation_->evaluate(state, f, C, false);
}

mortise_norms PlainContact::differentiate(const PlainState& state, Span<double> f, Span<double> C) {
  return implementation_->evaluate(state, f, C, true);
}

mortise_matrix PlainContact::jacobian(mortise_block block) {
  Implementation& self = *implementation_;
  self.check("mortise_jacobian",
             first_of({self.has_derivatives(), unless(block >= MORTISE_F_D && block <= MORTISE_C_Z, MORTISE_REFUSED,
                                                      fmt::format("there is no block {}", static_cast<int>(block)))}),
             std::to_string(block));
  CompressedRows& result = self.blocks[static_cast<std::size_t>(block)];
  self.agreement.run([&] {
    const ContactLinearisation linearised = self.linearise();
    if (block == MORTISE_F_D) {
      const RCP<Matrix> matrix = self.system->zeros(*self.contact, self.differentiated->at);
      linearised.add_stiffness(*matrix);
      result = compressed_rows(*matrix);
      return;
    }
    const SaddlePointBlocks blocks = linearised.saddle_point_blocks();
    result = compressed_rows(block == MORTISE_F_Z ? *blocks.B : block == MORTISE_C_D ? *blocks.C_d : *blocks.C_z);
  });
  return result.view();
}

mortise_matrix PlainContact::condense(const PlainMatrix& K, Span<double> rhs) {
  Implementation& self = *implementation_;
  const bool is_condensed = K.values.data() != nullptr && K.values.data() == self.condensed_rows.values.data();
  auto problem = first_of({self.has_derivatives(),
                           unless(!is_condensed, MORTISE_WRONG_ORDER,
                                  "the matrix is the condensed one: give that of the bodies, which mortise_condense() leaves as it is"),
                           wrong_matrix(K, rows()), wrong_numbers("rhs", {rhs.data(), rhs.size()}, rows())});
  if (!problem)
    problem =
        unless(!self.contact->keeps_multipliers(), MORTISE_REFUSED, "the multipliers of a pair stay unknowns: take the blocks of mortise_jacobian()");
  self.check("mortise_condense", problem);
  self.condensed.reset();
  self.agreement.run([&] {
    const RCP<Matrix>& matrix = self.system->fill(K, *self.contact, self.differentiated->at);
    const ContactLinearisation linearised = self.linearise();
    linearised.add_stiffness(*matrix);
    Vector right = to_vector(self.rows, {rhs.data(), rhs.size()});
    self.condensed = linearised.condense(*matrix, right);
    self.condensed_rows = compressed_rows(*matrix);
    from_vector(right, rhs);
  });
  return self.condensed_rows.view();
}

void PlainContact::solve(Span<const double> right, const Solve& solver, Span<double> dd, Span<double> dz) {
  Implementation& self = *implementation_;
  self.check("mortise_solve",
             first_of({self.has_condensed(), unless(static_cast<bool>(solver), MORTISE_NULL_POINTER, "\"solver\" is null"),
                       wrong_numbers("right", right, rows()), wrong_length("dd", dd, rows()), wrong_length("dz", dz, self.multipliers())}));
  std::optional<Problem> problem;
  bool failed = false;
  self.agreement.run([&] {
    Vector change_d(self.rows), change_z(self.contact->multiplier_map());
    self.condensed->solve(to_vector(self.rows, right), self.guarded(solver, problem, failed), change_d, change_z);
    if (failed) return;
    from_vector(change_d, dd);
    from_vector(change_z, dz);
  });
  self.check("mortise_solve", problem);
}

void PlainContact::recover(Span<const double> dd, Span<double> z) {
  Implementation& self = *implementation_;
  self.check("mortise_recover", first_of({self.has_condensed(), wrong_numbers("dd", dd, rows()), wrong_length("z", z, self.multipliers())}));
  self.agreement.run([&] {
    Vector recovered(self.contact->multiplier_map());
    self.condensed->recover(to_vector(self.rows, dd), recovered);
    from_vector(recovered, z);
  });
}

mortise_augmentation PlainContact::augment() {
  Implementation& self = *implementation_;
  self.check("mortise_augment", first_of({self.in_step(), self.has_laws()}));
  mortise_augmentation result{};
  self.agreement.run([&] {
    const Augmentation update = self.contact->augment(*self.laws, ++self.round);
    result = {update.error, update.tolerance, update.more ? 1 : 0, update.exhausted ? 1 : 0};
    if (!update.history) return;
    self.step = update.history;
    self.forget_iterates();
  });
  return result;
}

void PlainContact::accept() {
  Implementation& self = *implementation_;
  self.check("mortise_accept", first_of({self.in_step(), self.has_laws()}));
  self.agreement.run([&] { self.accepted = self.contact->commit(*self.laws); });
  self.step.reset();
  self.differentiated.reset();
  self.condensed.reset();
}

std::size_t PlainContact::count_nodes(int pair) const {
  const Implementation& self = *implementation_;
  if (const auto problem = first_of({self.is_ready(), self.is_pair(pair)}))
    throw PlainError(problem->status, "mortise_count_nodes: " + problem->text);
  return self.contact->slave_ids(static_cast<std::size_t>(pair)).size();
}

void PlainContact::report(int pair, Span<mortise_node> report) {
  Implementation& self = *implementation_;
  auto problem = first_of({self.is_ready(), self.is_pair(pair), self.has_laws()});
  if (!problem) problem = wrong_length("report", report, count_nodes(pair));
  self.check("mortise_report", problem, std::to_string(pair));
  self.agreement.run([&] {
    mortise_node* next = report.begin();
    for (const ContactNodeState& one : node_states(*self.laws, static_cast<std::size_t>(pair))) {
      mortise_node& node = *next++ = {};
      node.node = one.node;
      node.state = static_cast<std::int32_t>(one.state);
      node.carries = one.carries ? 1 : 0;
      node.pressure = one.pressure;
      node.gap = one.gap;
      node.shear = one.shear;
      node.shear_bound = one.shear_bound;
      node.slip = one.slip;
      node.slip_path = one.slip_path;
      node.weight = one.weight;
      std::copy(one.traction.begin(), one.traction.end(), node.traction);
      std::copy(one.normal.begin(), one.normal.end(), node.normal);
    }
  });
}

std::vector<unsigned char> PlainContact::store() {
  Implementation& self = *implementation_;
  self.check(
      "mortise_store",
      first_of({self.is_ready(), unless(self.accepted.has_value(), MORTISE_WRONG_ORDER, "call mortise_accept() before: no state is accepted")}));
  std::vector<unsigned char> bytes;
  self.agreement.run([&] {
    TableArchive archive(*self.comm);
    self.contact->store(archive, *self.accepted);
    bytes = to_bytes(archive.tables(), self.comm->getRank(), self.comm->getSize());
  });
  return bytes;
}

void PlainContact::restore(Span<const unsigned char> bytes, const PlainState& state) {
  Implementation& self = *implementation_;
  const bool null = bytes.data() == nullptr && !bytes.empty();
  ReadTables read;
  if (!null) read = from_bytes(bytes, self.comm->getRank(), self.comm->getSize());
  self.check("mortise_restore", first_of({self.is_ready(), self.wrong_state(state), wrong_numbers("z", state.z, self.multipliers()),
                                          unless(!null, MORTISE_NULL_POINTER, "\"bytes\" is null"), read.problem}));
  self.agreement.run([&] {
    const Vector d = to_vector(self.rows, state.d), z = to_vector(self.contact->multiplier_map(), state.z);
    const MultiVector prescribed = on_nodes(self.nodes, self.dimension, state.prescribed);
    TableArchive archive(*self.comm, std::move(read.tables));
    self.accepted = self.contact->restore(archive, NodalDisplacement(d, prescribed), z);
  });
  self.step.reset();
  self.forget_iterates();
}

}  // namespace mortise
