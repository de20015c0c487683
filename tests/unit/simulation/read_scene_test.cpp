#include "mortise/simulation/scene/read_scene.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <Tpetra_Core.hpp>
#include <filesystem>
#include <fstream>

#include "mortise/input/parameter_tree.hpp"
#include "mortise/simulation/model/model.hpp"

namespace mortise {
namespace {

const std::string text = R"xml(<ParameterList name="one block">
  <ParameterList name="variables">
    <Parameter name="n" type="int" value="3"/>
    <Parameter name="E" type="string" value="1000*n"/>
  </ParameterList>
  <ParameterList name="materials"><ParameterList name="soft">
    <Parameter name="type" type="string" value="hencky"/>
    <Parameter name="young's modulus" type="string" value="E"/>
    <Parameter name="poisson's ratio" type="double" value="0.3"/>
  </ParameterList></ParameterList>
  <ParameterList name="bodies"><ParameterList name="block">
    <Parameter name="material" type="string" value="soft"/>
    <Parameter name="element" type="string" value="Q4 F-bar"/>
    <ParameterList name="mesh">
      <Parameter name="type" type="string" value="block"/>
      <Parameter name="cells x" type="string" value="2*n"/>
      <Parameter name="cells y" type="string" value="n"/>
    </ParameterList>
  </ParameterList></ParameterList>
  <ParameterList name="boundary conditions"><ParameterList name="floor">
    <Parameter name="set" type="string" value="block/bottom"/>
    <Parameter name="x" type="double" value="0"/>
    <Parameter name="y" type="double" value="0"/>
  </ParameterList></ParameterList>
</ParameterList>
)xml";

class ReadScene : public ::testing::Test {
 protected:
  ReadScene() : file_(std::filesystem::temp_directory_path() / ("mortise_scene_" + std::to_string(getpid()) + ".xml")) {}
  ~ReadScene() override { std::filesystem::remove(file_); }

  Scene read(const std::string& content, const std::vector<std::string>& settings = {}) {
    std::ofstream(file_) << content;
    return read_scene(*comm_, file_, settings);
  }
  std::string complaint(const std::string& content) {
    try {
      read(content);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  static std::string replaced(const std::string& from, const std::string& to) {
    std::string changed = text;
    return changed.replace(changed.find(from), from.size(), to);
  }

  RCP<const Communicator> comm_ = Tpetra::getDefaultComm();
  std::filesystem::path file_;
};

TEST_F(ReadScene, VariablesReachEveryValue) {
  const Scene scene = read(text);
  EXPECT_EQ(scene.name, "one block");
  EXPECT_EQ(scene.kinematics, Kinematics::plane_strain);
  EXPECT_EQ(scene.bodies.at(0).value.element.value, ElementType::q4_f_bar);
  EXPECT_DOUBLE_EQ(scene.materials.at(0).value.law.options->youngs_modulus, 3000.0);
  const Model model(comm_, scene, Timers());
  EXPECT_EQ(model.size().elements, 18);
  EXPECT_EQ(model.dofs(), 2 * 7 * 4);
  EXPECT_EQ(model.slave_nodes(), 0);
  EXPECT_EQ(model.contact(), nullptr);
}

TEST_F(ReadScene, SettingsReplaceVariables) {
  const Scene scene = read(text, {"variables/n=5", "kinematics=axisymmetric"});
  EXPECT_DOUBLE_EQ(scene.materials.at(0).value.law.options->youngs_modulus, 5000.0);
  EXPECT_EQ(scene.kinematics, Kinematics::axisymmetric);
}

TEST_F(ReadScene, OnlyWhatTheSceneNamesIsBuilt) {
  const Model model(comm_, read(text), Timers());
  ASSERT_EQ(model.parts().contributions.size(), 1u);
  EXPECT_EQ(model.parts().contributions.front()->name(), "bulk");
  for (const auto& [effect, members] : model.effects()) {
    const bool expected = effect == "finite strain" || effect == "F-bar" || effect == "boundary conditions";
    EXPECT_EQ(members.size(), expected ? 1u : 0u) << effect;
  }
}

TEST_F(ReadScene, CombinationsWithoutMeaningAreRefusedByName) {
  EXPECT_NE(complaint(replaced("hencky", "small strain linear")).find("F-bar"), std::string::npos);
  EXPECT_NE(complaint(replaced("<ParameterList name=\"variables\">",
                               "<Parameter name=\"kinematics\" type=\"string\" value=\"plane stress\"/><ParameterList name=\"variables\">"))
                .find("plane stress"),
            std::string::npos);
}

TEST_F(ReadScene, ASceneWithoutBodiesIsRefused) {
  EXPECT_NE(complaint("<ParameterList name=\"nothing\"></ParameterList>").find("no bodies"), std::string::npos);
}

TEST_F(ReadScene, UnknownFieldsAreRefused) {
  const std::string message = complaint(replaced("<ParameterList name=\"variables\">",
                                                 "<ParameterList name=\"output\"><Parameter name=\"fields\" type=\"string\" "
                                                 "value=\"displacment\"/></ParameterList><ParameterList name=\"variables\">"));
  EXPECT_NE(message.find("did you mean \"displacement\""), std::string::npos) << message;
}

TEST_F(ReadScene, EverythingSpelledOutReadsBackAsTheSame) {
  const Scene scene = read(text);
  const auto spelled_out = [](const Scene& of) {
    return to_scene_xml(collect_parameters(of.name, of, CollectParameters::What::values), symbol_lists(of.symbols));
  };
  const std::string once = spelled_out(scene);
  const Scene again = read(once);
  EXPECT_EQ(spelled_out(again), once);
  EXPECT_EQ(scene.bodies[0].value.material.place.line, 12) << "places stay";
}

}  // namespace
}  // namespace mortise
