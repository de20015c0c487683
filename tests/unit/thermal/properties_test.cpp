// Properties of the temperature: parameters, tables with kinks, loads by name.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "heat_model.hpp"
#include "mortise/input/read_parameters.hpp"
#include "mortise/input/xml.hpp"

namespace mortise {
namespace {

using namespace test;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

template <class Options>
std::string read(Options& options, const std::string& parameters) {
  std::vector<Diagnostic> diagnostics;
  const XmlList root = parse_xml("<ParameterList name=\"heat\">\n" + parameters + "</ParameterList>\n", "heat.xml");
  read_parameters(options, root, {}, {}, diagnostics);
  std::string all;
  for (const Diagnostic& diagnostic : diagnostics) all += to_string(diagnostic) + "\n";
  return all;
}

std::string parameter(const std::string& name, const std::string& value) {
  return "<Parameter name=\"" + name + "\" type=\"string\" value=\"" + value + "\"/>\n";
}

TEST(ThermalProperties, AreReadAsNumbersExpressionsAndTables) {
  ThermalProperties properties;
  EXPECT_EQ(read(properties, parameter("conductivity", "2 + 0.5*temperature") +
                                 "<ParameterList name=\"specific heat table\">\n"
                                 "<Parameter name=\"temperatures\" type=\"string\" value=\"0, 100, 200\"/>\n"
                                 "<Parameter name=\"values\" type=\"string\" value=\"1, 3, 4\"/>\n</ParameterList>\n" +
                                 parameter("conductivity acts in", "reference") + parameter("source", "t + x*temperature")),
            "");
  EXPECT_EQ(properties.acts_in, ConductivityActsIn::reference);
  EXPECT_DOUBLE_EQ(properties.conductivity.at(4.0), 4.0);
  EXPECT_NEAR(properties.conductivity.with_slope(4.0).slope, 0.5, 1e-9);
  EXPECT_DOUBLE_EQ(properties.specific_heat.at(150.0), 3.5);
  EXPECT_DOUBLE_EQ(properties.specific_heat.with_slope(150.0).slope, 0.01);
  EXPECT_DOUBLE_EQ(properties.source->at({1.0, 2.0, 0.0, 0.0, 3.0}), 7.0);
  EXPECT_FALSE(properties.lumped_capacity);
}

TEST(ThermalProperties, RefuseWhatHasNoMeaning) {
  ThermalProperties none, half, both, negative;
  EXPECT_EQ(read(none, ""), "") << "nothing is said of heat";
  EXPECT_THAT(read(half, parameter("specific heat", "2")), HasSubstr("there is no conductivity"));
  const std::string said = read(both, parameter("conductivity", "2") +
                                          "<ParameterList name=\"conductivity table\">\n"
                                          "<Parameter name=\"temperatures\" type=\"string\" value=\"0\"/>\n"
                                          "<Parameter name=\"values\" type=\"string\" value=\"1\"/>\n</ParameterList>\n");
  EXPECT_THAT(said, HasSubstr("an expression and a table are given; give one of them"));
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
  EXPECT_THAT(read(negative, parameter("conductivity", "-2")), HasSubstr("the conductivity is -2; allowed: >= 0 and finite"));
}

TEST(ThermalProperties, LoadsAreMadeByName) {
  std::vector<std::string> names;
  for (const auto& entry : thermal_load_registry().entries()) names.push_back(entry.name);
  EXPECT_THAT(names, ElementsAre("heat flux", "convection", "radiation"));
  ConvectionOptions convection;
  EXPECT_EQ(read(convection, parameter("set", "body/left") + parameter("coefficient", "5 + 0.1*temperature") + parameter("surroundings", "20 + x")),
            "");
  EXPECT_DOUBLE_EQ(convection.coefficient.at({0.0, 0.0, 0.0, 0.0, 10.0}), 6.0);
  RadiationOptions radiation;
  EXPECT_THAT(read(radiation, parameter("set", "body/left") + parameter("surroundings", "20")), HasSubstr("stefan-boltzmann constant"));
}

// A wall whose conductivity has a kink: k = 1 up to 10, then it rises by 0.1 for each degree. With Phi = integral of k, Phi is linear in x.
TEST(ThermalProperties, AWallWithATableThatHasKinks) {
  HeatSetup setup;
  setup.thickness = 1.0;
  setup.properties.conductivity = TemperatureFunction({10.0, 30.0}, {1.0, 3.0});
  const auto Phi = [](double theta) { return theta < 10.0 ? theta : theta + 0.05 * (theta - 10.0) * (theta - 10.0); };
  const double cold = 0.0, hot = 25.0, q = Phi(hot) - Phi(cold);
  const auto error = [&](int cells) {
    const HeatModel model(distorted_mesh(CellShape::quadrilateral4, cells, 0.0), setup);
    const SteadyHeat solved = solve_steady(model, {std::make_shared<HeatConduction>(model.bodies)},
                                           {prescribe("body/left", cold), prescribe("body/right", hot)}, hot, 10.0);
    EXPECT_LE(solved.newton_steps, 10);
    double power = 0.0;
    const auto forces = solved.forces.getLocalViewHost(Tpetra::Access::ReadOnly);
    for (const LocalOrdinal node : model.mesh->node_sets.at("body/right")) power += forces(node, 0);
    return std::abs(power - q) / q;
  };
  EXPECT_LE(error(32), 1.0 / (32.0 * 32.0));
}

}  // namespace
}  // namespace mortise
