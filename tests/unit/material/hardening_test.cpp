// Hardening laws by themselves: slopes, inverses, the return map, and what reading them refuses.

#include "mortise/material/hardening.hpp"

#include <gtest/gtest.h>

#include <boost/math/quadrature/tanh_sinh.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include "law_fixture.hpp"
#include "mortise/input/read_parameters.hpp"
#include "plasticity_fixture.hpp"

namespace mortise {
namespace {

/// Slope by the law itself.
double slope_of(const Hardening& hardening, double alpha) {
  return std::visit([&](const auto& law) { return law.slope(alpha); }, hardening);
}

TEST(Hardening, TheListOfTheTestsHasEveryLaw) {
  const auto& entries = hardening_registry().entries();
  ASSERT_EQ(every_hardening().size(), entries.size());
  for (std::size_t n = 0; n < entries.size(); ++n) {
    EXPECT_EQ(every_hardening()[n].name, entries[n].name);
    EXPECT_EQ(every_hardening()[n].law.index(), n);
    EXPECT_EQ(entries[n].make()->hardening().index(), n);
  }
}

TEST(Hardening, SlopeIsTheDerivativeOfTheYieldStress) {
  // The difference's steps of 1e-4 stay within the law's own scale and on one side of the table's kinks.
  for (const auto& [name, law] : every_hardening())
    for (const double alpha : {0.01, 0.03, 0.11, 0.4, 1.2}) {
      const double slope = difference([&law = law, alpha](double t) { return yield_stress(law, alpha + t); });
      EXPECT_NEAR(slope_of(law, alpha), slope, bound * (1.0 + slope)) << name << " " << alpha;
    }
}

// The tanh-sinh rule bears the infinite slopes of Ludwik and Swift; the pieces of a table are integrated one by one.
TEST(Hardening, PlasticWorkIsTheIntegralOfTheYieldStress) {
  boost::math::quadrature::tanh_sinh<double> integrate;
  for (const auto& [name, law] : every_hardening()) {
    EXPECT_EQ(plastic_work(law, 0.0), 0.0) << name;
    std::vector<double> ends{0.0};
    if (const auto* table = std::get_if<TableHardening>(&law)) ends = table->table.times;
    ends.push_back(ends.back() + 0.7);
    double work = 0.0;
    for (std::size_t i = 1; i < ends.size(); ++i) {
      work += integrate.integrate([&law = law](double alpha) { return yield_stress(law, alpha); }, ends[i - 1], ends[i]);
      EXPECT_NEAR(plastic_work(law, ends[i]), work, 1e-12 * work) << name << " " << ends[i];
    }
  }
}

TEST(Hardening, NeverFalls) {
  for (const auto& [name, law] : every_hardening()) {
    EXPECT_GT(yield_stress(law, 0.0), 0.0) << name;
    double last = yield_stress(law, 0.0);
    for (double alpha = 1e-40; alpha < 10.0; alpha *= 1.1) {
      EXPECT_GE(yield_stress(law, alpha), last) << name << " " << alpha;
      EXPECT_GE(slope_of(law, alpha), 0.0) << name << " " << alpha;
      last = yield_stress(law, alpha);
    }
  }
}

TEST(Hardening, InverseIsThePlasticStrain) {
  const LudwikHardening ludwik = steel_hardening;
  const SwiftHardening swift{18.0, 0.01, 0.15};
  for (const double alpha : {1e-3, 0.02, 0.3, 2.0}) {
    EXPECT_NEAR(ludwik.plastic_strain(ludwik.yield_stress(alpha)), alpha, 1e-13 * ludwik.yield_stress(alpha) / ludwik.slope(alpha));
    EXPECT_NEAR(swift.plastic_strain(swift.yield_stress(alpha)), alpha, 1e-13 * swift.yield_stress(alpha) / swift.slope(alpha));
  }
  EXPECT_EQ(ludwik.plastic_strain(800.0), 0.0);
  EXPECT_EQ(swift.plastic_strain(1.0), 0.0);
}

TEST(Hardening, TableIsLinearBetweenItsKinksAndConstantBeyond) {
  const TableHardening table{Table{{0.0, 0.1, 0.3}, {100.0, 120.0, 130.0}}};
  EXPECT_DOUBLE_EQ(table.yield_stress(0.05), 110.0);
  EXPECT_DOUBLE_EQ(table.yield_stress(0.1), 120.0);
  EXPECT_DOUBLE_EQ(table.yield_stress(0.2), 125.0);
  EXPECT_DOUBLE_EQ(table.yield_stress(7.0), 130.0);
  EXPECT_DOUBLE_EQ(table.slope(0.0), 200.0);
  EXPECT_DOUBLE_EQ(table.slope(0.1), 50.0);  // at a kink that of the piece that starts there
  EXPECT_DOUBLE_EQ(table.slope(0.3), 0.0);
}

TEST(ReturnMap, TakesKinksOfATable) {
  // q_tr = 3 G x + sigma_y(alpha + x), solved by hand piece by piece.
  const TableHardening table{Table{{0.0, 0.1, 0.3}, {100.0, 120.0, 130.0}}};
  const double stiffness = 300.0;
  for (const auto& [alpha, increment] : {std::pair{0.0, 0.04}, {0.04, 0.06}, {0.04, 0.16}, {0.05, 0.25}, {0.05, 0.6}, {0.3, 0.1}, {0.9, 0.5}}) {
    const double trial = stiffness * increment + table.yield_stress(alpha + increment);
    const PlasticIncrement found = return_map(table, trial, alpha, stiffness);
    EXPECT_NEAR(found.strain, increment, 1e-14) << alpha;
  }
}

TEST(ReturnMap, IsTheClosedFormOfLinearHardening) {
  for (const double modulus : {0.0, 3.0, 3e5}) {
    const PlasticIncrement found = return_map(LinearHardening{10.0, modulus}, 14.0, 1e-6, 1200.0);
    const double exact = (14.0 - 10.0 - 1e-6 * modulus) / (1200.0 + modulus);
    EXPECT_NEAR(found.strain, exact, 1e-14 * 14.0 / (1200.0 + modulus));
    EXPECT_EQ(found.slope, modulus);
  }
  EXPECT_NEAR(return_map(PerfectPlasticity{10.0}, 14.0, 0.02, 1200.0).strain, 4.0 / 1200.0, 1e-16);
}

TEST(ReturnMap, MeetsTheYieldConditionFromAnyState) {
  // q_tr - 3 G x = sigma_y(alpha + x) to round-off, alpha over 12 decades and the excess over 12.
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> decades(0.0, 1.0);
  const double stiffness = 3.0 * soft.shear_modulus();
  for (const auto& [name, law] : every_hardening())
    for (int n = 0; n < 2000; ++n) {
      const double alpha = std::pow(10.0, -12.0 + 12.5 * decades(generator)), yield = yield_stress(law, alpha);
      const double trial = yield * (1.0 + std::pow(10.0, -10.0 + 12.0 * decades(generator)));
      const PlasticIncrement found = return_map(law, trial, alpha, stiffness);
      EXPECT_GE(found.strain, 0.0) << name;
      EXPECT_LE(found.strain, (trial - yield) / stiffness * (1.0 + 1e-12)) << name;
      EXPECT_NEAR(trial - stiffness * found.strain, yield_stress(law, alpha + found.strain), 1e-13 * trial) << name << " alpha " << alpha;
      EXPECT_EQ(found.slope, slope_of(law, alpha + found.strain)) << name;
    }
}

TEST(ReturnMap, FindsNothingForAStressThatIsNotFinite) {
  for (const auto& [name, law] : every_hardening()) {
    EXPECT_TRUE(std::isnan(return_map(law, std::numeric_limits<double>::quiet_NaN(), 0.0, 1200.0).strain)) << name;
    EXPECT_TRUE(std::isnan(return_map(law, std::numeric_limits<double>::infinity(), 0.0, 1200.0).strain)) << name;
  }
}

/// The stress s of s + 3 G ((s - sigma_0) / k)^(1/n) = q_tr by bisection with 50 digits, and from it alpha.
double precise_increment(const LudwikHardening& law, double trial, double stiffness) {
  using Real = boost::multiprecision::cpp_bin_float_50;
  const Real yield(law.initial_yield_stress), factor(law.strength_coefficient), power(1.0 / Real(law.exponent)), q(trial), g(stiffness);
  Real low = 0, high = q - yield;  // s - sigma_0
  for (int n = 0; n < 170; ++n) {
    const Real middle = (low + high) / 2;
    (yield + middle + g * pow(middle / factor, power) > q ? high : low) = middle;
  }
  return static_cast<double>(pow(low / factor, power));
}

TEST(ReturnMap, FirstPlasticIncrementOfLudwikOverTwelveDecades) {
  // From alpha = 0, where the slope is infinite, to trial stresses r above the yield stress. alpha follows from a difference r of numbers of order 1.
  // So the trial stress itself has a relative error of a few eps / (n r).
  constexpr double eps = std::numeric_limits<double>::epsilon();
  for (const auto& [elastic, law] : {std::pair{steel, steel_hardening}, {aluminium, aluminium_hardening}}) {
    const double stiffness = 3.0 * elastic.shear_modulus();
    double last = 0.0;
    for (double r = 1e-14; r < 2e-1; r *= std::pow(10.0, 0.25)) {
      const double trial = law.initial_yield_stress * (1.0 + r);
      const PlasticIncrement found = return_map(law, trial, 0.0, stiffness);
      EXPECT_GT(found.strain, last) << "beyond yield by " << r;
      EXPECT_NEAR(trial - stiffness * found.strain, law.yield_stress(found.strain), 1e-12 * trial) << "beyond yield by " << r;
      EXPECT_TRUE(std::isfinite(found.slope)) << "beyond yield by " << r;
      const double exact = precise_increment(law, trial, stiffness);
      EXPECT_NEAR(found.strain / exact, 1.0, 8.0 * eps * (1.0 + 1.0 / (law.exponent * r))) << "beyond yield by " << r;
      last = found.strain;
    }
  }
}

/// Message on reading the parameters of a hardening law.
std::string refused(const std::string& parameters) {
  struct List {
    Choice<HardeningOptions> hardening;
    void describe(Parameters& visitor) { visitor.choose(hardening, hardening_registry(), "the law"); }
  } list;
  const XmlList root = parse_xml("<ParameterList name=\"hardening\">\n" + parameters + "</ParameterList>\n", "law.xml");
  std::vector<Diagnostic> diagnostics;
  read_parameters(list, root, Symbols(), {}, diagnostics);
  std::string text;
  for (const auto& one : diagnostics) text += to_string(one) + "\n";
  return text;
}

std::string parameter(const std::string& name, const std::string& value) {
  return "<Parameter name=\"" + name + "\" type=\"string\" value=\"" + value + "\"/>\n";
}

std::string table(const std::string& strains, const std::string& stresses) {
  return parameter("type", "table") + parameter("plastic strains", strains) + parameter("yield stresses", stresses);
}

void expect_refused(const std::string& parameters, const std::string& message) {
  EXPECT_NE(refused(parameters).find(message), std::string::npos) << parameters << refused(parameters);
}

TEST(HardeningOptions, AcceptWhatIsRight) {
  EXPECT_EQ(refused(table("0, 0.1, 1", "10, 12, 12")), "");
  EXPECT_EQ(refused(parameter("type", "ludwik") + parameter("yield stress", "830") + parameter("strength coefficient", "600") +
                    parameter("exponent", "0.21")),
            "");
}

TEST(HardeningOptions, RefuseSofteningAndTablesThatAreNone) {
  expect_refused(table("0, 0.1, 1", "10, 12, 11"), "law.xml:4: error: \"yield stresses\" fall: softening");
  expect_refused(table("0, 0.1, 1", "10, 12"), "law.xml:4: error: there are 2 \"yield stresses\" for 3");
  expect_refused(table("0.1, 1", "10, 12"), "law.xml:3: error: ");
  expect_refused(table("0, 1, 1", "10, 12, 13"), "ascend");
  expect_refused(table("0, 1", "0, 12"), "larger than 0");
  expect_refused(parameter("type", "table") + parameter("plastic strains", "0, 1"), "\"yield stresses\" is missing");
  expect_refused(parameter("type", "linear") + parameter("yield stress", "10") + parameter("modulus", "-1"), "law.xml:4: error: \"modulus\" is -1");
  expect_refused(parameter("type", "perfect") + parameter("yield stress", "0"), "\"yield stress\" is 0; allowed: > 0");
  expect_refused(parameter("type", "ludwick"), "did you mean \"ludwik\"?");
  // All at once.
  const std::string all = parameter("type", "swift") + parameter("exponent", "1.5") + parameter("initial strain", "0");
  expect_refused(all, "\"exponent\" is 1.5");
  expect_refused(all, "\"initial strain\" is 0");
  expect_refused(all, "\"strength coefficient\" is missing");
}

}  // namespace
}  // namespace mortise
