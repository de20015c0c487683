// The runs of a study: combinations, exclusions, names, settings.

#include "mortise/studies/study_points.hpp"

#include <gmock/gmock.h>

#include "mortise/input/read_parameters.hpp"

namespace mortise {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

StudyFile study(const std::string& more, std::vector<Diagnostic>& diagnostics) {
  const std::string text = R"(<ParameterList name="study">
  <Parameter name="scene" type="string" value="scene.xml"/>
  <ParameterList name="settings"><Parameter name="variables/F" type="int" value="800"/></ParameterList>
  <ParameterList name="axes">
    <ParameterList name="element">
      <ParameterList name="choices">
        <ParameterList name="Q4"><Parameter name="bodies/a/element" type="string" value="Q4"/></ParameterList>
        <ParameterList name="Q4 F-bar">
          <ParameterList name="bodies"><ParameterList name="a"><Parameter name="element" type="string" value="Q4 F-bar"/></ParameterList></ParameterList>
          <Parameter name="ranks" type="int" value="2"/>
        </ParameterList>
      </ParameterList>
    </ParameterList>
    <ParameterList name="n"><Parameter name="setting" type="string" value="variables/n"/><Parameter name="values" type="string" value="2, 4, 8"/></ParameterList>
  </ParameterList>
  <ParameterList name="quantities"><ParameterList name="peak"><Parameter name="measure" type="string" value="itself"/></ParameterList></ParameterList>
)" + more + "</ParameterList>";
  StudyFile file;
  read_parameters(file, parse_xml(text, "study.xml"), {}, {}, diagnostics);
  return file;
}

std::vector<std::string> names(const std::vector<StudyPoint>& points) {
  std::vector<std::string> all;
  for (const auto& point : points) all.push_back(point.name);
  return all;
}

TEST(StudyPoints, AreAllCombinationsTheLastAxisFirst) {
  std::vector<Diagnostic> diagnostics;
  const auto points = study_points(study("", diagnostics), diagnostics);
  EXPECT_THAT(diagnostics, IsEmpty());
  EXPECT_THAT(names(points), ElementsAre("element=Q4,n=2", "element=Q4,n=4", "element=Q4,n=8", "element=Q4_F-bar,n=2", "element=Q4_F-bar,n=4",
                                         "element=Q4_F-bar,n=8"));
  EXPECT_THAT(points[1].words(), ElementsAre("variables/F=800", "bodies/a/element=Q4", "variables/n=4"));
  EXPECT_THAT(points[5].words(), ElementsAre("variables/F=800", "bodies/a/element=Q4 F-bar", "variables/n=8"));
  EXPECT_EQ(points[1].ranks, 1);
  EXPECT_EQ(points[5].ranks, 2);
  EXPECT_EQ(points[5].label(), "Q4 F-bar, n = 8");
}

TEST(StudyPoints, HaveTheTimeLimitOfTheStudyUnlessTheirSettingsSayAnother) {
  std::vector<Diagnostic> diagnostics;
  EXPECT_EQ(study_points(study("", diagnostics), diagnostics)[0].time_limit, std::numeric_limits<double>::infinity());
  StudyFile limited = study(R"(<Parameter name="time limit" type="double" value="60"/>)", diagnostics);
  limited.axes[1].value.values.value = {"2", "4"};
  limited.axes[0].value.choices[1].value.all.push_back({"time limit", "7.5", {}});
  const auto points = study_points(limited, diagnostics);
  EXPECT_THAT(diagnostics, IsEmpty());
  EXPECT_EQ(points[1].time_limit, 60.0);
  EXPECT_EQ(points[2].time_limit, 7.5);
  EXPECT_THAT(points[2].words(), ElementsAre("variables/F=800", "bodies/a/element=Q4 F-bar", "variables/n=2"));
}

TEST(StudyPoints, LeaveOutWhatIsExcluded) {
  std::vector<Diagnostic> diagnostics;
  const std::string exclude = R"(<ParameterList name="exclude">
    <ParameterList name="one"><Parameter name="element" type="string" value="Q4"/><Parameter name="n" type="string" value="4, 8"/></ParameterList>
    <ParameterList name="two"><Parameter name="n" type="string" value="2"/></ParameterList></ParameterList>)";
  const auto points = study_points(study(exclude, diagnostics), diagnostics);
  EXPECT_THAT(diagnostics, IsEmpty());
  EXPECT_THAT(names(points), ElementsAre("element=Q4_F-bar,n=4", "element=Q4_F-bar,n=8"));
}

TEST(StudyPoints, SayWhatAnExclusionDoesNotMean) {
  std::vector<Diagnostic> diagnostics;
  const std::string exclude = R"(<ParameterList name="exclude"><ParameterList name="one"><Parameter name="elemnt" type="string" value="Q4"/>
<Parameter name="n" type="string" value="4, 16"/></ParameterList></ParameterList>)";
  study_points(study(exclude, diagnostics), diagnostics);
  ASSERT_THAT(diagnostics, SizeIs(2));
  EXPECT_EQ(diagnostics[0].place.line, 17);
  EXPECT_THAT(to_string(diagnostics[0]), HasSubstr("there is no axis \"elemnt\"; did you mean \"element\"?"));
  EXPECT_EQ(diagnostics[1].place.line, 18);
  EXPECT_THAT(to_string(diagnostics[1]), HasSubstr("there is no value of \"n\" \"16\""));
}

TEST(StudyPoints, EvaluateExpressionsOfVariablesQuantitiesAndUnknowns) {
  StudyPoint point;
  point.symbols.variables["n"] = 4.0;
  point.quantities = {"peak", "n"};
  const auto value = [&](const std::string& text) { return evaluate({text, {"study.xml", 3, ""}}, point, {10.0, 99.0}, 100.0); };
  EXPECT_EQ(value("1/n"), 0.25);  // a variable comes before a quantity of its name
  EXPECT_EQ(value("peak + sqrt(dofs)"), 20.0);
  EXPECT_THROW(value("1/m"), InputError);
}

// 9 axes of 9 values would be 387 million runs.
TEST(StudyPoints, AreNotMoreThanAnybodyRuns) {
  std::vector<Diagnostic> diagnostics;
  StudyFile many = study("", diagnostics);
  many.axes.resize(1);
  many.axes.front().value.choices.clear();
  many.axes.front().value.setting.value = "variables/n";
  many.axes.front().value.values.value = {"1", "2", "3", "4", "5", "6", "7", "8", "9"};
  many.axes.resize(9, many.axes.front());
  EXPECT_THAT(study_points(many, diagnostics), IsEmpty());
  ASSERT_THAT(diagnostics, SizeIs(1));
  EXPECT_THAT(diagnostics.front().message, HasSubstr("more than 10000 combinations"));
}

}  // namespace
}  // namespace mortise
