// The calls of contact with plain arrays within steps.

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>

#include "history_bytes.hpp"
#include "mortise/contact/contact_report.hpp"
#include "plain_implementation.hpp"

namespace mortise {

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
