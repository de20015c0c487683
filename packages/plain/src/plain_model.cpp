// The model of contact with plain arrays: nodes, pairs, facets.

#include <Tpetra_Map.hpp>
#include <algorithm>
#include <cmath>

#include "communicator.hpp"
#include "mortise/core/trilinos_versions.hpp"
#include "options.hpp"
#include "plain_implementation.hpp"

namespace mortise {

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

std::size_t PlainContact::rows() const { return local_id_count(*implementation_->rows); }
std::size_t PlainContact::nodes() const { return local_id_count(*implementation_->nodes); }
int PlainContact::dimension() const { return implementation_->dimension; }
const std::vector<std::int64_t>& PlainContact::multiplier_ids() const { return implementation_->multiplier_ids; }
const std::vector<std::int64_t>& PlainContact::multiplier_nodes() const { return implementation_->multiplier_nodes; }
const std::vector<double>& PlainContact::multiplier_weights() const { return implementation_->multiplier_weights; }

}  // namespace mortise
