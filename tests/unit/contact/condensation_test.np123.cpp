// The linearised contact against central differences, and the condensed step against that of the whole saddle point system.

#include <gtest/gtest.h>

#include "formulations.hpp"
#include "two_surfaces.hpp"

namespace mortise {
namespace {

using test::Fixture;
using test::hardly_covered;
using test::hardly_covered_at_a_corner;
using test::TwoSurfaces;

double wiggle(GlobalOrdinal id) { return std::sin(12.9898 * static_cast<double>(id) + 0.7); }

struct Case {
  std::string name;
  TwoSurfaces surfaces;
};

// Quadratic facets: middles whose multipliers act on corners, of the same and of other ranks, with and without a multiplier of their own.
void add_quadratic(std::vector<Case>& all) {
  const auto add = [&](const std::string& name, const TwoSurfaces& linear, bool master, std::optional<double> coefficient) {
    all.push_back({"quadratic, " + name, test::quadratic(linear, true, master)});
    if (coefficient) {
      auto coulomb = std::make_shared<CoulombFriction>();
      coulomb->coefficient = Expression(*coefficient);
      all.back().surfaces.options.friction.options = coulomb;
    }
    return &all.back().surfaces;
  };
  const TwoSurfaces arch = test::arch_on_ground(), dome = test::dome_on_waves(), faceted = test::dome_on_waves(true);
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
  for (const test::NamedFormulation& formulation : test::other_formulations()) {
    if (formulation.options->coupling() == Coupling::node_to_segment) continue;
    add("plane, " + formulation.name, arch, true, 0.12)->options.formulation.options = formulation.options;
    if (test::in_space(formulation)) add("space, " + formulation.name, dome, false, 0.12)->options.formulation.options = formulation.options;
  }
}

// Corners that take the master's normal: their rows depend on both of their facets.
void add_corners(std::vector<Case>& all) {
  const auto add = [&](const std::string& name, double coefficient, bool quadratic = false) {
    const TwoSurfaces corner = test::corner_on_ground();
    all.push_back({"corner, " + name, quadratic ? test::quadratic(corner, true, true) : corner});
    auto coulomb = std::make_shared<CoulombFriction>();
    coulomb->coefficient = Expression(coefficient);
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
  for (const test::NamedFormulation& formulation : test::other_formulations()) {
    add(formulation.name, 0.0)->options.formulation.options = formulation.options;
    add(formulation.name + ", coulomb", 0.12)->options.formulation.options = formulation.options;
  }
}

std::vector<Case> cases() {
  std::vector<Case> all;
  all.push_back({"current", test::arch_on_ground()});
  all.push_back({"standard weighting", test::arch_on_ground()});
  all.back().surfaces.options.mortar.gap_weighting = GapWeighting::standard;
  all.push_back({"partly fixed", test::arch_on_ground()});
  all.back().surfaces.fixed[0] = {true, false, false};
  all.push_back({"crosspoint", test::arch_on_ground()});
  all.back().surfaces.fixed[2] = {true, true, false};
  all.push_back({"axisymmetric", test::arch_on_ground()});
  all.back().surfaces.measure = {true, 1.0};
  all.push_back({"reference", test::arch_on_ground()});
  all.back().surfaces.options.geometry = ContactGeometry::reference;
  const auto add_friction = [&](const std::string& name, double coefficient, const std::shared_ptr<FrictionLaw>& given = {}) {
    all.push_back({name, test::arch_on_ground()});
    auto coulomb = std::make_shared<CoulombFriction>();
    coulomb->coefficient = Expression(coefficient);
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
  of_pressure->coefficient = Expression::of({"pressure", "slip"}, "0.05 + 0.2*exp(-pressure/5)", {});
  of_pressure->largest_traction = 0.9;
  add_friction("coulomb of pressure, bounded", 0.0, of_pressure);
  // The master ends a little behind slave node 4: node 5 is tied to it, and 4 to 3 and 5.
  const auto end_behind = [](TwoSurfaces& surfaces, double end) {
    for (test::Point& x : surfaces.master) x[0] *= end / 4.6;
  };
  all.push_back({"hardly covered", test::arch_on_ground()});
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
  // In space.
  const auto add_in_space = [&](const std::string& name, std::optional<double> coefficient, bool triangles = false) {
    if (coefficient)
      add_friction("space, " + name, *coefficient);
    else
      all.push_back({"space, " + name, {}});
    TwoSurfaces surfaces = test::dome_on_waves(triangles);
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
  add_quadratic(all);
  add_corners(all);
  for (const test::NamedFormulation& formulation : test::other_formulations()) {
    if (!test::in_space(formulation)) continue;
    add_in_space(formulation.name, {})->options.formulation.options = formulation.options;
    add_in_space(formulation.name + ", coulomb", 0.12)->options.formulation.options = formulation.options;
  }
  for (const test::NamedFormulation& formulation : test::other_formulations()) {
    const auto set = [&](const std::string& name) {
      all.back().name = formulation.name + (name.empty() ? "" : ", ") + name;
      all.back().surfaces.options.formulation.options = formulation.options;
      return &all.back().surfaces;
    };
    all.push_back({"", test::arch_on_ground()});
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
std::vector<int> indices(bool eliminated_only) {
  std::vector<int> result;
  const std::vector<Case> all = cases();
  for (std::size_t i = 0; i < all.size(); ++i)
    if (!eliminated_only || all[i].surfaces.options.formulation.options->elimination() != Elimination::none) result.push_back(static_cast<int>(i));
  return result;
}

std::string test_name(const ::testing::TestParamInfo<int>& info) {
  std::string name = cases()[info.param].name;
  std::replace(name.begin(), name.end(), ' ', '_');
  name.erase(std::remove(name.begin(), name.end(), ','), name.end());
  return name;
}

/// Where the step started: slips are measured from here.
void start(Fixture& fixture) {
  const auto before = Fixture::vector(fixture.dofs, [](GlobalOrdinal id) { return 0.01 * std::sin(3.1 * static_cast<double>(id) + 0.2); });
  const std::vector<char> held(fixture.nodes->getNodeNumElements(), 0);
  Vector z(fixture.contact->multiplier_map());
  fixture.contact->start_step(*before, held, z);
  fixture.contact->augment(*fixture.multipliers([](std::size_t node) { return 0.3 * node; }), 1);
}

// Some nodes pressed, some open (in space those further on too); the tangential part is not zero, as it is before Newton has converged.
double pressure(std::size_t node) {
  return node == 1 || node == 2 || node == 3 || node == 4 ? 3.0 + node : (node == 0 ? 2.0 : node > 5 && node % 3 != 0 ? 2.5 : 0.0);
}

class Linearisation : public ::testing::TestWithParam<int> {};
class Condensation : public ::testing::TestWithParam<int> {};

TEST_P(Linearisation, AgreesWithCentralDifferences) {
  const Case one = cases()[GetParam()];
  SCOPED_TRACE(one.name);
  Fixture fixture(one.surfaces, Tpetra::getDefaultComm());
  ContactSystem& contact = *fixture.contact;
  std::optional<StepFailure> failure;
  const auto d = Fixture::vector(fixture.dofs, [](GlobalOrdinal id) { return 0.01 * wiggle(id); });
  const auto v = Fixture::vector(fixture.dofs, [](GlobalOrdinal id) { return wiggle(3 * id + 1); });
  const auto z = fixture.multipliers(pressure);
  const auto w = Fixture::vector(contact.multiplier_map(), [](GlobalOrdinal id) { return wiggle(5 * id + 2); });

  start(fixture);
  contact.evaluate(*d, true, failure);
  ASSERT_FALSE(failure);
  contact.augment(*z, 1);
  bool changed = false;
  const auto system = rcp(new Matrix(contact.system_graph([&] { return fixture.bulk; }, changed)));
  contact.add_stiffness(*z, *system);
  system->fillComplete(fixture.dofs, fixture.dofs);
  const auto blocks = contact.saddle_point_blocks(*z);
  Vector force(fixture.dofs), law(contact.multiplier_map());
  system->apply(*v, force);
  blocks.B->apply(*w, force, Teuchos::NO_TRANS, 1.0, 1.0);
  blocks.C_d->apply(*v, law);
  blocks.C_z->apply(*w, law, Teuchos::NO_TRANS, 1.0, 1.0);
  const ContactNorms norms = contact.norms(*z);
  EXPECT_GT(norms.active, 0);
  EXPECT_LE(norms.active, static_cast<int>(one.surfaces.slave.size()));
  if (one.name.find("mixed") != std::string::npos) {
    EXPECT_GT(norms.sticking, 0);
    EXPECT_LT(norms.sticking, norms.active);
  }
  if (one.name.find("mostly stick") != std::string::npos) {
    EXPECT_GE(norms.sticking, norms.active - 1);
  }
  if (one.name.find("mostly slip") != std::string::npos) {
    EXPECT_LE(norms.sticking, 1);
  }

  const double h = 1e-6;
  Vector force_difference(fixture.dofs), law_difference(contact.multiplier_map());
  for (const double sign : {1.0, -1.0}) {
    Vector d_h(*d, Teuchos::Copy), z_h(*z, Teuchos::Copy), f(fixture.dofs), C(contact.multiplier_map());
    d_h.update(sign * h, *v, 1.0);
    z_h.update(sign * h, *w, 1.0);
    contact.evaluate(d_h, false, failure);
    contact.add_contact_force(z_h, f);
    contact.complementarity(z_h, C);
    force_difference.update(sign / (2.0 * h), f, 1.0);
    law_difference.update(sign / (2.0 * h), C, 1.0);
  }
  ASSERT_FALSE(failure);
  const double force_size = force.norm2(), law_size = law.norm2();
  force_difference.update(-1.0, force, 1.0);
  law_difference.update(-1.0, law, 1.0);
  EXPECT_GT(force_size, 0.0);
  EXPECT_GT(law_size, 0.0);
  EXPECT_LE(force_difference.norm2(), 1e-6 * force_size);
  EXPECT_LE(law_difference.norm2(), 1e-6 * law_size);
}

TEST_P(Condensation, StepEqualsSaddlePointStep) {
  const Case one = cases()[GetParam()];
  SCOPED_TRACE(one.name);
  Fixture fixture(one.surfaces, Tpetra::getDefaultComm());
  ContactSystem& contact = *fixture.contact;
  std::optional<StepFailure> failure;
  const auto d = Fixture::vector(fixture.dofs, [](GlobalOrdinal id) { return 0.01 * wiggle(id); });
  const auto r = Fixture::vector(fixture.dofs, [](GlobalOrdinal id) { return 5.0 * wiggle(7 * id + 3); });  // without f_c
  const auto z = fixture.multipliers(pressure);
  start(fixture);
  contact.evaluate(*d, true, failure);
  ASSERT_FALSE(failure);
  contact.augment(*z, 1);
  bool changed = false;
  const auto graph = contact.system_graph([&] { return fixture.bulk; }, changed);

  const auto dof_ids = Fixture::all_ids(*fixture.dofs);
  const auto z_ids = Fixture::all_ids(*contact.multiplier_map());
  const Eigen::Index n = dof_ids.size(), m = z_ids.size();
  std::vector<Eigen::Index> fixed;
  for (std::size_t node = 0; node < one.surfaces.size(); ++node)
    for (int i = 0; i < one.surfaces.dimension; ++i)
      if (one.surfaces.fixed[node][i]) fixed.push_back(one.surfaces.dimension * node + i);

  // The whole system: [K + C~, B; C_d, C_z] (dd, dz) = -(r + f_c, C), Dirichlet rows dd = 0.
  const auto full = fixture.springs(graph);
  contact.add_stiffness(*z, *full);
  const auto blocks = contact.saddle_point_blocks(*z);
  Vector total(*r, Teuchos::Copy), C(contact.multiplier_map());
  contact.add_contact_force(*z, total);
  contact.complementarity(*z, C);
  Eigen::MatrixXd A(n + m, n + m);
  A << Fixture::dense(*full, dof_ids, dof_ids), Fixture::dense(*blocks.B, dof_ids, z_ids), Fixture::dense(*blocks.C_d, z_ids, dof_ids),
      Fixture::dense(*blocks.C_z, z_ids, z_ids);
  Eigen::VectorXd b(n + m);
  b << -Fixture::dense(total, dof_ids), -Fixture::dense(C, z_ids);
  for (const Eigen::Index row : fixed) {
    A.row(row).setZero();
    A(row, row) = 1.0;
    b[row] = 0.0;
  }
  const Eigen::VectorXd whole = A.fullPivLu().solve(b);

  // Condensed.
  const auto system = fixture.springs(graph);
  Vector rhs(*r, Teuchos::Copy);
  rhs.scale(-1.0);
  contact.add_stiffness(*z, *system);
  contact.condense(*z, *system, rhs);
  Eigen::MatrixXd condensed = Fixture::dense(*system, dof_ids, dof_ids);
  Eigen::VectorXd right = Fixture::dense(rhs, dof_ids);
  for (const Eigen::Index row : fixed) {
    condensed.row(row).setZero();
    condensed(row, row) = 1.0;
    right[row] = 0.0;
  }
  const Eigen::FullPivLU<Eigen::MatrixXd> factors(condensed);
  const auto vector_of = [](const RCP<const Map>& map, const std::vector<GlobalOrdinal>& ids, const Eigen::VectorXd& values) {
    return Fixture::vector(map, [&](GlobalOrdinal id) { return values[std::lower_bound(ids.begin(), ids.end(), id) - ids.begin()]; });
  };
  Eigen::VectorXd increment = factors.solve(right);
  Vector z_new(contact.multiplier_map());
  contact.recover(*vector_of(fixture.dofs, dof_ids, increment), z_new);
  z_new.update(-1.0, *z, 1.0);
  // What condensation leaves out of J = J~ + L: the step x of J is  J~^-1 (-F) - J~^-1 (0, L x).
  const bool is_tied = one.name.find("hardly covered") != std::string::npos;
  if (is_tied) EXPECT_TRUE(contact.leaves_out_couplings());
  if (contact.leaves_out_couplings()) {
    Vector left_out(contact.multiplier_map()), right_of_left_out(fixture.dofs), z_change(contact.multiplier_map());
    contact.apply_left_out(*vector_of(fixture.dofs, dof_ids, whole.head(n)), *vector_of(contact.multiplier_map(), z_ids, whole.tail(m)), left_out);
    EXPECT_GT(left_out.norm2(), 0.0);
    contact.condense_right_hand_side(left_out, right_of_left_out);
    Eigen::VectorXd b_left_out = Fixture::dense(right_of_left_out, dof_ids);
    for (const Eigen::Index row : fixed) b_left_out[row] = 0.0;
    const Eigen::VectorXd change = factors.solve(b_left_out);
    contact.recover(*vector_of(fixture.dofs, dof_ids, change), z_change);
    increment += change;
    z_new.update(1.0, z_change, 1.0);
  }

  EXPECT_LE((increment - whole.head(n)).norm(), 1e-11 * whole.head(n).norm());
  EXPECT_LE((Fixture::dense(z_new, z_ids) - whole.tail(m)).norm(), 1e-11 * whole.tail(m).norm());
  // Every diagonal of the condensed matrix is positive, as relaxation needs it. That of a penalty is what its stiffness makes it.
  // In space a node that slips at the edge of its cone has only c_t D_jj^2 of its own across the slip, which the made-up springs may outdo.
  // So has there a corner of quadratic facets of whose weight a tenth is covered: the facet's turn outdoes D_jj.
  const bool slips_in_space = one.surfaces.dimension == 3 && one.surfaces.options.friction.options->acts();
  const bool quadratic_in_space = one.surfaces.dimension == 3 && one.surfaces.slave_facets.front().size() > 4;
  if (one.surfaces.options.formulation.options->elimination() == Elimination::momentum && !slips_in_space && !quadratic_in_space)
    EXPECT_GT(condensed.diagonal().minCoeff(), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Cases, Linearisation, ::testing::ValuesIn(indices(false)), test_name);
INSTANTIATE_TEST_SUITE_P(Cases, Condensation, ::testing::ValuesIn(indices(true)), test_name);

TEST(ReferenceGeometry, GapIsTheTransposeOfTheForce) {
  TwoSurfaces surfaces = test::arch_on_ground();
  surfaces.options.geometry = ContactGeometry::reference;
  surfaces.options.mortar.search_reach = 1.0;
  Fixture fixture(surfaces, Tpetra::getDefaultComm());
  ContactSystem& contact = *fixture.contact;
  std::optional<StepFailure> failure;
  Vector d(fixture.dofs);
  start(fixture);
  contact.evaluate(d, true, failure);
  bool changed = false;
  contact.system_graph([&] { return fixture.bulk; }, changed);
  const auto z = fixture.multipliers([](std::size_t) { return 1e3; });  // all closed
  const auto blocks = contact.saddle_point_blocks(*z);
  const auto dof_ids = Fixture::all_ids(*fixture.dofs), z_ids = Fixture::all_ids(*contact.multiplier_map());
  const Eigen::MatrixXd B = Fixture::dense(*blocks.B, dof_ids, z_ids), C_d = Fixture::dense(*blocks.C_d, z_ids, dof_ids);
  const Eigen::MatrixXd C_z = Fixture::dense(*blocks.C_z, z_ids, z_ids);
  int closed = 0;
  for (Eigen::Index j = 0; j < C_d.rows(); j += 2) {
    if (C_d.row(j).isZero(0.0)) continue;
    ++closed;
    // The normal from the tangential row of C_z; the row of C_d is -c_n times the force of a unit pressure.
    const Eigen::Vector2d normal(C_z(j + 1, j + 1), -C_z(j + 1, j));
    const Eigen::VectorXd push = B.middleCols(j, 2) * normal;
    const double factor = C_d.row(j).norm() / push.norm();
    EXPECT_LE((C_d.row(j).transpose() + factor * push).norm(), 1e-13 * C_d.row(j).norm());
  }
  EXPECT_GE(closed, 4);
}

}  // namespace
}  // namespace mortise
