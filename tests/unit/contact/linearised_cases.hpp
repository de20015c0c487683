#pragma once
// Cases that the linearised contact is tested on: formulations, friction, fixed nodes, cover, in 2D and 3D.

#include <gtest/gtest.h>

#include <cmath>

#include "formulations.hpp"
#include "mortise/mortar/coupling/node_to_segment.hpp"
#include "pairs/pair_history.hpp"
#include "two_surfaces.hpp"

namespace mortise::test {

inline double wiggle(GlobalOrdinal id) { return std::sin(12.9898 * static_cast<double>(id) + 0.7); }

struct Case {
  std::string name;
  TwoSurfaces surfaces;
};

/// `history` as if no master facet had covered any slave node: slips and gaps at the start are then those of the motion itself.
inline ContactHistory without_couplings(const ContactHistory& history) {
  AcceptedContact accepted = *history;
  for (PairHistory& pair : accepted.pairs) {
    if (pair.slip == nullptr) continue;
    auto slip = std::make_shared<SlipReferences>(*pair.slip);
    for (std::size_t s = 0; s < slip->nodes.size(); ++s) {
      slip->nodes[s].clear();
      slip->coefficients[s].clear();
      slip->gaps[s] = 0.0;
    }
    pair.slip = slip;
  }
  return ContactHistory(std::move(accepted));
}

// Quadratic facets: mid-side nodes whose multipliers act on corners, of the same and of other ranks, with and without a multiplier of their own.
inline void add_quadratic(std::vector<Case>& all) {
  const auto add = [&](const std::string& name, const TwoSurfaces& linear, bool master, std::optional<double> coefficient) {
    all.push_back({"quadratic, " + name, quadratic(linear, true, master)});
    if (coefficient) {
      auto coulomb = std::make_shared<CoulombFriction>();
      coulomb->coefficient = ScalarFunction(*coefficient);
      all.back().surfaces.options.friction.options = coulomb;
    }
    return &all.back().surfaces;
  };
  const TwoSurfaces arch = arch_on_ground(), dome = dome_on_waves(), faceted = dome_on_waves(true);
  const std::array<bool, 3> in_x = {true, false, false}, all_of_plane = {true, true, false}, everything = {true, true, true};
  add("plane", arch, true, {});
  add("plane, linear master", arch, false, {});
  add("plane, standard weighting", arch, true, {})->options.mortar.gap_weighting = GapWeighting::standard;
  add("plane, partly fixed", arch, true, {})->fixed[0] = in_x;
  add("plane, corner fixed", arch, true, {})->fixed[2] = all_of_plane;
  add("plane, reference", arch, true, {})->options.geometry = ContactGeometry::reference;
  add("plane, axisymmetric", arch, true, 0.12)->measure = {true, 1.0};
  add("plane, coulomb, mostly stick", arch, true, 2.0);
  add("plane, coulomb", arch, true, 0.12);
  add("plane, coulomb, partly fixed", arch, true, 0.12)->fixed[0] = in_x;
  add("plane, coulomb, corner fixed", arch, true, 0.12)->fixed[2] = all_of_plane;
  add("space", dome, true, {});
  add("space, triangles", faceted, false, {});
  add("space, coulomb", dome, false, 0.12);
  add("space, coulomb, high, triangles", faceted, true, 3.0);
  add("space, symmetry plane", dome, false, 0.12)->fixed[1] = in_x;
  add("space, corner fixed", dome, false, 0.12)->fixed[5] = everything;
  add("space, middle fixed", dome, false, 0.12)->fixed[20] = everything;
  add("space, triangles, middle fixed", faceted, false, {})->fixed[20] = everything;
  add("space, hardly covered", hardly_covered(dome), true, {});
  add("space, hardly covered, coulomb", hardly_covered(dome), false, 0.12);
  add("space, hardly covered, triangles", hardly_covered(faceted), false, 0.12);
  add("space, hardly covered, corner", hardly_covered_at_a_corner(dome), true, {});
  add("space, hardly covered, corner, coulomb", hardly_covered_at_a_corner(dome), false, 0.12);
  add("space, hardly covered, corner, triangles", hardly_covered_at_a_corner(faceted), false, 0.12);
  for (const NamedFormulation& formulation : other_formulations()) {
    if (!formulation.options->coupling()->takes_quadratic_facets()) continue;
    add("plane, " + formulation.name, arch, true, 0.12)->options.formulation.options = formulation.options;
    if (in_space(formulation)) add("space, " + formulation.name, dome, false, 0.12)->options.formulation.options = formulation.options;
  }
}

// Corners that take the master's normal: their rows depend on both of their facets.
inline void add_corners(std::vector<Case>& all) {
  const auto add = [&](const std::string& name, double coefficient, bool quadratic = false) {
    const TwoSurfaces corner = corner_on_ground();
    all.push_back({"corner, " + name, quadratic ? test::quadratic(corner, true, true) : corner});
    auto coulomb = std::make_shared<CoulombFriction>();
    coulomb->coefficient = ScalarFunction(coefficient);
    if (coefficient > 0.0) all.back().surfaces.options.friction.options = coulomb;
    return &all.back().surfaces;
  };
  add("frictionless", 0.0);
  add("coulomb", 0.12);
  add("coulomb, high", 2.0);
  add("coulomb, axisymmetric", 0.12)->measure = {true, 1.0};
  add("coulomb, standard weighting", 0.12)->options.mortar.gap_weighting = GapWeighting::standard;
  add("coulomb, nearest facet", 0.12)->options.mortar.corners = CornerRule::nearest_facet;
  add("coulomb, quadratic", 0.12, true);
  for (const NamedFormulation& formulation : other_formulations()) {
    add(formulation.name, 0.0)->options.formulation.options = formulation.options;
    add(formulation.name + ", coulomb", 0.12)->options.formulation.options = formulation.options;
  }
}

inline std::vector<Case> cases() {
  std::vector<Case> all;
  all.push_back({"current", arch_on_ground()});
  all.push_back({"standard weighting", arch_on_ground()});
  all.back().surfaces.options.mortar.gap_weighting = GapWeighting::standard;
  all.push_back({"partly fixed", arch_on_ground()});
  all.back().surfaces.fixed[0] = {true, false, false};
  all.push_back({"crosspoint", arch_on_ground()});
  all.back().surfaces.fixed[2] = {true, true, false};
  all.push_back({"axisymmetric", arch_on_ground()});
  all.back().surfaces.measure = {true, 1.0};
  all.push_back({"reference", arch_on_ground()});
  all.back().surfaces.options.geometry = ContactGeometry::reference;
  const auto add_friction = [&](const std::string& name, double coefficient, const std::shared_ptr<FrictionLaw>& given = {}) {
    all.push_back({name, arch_on_ground()});
    auto coulomb = std::make_shared<CoulombFriction>();
    coulomb->coefficient = ScalarFunction(coefficient);
    all.back().surfaces.options.friction.options = given ? given : coulomb;
    return &all.back().surfaces;
  };
  add_friction("coulomb, mostly stick", 2.0);
  add_friction("coulomb, mixed", 0.12);
  add_friction("coulomb, mostly slip", 0.02);
  add_friction("coulomb, partly fixed", 0.12)->fixed[0] = {true, false, false};
  add_friction("coulomb, crosspoint", 0.12)->fixed[2] = {true, true, false};
  add_friction("coulomb, axisymmetric", 0.12)->measure = {true, 1.0};
  add_friction("coulomb, reference", 0.12)->options.geometry = ContactGeometry::reference;
  add_friction("coulomb, standard weighting", 0.12)->options.mortar.gap_weighting = GapWeighting::standard;
  auto tresca = std::make_shared<TrescaFriction>();
  tresca->traction = 0.8;
  add_friction("tresca", 0.0, tresca);
  auto of_pressure = std::make_shared<CoulombFriction>();
  of_pressure->coefficient =
      ScalarFunction([](const std::vector<double>& of) { return 0.05 + 0.2 * std::exp(-of[0] / 5.0); }, "0.05 + 0.2*exp(-pressure/5)");
  of_pressure->largest_traction = 0.9;
  add_friction("coulomb of pressure, bounded", 0.0, of_pressure);
  // The master ends a little behind slave node 4: node 5 is tied to it, and 4 to 3 and 5.
  const auto end_behind = [](TwoSurfaces& surfaces, double end) {
    for (Point& x : surfaces.master) x[0] *= end / 4.6;
  };
  all.push_back({"hardly covered", arch_on_ground()});
  end_behind(all.back().surfaces, 4.2);
  for (const double coefficient : {0.12, 3.0})
    end_behind(*add_friction(coefficient < 1.0 ? "hardly covered, coulomb" : "hardly covered, coulomb, high", coefficient), 4.15);
  end_behind(*add_friction("hardly covered, half, coulomb", 0.12), 4.6);
  auto* turned = add_friction("hardly covered, axisymmetric", 0.12);
  end_behind(*turned, 4.2);
  turned->measure = {true, 1.0};
  end_behind(*add_friction("hardly covered, standard weighting", 0.12), 4.2);
  all.back().surfaces.options.mortar.gap_weighting = GapWeighting::standard;
  end_behind(*add_friction("hardly covered, reference", 0.12), 4.2);
  all.back().surfaces.options.geometry = ContactGeometry::reference;
  // 3D.
  const auto add_in_space = [&](const std::string& name, std::optional<double> coefficient, bool triangles = false) {
    if (coefficient)
      add_friction("space, " + name, *coefficient);
    else
      all.push_back({"space, " + name, {}});
    TwoSurfaces surfaces = dome_on_waves(triangles);
    if (name.find("hardly covered") != std::string::npos) surfaces = hardly_covered(surfaces);
    surfaces.options = all.back().surfaces.options;
    all.back().surfaces = surfaces;
    return &all.back().surfaces;
  };
  add_in_space("frictionless", {});
  add_in_space("triangles", {}, true);
  add_in_space("standard weighting", {})->options.mortar.gap_weighting = GapWeighting::standard;
  add_in_space("symmetry plane", {})->fixed[1] = {true, false, false};
  add_in_space("symmetry edge", {})->fixed[0] = {true, true, false};
  add_in_space("crosspoint", {})->fixed[5] = {true, true, true};
  add_in_space("reference", {})->options.geometry = ContactGeometry::reference;
  add_in_space("coulomb, mostly stick", 3.0);
  add_in_space("coulomb, mixed", 0.12);
  add_in_space("coulomb, mostly slip", 0.02);
  add_in_space("coulomb, triangles", 0.12, true);
  add_in_space("coulomb, symmetry plane", 0.12)->fixed[1] = {true, false, false};
  add_in_space("coulomb, symmetry edge", 0.12)->fixed[0] = {true, true, false};
  add_in_space("coulomb, crosspoint", 0.12)->fixed[5] = {true, true, true};
  add_in_space("coulomb, reference", 0.12)->options.geometry = ContactGeometry::reference;
  add_in_space("hardly covered", {});
  add_in_space("hardly covered, coulomb", 0.12);
  add_in_space("hardly covered, coulomb, high", 3.0);
  add_in_space("hardly covered, triangles", 0.12, true);
  add_in_space("hardly covered, symmetry plane", 0.12)->fixed[2] = {false, true, false};
  const auto augmented = std::make_shared<AugmentedLagrange>();
  add_in_space("hardly covered, coulomb, augmented lagrange", 0.12)->options.formulation.options = augmented;
  add_in_space("hardly covered, coulomb, high, augmented lagrange", 3.0)->options.formulation.options = augmented;
  const auto exponential = std::make_shared<ExponentialPressure>();
  exponential->clearance = 0.05;
  exponential->pressure = 1.5;
  const auto soft = std::make_shared<PressureOverclosure>();
  soft->law.options = exponential;
  add_in_space("hardly covered, coulomb, pressure overclosure", 0.12)->options.formulation.options = soft;
  add_quadratic(all);
  add_corners(all);
  // Interferences and gaps that are prescribed, of time and place.
  const ScalarFunction clearance([](const std::vector<double>& of) { return of[0] * (0.02 * of[1] - 0.05); }, "t*(0.02*x - 0.05)");
  for (const auto& name : {"current", "axisymmetric", "reference", "coulomb, mixed", "hardly covered, coulomb", "space, frictionless",
                           "space, coulomb, mixed", "space, hardly covered, coulomb", "quadratic, plane", "quadratic, space, coulomb"}) {
    const auto without = std::find_if(all.begin(), all.end(), [&](const Case& one) { return one.name == name; });
    if (without == all.end()) throw std::logic_error(name);
    all.push_back({"clearance, " + without->name, without->surfaces});
    all.back().surfaces.options.clearance = clearance;
  }
  for (const auto& name : {"current", "axisymmetric", "reference", "coulomb, mixed", "hardly covered, coulomb", "space, coulomb, mixed",
                           "quadratic, plane", "clearance, current"}) {
    const auto on_gaps = std::find_if(all.begin(), all.end(), [&](const Case& one) { return one.name == name; });
    if (on_gaps == all.end()) throw std::logic_error(name);
    all.push_back({"gap rate, " + on_gaps->name, on_gaps->surfaces});
    all.back().surfaces.has_conditions_on_rate = true;
  }
  for (const NamedFormulation& formulation : other_formulations()) {
    if (formulation.options->coupling()->has_forces_of_gaps() || !formulation.options->coupling()->integrates_facets()) continue;
    add_friction("clearance, " + formulation.name, 0.12)->options.formulation.options = formulation.options;
    all.back().surfaces.options.clearance = clearance;
  }
  for (const NamedFormulation& formulation : other_formulations()) {
    if (!in_space(formulation)) continue;
    add_in_space(formulation.name, {})->options.formulation.options = formulation.options;
    add_in_space(formulation.name + ", coulomb", 0.12)->options.formulation.options = formulation.options;
  }
  for (const NamedFormulation& formulation : other_formulations()) {
    const auto set = [&](const std::string& name) {
      all.back().name = formulation.name + (name.empty() ? "" : ", ") + name;
      all.back().surfaces.options.formulation.options = formulation.options;
      return &all.back().surfaces;
    };
    all.push_back({"", arch_on_ground()});
    set("");
    add_friction("", 0.12);
    set("coulomb");
    add_friction("", 2.0);
    set("coulomb, high");
    add_friction("", 0.12);
    set("coulomb, partly fixed")->fixed[0] = {true, false, false};
    add_friction("", 0.12);
    set("coulomb, crosspoint")->fixed[2] = {true, true, false};
    add_friction("", 0.12);
    set("coulomb, axisymmetric")->measure = {true, 1.0};
    add_friction("", 0.12);
    set("coulomb, reference")->options.geometry = ContactGeometry::reference;
  }
  for (const auto& name : {"coulomb, mixed", "space, coulomb, mixed", "quadratic, plane, coulomb", "quadratic, space, coulomb", "penalty, coulomb"}) {
    const auto whole = std::find_if(all.begin(), all.end(), [&](const Case& one) { return one.name == name; });
    if (whole == all.end()) throw std::logic_error(name);
    all.push_back({whole->name + ", zeros dropped", whole->surfaces});
    all.back().surfaces.zeros_dropped = true;
  }
  for (Case& one : all) one.surfaces.options.mortar.search_reach = 1.0;
  return all;
}

/// Indices of the cases, or of those alone whose multipliers are eliminated.
inline std::vector<int> indices(bool eliminated_only) {
  std::vector<int> result;
  const std::vector<Case> all = cases();
  for (std::size_t i = 0; i < all.size(); ++i)
    if (!eliminated_only || !all[i].surfaces.options.formulation.options->enforcement()->keeps_multipliers()) result.push_back(static_cast<int>(i));
  return result;
}

inline std::string test_name(const ::testing::TestParamInfo<int>& info) {
  std::string name = cases()[info.param].name;
  std::replace(name.begin(), name.end(), ' ', '_');
  name.erase(std::remove(name.begin(), name.end(), ','), name.end());
  return name;
}

/// The history with multipliers that a first update sets to those of `laws`, or `history` itself where there is nothing to update.
inline ContactHistory updated(const ContactSystem& contact, const ContactLaws& laws, const ContactHistory& history) {
  const Augmentation augmentation = contact.augment(laws, 1);
  return augmentation.history ? *augmentation.history : history;
}

/// Where the step started: slips are measured from here.
inline ContactHistory start(const Fixture& fixture) {
  const auto before = Fixture::vector(fixture.dofs, [](GlobalOrdinal id) { return 0.01 * std::sin(3.1 * static_cast<double>(id) + 0.2); });
  const auto pressed = fixture.multipliers([](std::size_t node) { return 0.3 * node; });
  const ContactSystem& contact = *fixture.contact;
  Vector z(contact.multiplier_map());
  const ContactHistory history = fixture.first_step(*before, z);
  return contact.with_clearances(updated(contact, contact.evaluate(*before, history).laws(*pressed), history), 0.5);
}

/// The solution of A x = b. Corrections with residuals of more digits make up for what a badly scaled A takes of them.
inline Eigen::VectorXd refined_solution(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  using Exact = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
  const Eigen::FullPivLU<Eigen::MatrixXd> factors(A);
  const Exact of_A = A.cast<long double>(), of_b = b.cast<long double>();
  Exact x = Exact::Zero(b.size(), 1);
  for (int refinement = 0; refinement < 3; ++refinement) {
    const Exact left = of_b - of_A * x;
    const Eigen::VectorXd residual = left.col(0).cast<double>();
    x += factors.solve(residual).cast<long double>();
  }
  return x.col(0).cast<double>();
}

// Some nodes pressed, some open (in 3D those further on too); the tangential part is not zero, as it is before Newton has converged.
inline double pressure(std::size_t node) {
  return node == 1 || node == 2 || node == 3 || node == 4 ? 3.0 + node : (node == 0 ? 2.0 : node > 5 && node % 3 != 0 ? 2.5 : 0.0);
}

/// Expects that the linearised contact, somewhere in a step, is what central differences of forces and conditions give. The norms there.
/// @param newly_covered  none of the slave nodes were covered when the step began
inline ContactNorms expect_linearisation_of_differences(const TwoSurfaces& surfaces, bool newly_covered = false) {
  Fixture fixture(surfaces, Tpetra::getDefaultComm());
  const ContactSystem& contact = *fixture.contact;
  const auto d = Fixture::vector(fixture.dofs, [](GlobalOrdinal id) { return 0.01 * wiggle(id); });
  const auto v = Fixture::vector(fixture.dofs, [](GlobalOrdinal id) { return wiggle(3 * id + 1); });
  const auto z = fixture.multipliers(pressure);
  const auto w = Fixture::vector(contact.multiplier_map(), [](GlobalOrdinal id) { return wiggle(5 * id + 2); });

  const ContactHistory started = newly_covered ? without_couplings(start(fixture)) : start(fixture);
  const DifferentiatedContact evaluated = contact.differentiate(*d, started);
  const ContactHistory history = updated(contact, evaluated.laws(*z), started);
  const DifferentiatedContact at = evaluated.with(history);
  const ContactLaws laws = at.laws(*z);
  const ContactLinearisation linearised = at.linearise(laws);
  const auto system = rcp(new Matrix(contact.graph(at, [&] { return fixture.bulk; })));
  linearised.add_stiffness(*system);
  system->fillComplete(fixture.dofs, fixture.dofs);
  const auto blocks = linearised.saddle_point_blocks();
  Vector force(fixture.dofs), law(contact.multiplier_map());
  system->apply(*v, force);
  blocks.B->apply(*w, force, Teuchos::NO_TRANS, 1.0, 1.0);
  blocks.C_d->apply(*v, law);
  blocks.C_z->apply(*w, law, Teuchos::NO_TRANS, 1.0, 1.0);
  const ContactNorms norms = laws.norms(history->states);
  EXPECT_GT(norms.active, 0);
  EXPECT_LE(norms.active, static_cast<int>(surfaces.slave.size()));
  const double h = 1e-6;
  Vector force_difference(fixture.dofs), law_difference(contact.multiplier_map());
  for (const double sign : {1.0, -1.0}) {
    Vector d_h(*d, Teuchos::Copy), z_h(*z, Teuchos::Copy), f(fixture.dofs), C(contact.multiplier_map());
    d_h.update(sign * h, *v, 1.0);
    z_h.update(sign * h, *w, 1.0);
    const ContactLaws moved = contact.evaluate(d_h, history).laws(z_h);
    moved.add_force(f);
    moved.complementarity(C);
    force_difference.update(sign / (2.0 * h), f, 1.0);
    law_difference.update(sign / (2.0 * h), C, 1.0);
  }
  const double force_size = force.norm2(), law_size = law.norm2();
  force_difference.update(-1.0, force, 1.0);
  law_difference.update(-1.0, law, 1.0);
  EXPECT_GT(force_size, 0.0);
  EXPECT_GT(law_size, 0.0);
  EXPECT_LE(force_difference.norm2(), 1e-6 * force_size);
  EXPECT_LE(law_difference.norm2(), 1e-6 * law_size);
  return norms;
}

}  // namespace mortise::test
