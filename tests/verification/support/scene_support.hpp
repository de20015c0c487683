#pragma once
// A scene without errors, what tests do to it, and runs of it.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "launch.hpp"

namespace scene_support {

namespace files = std::filesystem;

/// Two blocks on each other: a scene without errors.
inline const std::string good_scene = R"xml(<ParameterList name="two blocks">
  <Parameter name="kinematics" type="string" value="plane strain"/>
  <ParameterList name="tables">
    <ParameterList name="ramp">
      <Parameter name="times" type="string" value="0, 1"/>
      <Parameter name="values" type="string" value="0, 1"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="materials">
    <ParameterList name="soft">
      <Parameter name="type" type="string" value="neo hooke"/>
      <Parameter name="young's modulus" type="double" value="1000"/>
      <Parameter name="poisson's ratio" type="double" value="0.3"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="bodies">
    <ParameterList name="upper">
      <Parameter name="material" type="string" value="soft"/>
      <Parameter name="element" type="string" value="Q4"/>
      <ParameterList name="mesh">
        <Parameter name="type" type="string" value="block"/>
        <Parameter name="corners" type="string" value="0, 1, 1, 1, 1, 2, 0, 2"/>
        <Parameter name="cells x" type="int" value="2"/>
        <Parameter name="cells y" type="int" value="2"/>
      </ParameterList>
    </ParameterList>
    <ParameterList name="lower">
      <Parameter name="material" type="string" value="soft"/>
      <ParameterList name="mesh">
        <Parameter name="type" type="string" value="block"/>
        <Parameter name="cells x" type="int" value="3"/>
        <Parameter name="cells y" type="int" value="2"/>
      </ParameterList>
    </ParameterList>
  </ParameterList>
  <ParameterList name="sets">
    <ParameterList name="seat">
      <Parameter name="of" type="string" value="lower/top"/>
      <Parameter name="kind" type="string" value="sides"/>
      <Parameter name="where" type="string" value="2 - x"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="boundary conditions">
    <ParameterList name="floor">
      <Parameter name="set" type="string" value="lower/bottom"/>
      <Parameter name="x" type="double" value="0"/>
      <Parameter name="y" type="double" value="0"/>
    </ParameterList>
    <ParameterList name="side">
      <Parameter name="set" type="string" value="upper/left"/>
      <Parameter name="x" type="string" value="0*t"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="loads">
    <ParameterList name="pressure">
      <Parameter name="type" type="string" value="follower pressure"/>
      <Parameter name="set" type="string" value="upper/top"/>
      <Parameter name="pressure" type="string" value="ramp(t)"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="contact">
    <ParameterList name="interface">
      <Parameter name="slave" type="string" value="seat"/>
      <Parameter name="master" type="string" value="upper/bottom"/>
    </ParameterList>
  </ParameterList>
</ParameterList>
)xml";

/// `text` with `to` in the place of the first `from`.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto position = text.find(from);
  EXPECT_NE(position, std::string::npos) << from;
  return position == std::string::npos ? text : text.replace(position, from.size(), to);
}

/// The line on which `marker` begins.
inline int line_of(const std::string& text, const std::string& marker) {
  const auto position = text.find(marker);
  return position == std::string::npos ? -1 : 1 + static_cast<int>(std::count(text.begin(), text.begin() + position, '\n'));
}

/// The good scene's master with a list "friction" of this type.
inline std::string with_friction(const std::string& type) {
  return R"xml(value="upper/bottom"/>
      <ParameterList name="friction"><Parameter name="type" type="string" )xml" +
         type + "</ParameterList>";
}

/// Runs a scene in a fresh directory of its own; its results would go to <directory>/results.
inline Ending run(const files::path& directory, const std::string& scene, int ranks, const std::vector<std::string>& more = {}) {
  files::remove_all(directory);
  files::create_directories(directory);
  std::ofstream(directory / "scene.xml") << scene;
  std::vector<std::string> command{MPIEXEC, "-n", std::to_string(ranks), MORTISE, "run", directory / "scene.xml", "-o", directory / "results"};
  command.insert(command.end(), more.begin(), more.end());
  return launch(command, 60);
}

}  // namespace scene_support
