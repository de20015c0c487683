// Every kind of quantity on fields made by hand, with values known beforehand; the same on any number of ranks.

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "mortise/input/read_parameters.hpp"
#include "quantity_fixture.hpp"

namespace mortise {
namespace {

using namespace test;
using ::testing::HasSubstr;

template <class Action>
std::string input_error(const Action& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "no InputError";
  return {};
}

TEST(Quantity, StressOfUniformStrain) {
  TwoBlocks blocks;
  blocks.move([](int, const Point& X) { return uniform_strain(X); });
  EXPECT_NEAR(blocks.value(field<Mean>(PointField::stress_xx, "")), stress_xx, 1e-13);
  EXPECT_NEAR(blocks.value(field<Mean>(PointField::stress_yy, "upper")), stress_yy, 1e-13);
  EXPECT_NEAR(blocks.value(field<Extremum>(PointField::stress_zz, "lower")), stress_zz, 1e-13);
  EXPECT_NEAR(blocks.value(field<Extremum>(PointField::stress_xy, "")), stress_xy, 1e-13);
  const double von_mises =
      std::sqrt(0.5 * (std::pow(stress_xx - stress_yy, 2) + std::pow(stress_yy - stress_zz, 2) + std::pow(stress_zz - stress_xx, 2)) +
                3.0 * stress_xy * stress_xy);
  EXPECT_NEAR(blocks.value(field<Extremum>(PointField::von_mises, "")), von_mises, 1e-13);
  // Mohr's circle; zz is a principal stress of its own.
  const double middle = 0.5 * (stress_xx + stress_yy), radius = std::hypot(0.5 * (stress_xx - stress_yy), stress_xy);
  std::array<double, 3> principal{middle + radius, middle - radius, stress_zz};
  std::sort(principal.begin(), principal.end());
  EXPECT_NEAR(blocks.value(field<Extremum>(PointField::largest_principal_stress, "")), principal[2], 1e-13);
  EXPECT_NEAR(blocks.value(field<Mean>(PointField::middle_principal_stress, "upper")), principal[1], 1e-13);
  EXPECT_NEAR(blocks.value(field<Extremum>(PointField::smallest_principal_stress, "lower")), principal[0], 1e-13);
  EXPECT_LT(blocks.value(*quantity("spread")), 1e-12);
}

// Strain e below and 2 e above, equal volumes: the mean is 1.5 sigma(e), every deviation 0.5 sigma(e).
TEST(Quantity, SpreadOfTwoStresses) {
  TwoBlocks blocks;
  blocks.move([](int body, const Point& X) {
    const Point u = uniform_strain(X);
    return Point{(1.0 + body) * u[0], (1.0 + body) * u[1]};
  });
  EXPECT_NEAR(blocks.value(*quantity("spread")), 1.0 / 3.0, 1e-12);
  EXPECT_LT(blocks.value(*quantity("spread", {{"bodies", "upper"}})), 1e-12);
  EXPECT_THAT(input_error([&] {
                blocks.value(*quantity("spread", {{"bodies", "uper"}}));
              }),
              ::testing::AllOf(HasSubstr("scene.xml:3"), HasSubstr("did you mean \"upper\"")));
  EXPECT_TRUE(std::isnan(TwoBlocks().value(*quantity("spread")))) << "without stress there is nothing to compare with";
}

// Blocks that turn under a traction that stays: what is along the surface changes, what is along x does not.
TEST(Quantity, PartsOfTheContactTraction) {
  TwoBlocks blocks;
  const double angle = 0.3, cosine = std::cos(angle), sine = std::sin(angle), pressure = 3.0, shear = 0.7;
  blocks.move([=](int, const Point& X) { return Point{(cosine - 1.0) * X[0] - sine * X[1], sine * X[0] + (cosine - 1.0) * X[1]}; });
  blocks.press([=](double) { return pressure; }, shear);
  const auto part = [](ContactTraction::Part which, TractionMeasure measure = TractionMeasure::pair) {
    ContactTraction traction;
    traction.part = which;
    traction.measure = measure;
    return traction;
  };
  using Part = ContactTraction::Part;
  EXPECT_NEAR(blocks.value(part(Part::x)), shear, 1e-13);
  EXPECT_NEAR(blocks.value(part(Part::y)), -pressure, 1e-13);
  EXPECT_NEAR(blocks.value(part(Part::pressure)), shear * sine + pressure * cosine, 1e-13);
  EXPECT_NEAR(blocks.value(part(Part::shear)), shear * cosine - pressure * sine, 1e-13);
  ContactTraction there = part(Part::x, TractionMeasure::reference);
  there.x = 1.9;
  EXPECT_NEAR(blocks.value(there), shear, 1e-12) << "no length changes";
}

TEST(Quantity, DisplacementOfNodes) {
  TwoBlocks blocks;
  blocks.move([](int body, const Point& X) { return Point{0.01 * X[0] - 0.02, body == 0 ? 0.003 * X[1] : -0.05}; });
  EXPECT_NEAR(blocks.value(field<Extremum>(PointField::displacement_x, "")), 0.02, 1e-16);
  Extremum least = field<Extremum>(PointField::displacement_x, "lower/top");
  least.which = Extremum::Which::minimum;
  EXPECT_NEAR(blocks.value(least), -0.02, 1e-16);
  Extremum largest = field<Extremum>(PointField::displacement_y, "");
  largest.which = Extremum::Which::maximum_absolute;
  EXPECT_NEAR(blocks.value(largest), 0.05, 1e-16);
  EXPECT_NEAR(blocks.value(field<Mean>(PointField::displacement_x, "lower/top")), 0.0, 1e-16);
  EXPECT_NEAR(blocks.value(field<Extremum>(PointField::displacement_magnitude, "upper")), std::hypot(0.02, 0.05), 1e-16);
  EXPECT_THAT(input_error([&] { blocks.value(field<Mean>(PointField::displacement_x, "lower/topp")); }), HasSubstr("lower/top"));
}

TEST(Quantity, DisplacementOfAPoint) {
  TwoBlocks blocks;
  blocks.move([](int body, const Point& X) { return body == 0 ? uniform_strain(X) : Point{0.1, 0.2 * X[0]}; });
  const auto at = [](double x, double y, Component component, const std::string& body = "") {
    PointDisplacement point;
    point.point.x.value = x, point.point.y.value = y, point.component = component, point.point.body.value = body;
    return point;
  };
  for (const Point& X : {Point{0.0, 0.0}, {1.3, 0.2}, {3.999, 0.71}, {2.0, 0.5}}) {
    EXPECT_NEAR(blocks.value(at(X[0], X[1], Component::x)), uniform_strain(X)[0], 1e-14);
    EXPECT_NEAR(blocks.value(at(X[0], X[1], Component::y)), uniform_strain(X)[1], 1e-14);
  }
  EXPECT_NEAR(blocks.value(at(2.7, 1.6, Component::y)), 0.54, 1e-14);
  EXPECT_NEAR(blocks.value(at(2.7, 1.0, Component::x)), uniform_strain({2.7, 1.0})[0], 1e-14) << "on the interface: the first body";
  EXPECT_NEAR(blocks.value(at(2.7, 1.0, Component::x, "upper")), 0.1, 1e-14);
  EXPECT_THAT(input_error([&] { blocks.value(at(5.0, 0.5, Component::x)); }), HasSubstr("(5, 0.5) lies in no body"));
  EXPECT_THAT(input_error([&] { blocks.value(at(1.0, 0.5, Component::x, "upper")); }), HasSubstr("not in the body \"upper\""));
}

TEST(Quantity, ReactionsOfASet) {
  TwoBlocks blocks;
  blocks.reaction = blocks.nodal([](int body, const Point& X) { return Point{1.0 + body, X[0]}; });
  Reaction reaction;
  reaction.set.value = "lower/bottom";  // 5 nodes at x = 0 ... 4
  EXPECT_NEAR(blocks.value(reaction), 10.0, 1e-14);
  reaction.component = Reaction::Of::x;
  EXPECT_NEAR(blocks.value(reaction), 5.0, 1e-14);
  reaction.set.value = "lower/botom";
  EXPECT_THAT(input_error([&] { blocks.value(reaction); }), HasSubstr("lower/bottom"));
}

TEST(Quantity, BalanceOfLoadsAndReactions) {
  TwoBlocks blocks;
  blocks.prescribed = blocks.dofs("lower/bottom");
  blocks.external = blocks.nodal([](int, const Point& X) { return Point{0.0, X[1] == 2.0 ? -5.0 : 0.0}; });  // 6 nodes: -30
  // 5 supported nodes carry 6 each: balance. A value on free dofs is no reaction.
  blocks.reaction = blocks.nodal([](int, const Point& X) { return Point{0.0, X[1] == 0.0 ? 6.0 : 100.0}; });
  const auto imbalance = quantity("momentum imbalance", {{"of", "total"}});
  EXPECT_NEAR(blocks.value(*imbalance), 0.0, 1e-15);
  blocks.reaction = blocks.nodal([](int, const Point& X) { return Point{X[1] == 0.0 ? 0.3 : 0.0, X[1] == 0.0 ? 6.0 : 0.0}; });
  EXPECT_NEAR(blocks.value(*imbalance), 1.5 / 30.0, 1e-15);
  blocks.force_round_off = 29.9;
  EXPECT_NEAR(blocks.value(*imbalance), 1.5 / 30.0, 1e-15);
  blocks.force_round_off = 30.1;
  EXPECT_EQ(blocks.value(*imbalance), 0.0) << "no forces are in balance";

  TwoBlocks rings(Kinematics::axisymmetric);
  rings.external = rings.nodal([](int, const Point&) { return Point{7.0, 0.0}; });
  EXPECT_EQ(rings.value(*imbalance), 0.0) << "radial forces do not have to balance";
}

TEST(Quantity, UniformPressure) {
  TwoBlocks blocks;
  blocks.press([](double) { return 3.0; });
  ContactForce force;
  EXPECT_NEAR(blocks.value(force), 3.0 * width * thickness, 1e-12);
  force.component = Component::x;
  EXPECT_NEAR(blocks.value(force), 0.0, 1e-12);
  EXPECT_LT(blocks.value(*quantity("momentum imbalance", {{"of", "contact"}})), 1e-12);
  EXPECT_NEAR(blocks.value(PeakPressure()), 3.0, 1e-14);
  EXPECT_EQ(blocks.value(*quantity("active count")), upper_cells + 1);
  EXPECT_NEAR(blocks.value(ContactLength()), width, 1e-14);
  EXPECT_NEAR(blocks.value(ContactArea()), width * thickness, 1e-13);
  EXPECT_NEAR(blocks.value(PressureVariation()), 0.0, 1e-13);
  EXPECT_NEAR(blocks.value(field<Mean>(PointField::contact_pressure, "pair")), 3.0, 1e-13);
}

// p = 3 (1 - x / L) on [0, L]: int p x^2 / int p = L^2 / 6, exactly so for p_h. The last node, without pressure, is open.
TEST(Quantity, LinearPressure) {
  TwoBlocks blocks;
  blocks.press([](double x) { return 3.0 * (1.0 - x / width); });
  EXPECT_NEAR(blocks.value(HalfWidth()), 2.0 * std::sqrt(width * width / 6.0), 1e-12);
  HalfWidth shifted;
  shifted.center = 1.0;  // int p (x - 1)^2 / int p = L^2/6 - 2 L/3 + 1
  EXPECT_NEAR(blocks.value(shifted), 2.0 * std::sqrt(width * width / 6.0 - 2.0 * width / 3.0 + 1.0), 1e-12);
  EXPECT_NEAR(blocks.value(PeakPressure()), 3.0, 1e-14);
  EXPECT_EQ(blocks.value(*quantity("active count")), upper_cells);
  EXPECT_NEAR(blocks.value(ContactLength()), width - 0.5 * width / upper_cells, 1e-14);
  EXPECT_NEAR(blocks.value(ContactForce()), 1.5 * width * thickness, 1e-12);
}

// Nodes of 0 and 2 in turn; and a disc out of rings, half a facet for each closed end.
TEST(Quantity, VariationOfAPressureAndAreaOfRings) {
  TwoBlocks blocks;
  blocks.press([](double x) { return static_cast<int>(std::round(x * upper_cells / width)) % 2 == 0 ? 0.0 : 2.0; });
  EXPECT_NEAR(blocks.value(PressureVariation()), 2.0 * upper_cells, 1e-13);

  TwoBlocks rings(Kinematics::axisymmetric);
  rings.press([](double x) { return x < 0.5 * width ? 2.0 : 0.0; });  // nodes at 0, 0.8, 1.6: up to 2
  EXPECT_NEAR(rings.value(ContactArea()), EIGEN_PI * 2.0 * 2.0, 1e-12);
}

TEST(Quantity, GapOfALiftedBody) {
  TwoBlocks blocks;
  blocks.move([](int body, const Point&) { return Point{0.0, body == 1 ? 0.125 : 0.0}; });
  EXPECT_NEAR(blocks.value(field<Extremum>(PointField::gap, "pair")), 0.125, 1e-12);
  EXPECT_NEAR(blocks.value(field<Mean>(PointField::gap, "")), 0.125, 1e-12);
  EXPECT_EQ(blocks.value(*quantity("active count")), 0.0);
  EXPECT_EQ(blocks.value(PeakPressure()), 0.0);
  EXPECT_EQ(blocks.value(HalfWidth()), 0.0);
}

TEST(Quantity, NamesOfPairs) {
  TwoBlocks blocks;
  PeakPressure peak;
  peak.pair = {"piar", {"scene.xml", 9, "quantities/peak"}};
  EXPECT_THAT(input_error([&] { blocks.value(peak); }), ::testing::AllOf(HasSubstr("scene.xml:9"), HasSubstr("did you mean \"pair\"")));
  auto context = blocks.context();
  context.pairs.push_back({"other", "upper/bottom", "lower/top"});
  EXPECT_THAT(input_error([&] { PeakPressure().make_evaluator(context); }), HasSubstr("\"pair\", \"other\""));
  context.pairs.clear();
  EXPECT_THAT(input_error([&] { PeakPressure().make_evaluator(context); }), HasSubstr("no contact"));
}

TEST(ErrorNorm, OfDisplacementAndStress) {
  TwoBlocks blocks;
  blocks.move([](int, const Point& X) { return uniform_strain(X); });
  const auto linear = std::make_shared<LinearDisplacement>();
  const auto uniform = std::make_shared<UniformState>();
  const auto scaled = [&](double factor) {  // u_h = factor^-1 of the exact one: the error is 1 - 1/factor
    linear->xx = ScalarFunction(0.01 * factor), linear->xy = ScalarFunction(0.006 * factor), linear->yy = ScalarFunction(-0.02 * factor);
    uniform->xx = ScalarFunction(stress_xx * factor), uniform->yy = ScalarFunction(stress_yy * factor);
    uniform->zz = ScalarFunction(stress_zz * factor), uniform->xy = ScalarFunction(stress_xy * factor);
  };
  ErrorNorm displacement, stress;
  displacement.of = ErrorNorm::Of::displacement, displacement.exact = {"linear displacement", linear, {}};
  stress.of = ErrorNorm::Of::stress, stress.exact = {"uniform", uniform, {}};
  scaled(1.0);
  EXPECT_LT(blocks.value(displacement), 1e-13);
  EXPECT_LT(blocks.value(stress), 1e-13);
  scaled(2.0);
  EXPECT_NEAR(blocks.value(displacement), 0.5, 1e-13);
  stress.on.value = "upper";
  EXPECT_NEAR(blocks.value(stress), 0.5, 1e-13);
  displacement.exact = {"uniform", uniform, {}};
  EXPECT_THAT(input_error([&] { blocks.value(displacement); }), HasSubstr("\"uniform\" knows no displacement"));
}

// p_h = 2 (1 - x / L) against p = 2: the squared error over [a, b] is (b^3 - a^3) / (3 L^2 (b - a)); a and b lie inside facets.
TEST(ErrorNorm, OfPressureOverARange) {
  TwoBlocks blocks;
  blocks.press([](double x) { return 2.0 * (1.0 - x / width); });
  const auto uniform = std::make_shared<UniformState>();
  uniform->contact_pressure = parse_expression("2*t", {});
  ErrorNorm error;
  error.exact = {"uniform", uniform, {}};
  EXPECT_NEAR(blocks.value(error), std::sqrt(1.0 / 3.0), 1e-13);
  error.from = 0.3, error.to = 2.9;
  EXPECT_NEAR(blocks.value(error), std::sqrt((std::pow(2.9, 3) - std::pow(0.3, 3)) / (3.0 * width * width * 2.6)), 1e-13);
  EXPECT_TRUE(std::isnan(blocks.value(error, 0.0))) << "no pressure to compare with";
  error.unit = ErrorNorm::Unit::half_width;
  EXPECT_THAT(input_error([&] { blocks.value(error); }), HasSubstr("no half width"));
}

// p_h = 2 (1 - X / L) on blocks stretched to three halves: the surface is L long in the reference configuration and 3/2 L in the current one.
TEST(ErrorNorm, SurfaceQuantitiesStandWhereTheGeometryOfThePairIs) {
  for (const auto& [geometry, stretch] : {std::pair(ContactGeometry::current, 1.5), std::pair(ContactGeometry::reference, 1.0)}) {
    TwoBlocks blocks(Kinematics::plane_strain, geometry);
    blocks.press([](double X) { return 2.0 * (1.0 - X / width); });
    blocks.move([](int, const Point& X) { return Point{0.5 * X[0], 0.0}; });
    EXPECT_NEAR(blocks.value(HalfWidth()), stretch * 2.0 * std::sqrt(width * width / 6.0), 1e-12);
    EXPECT_NEAR(blocks.value(ContactLength()), stretch * (width - 0.5 * width / upper_cells), 1e-13);
    const auto uniform = std::make_shared<UniformState>();
    uniform->contact_pressure = ScalarFunction(2.0);
    ErrorNorm error;
    error.exact = {"uniform", uniform, {}};
    error.from = 0.3, error.to = 2.9;
    const double a = 0.3 / stretch, b = 2.9 / stretch;
    EXPECT_NEAR(blocks.value(error), std::sqrt((std::pow(b, 3) - std::pow(a, 3)) / (3.0 * width * width * (b - a))), 1e-13);
  }
}

// p_h = c against Hertz over [0, 1.5 a]: |error|^2 = (1.5 c^2 a - 2 c p0 a pi/4 + 2/3 p0^2 a) / (2/3 p0^2 a). Eight Gauss points miss the integral of
// sqrt(1 - x/a) up to the end of its range by less than 1e-3 relative. They miss those of its square and of a constant not at all.
TEST(ErrorNorm, OfPressureAgainstHertz) {
  TwoBlocks blocks;
  const auto hertz = std::make_shared<HertzLineContact>();
  hertz->load = ScalarFunction(100.0), hertz->radius = 1.0;
  hertz->first_youngs_modulus = hertz->second_youngs_modulus = youngs_modulus;
  const double a = hertz->half_width(1.0), p0 = hertz->peak(1.0), c = 0.4 * p0, pi = std::acos(-1.0);
  ASSERT_LT(1.5 * a, width) << "the range has to lie on the surface";
  ErrorNorm error;
  error.exact = {"hertz line contact", hertz, {}};
  error.from = 0.0, error.to = 1.5, error.unit = ErrorNorm::Unit::half_width;
  EXPECT_NEAR(blocks.value(error), 1.0, 1e-14) << "without pressure all of it is missing";
  blocks.press([&](double) { return c; });
  const double reference = 2.0 / 3.0 * p0 * p0;
  EXPECT_NEAR(blocks.value(error), std::sqrt((1.5 * c * c - 0.5 * pi * c * p0 + reference) / reference), 1e-3);
}

/// An entry of a scene's list "quantities".
struct Entry {
  Choice<Quantity> quantity;
  void describe(Parameters& parameters) { parameters.choose(quantity, quantity_registry(), "the kind of quantity"); }
};

TEST(Derived, AFormulaKnowsTimeVariablesAndEarlierQuantities) {
  TwoBlocks blocks;
  Symbols symbols;
  symbols.variables["length"] = 4.0;
  QuantityContext context = blocks.context(0.5);
  context.symbols = &symbols;
  context.earlier = {"first", "with a space", "second"};
  FormulaQuantity formula;
  context.earlier_values = {3.0, 100.0, 8.0};
  formula.value = {"second/length + t*first", {}};
  EXPECT_DOUBLE_EQ(formula.make_evaluator(context)->evaluate(context), 2.0 + 1.5);
  formula.value = {"first/(second - 8)", {}};
  EXPECT_TRUE(std::isnan(formula.make_evaluator(context)->evaluate(context)));
  formula.value = {"third", {"scene.xml", 7, "quantities/third"}};
  const std::string message = input_error([&] { formula.make_evaluator(context); });
  EXPECT_THAT(message, HasSubstr("scene.xml:7"));
  EXPECT_THAT(message, HasSubstr("known names: t, first"));
}

TEST(Derived, ExtremesOverTimeSkipWhatIsNoNumber) {
  TwoBlocks blocks;
  QuantityContext context = blocks.context();
  context.earlier = {"force"};
  const std::vector<double> history{std::nan(""), -2.0, 3.0, std::nan(""), -5.0, 1.0};
  const auto extreme = [&](const std::string& which) {
    const auto over_time = quantity("over time", {{"quantity", "force"}, {"which", which}});
    // The second evaluator begins while the first one is in the middle of its history: neither knows of the other.
    const auto first = over_time->make_evaluator(context);
    std::unique_ptr<QuantityEvaluator> second;
    std::vector<double> of_first, of_second;
    for (std::size_t step = 0; step < 2 * history.size(); ++step) {
      if (step == history.size() / 2) second = over_time->make_evaluator(context);
      if (step < history.size()) {
        context.earlier_values = {history[step]};
        of_first.push_back(first->evaluate(context));
      }
      if (second && of_second.size() < history.size()) {
        context.earlier_values = {history[of_second.size()]};
        of_second.push_back(second->evaluate(context));
      }
    }
    EXPECT_TRUE(std::isnan(of_first[0]));
    EXPECT_TRUE(std::isnan(of_second[0]));
    of_first.erase(of_first.begin());
    EXPECT_EQ(of_first, std::vector<double>(of_second.begin() + 1, of_second.end()));
    return of_first;
  };
  EXPECT_EQ(extreme("maximum"), (std::vector<double>{-2.0, 3.0, 3.0, 3.0, 3.0}));
  EXPECT_EQ(extreme("minimum"), (std::vector<double>{-2.0, -2.0, -2.0, -5.0, -5.0}));
  EXPECT_EQ(extreme("maximum absolute"), (std::vector<double>{2.0, 3.0, 3.0, 5.0, 5.0}));
  EXPECT_THAT(input_error([&] { quantity("over time", {{"quantity", "forse"}})->make_evaluator(context); }), HasSubstr("did you mean \"force\"?"));
}

TEST(Registry, AnErrorNormIsReadWithItsExactSolution) {
  const auto read = [](const std::string& field, Entry& entry) {
    const std::string text =
        "<ParameterList name=\"q\"><Parameter name=\"type\" type=\"string\" value=\"error norm\"/>"
        "<Parameter name=\"field\" type=\"string\" value=\"" +
        field +
        "\"/>"
        "<Parameter name=\"to\" type=\"double\" value=\"1.5\"/><Parameter name=\"unit\" type=\"string\" value=\"half width\"/>"
        "<ParameterList name=\"exact\"><Parameter name=\"type\" type=\"string\" value=\"hertz line contact\"/>"
        "<Parameter name=\"load\" type=\"double\" value=\"F*t\"/></ParameterList></ParameterList>";
    Symbols symbols;
    symbols.variables["F"] = 7.0;
    std::vector<Diagnostic> diagnostics;
    read_parameters(entry, parse_xml(text, "scene.xml"), symbols, {}, diagnostics);
    return diagnostics;
  };
  Entry good, bad;
  EXPECT_TRUE(read("contact pressure", good).empty());
  const auto norm = std::dynamic_pointer_cast<ErrorNorm>(good.quantity.options);
  ASSERT_NE(norm, nullptr);
  EXPECT_EQ(norm->to, 1.5);
  const auto hertz = std::dynamic_pointer_cast<HertzLineContact>(norm->exact.options);
  ASSERT_NE(hertz, nullptr);
  EXPECT_EQ(hertz->load(2.0), 14.0);
  EXPECT_EQ(read("stress", bad).size(), 1u) << "a range means nothing to a stress";
}

}  // namespace
}  // namespace mortise
