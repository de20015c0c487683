// An enforcement and a coupling that the library does not have, made from its public headers.

#include <Eigen/LU>
#include <cmath>

#include "linearised_cases.hpp"
#include "mortise/contact/contact_report.hpp"
#include "mortise/contact/enforcement/exact.hpp"
#include "mortise/core/trilinos_versions.hpp"

namespace mortise {
namespace {

using namespace test;

/// A pressure p of the penetration h, and dp/dh.
struct Pressure {
  double value, slope;
};
using PressureOfPenetration = Pressure (*)(double h);

Pressure quadratic_pressure(double h) { return h > 0.0 ? Pressure{400.0 * h * h, 800.0 * h} : Pressure{0.0, 0.0}; }
Pressure exponential_pressure(double h) {
  const double value = 1.5 * std::exp(h / 0.05);
  return {value, value / 0.05};
}

/// A soft surface without friction:  z_n = p(h),   h = -g / w.
class SoftSurface final : public Enforcement {
 public:
  explicit SoftSurface(PressureOfPenetration pressure) : pressure_(pressure) {}
  Complementarity law(const ContactNode& node) const override {
    const double h = -node.gap / node.weight;
    const Pressure p = pressure_(h);
    if (!(p.value > 0.0)) return open_node(node.z);
    Complementarity law = closed_node(1.0, node.gap, node.frame(), node.z);
    law.C[0] = node.z.dot(node.normal) - p.value;
    law.C_z.row(0) = node.normal.transpose();
    law.normal_factor.row(0) = node.z.transpose();
    law.gap_factor[0] = p.slope / node.weight;  // dh = -dg / w - h dw / w
    law.weight_factor[0] = p.slope * h / node.weight;
    return law;
  }

 private:
  PressureOfPenetration pressure_;
};

/// N_j as functions of the multipliers, and dual ones as weights of the gap.
struct DualGapCoupling final : Coupling {
  std::string name() const override { return "dual gap"; }
  bool has_dual_multipliers() const override { return false; }
  bool has_dual_gap(GapWeighting) const override { return true; }
};

struct OwnFormulation final : Formulation {
  SharedCoupling of;
  SharedEnforcement by;
  OwnFormulation(SharedCoupling of, SharedEnforcement by) : of(std::move(of)), by(std::move(by)) {}
  void describe(Parameters&) override {}
  SharedCoupling coupling() const override { return of; }
  SharedEnforcement enforcement() const override { return by; }
};

TwoSurfaces with_own(TwoSurfaces surfaces, const SharedCoupling& coupling, const SharedEnforcement& enforcement) {
  surfaces.options.formulation.options = std::make_shared<OwnFormulation>(coupling, enforcement);
  surfaces.options.mortar.search_reach = 1.0;
  return surfaces;
}

std::vector<SharedCoupling> with_own_coupling() {
  return {coupling_of<DualMortarCoupling>(), coupling_of<StandardMortarCoupling>(), coupling_of<NodeToSegmentCoupling>(),
          coupling_of<DualGapCoupling>()};
}

std::vector<SharedEnforcement> soft_surfaces() {
  return {std::make_shared<const SoftSurface>(quadratic_pressure), std::make_shared<const SoftSurface>(exponential_pressure)};
}

TEST(OwnEnforcement, IsLinearisedExactly) {
  for (const SharedCoupling& coupling : with_own_coupling())
    for (const SharedEnforcement& enforcement : soft_surfaces()) {
      SCOPED_TRACE(coupling->name());
      expect_linearisation_of_differences(with_own(arch_on_ground(), coupling, enforcement));
      if (coupling->exists_in(3)) expect_linearisation_of_differences(with_own(hardly_covered(dome_on_waves()), coupling, enforcement));
      if (coupling->takes_quadratic_facets())
        expect_linearisation_of_differences(with_own(quadratic(arch_on_ground(), true, true), coupling, enforcement));
    }
}

TEST(OwnCoupling, IsLinearisedExactly) {
  const auto coupling = coupling_of<DualGapCoupling>();
  for (TwoSurfaces surfaces : {arch_on_ground(), dome_on_waves(), quadratic(arch_on_ground(), true, true)}) {
    const auto coulomb = std::make_shared<CoulombFriction>();
    coulomb->coefficient = ScalarFunction(0.12);
    surfaces.options.friction.options = coulomb;
    expect_linearisation_of_differences(with_own(surfaces, coupling, std::make_shared<const KeptMultipliers>()));
    const auto penalty = std::make_shared<Penalty>();
    penalty->discretisation = coupling;
    surfaces.options.formulation.options = penalty;
    surfaces.options.mortar.search_reach = 1.0;
    expect_linearisation_of_differences(surfaces);
  }
}

/// Two blocks of springs that stand side by side, k_s and k_m over their surfaces, a distance apart. The foot of the upper one is pushed down.
struct PressedBlocks {
  static constexpr double of_slave = 20.0, of_master = 30.0, apart = 0.1;

  static TwoSurfaces surfaces() {
    TwoSurfaces blocks;
    for (int i = 0; i < 6; ++i) blocks.slave.push_back({static_cast<double>(i), apart, 0.0});
    for (int i = 0; i < 8; ++i) blocks.master.push_back({5.0 * (7 - i) / 7.0, 0.0, 0.0});
    blocks.fixed.assign(blocks.size(), {});
    return blocks;
  }

  Fixture fixture;
  RCP<Vector> d, z;
  explicit PressedBlocks(const TwoSurfaces& surfaces)
      : fixture(surfaces, Tpetra::getDefaultComm()), d(rcp(new Vector(fixture.dofs))), z(rcp(new Vector(fixture.contact->multiplier_map()))) {}

  /// Of the springs at a node.
  static double stiffness(GlobalOrdinal dof) {
    const GlobalOrdinal node = dof / 2;
    const bool slave = node < 6, end = node == 0 || node == 5 || node == 6 || node == 13;
    return (slave ? of_slave : of_master * 5.0 / 7.0) * (end ? 0.5 : 1.0);
  }
  static double foot(GlobalOrdinal dof, double push) { return dof < 12 && dof % 2 == 1 ? -push : 0.0; }

  /// Newton's method; how many steps it took.
  int solve(double push) {
    const ContactSystem& contact = *fixture.contact;
    const ContactHistory history = fixture.first_step(*d, *z);
    const auto ids = Fixture::all_ids(*fixture.dofs);
    for (int step = 0; step < 30; ++step) {
      const DifferentiatedContact at = contact.differentiate(*d, history);
      const ContactLaws laws = at.laws(*z);
      const Eigen::VectorXd u = Fixture::dense(*d, ids);
      const auto springs = Fixture::vector(fixture.dofs, [&](GlobalOrdinal dof) { return -stiffness(dof) * (u[dof] - foot(dof, push)); });
      Vector residual(*springs, Teuchos::Copy), C(contact.multiplier_map());
      residual.scale(-1.0);
      laws.add_force(residual);
      laws.complementarity(C);
      if (step > 0 && residual.norm2() < 1e-12 && C.norm2() < 1e-12) return step;
      const auto matrix = rcp(new Matrix(contact.graph(at, [&] { return fixture.bulk; })));
      for (const GlobalOrdinal dof : local_ids(*fixture.dofs)) {
        const double value = stiffness(dof);
        matrix->sumIntoGlobalValues(dof, 1, &value, &dof);
      }
      const ContactLinearisation linearised = at.linearise(laws);
      linearised.add_stiffness(*matrix);
      NodeElimination condensed = linearised.condense(*matrix, *springs);
      const Eigen::VectorXd change = Fixture::dense(*matrix, ids, ids).fullPivLu().solve(Fixture::dense(*springs, ids));
      const auto increment = Fixture::vector(fixture.dofs, [&](GlobalOrdinal dof) { return change[dof]; });
      condensed.recover(*increment, *z);
      d->update(1.0, *increment, 1.0);
    }
    return -1;
  }
};

// The foot is pushed by the distance, the penetration h and what the springs give way, p(h) (1 / k_s + 1 / k_m).
TEST(OwnEnforcement, PressedBlocksPenetrateByWhatTheirLawSays) {
  const double h = 0.06;
  for (const SharedCoupling& coupling : {coupling_of<DualMortarCoupling>(), coupling_of<StandardMortarCoupling>(), coupling_of<DualGapCoupling>()})
    for (const PressureOfPenetration pressure : {quadratic_pressure, exponential_pressure}) {
      SCOPED_TRACE(coupling->name());
      const double p = pressure(h).value;
      PressedBlocks blocks(with_own(PressedBlocks::surfaces(), coupling, std::make_shared<const SoftSurface>(pressure)));
      const double push = PressedBlocks::apart + h + p * (1.0 / PressedBlocks::of_slave + 1.0 / PressedBlocks::of_master);
      const int steps = blocks.solve(push);
      EXPECT_GT(steps, 0);
      EXPECT_LE(steps, 12);
      const ContactSystem& contact = *blocks.fixture.contact;
      const ContactLaws laws = contact.evaluate(*blocks.d, contact.initial_history(*blocks.d)).laws(*blocks.z);
      for (const ContactNodeState& node : node_states(laws, 0)) {
        EXPECT_NEAR(-node.gap, h, 1e-12);
        EXPECT_NEAR(node.pressure, p, 1e-11);
      }
    }
}

TEST(OwnFormulation, IsRefusedWhereCouplingAndEnforcementDoNotGoTogether) {
  const auto refusal = [](const SharedCoupling& coupling, const SharedEnforcement& enforcement) -> std::string {
    try {
      Fixture fixture(with_own(arch_on_ground(), coupling, enforcement), Tpetra::getDefaultComm());
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const auto condensed = std::make_shared<const CondensedMultipliers>();
  EXPECT_EQ(refusal(coupling_of<DualMortarCoupling>(), condensed), "");
  EXPECT_NE(refusal(coupling_of<DualGapCoupling>(), condensed).find("the multipliers of dual gap cannot be condensed"), std::string::npos);
  EXPECT_NE(refusal(coupling_of<VariationalMortarCoupling>(), soft_surfaces()[0]).find("variational mortar have to stay unknowns"),
            std::string::npos);
  EXPECT_NE(refusal(coupling_of<DualMortarCoupling>(), nullptr).find("no coupling or no enforcement"), std::string::npos);
}

}  // namespace
}  // namespace mortise
