// Differences of traction profiles whose integrals are known.

#include "mortise/studies/study_profile.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>

#include "mortise/core/error.hpp"

namespace mortise {
namespace {

TEST(ProfileDifference, IsExactForLinesOnDifferentMeshes) {
  // The same parabola-like roof on other points, and a roof against its double.
  const TractionProfile roof{"pair", "0", {0.0, 1.0, 2.0}, {0.0, 1.0, 0.0}},
      same{"pair", "0", {0.0, 0.25, 1.0, 1.5, 2.0}, {0.0, 0.25, 1.0, 0.5, 0.0}};
  EXPECT_NEAR(profile_difference({same}, {roof}), 0.0, 1e-15);
  const TractionProfile twice{"pair", "0", {0.0, 1.0, 2.0}, {0.0, 2.0, 0.0}};
  EXPECT_NEAR(profile_difference({twice}, {roof}), 1.0, 1e-14);
}

TEST(ProfileDifference, CountsWhatOnlyOneHas) {
  const TractionProfile unit{"pair", "0", {0.0, 1.0}, {1.0, 1.0}}, longer{"pair", "0", {0.0, 1.25}, {1.0, 1.0}},
      other{"other", "0", {0.0, 1.0}, {2.0, 2.0}};
  EXPECT_NEAR(profile_difference({longer}, {unit}), 0.5, 1e-14);  // int over the last quarter
  EXPECT_NEAR(profile_difference({}, {unit}), 1.0, 1e-14);
  EXPECT_NEAR(profile_difference({unit, other}, {unit}), 2.0, 1e-14);
  EXPECT_TRUE(std::isnan(profile_difference({unit}, {})) || std::isinf(profile_difference({unit}, {})));
}

TEST(ReadProfiles, TakesTheLastTimeOfEachPairAndPart) {
  const std::string path = testing::TempDir() + "profiles_of_study.csv";
  std::ofstream(path) << "time,pair,part,arc_length,x,y,pressure,shear,gap,state\n"
                         "0.5,\"a, b\",0,0,0,0,9,9,0,1\n0.5,\"a, b\",0,1,0,0,9,9,0,1\n"
                         "1,\"a, b\",0,0,0,0,1,0,0,1\n1,\"a, b\",0,2,0,0,3,-1,0,1\n1,\"a, b\",1,0,0,0,5,0,0,1\n";
  const auto pressure = read_profiles(path, "pressure");
  ASSERT_EQ(pressure.size(), 2u);
  EXPECT_EQ(pressure[0].pair, "a, b");
  EXPECT_EQ(pressure[0].arc_length, (std::vector<double>{0.0, 2.0}));
  EXPECT_EQ(pressure[0].traction, (std::vector<double>{1.0, 3.0}));
  EXPECT_EQ(pressure[1].part, "1");
  EXPECT_EQ(read_profiles(path, "shear")[0].traction, (std::vector<double>{0.0, -1.0}));
  EXPECT_THROW(read_profiles(path, "presure"), FileError);
  EXPECT_THROW(read_profiles(path + ".none", "pressure"), FileError);
  std::remove(path.c_str());
}

}  // namespace
}  // namespace mortise
