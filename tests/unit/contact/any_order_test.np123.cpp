// Evaluations depend on the displacement and the history alone: in any order they give the same bits.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "linearised_cases.hpp"

namespace mortise {
namespace {

using namespace test;

/// Cases of each kind of coupling, enforcement and geometry.
std::vector<int> chosen(bool current_geometry_only) {
  const std::vector<std::string> names = {"current",
                                          "coulomb, mixed",
                                          "coulomb, reference",
                                          "hardly covered, coulomb",
                                          "quadratic, plane, coulomb",
                                          "quadratic, plane, variational mortar",
                                          "corner, coulomb",
                                          "corner, coulomb, nearest facet",
                                          "standard mortar, coulomb",
                                          "node to segment, coulomb",
                                          "penalty, coulomb",
                                          "variational mortar, coulomb",
                                          "augmented lagrange, coulomb",
                                          "space, frictionless",
                                          "space, coulomb, mixed",
                                          "space, coulomb, triangles",
                                          "space, hardly covered, coulomb",
                                          "space, penalty, coulomb",
                                          "space, hardly covered, coulomb, augmented lagrange",
                                          "quadratic, space, hardly covered, coulomb"};
  const std::vector<Case> all = cases();
  std::vector<int> result;
  for (const std::string& name : names) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const Case& one) { return one.name == name; });
    if (found == all.end()) throw std::logic_error(name);
    if (current_geometry_only && found->surfaces.options.geometry == ContactGeometry::reference) continue;
    result.push_back(static_cast<int>(found - all.begin()));
  }
  return result;
}

/// The slave moved along the master by `shift` facets, all nodes by a little.
RCP<Vector> moved(const Fixture& fixture, const TwoSurfaces& surfaces, double shift, int seed) {
  const GlobalOrdinal dimension = surfaces.dimension, slave_dofs = dimension * static_cast<GlobalOrdinal>(surfaces.slave.size());
  return Fixture::vector(fixture.dofs, [&](GlobalOrdinal id) {
    const double along = id >= slave_dofs ? 0.0 : id % dimension == 0 ? shift : dimension == 3 && id % dimension == 1 ? 0.3 * shift : 0.0;
    return along + 0.01 * wiggle(id + 100 * seed);
  });
}

/// Numbers of this rank, by what they are. Those of matrices are of all ranks, by global ids; entries that are left out of a pattern are 0.
using Numbers = std::map<std::string, std::vector<double>>;

std::vector<double> numbers_of(const Vector& vector) {
  const auto view = vector.getLocalViewHost(Tpetra::Access::ReadOnly);
  std::vector<double> result;
  for (std::size_t k = 0; k < view.extent(0); ++k) result.push_back(view(k, 0));
  return result;
}

std::vector<double> numbers_of(const Matrix& matrix, const std::vector<GlobalOrdinal>& rows, const std::vector<GlobalOrdinal>& columns) {
  const Eigen::MatrixXd dense = Fixture::dense(matrix, rows, columns);
  return {dense.data(), dense.data() + dense.size()};
}

std::vector<double> numbers_of(const ContactLaws& laws, std::size_t pairs) {
  std::vector<double> result;
  const auto add = [&](const std::array<double, 3>& vector) { result.insert(result.end(), vector.begin(), vector.end()); };
  for (std::size_t pair = 0; pair < pairs; ++pair)
    for (const ContactNodeState& node : node_states(laws, pair)) {
      add(node.traction);
      add(node.normal);
      add(node.force);
      for (const double value : {static_cast<double>(node.node), static_cast<double>(node.state), node.pressure, node.gap, node.weight, node.covered,
                                 node.shear, node.shear_bound, node.slip, node.slip_path})
        result.push_back(value);
    }
  return result;
}

/// Results of an evaluation at the multipliers of the cases.
Numbers numbers_of(const Fixture& fixture, const DifferentiatedContact& at, const ContactHistory& history) {
  const ContactSystem& contact = *fixture.contact;
  const ContactLaws laws = at.laws(*fixture.multipliers(pressure));
  const ContactNorms norms = laws.norms(history->states);
  Vector C(contact.multiplier_map()), force(fixture.dofs);
  laws.complementarity(C);
  laws.add_force(force);
  const std::vector<GlobalOrdinal> dofs = Fixture::all_ids(*fixture.dofs), multipliers = Fixture::all_ids(*contact.multiplier_map());
  const ContactLinearisation linearised = at.linearise(laws);
  const SaddlePointBlocks blocks = linearised.saddle_point_blocks();
  const RCP<Matrix> system = fixture.springs(contact.graph(at, [&] { return fixture.bulk; }));
  linearised.add_stiffness(*system);
  Numbers result = {{"C", numbers_of(C)},
                    {"f_c", numbers_of(force)},
                    {"norms",
                     {norms.gap, norms.complementarity, norms.force, norms.violation, static_cast<double>(norms.active),
                      static_cast<double>(norms.sticking), static_cast<double>(norms.changed)}},
                    {"states of nodes", numbers_of(laws, contact.pairs())},
                    {"B", numbers_of(*blocks.B, dofs, multipliers)},
                    {"C_d", numbers_of(*blocks.C_d, multipliers, dofs)},
                    {"C_z", numbers_of(*blocks.C_z, multipliers, multipliers)},
                    {"K and C~", numbers_of(*system, dofs, dofs)}};
  if (contact.keeps_multipliers()) return result;
  const RCP<Vector> rhs = Fixture::vector(fixture.dofs, [](GlobalOrdinal id) { return 5.0 * wiggle(7 * id + 3); });
  linearised.condense(*system, *rhs);
  result["condensed matrix"] = numbers_of(*system, dofs, dofs);
  result["condensed right-hand side"] = numbers_of(*rhs);
  return result;
}

// Zeros may be of either sign: entries of other candidates are sums of them. A NaN equals nothing.
void expect_same_bits(const Numbers& found, const Numbers& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (const auto& [what, values] : expected) {
    const std::vector<double>& others = found.at(what);
    ASSERT_EQ(others.size(), values.size()) << what;
    const auto [other, value] = std::mismatch(others.begin(), others.end(), values.begin());
    if (other == others.end()) continue;
    ADD_FAILURE() << what << ": entry " << other - others.begin() << " is off by " << *other - *value << " from " << *value;
  }
}

/// Accepted states, each a step after the one before, and the guesses that the start rule made on the way.
struct Chain {
  std::vector<ContactHistory> histories;
  Numbers guesses;
};

constexpr std::array<double, 4> ends = {0.0, 0.4, -0.3, 0.4};  // shift where each of the states was accepted

/// @param meanwhile  called with the history between any two evaluations
template <class Meanwhile>
Chain chain(const Fixture& fixture, const TwoSurfaces& surfaces, const Meanwhile& meanwhile) {
  const ContactSystem& contact = *fixture.contact;
  const RCP<Vector> z = fixture.multipliers(pressure);
  RCP<Vector> d = moved(fixture, surfaces, ends[0], 0);
  Chain result{{contact.initial_history(*d)}, {}};
  for (int step = 1; step < static_cast<int>(ends.size()); ++step) {
    Vector guess(*z, Teuchos::Copy);
    meanwhile(result.histories.back());
    ContactHistory history = contact.start_step(result.histories.back(), *d, guess);
    result.guesses["step " + std::to_string(step)] = numbers_of(guess);
    d = moved(fixture, surfaces, ends[static_cast<std::size_t>(step)], step);
    meanwhile(history);
    history = updated(contact, contact.evaluate(*d, history).laws(*z), history);
    meanwhile(history);
    result.histories.push_back(contact.commit(contact.evaluate(*d, history).laws(*z)));
  }
  return result;
}

Chain chain(const Fixture& fixture, const TwoSurfaces& surfaces) {
  return chain(fixture, surfaces, [](const ContactHistory&) {});
}

/// A displacement and a history to evaluate with. Those far off have other candidates than the rest.
struct Query {
  double shift;
  int seed;
  std::size_t history;
};

const std::vector<Query> queries = {{0.0, 0, 0}, {0.4, 1, 1}, {0.4, 1, 3}, {-0.3, 2, 2}, {2.3, 4, 2}, {-2.0, 5, 1}, {0.15, 3, 3}};

class AnyOrder : public ::testing::TestWithParam<int> {
 protected:
  /// Two models of the same surfaces.
  AnyOrder() : surfaces_(cases()[GetParam()].surfaces), one_(surfaces_, Tpetra::getDefaultComm()), other_(surfaces_, Tpetra::getDefaultComm()) {}

  RCP<Vector> displacement(const Fixture& fixture, const Query& query) const { return moved(fixture, surfaces_, query.shift, query.seed); }
  DifferentiatedContact evaluate(const Fixture& fixture, const Chain& chain, const Query& query) const {
    return fixture.contact->differentiate(*displacement(fixture, query), chain.histories[query.history]);
  }
  Numbers numbers(const Fixture& fixture, const Chain& chain, const Query& query) const {
    return numbers_of(fixture, evaluate(fixture, chain, query), chain.histories[query.history]);
  }
  std::vector<Numbers> all_numbers(const Fixture& fixture, const Chain& chain) const {
    std::vector<Numbers> result;
    for (const Query& query : queries) result.push_back(numbers(fixture, chain, query));
    return result;
  }

  TwoSurfaces surfaces_;
  Fixture one_, other_;
};

TEST_P(AnyOrder, GivesTheSameBits) {
  const Chain in_order = chain(one_, surfaces_);
  const std::vector<Numbers> expected = all_numbers(one_, in_order);
  for (std::size_t k = 1; k < queries.size(); ++k)
    if (queries[k].seed != queries[k - 1].seed) EXPECT_NE(expected[k].at("norms"), expected[k - 1].at("norms")) << "nothing to tell apart";

  // The other model has looked elsewhere before each step, and within it.
  const Chain with_detours = chain(other_, surfaces_, [&](const ContactHistory& history) {
    for (const double shift : {2.3, -2.0}) other_.contact->evaluate(*moved(other_, surfaces_, shift, 5), history);
  });
  expect_same_bits(with_detours.guesses, in_order.guesses);

  for (const unsigned seed : {1u, 2u, 3u}) {
    SCOPED_TRACE(seed);
    std::vector<std::size_t> order(2 * queries.size());  // each one twice
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::shuffle(order.begin(), order.end(), std::mt19937(seed));
    const std::size_t first = order.front() % queries.size();
    const DifferentiatedContact kept = evaluate(other_, with_detours, queries[first]);
    for (const std::size_t place : order) {
      const std::size_t k = place % queries.size();
      SCOPED_TRACE(k);
      expect_same_bits(numbers(other_, with_detours, queries[k]), expected[k]);
      // In between, without derivatives and with another history.
      const Query& between = queries[(k + seed) % queries.size()];
      other_.contact->evaluate(*displacement(other_, between), with_detours.histories[(between.history + 1) % with_detours.histories.size()]);
    }
    SCOPED_TRACE("kept from before the others");
    expect_same_bits(numbers_of(other_, kept, with_detours.histories[queries[first].history]), expected[first]);
  }
}

// Else the order of searches would not matter. The geometry of the reference configuration has one graph.
TEST_P(AnyOrder, ChangesCandidates) {
  const Chain in_order = chain(one_, surfaces_);
  std::vector<RCP<const Graph>> graphs;
  for (const Query& query : queries)
    graphs.push_back(one_.contact->graph(evaluate(one_, in_order, query), [&] { return RCP<const Graph>(one_.bulk); }));
  const bool changed = std::any_of(graphs.begin(), graphs.end(), [&](const RCP<const Graph>& graph) { return graph != graphs.front(); });
  EXPECT_EQ(changed, surfaces_.options.geometry == ContactGeometry::current);
}

/// The same data in other objects.
ContactHistory rebuilt(const ContactHistory& history) {
  AcceptedContact data = *history;
  for (PairHistory& pair : data.pairs)
    if (pair.slip != nullptr) pair.slip = std::make_shared<const SlipReferences>(*pair.slip);
  data.positions = rcp(new MultiVector(*data.positions, Teuchos::Copy));
  data.multipliers = rcp(new Vector(*data.multipliers, Teuchos::Copy));
  return ContactHistory(std::move(data));
}

// In the model that made them, and in another one of the same surfaces, as after a restart.
TEST_P(AnyOrder, HistoriesAreTheirData) {
  const Chain original = chain(one_, surfaces_);
  Chain of_data, of_copies;
  for (const ContactHistory& history : original.histories) {
    const AcceptedContact data = *history;
    of_data.histories.push_back(ContactHistory(data));
    of_copies.histories.push_back(rebuilt(history));
  }
  const std::vector<Numbers> expected = all_numbers(one_, original);
  for (const Fixture* fixture : {&one_, &other_})
    for (const Chain* again : {&of_data, &of_copies})
      for (std::size_t k = 0; k < queries.size(); ++k) {
        SCOPED_TRACE(k);
        expect_same_bits(numbers(*fixture, *again, queries[k]), expected[k]);
      }

  // The step that follows.
  const auto next = [&](const Fixture& fixture, const ContactHistory& accepted) {
    const RCP<Vector> d = moved(fixture, surfaces_, ends.back(), 3), guess = fixture.multipliers(pressure);
    const ContactHistory history = fixture.contact->start_step(accepted, *d, *guess);
    Numbers result = numbers_of(fixture, fixture.contact->differentiate(*moved(fixture, surfaces_, 0.15, 6), history), history);
    result["guess"] = numbers_of(*guess);
    return result;
  };
  const Numbers of_original = next(one_, original.histories.back());
  expect_same_bits(next(one_, of_data.histories.back()), of_original);
  expect_same_bits(next(other_, of_copies.histories.back()), of_original);
}

INSTANTIATE_TEST_SUITE_P(Cases, AnyOrder, ::testing::ValuesIn(chosen(false)), test_name);

/// The geometry of the reference configuration does not look at displacements: nothing fails there.
class AfterAFailure : public AnyOrder {};

TEST_P(AfterAFailure, GivesTheSameBits) {
  const Chain in_order = chain(one_, surfaces_), again = chain(other_, surfaces_);
  const std::vector<Numbers> expected = all_numbers(one_, in_order);
  const auto not_a_number = Fixture::vector(other_.dofs, [](GlobalOrdinal) { return std::numeric_limits<double>::quiet_NaN(); });
  const auto infinite_at_one_node = Fixture::vector(
      other_.dofs, [&](GlobalOrdinal id) { return id / surfaces_.dimension == 1 ? std::numeric_limits<double>::infinity() : 0.01 * wiggle(id); });
  const auto without_extent = Fixture::vector(other_.dofs, [&](GlobalOrdinal id) {  // the slave has shrunk to a point
    const auto node = static_cast<std::size_t>(id / surfaces_.dimension);
    return node < surfaces_.slave.size() ? -surfaces_.slave[node][static_cast<std::size_t>(id % surfaces_.dimension)] : 0.0;
  });
  const std::vector<std::pair<std::string, RCP<Vector>>> failing = {
      {"not a number", not_a_number}, {"infinite at one node", infinite_at_one_node}, {"without extent", without_extent}};
  for (const auto& one : failing) {
    SCOPED_TRACE(one.first);
    for (std::size_t k = 0; k < queries.size(); ++k) {
      SCOPED_TRACE(k);
      const ContactHistory& history = again.histories[(k + 1) % again.histories.size()];
      if (k % 2 == 0)
        EXPECT_THROW(other_.contact->evaluate(*one.second, history), StepFailure);
      else
        EXPECT_THROW(other_.contact->differentiate(*one.second, history), StepFailure);
      expect_same_bits(numbers(other_, again, queries[k]), expected[k]);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, AfterAFailure, ::testing::ValuesIn(chosen(true)), test_name);

}  // namespace
}  // namespace mortise
