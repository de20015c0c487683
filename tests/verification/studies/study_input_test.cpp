// `mortise study`: bad studies, and a machine that cannot draw.

#include <gtest/gtest.h>

#include "study_support.hpp"

namespace {

using namespace study_support;
namespace files = std::filesystem;

TEST(Study, EverythingThatIsWrongIsSaidAtOnceWithItsLine) {
  const std::string results = directory + "/bad", file = write_study("bad", R"(<ParameterList name="axes">
<ParameterList name="n"><Parameter name="setting" type="string" value="variables/m"/><Parameter name="value" type="string" value="2, 4"/></ParameterList>
<ParameterList name="element"><ParameterList name="choices"><ParameterList name="Q5">
<Parameter name="bodies/inner ring/element" type="string" value="Q5"/></ParameterList></ParameterList></ParameterList>
<ParameterList name="ranks"><Parameter name="setting" type="string" value="ranks"/><Parameter name="values" type="string" value="0"/></ParameterList>
</ParameterList>
<Parameter name="series" type="string" value="elemnt"/>
<ParameterList name="quantities">
<ParameterList name="stres_error"><Parameter name="measure" type="string" value="itself"/></ParameterList>
<ParameterList name="stress_error"><Parameter name="reference" type="string" value="finest"/></ParameterList>
<ParameterList name="displacement_error"/>
</ParameterList>
)");
  files::remove_all(results);
  const Ending ending = study(file, results);
  EXPECT_EQ(ending.code, 2) << ending.output;
  for (const char* expected : {":5: error: axes/n: \"values\" is missing", ":5: error: axes/n: unknown parameter \"value\"; did you mean \"values\"?",
                               ":8: error: axes/ranks: \"ranks\" is \"0\"", ":10: error: there is no axis \"elemnt\"; did you mean \"element\"?",
                               ":14: error: quantities/displacement_error: \"value\" is missing"})
    EXPECT_TRUE(contains(ending.output, expected)) << expected << "\n" << ending.output;
  EXPECT_FALSE(files::exists(results));
}

TEST(Study, SettingsThatTheSceneDoesNotKnowAreSaidWithTheLineOfTheStudy) {
  const std::string results = directory + "/unknown", file = write_study("unknown", R"(<ParameterList name="axes">
<ParameterList name="element"><ParameterList name="choices"><ParameterList name="Q5">
<Parameter name="bodies/inner ring/element" type="string" value="Q5"/></ParameterList></ParameterList></ParameterList>
)" + meshes + R"(</ParameterList>
<ParameterList name="settings"><Parameter name="newton/maximum iteration" type="int" value="9"/></ParameterList>
<ParameterList name="quantities">
<ParameterList name="stres_error"><Parameter name="measure" type="string" value="itself"/></ParameterList>
</ParameterList>
)");
  files::remove_all(results);
  const Ending ending = study(file, results);
  EXPECT_EQ(ending.code, 2) << ending.output;
  for (const char* expected : {":6: error: bodies/inner ring: \"element\" is \"Q5\"; allowed: ",
                               ":10: error: newton: unknown parameter \"maximum iteration\"; did you mean"})
    EXPECT_TRUE(contains(ending.output, expected)) << expected << "\n" << ending.output;
  EXPECT_FALSE(files::exists(results));
  EXPECT_EQ(launch({MORTISE, "study", directory + "/none.xml"}).code, 5);
}

TEST(Study, WithoutMatplotlibNothingIsRun) {
  const std::string results = directory + "/no_python",
                    file = write_study("no_python", "<ParameterList name=\"axes\">\n" + meshes + R"(</ParameterList>
<ParameterList name="quantities"><ParameterList name="stress_error"><Parameter name="measure" type="string" value="itself"/></ParameterList></ParameterList>
)");
  const Ending ending = study(file, results, {"env", "MORTISE_PYTHON=/nowhere/python3"});
  EXPECT_EQ(ending.code, 5) << ending.output;
  EXPECT_TRUE(contains(ending.output, "please install python3-matplotlib and python3-h5py")) << ending.output;
  EXPECT_FALSE(files::exists(results + "/points"));
}

}  // namespace
