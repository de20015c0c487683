// Newton's method of a host with displacements and temperatures, as docs/thermal_contact.md shows it.
#include <gtest/gtest.h>

#include <cmath>

#include "mortise/core/over_ranks.hpp"
#include "two_bodies.hpp"

namespace mortise {
namespace {

using namespace test;

constexpr double E = 1000.0, round_off = 1e-12;

TwoBodies blocks(int dimension, double overhang) {
  GridBody lower, upper;
  lower.cells = {4, dimension == 3 ? 2 : 3, 2};
  upper.cells = {3, dimension == 3 ? 2 : 2, 2};
  lower.place = [dimension](const Point& u) {
    Point x = u;
    x[dimension - 1] -= 1.0;
    return x;
  };
  upper.place = [overhang](const Point& u) {
    Point x = u;
    x[0] += overhang;
    return x;
  };
  lower.modulus = upper.modulus = E;
  lower.conductivity = 2.0;
  upper.conductivity = 0.5;
  lower.capacity = 0.02;
  upper.capacity = 0.05;
  lower.expansion = 2e-4;
  upper.expansion = 1e-3;
  const auto coulomb = std::make_shared<CoulombFriction>();
  coulomb->coefficient = ScalarFunction(0.3);
  ContactOptions options;
  options.friction = {"coulomb", coulomb, {}};
  const int up = dimension - 1;
  return TwoBodies(dimension, {lower, upper}, 1, options, E, [up](int body, const Point& unit) { return unit[up] == (body == 0 ? 0.0 : 1.0); });
}

ThermalPair with_friction() {
  const auto conductance = std::make_shared<PowerConductance>();
  conductance->factor = 40.0;
  conductance->hardness = 10.0;
  conductance->without_pressure = 0.2;
  const auto medium = std::make_shared<MediumConductance>();
  medium->conductivity = 2e-3;
  medium->distance = 1e-2;
  return {0, conductance, medium, share_of_slave(std::sqrt(0.5 * 0.05), std::sqrt(2.0 * 0.02))};
}

/// The upper block is pressed on the lower one, then drawn along it, in equal steps of time. Far faces keep their temperatures.
/// @param insulated  they keep none, and nothing is conducted from block to block: each stores its share of the heat of friction
void expect_quadratic_convergence(int dimension, bool insulated) {
  const TwoBodies bodies = blocks(dimension, 0.28);  // a part of the slave is not covered
  const ContactSystem& contact = *bodies.contact;
  const RCP<const Map>& dofs = bodies.table->dofs;
  ThermalPair pair = with_friction();
  if (insulated) pair.conductance.reset(), pair.gap.reset();
  const ThermalContact thermal(contact, bodies.table->fields[1], dofs, {pair});
  constexpr double time_step = 0.002, warm = 0.1, down = 0.005, right = 0.01;
  const std::vector<GlobalOrdinal> ids = bodies.all_ids();
  Matrix K(bodies.graph());
  bodies.assemble(time_step, K);
  K.fillComplete(dofs, dofs);

  const auto is_prescribed = [&](GlobalOrdinal id) {
    const GlobalOrdinal first = bodies.temperature(0), node = id < first ? id / dimension : id - first;
    return bodies.is_far(node) && !(insulated && id >= first);
  };
  // What temperatures store, over the step of time: the matrix with capacity less that without.
  const auto storage = [&](const Vector& of) {
    Vector temperatures(of, Teuchos::Copy), result(dofs), product(dofs);
    for (const GlobalOrdinal id : local_ids(*dofs))
      if (id < bodies.temperature(0)) temperatures.replaceGlobalValue(id, 0.0);
    K.apply(temperatures, result);
    Matrix without(bodies.graph());
    bodies.assemble(1e300, without);
    without.fillComplete(dofs, dofs);
    without.apply(temperatures, product);
    result.update(-1.0, product, 1.0);
    return result;
  };
  Vector x(dofs), z(contact.multiplier_map()), dx(dofs), dz(contact.multiplier_map()), target(dofs);
  ContactHistory accepted = contact.initial_history(x);
  double friction = 0.0, hottest = 0.0;
  int slipping = 0, sticking = 0;
  for (int step = 1; step <= 4; ++step) {
    SCOPED_TRACE(testing::Message() << dimension << "D, step " << step);
    for (const GlobalOrdinal node : local_ids(*bodies.nodes)) {
      if (!bodies.is_far(node) || bodies.body_of[node] == 0) continue;
      target.replaceGlobalValue(bodies.displacement(node, 0), right * std::max(0, step - 2));
      target.replaceGlobalValue(bodies.displacement(node, dimension - 1), -down * std::min(step, 2));
      target.replaceGlobalValue(bodies.temperature(node), warm);
    }
    const Vector stored = storage(x);  // when the step began
    const ContactHistory history = contact.start_step(accepted, x, z);
    ContactStates last = history->states;
    std::vector<double> residuals;
    for (int iteration = 0;; ++iteration) {
      ASSERT_LT(iteration, 20);
      const DifferentiatedContact at = contact.differentiate(x, history, &last);
      const ContactLaws laws = at.laws(z);
      const ContactLinearisation linearised = at.linearise(laws);
      const DifferentiatedHeat heat = thermal.differentiate(linearised, x, time_step);
      Vector r(dofs), total(dofs), rhs(dofs);
      K.apply(x, r);
      r.update(-1.0, stored, 1.0);
      Tpetra::deep_copy(total, r);
      laws.add_force(total);
      heat.add_to(total);
      rhs.update(-1.0, r, 0.0);  // without the forces and the heat of contact
      const ContactNorms norms = laws.norms(last);
      double of_momentum = 0.0, of_heat = 0.0, off = 0.0;
      for (const GlobalOrdinal id : local_ids(*dofs)) {
        const LocalOrdinal row = dofs->getLocalElement(id);
        if (is_prescribed(id))
          off += std::abs(target.getData()[row] - x.getData()[row]);
        else
          (id < bodies.temperature(0) ? of_momentum : of_heat) += std::pow(total.getData()[row], 2);
      }
      const std::vector<double> sums = sum_over_ranks(*bodies.comm, std::vector<double>{of_momentum, of_heat, off});
      if (norms.changed > 0) residuals.clear();
      residuals.push_back(std::sqrt(sums[0]) / E + std::sqrt(sums[1]) + sums[2] + norms.gap + norms.complementarity);
      if (norms.changed == 0 && residuals.back() < round_off && iteration > 0) {
        accepted = contact.commit(laws);
        const HeatFlow flow = heat.flow(0);
        friction += flow.friction * time_step;
        for (const NodeHeat& node : heat.nodes(0)) EXPECT_GE(node.friction, 0.0);
        for (const ContactNodeState& node : node_states(laws, 0)) {
          slipping += node.state == ContactState::slip;
          sticking += node.state == ContactState::stick;
        }
        break;
      }
      last = laws.states();
      Matrix A(contact.graph(at, [&] { return bodies.graph(); }));
      bodies.assemble(time_step, A);
      linearised.add_stiffness(A);
      const NodeElimination condensed = linearised.condense(A, rhs);
      heat.condense(condensed, A, rhs);
      A.fillComplete(dofs, dofs);
      Eigen::MatrixXd system = Fixture::dense(A, ids, ids);
      for (std::size_t n = 0; n < ids.size(); ++n)
        if (is_prescribed(ids[n])) {
          const auto row = static_cast<Eigen::Index>(n);
          system.row(row).setZero();
          system(row, row) = E;
        }
      for (const GlobalOrdinal id : local_ids(*dofs))
        if (const LocalOrdinal row = dofs->getLocalElement(id); is_prescribed(id))
          rhs.replaceLocalValue(row, E * (target.getData()[row] - x.getData()[row]));
      const Eigen::PartialPivLU<Eigen::MatrixXd> factors(system);
      const auto solve = [&](const Vector& right_hand_side, Vector& solution) {
        const Eigen::VectorXd all = factors.solve(Fixture::dense(right_hand_side, ids));
        Tpetra::deep_copy(solution, *Fixture::vector(dofs, [&](GlobalOrdinal id) { return all[id]; }));
      };
      condensed.solve(rhs, solve, dx, dz, heat.of_multipliers().get());
      x.update(1.0, dx, 1.0);
      z.update(1.0, dz, 1.0);
    }
    // Near the solution: residuals of different fields are summed as they are.
    constexpr double near = 0.05;
    ASSERT_GE(residuals.size(), 2u);
    EXPECT_LT(residuals[residuals.size() - 2], near);
    for (std::size_t k = 1; k < residuals.size(); ++k)
      if (residuals[k - 1] < near) EXPECT_LE(residuals[k], 10.0 * residuals[k - 1] * residuals[k - 1] + round_off) << "iterate " << k;
    for (const GlobalOrdinal node : local_ids(*bodies.nodes))
      hottest = std::max(hottest, x.getData()[dofs->getLocalElement(bodies.temperature(node))]);
  }
  EXPECT_GT(friction, 0.0);
  if (insulated) {
    std::vector<double> of_block(2, 0.0);
    const Vector stored = storage(x);
    for (const GlobalOrdinal node : local_ids(*bodies.nodes))
      of_block[bodies.body_of[node]] += time_step * stored.getData()[dofs->getLocalElement(bodies.temperature(node))];
    const std::vector<double> all = sum_over_ranks(*bodies.comm, of_block);
    EXPECT_NEAR(all[1], *pair.slave_share * friction, 1e-9 * friction);
    EXPECT_NEAR(all[0], (1.0 - *pair.slave_share) * friction, 1e-9 * friction);
  } else {
    EXPECT_GT(most_over_ranks(*bodies.comm, hottest), warm);  // warmer than any face that is held: by friction
  }
  EXPECT_GT(sum_over_ranks(*bodies.comm, slipping), 0);
  EXPECT_GT(sum_over_ranks(*bodies.comm, sticking), 0);
}

TEST(HostWithTemperatures, ConvergesQuadraticallyInThePlane) { expect_quadratic_convergence(2, false); }
TEST(HostWithTemperatures, ConvergesQuadraticallyInSpace) { expect_quadratic_convergence(3, false); }
TEST(HostWithTemperatures, KeepsTheHeatOfFrictionWhereInsulated) { expect_quadratic_convergence(2, true); }

}  // namespace
}  // namespace mortise
