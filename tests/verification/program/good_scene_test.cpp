// The scene that other tests break, unbroken.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "scene_support.hpp"

namespace {

using namespace scene_support;

TEST(GoodScene, Runs) {
  for (const int ranks : {1, 2}) {
    const Ending ending = run(files::path(SCRATCH) / fmt::format("good_np{}", ranks), good_scene, ranks);
    EXPECT_EQ(ending.code, 0) << ending.output;
  }
}

TEST(Checks, AMissedOneIsSaidQuietlyToo) {
  const std::string scene =
      replaced(good_scene, R"xml(  <ParameterList name="contact">)xml", R"xml(  <ParameterList name="quantities"><ParameterList name="force">
    <Parameter name="type" type="string" value="contact force"/></ParameterList></ParameterList>
  <ParameterList name="checks"><ParameterList name="too much"><Parameter name="quantity" type="string" value="force"/>
    <Parameter name="low" type="double" value="1e9"/></ParameterList></ParameterList>
  <ParameterList name="contact">)xml");
  const Ending ending = run(files::path(SCRATCH) / "missed_check", scene, 1, {"--quiet"});
  EXPECT_EQ(ending.code, 4) << ending.output;
  EXPECT_NE(ending.output.find("check too much: 1e+09 <= force"), std::string::npos) << ending.output;
  EXPECT_NE(ending.output.find("MISSED"), std::string::npos) << ending.output;
}

}  // namespace
