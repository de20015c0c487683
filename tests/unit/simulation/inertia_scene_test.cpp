// Scenes with inertia: what is refused, and that nothing of it exists in scenes without.

#include <gtest/gtest.h>
#include <unistd.h>

#include <Tpetra_Core.hpp>
#include <Tpetra_Vector.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "mortise/nonlinear/semi_smooth_system.hpp"
#include "mortise/simulation/model/model.hpp"
#include "mortise/simulation/scene/read_scene.hpp"

namespace mortise {
namespace {

const std::string text = R"xml(<ParameterList name="thrown block">
  <ParameterList name="materials"><ParameterList name="soft">
    <Parameter name="type" type="string" value="hencky"/>
    <Parameter name="young's modulus" type="double" value="1000"/>
    <Parameter name="poisson's ratio" type="double" value="0.3"/>
    <Parameter name="density" type="double" value="2"/>
  </ParameterList></ParameterList>
  <ParameterList name="bodies">
    <ParameterList name="block">
      <Parameter name="material" type="string" value="soft"/>
      <ParameterList name="mesh">
        <Parameter name="type" type="string" value="block"/>
        <Parameter name="cells x" type="int" value="2"/>
        <Parameter name="cells y" type="int" value="2"/>
      </ParameterList>
    </ParameterList>
    <ParameterList name="tool">
      <Parameter name="rigid" type="bool" value="true"/>
      <Parameter name="density" type="double" value="3"/>
      <ParameterList name="mesh">
        <Parameter name="type" type="string" value="block"/>
        <Parameter name="cells x" type="int" value="2"/>
        <Parameter name="cells y" type="int" value="2"/>
        <Parameter name="translation" type="string" value="3, 0"/>
      </ParameterList>
    </ParameterList>
  </ParameterList>
  <ParameterList name="inertia">
    <Parameter name="scheme" type="string" value="generalised alpha"/>
  </ParameterList>
  <ParameterList name="initial conditions"><ParameterList name="throw">
    <Parameter name="body" type="string" value="block"/>
    <Parameter name="velocity x" type="double" value="1"/>
  </ParameterList></ParameterList>
</ParameterList>
)xml";

class InertiaScene : public ::testing::Test {
 protected:
  InertiaScene() : file_(std::filesystem::temp_directory_path() / ("mortise_inertia_" + std::to_string(getpid()) + ".xml")) {}
  ~InertiaScene() override { std::filesystem::remove(file_); }

  static std::string replaced(const std::string& from, const std::string& to) {
    std::string result = text;
    const std::size_t at = result.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return result.replace(at, from.size(), to);
  }
  static std::string with(const std::string& list, const std::string& parameter) {
    const std::string opening = "<ParameterList name=\"" + list + "\">";
    return replaced(opening, opening + parameter);
  }
  Scene read(const std::string& content) {
    std::ofstream(file_) << content;
    return read_scene(*comm_, file_, {});
  }
  /// Message of the error of a scene or of its model; "" without.
  std::string refusal(const std::string& content) {
    try {
      Model(comm_, read(content), Timers());
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  void expect_refusal(const std::string& content, const std::string& words) {
    const std::string message = refusal(content);
    EXPECT_NE(message.find(words), std::string::npos) << message;
  }

  RCP<const Communicator> comm_ = Tpetra::getDefaultComm();
  std::filesystem::path file_;
};

std::string number(const std::string& name, const std::string& value) {
  return "<Parameter name=\"" + name + "\" type=\"double\" value=\"" + value + "\"/>";
}

TEST_F(InertiaScene, HasMassAndTime) {
  const Model model(comm_, read(text), Timers());
  ASSERT_TRUE(model.parts().time);
  Vector ones(model.parts().dofs);
  ones.putScalar(1.0);
  EXPECT_NEAR(model.inertia().mass->times(ones)->dot(ones), 2.0 * (2.0 + 3.0), 1e-12);  // both directions; the tool by its nodes
}

TEST_F(InertiaScene, WithoutASchemeNothingOfItExists) {
  std::string content = replaced("<ParameterList name=\"inertia\">", "<ParameterList name=\"inertia\"><!--");
  content.replace(content.find("generalised alpha\"/>"), 20, "generalised alpha\"/>-->");
  const std::size_t from = content.find("<ParameterList name=\"initial conditions\">");
  content.erase(from, content.rfind("</ParameterList>") - from);
  content.replace(content.find("<Parameter name=\"rigid\" type=\"bool\" value=\"true\"/>"), 50,
                  "<Parameter name=\"material\" type=\"string\" value=\"soft\"/>");
  content.replace(content.find("<Parameter name=\"density\" type=\"double\" value=\"3\"/>"), 51, "");
  content.replace(content.rfind("</ParameterList>"), 0, R"xml(<ParameterList name="boundary conditions">
    <ParameterList name="one"><Parameter name="set" type="string" value="block/bottom"/><Parameter name="x" type="double" value="0"/>
      <Parameter name="y" type="double" value="0"/></ParameterList>
    <ParameterList name="other"><Parameter name="set" type="string" value="tool/bottom"/><Parameter name="x" type="double" value="0"/>
      <Parameter name="y" type="double" value="0"/></ParameterList></ParameterList>)xml");
  const Model model(comm_, read(content), Timers());
  EXPECT_FALSE(model.parts().time);
  EXPECT_FALSE(model.inertia().mass);
  for (const auto& contribution : model.parts().contributions) EXPECT_EQ(contribution->uses().time_derivatives, 0);
  const Timers timers;
  const SemiSmoothSystem system(model.parts(), timers);
  const Vector x(system.map());
  const AcceptedState state = system.initial_state(x);
  EXPECT_FALSE(state.rates);
  const StepContext context = system.step_from(state, 1.0);
  EXPECT_FALSE(context.step);
  system.commit(system.evaluate(x, context));
  std::ostringstream times;
  timers.stacked().stopBaseTimer();
  timers.stacked().report(times, model.mesh()->comm);
  EXPECT_EQ(times.str().find("inertia"), std::string::npos) << times.str();
}

TEST_F(InertiaScene, RefusesWhatMakesNoSense) {
  expect_refusal(with("inertia", number("spectral radius", "1.5")), "spectral radius");
  const auto newmark = [&](const std::string& parameters) {
    std::string content = with("inertia", parameters);
    return content.replace(content.find("generalised alpha"), 17, "newmark");
  };
  expect_refusal(newmark(number("beta", "0.2") + number("gamma", "0.6")), "unstable for 2 beta < gamma");
  expect_refusal(newmark(""), "ring without end");
  EXPECT_EQ(refusal(newmark(number("beta", "0.3025") + number("gamma", "0.6"))), "");
  EXPECT_EQ(refusal(with("inertia", number("beta", "0.2") + number("gamma", "0.6"))), "") << "they are Newmark's";
  expect_refusal(with("inertia", number("gamma", "0.4")), "gamma");
  expect_refusal(with("inertia", number("mass damping", "-1")), "mass damping");
  expect_refusal(with("inertia", number("impact tolerance", "0")), "impact tolerance");
  expect_refusal(with("inertia", number("spectral radius", "1")), "ring without end");
  expect_refusal(replaced(number("density", "2"), ""), "block");
  expect_refusal(replaced(number("density", "3"), ""), "moves and has no mass");
  expect_refusal(replaced(number("density", "3"), number("mass", "3")), "moments of inertia");
  expect_refusal(replaced("generalised alpha", "none"), "need inertia");
  expect_refusal(with("inertia", "<Parameter name=\"contact condition\" type=\"string\" value=\"gap rate\"/>"), "a \"spectral radius\" of 1");
  expect_refusal(replaced(number("density", "2"), number("density", "-2")), "density");
  expect_refusal(with("inertia", number("stiffness damping", "-1")), "stiffness damping");
  expect_refusal(with("inertia", number("error tolerance", "0")), "error tolerance");
  expect_refusal(with("inertia", number("beta", "0")), "beta");
  expect_refusal(with("throw", "<Parameter name=\"axis\" type=\"string\" value=\"0, 0, 0\"/>"), "no direction");
}

TEST_F(InertiaScene, ConditionsOnTheGapRateAreExact) {
  std::string content =
      with("inertia", number("spectral radius", "1") + "<Parameter name=\"contact condition\" type=\"string\" value=\"gap rate\"/>");
  const std::string pair = R"xml(<ParameterList name="contact"><ParameterList name="pair">
    <Parameter name="slave" type="string" value="block/right"/><Parameter name="master" type="string" value="tool/left"/>
    <ParameterList name="formulation"><Parameter name="type" type="string" value="penalty"/></ParameterList>
  </ParameterList></ParameterList>)xml";
  content.insert(content.rfind("</ParameterList>"), pair);
  expect_refusal(content, "\"penalty\" gives way");
}

// A rigid body has the weight of its mass, and nodes without mass have none: bodies fall alike.
TEST_F(InertiaScene, WeightIsThatOfTheMass) {
  std::string content = text;
  const std::string more = R"xml(<ParameterList name="loads"><ParameterList name="weight">
    <Parameter name="type" type="string" value="gravity"/><Parameter name="y" type="double" value="-10"/>
  </ParameterList></ParameterList>
  <ParameterList name="contact"><ParameterList name="pair">
    <Parameter name="slave" type="string" value="block/right"/><Parameter name="master" type="string" value="tool/left"/>
  </ParameterList></ParameterList>)xml";
  content.insert(content.rfind("</ParameterList>"), more);
  const Model model(comm_, read(content), Timers());
  EXPECT_GT(model.inertia().without_mass, 0);
  const SemiSmoothSystem system(model.parts(), Timers());
  const AcceptedState state = system.initial_state(Vector(system.map()), Vector(model.parts().dofs), false);
  const auto a = state.rates->acceleration->getLocalViewHost(Tpetra::Access::ReadOnly);
  const Mesh& mesh = *model.mesh();
  for (LocalOrdinal node = 0; node < mesh.owned_body_count(); ++node) {
    EXPECT_NEAR(a(2 * node, 0), 0.0, 1e-10);
    EXPECT_NEAR(a(2 * node + 1, 0), -10.0, 1e-10);
  }
}

// A body that does not turn has no forces that could ring.
TEST_F(InertiaScene, RigidBodiesThatDoNotTurnTakeAnyScheme) {
  std::string content = with("inertia", number("spectral radius", "1"));
  content.insert(content.rfind("</ParameterList>"), R"xml(<ParameterList name="boundary conditions"><ParameterList name="guide">
    <Parameter name="set" type="string" value="tool/reference"/><Parameter name="rotation" type="double" value="0"/>
  </ParameterList></ParameterList>)xml");
  EXPECT_EQ(refusal(content), "");
}

TEST_F(InertiaScene, ABodyMayBeMassless) {
  std::string content = replaced(number("density", "2"), "");
  const std::string opening = "<ParameterList name=\"block\">";
  content.insert(content.find(opening) + opening.size(), "<Parameter name=\"massless\" type=\"bool\" value=\"true\"/>");
  EXPECT_EQ(refusal(content), "");
}

}  // namespace
}  // namespace mortise
