// Values without meaning: failures that all ranks know, with place, value and what is allowed; errors of what is given.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Tpetra_MultiVector.hpp>

#include "heat_model.hpp"

namespace mortise {
namespace {

using namespace test;
using ::testing::AllOf;
using ::testing::HasSubstr;

HeatSetup plain_setup() {
  HeatSetup setup;
  setup.properties.conductivity = 2.0;
  setup.properties.specific_heat = 0.5;
  return setup;
}

/// The failure that all ranks throw of a contribution whose temperature is 1 but for 400 beyond x = 0.9, and of its Jacobian.
std::pair<FailureKind, std::string> failure_of(const HeatModel& model, Contribution& contribution, const VectorField& u = {}, double hot = 400.0) {
  const Vector x = model.unknowns([&](const Position& X) { return X[0] > 0.9 ? hot : 1.0; }, u);
  Configuration at{0.5, x, x};
  at.velocity = at.local_velocity = &x;
  Vector residual(model.space->dofs());
  Matrix jacobian(model.space->graph());
  std::optional<StepFailure> of_residual, of_jacobian;
  contribution.add_residual(at, residual, of_residual);
  contribution.add_jacobian(at, {0.0, 2.0, 1.0, nullptr}, jacobian, of_jacobian);
  EXPECT_EQ(of_residual.has_value(), of_jacobian.has_value());
  try {
    throw_if_any(*model.mesh->comm, of_residual);
  } catch (const StepFailure& failure) {
    return {failure.kind(), failure.what()};
  }
  return {FailureKind::diverged, "no failure"};
}

TEST(HeatFailures, NameBodyPlaceTemperatureValueAndRange) {
  HeatSetup setup = plain_setup();
  setup.properties.conductivity = of_temperature([](double theta) { return 2.0 - 0.01 * theta; }, "2 - 0.01 temperature");
  setup.properties.specific_heat = of_temperature([](double theta) { return theta < 300.0 ? 1.0 : 0.0; }, "steps");
  setup.properties.source = function_of([](const std::vector<double>& at) { return 1.0 / (at[4] < 300.0 ? 1.0 : 0.0); }, "poles");
  const HeatModel model(strip(4, 4, 1.0), setup);
  HeatConduction conduction(model.bodies);
  HeatCapacity capacity(model.bodies);
  HeatSource source(model.bodies);
  const auto of_conduction = failure_of(model, conduction), of_capacity = failure_of(model, capacity), of_source = failure_of(model, source);
  EXPECT_EQ(of_conduction.first, FailureKind::input);
  EXPECT_THAT(of_conduction.second,
              AllOf(HasSubstr("body \"body\""), HasSubstr("the conductivity \"2 - 0.01 temperature\" is -1.1"), HasSubstr("at the temperature 315.6"),
                    HasSubstr("in element "), HasSubstr("at (0.947169, "), HasSubstr("allowed: >= 0 and finite")));
  EXPECT_EQ(of_capacity.first, FailureKind::input);
  EXPECT_THAT(of_capacity.second,
              AllOf(HasSubstr("the specific heat \"steps\" is 0 at the temperature 315.6"), HasSubstr("allowed: > 0 and finite")));
  EXPECT_THAT(of_source.second, AllOf(HasSubstr("the heat source \"poles\" is inf at the temperature 315.6"), HasSubstr("allowed: finite")));
}

TEST(HeatFailures, AFunctionThatThrowsIsNamedWithItsReason) {
  HeatSetup setup = plain_setup();
  setup.properties.conductivity = of_temperature(
      [](double theta) -> double {
        if (theta > 300.0) throw std::runtime_error("out of its range");
        return 1.0;
      },
      "host");
  const HeatModel model(strip(4, 4, 1.0), setup);
  HeatConduction conduction(model.bodies);
  EXPECT_THAT(failure_of(model, conduction).second, HasSubstr("the conductivity \"host\" is nan (out of its range)"));
}

TEST(HeatFailures, LumpedCapacityNamesTheNode) {
  HeatSetup setup = plain_setup();
  setup.properties.lumped_capacity = true;
  setup.properties.specific_heat = of_temperature([](double theta) { return 300.0 - theta; });
  const HeatModel model(strip(4, 1, 1.0), setup);
  HeatCapacity capacity(model.bodies);
  EXPECT_THAT(failure_of(model, capacity).second, AllOf(HasSubstr("is -100 at the temperature 400 in element"), HasSubstr("at (1, ")));
}

TEST(HeatFailures, AnElementThatIsTurnedInsideOut) {
  HeatSetup setup = plain_setup();
  setup.displacement = true;
  const HeatModel model(strip(4, 4, 1.0), setup);
  HeatConduction conduction(model.bodies);
  const auto [kind, message] = failure_of(model, conduction, [](const Position& X) -> Position { return {X[0] > 0.9 ? -0.5 : 0.0, 0.0, 0.0}; });
  EXPECT_EQ(kind, FailureKind::inverted_element);
  EXPECT_THAT(message, AllOf(HasSubstr("body \"body\": element "), HasSubstr("is turned inside out, det F = -1")));
}

TEST(HeatFailures, OfLoadsNameTheSet) {
  const HeatModel model(strip(4, 4, 1.0), plain_setup());
  const auto radiation = load_on<RadiationOptions>(model, "body/right", [](RadiationOptions& options) {
    options.stefan_boltzmann = 1.0;
    options.surroundings = 300.0;
  });
  const auto of_radiation = failure_of(model, *radiation, {}, -5.0);
  EXPECT_EQ(of_radiation.first, FailureKind::input);
  EXPECT_THAT(of_radiation.second, AllOf(HasSubstr("radiation on \"body/right\": the absolute temperature of the surface is -5 at (1, "),
                                         HasSubstr("t = 0.5"), HasSubstr("allowed: > 0 and finite")));
  const auto cooling =
      convection(model, "body/right", function_of([](const std::vector<double>& at) { return 300.0 - at[4]; }, "300 - temperature"), 20.0);
  EXPECT_THAT(failure_of(model, *cooling).second,
              AllOf(HasSubstr("convection on \"body/right\": the coefficient \"300 - temperature\" is -100"), HasSubstr("allowed: >= 0 and finite")));
  const auto around = convection(model, "body/right", 1.0, function_of([](const std::vector<double>&) { return std::nan(""); }, "nothing"));
  EXPECT_THAT(failure_of(model, *around).second, HasSubstr("the temperature of the surroundings \"nothing\" is nan"));
  const auto flux = heat_flux(model, "body/right", function_of([](const std::vector<double>& at) { return 1.0 / (at[0] - 0.5); }, "pole"));
  EXPECT_THAT(failure_of(model, *flux).second,
              AllOf(HasSubstr("heat flux on \"body/right\": the flux \"pole\" is inf"), HasSubstr("allowed: finite")));
}

/// The InputError of a function, which every rank throws.
template <class Function>
std::string error_of(const Function& function) {
  try {
    function();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(HeatErrors, OfProperties) {
  const auto error = [](const std::function<void(HeatSetup&)>& change, CellShape shape = CellShape::quadrilateral4) {
    HeatSetup setup = plain_setup();
    change(setup);
    return error_of([&] { HeatModel(strip(2, 2, 1.0, shape), setup); });
  };
  EXPECT_EQ(error([](HeatSetup&) {}), "no error");
  EXPECT_THAT(error([](HeatSetup& s) { s.properties.conductivity = -1.0; }),
              HasSubstr("body \"body\": the conductivity is -1; allowed: >= 0 and finite"));
  EXPECT_THAT(error([](HeatSetup& s) { s.properties.conductivity = {}; }), HasSubstr("there is no conductivity"));
  EXPECT_THAT(error([](HeatSetup& s) { s.properties.conductivity = {{0.0, 1.0}, {2.0, -1.0}}; }), HasSubstr("the conductivity is -1"));
  EXPECT_THAT(error([](HeatSetup& s) {
                s.properties.conductivity = {{1.0, 0.0}, {2.0, 1.0}};
              }),
              HasSubstr("conductivity: \"temperatures\" of a table has 0 at place 2; numbers have to be finite and ascend"));
  EXPECT_THAT(error([](HeatSetup& s) { s.properties.conductivity = {{1.0, 2.0}, {2.0}}; }), HasSubstr("has 2 numbers and \"values\" 1"));
  EXPECT_THAT(error([](HeatSetup& s) { s.properties.specific_heat = 0.0; }), HasSubstr("the specific heat is 0; allowed: > 0 and finite"));
  EXPECT_THAT(error([](HeatSetup& s) { s.density = 0.0; }), HasSubstr("it has a specific heat, and its density is 0"));
  EXPECT_THAT(error([](HeatSetup& s) { s.properties.lumped_capacity = true; }, CellShape::quadrilateral8),
              HasSubstr("a lumped capacity is for linear cells"));
}

TEST(HeatErrors, OfSets) {
  auto block = std::make_shared<BlockMesh>();
  block->cells_x = block->cells_y = 2;
  auto other = std::make_shared<BlockMesh>(*block);
  other->translation = {1.5, 0.0};
  const RCP<Mesh> mesh = build_mesh(world(), {{"warm", {}, block, CellShape::quadrilateral4}, {"cold", {}, other, CellShape::quadrilateral4}}, {});
  std::vector<char> lives;
  for (LocalOrdinal node = 0; node < mesh->owned_count(); ++node) lives.push_back(mesh->body_of_node[node] == 0 ? 1 : 0);
  const auto space = std::make_shared<FieldSpace>(mesh, std::vector<FieldDeclaration>{{"displacement", 2}, {"temperature", 1, lives}});
  const auto properties = std::make_shared<ThermalProperties>(plain_setup().properties);
  const auto bodies =
      std::make_shared<ThermalBodies>(space, Kinematics::plane_strain, 1.0, std::vector<ThermalBody>{{{}, properties, 1.0}, {{}, nullptr, 0.0}});
  ConvectionOptions options;
  options.set = {"cold/left", {}};
  EXPECT_THAT(error_of([&] { options.make(bodies); }), HasSubstr("the set \"cold/left\" has sides of the body \"cold\", which has no temperature"));
  options.set = {"hot/left", {}};
  EXPECT_THAT(error_of([&] { options.make(bodies); }), HasSubstr("hot/left"));
  options.set = {"warm/left", {}};
  EXPECT_NO_THROW(options.make(bodies));
  EXPECT_THAT(error_of([&] { PrescribedTemperatures(*bodies, {prescribe("cold", 1.0)}); }), HasSubstr("has no temperature"));
  EXPECT_THAT(error_of([&] {
                PrescribedTemperatures(*bodies, {prescribe("warm/left", 1.0), prescribe("warm/top", 2.0)});
              }),
              HasSubstr("prescribed temperature \"warm/top\": it differs from \"warm/left\" at the node at (0, 1)"));
  EXPECT_NO_THROW(PrescribedTemperatures(*bodies, {prescribe("warm/left", 1.0), prescribe("warm/top", 1.0)}));
  // A body without a temperature has no rows, and no flux.
  const Vector x(space->local_dofs());
  for (const auto& flux : bodies->element_heat_fluxes(x, 1)) EXPECT_EQ(flux, (std::array<double, 3>{}));
}

TEST(HeatErrors, APrescribedTemperatureWithoutAValueIsAFailure) {
  const HeatModel model(strip(2, 2, 1.0), plain_setup());
  const PrescribedTemperatures prescribed(*model.bodies,
                                          {prescribe("body/left", function_of([](const std::vector<double>& at) { return 1.0 / at[0]; }, "1 / t"))});
  std::optional<StepFailure> failure;
  prescribed.values(1.0, failure);
  EXPECT_FALSE(failure);
  prescribed.values(0.0, failure);
  EXPECT_THROW(throw_if_any(*model.mesh->comm, failure), StepFailure);
  if (failure)
    EXPECT_THAT(failure->what(), AllOf(HasSubstr("prescribed temperature \"body/left\": \"1 / t\" is inf at t = 0"), HasSubstr("allowed: finite")));
}

}  // namespace
}  // namespace mortise
