#include "plain_implementation.hpp"

#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>

#include "mortise/core/over_ranks.hpp"
#include "mortise/core/trilinos_versions.hpp"
#include "options.hpp"

namespace mortise {
namespace {

/// A map of the ids of this rank, which no other rank may have.
RCP<const Map> map_of(const char* name, Span<const std::int64_t> ids, const RCP<const Communicator>& comm) {
  const std::vector<GlobalOrdinal> all(ids.begin(), ids.end());
  const auto count = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  const auto map = rcp(new const Map(count, all.data(), static_cast<LocalOrdinal>(all.size()), 0, comm));
  if (!map->isOneToOne())
    throw PlainError(MORTISE_REFUSED, fmt::format("mortise_create: \"{}\" holds an id that another rank has too; each belongs to one rank", name));
  return map;
}

}  // namespace

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

PlainContact::Implementation::Implementation(RCP<const Communicator> comm, const PlainModel& model, const std::string& options)
    : comm(std::move(comm)) {
  agreement.check("mortise_create", wrong_model(model), fmt::format("{} {}", model.dimension, options));
  agreement.run([&] { take(model, options); });
}

void PlainContact::Implementation::take(const PlainModel& model, const std::string& options) {
  read_options(measure, options, "options");
  dimension = model.dimension;
  nodes = map_of("node_ids", model.node_ids, comm);
  rows = map_of("row_ids", model.row_ids, comm);
  field.emplace("displacement", nodes, dimension, std::vector<GlobalOrdinal>(model.node_rows.begin(), model.node_rows.end()));
  reference = rcp(new MultiVector(on_nodes(nodes, dimension, model.positions)));
  std::vector<double> marks(model.node_rows.size());
  for (std::size_t k = 0; k < marks.size(); ++k) marks[k] = model.node_rows[k] == NodalField::none ? 1.0 : model.marks.empty() ? 0.0 : model.marks[k];
  fixed = rcp(new MultiVector(on_nodes(nodes, dimension, marks)));
  system.emplace(rows);
}

void PlainContact::Implementation::set_up() {
  for (std::size_t p = 0; p < pairs.size(); ++p)
    if (pairs[p].options.formulation.options->two_pass() && !pairs[p].second_pass_of &&
        std::none_of(pairs.begin(), pairs.end(), [&](const ContactPair& one) { return one.second_pass_of == p; }))
      throw PlainError(MORTISE_REFUSED, fmt::format("mortise_ready: the formulation of \"{}\" has two passes; add the second one by "
                                                    "mortise_add_second_pass()",
                                                    pairs[p].name));
  contact.emplace(*field, rows, reference, fixed, measure.measure, pairs, Timers());
  const GlobalOrdinal first = rows->getMaxAllGlobalIndex() + 1;
  for (const GlobalOrdinal id : local_ids(*contact->multiplier_map())) {
    multiplier_ids.push_back(id);
    multiplier_nodes.push_back((id - first) / dimension);
  }
  multiplier_weights.resize(multipliers());
  from_vector(*contact->weights(), multiplier_weights);
}

void PlainContact::Implementation::forget_iterates() {
  laws.reset();
  differentiated.reset();
  condensed.reset();
}

mortise_norms PlainContact::Implementation::evaluate(const PlainState& state, Span<double> f, Span<double> C, bool derivatives) {
  check(derivatives ? "mortise_differentiate" : "mortise_evaluate",
        first_of({in_step(), wrong_state(state), wrong_numbers("z", state.z, multipliers()), wrong_optional("f", f, local_id_count(*rows)),
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

ContactLinearisation PlainContact::Implementation::linearise() {
  last = differentiated->laws.states();
  return differentiated->at.linearise(differentiated->laws);
}

NodeElimination::Solve PlainContact::Implementation::guarded(const Solve& solver, std::optional<Problem>& problem, bool& failed) const {
  return [&solver, &problem, &failed, this](const Vector& right, Vector& dd) {
    std::vector<double> solution(local_id_count(*rows), 0.0);
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

}  // namespace mortise
