// profiles.csv: contact along the arc length.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "launch.hpp"

namespace {

using Table = std::vector<std::vector<double>>;

/// The rows of a run of Hertz on `ranks` ranks: time, part, arc_length, x, y, pressure, shear, gap, state.
Table profile(const std::string& directory, int ranks) {
  std::filesystem::remove_all(directory);
  const Ending ending = launch({MPIEXEC, "-n", std::to_string(ranks), MORTISE, "run", std::string(INPUTS) + "/paper/hertz_elastic.xml", "--set",
                                "variables/steps=4", "--set", "variables/mu=0", "--set", "stepping/output times=0.5", "-o", directory});
  EXPECT_EQ(ending.code, 0) << ending.output;
  std::istringstream file(read_file(directory + "/profiles.csv"));
  std::string line, entry;
  std::getline(file, line);
  EXPECT_EQ(line, "time,pair,part,arc_length,x,y,pressure,shear,gap,state");
  Table rows;
  while (std::getline(file, line)) {
    std::istringstream entries(line);
    rows.emplace_back();
    for (int column = 0; std::getline(entries, entry, ','); ++column)
      if (column != 1) rows.back().push_back(std::stod(entry));
  }
  return rows;
}

TEST(Profile, IsInOrderOfTheArcAndCarriesTheForceOnAnyNumberOfRanks) {
  const std::string directory = std::string(SCRATCH) + "/profile";
  const Table one = profile(directory + "_1", 1);
  ASSERT_EQ(one.size(), 32u) << "16 slave nodes at the output time and at the end";
  double end_force = 0.0;
  for (std::size_t n = 0; n < one.size(); ++n) {
    const auto& row = one[n];
    ASSERT_EQ(row.size(), 9u);
    EXPECT_EQ(row[0], n < 16 ? 0.5 : 1.0);
    EXPECT_EQ(row[8] > 0.0, row[5] > 0.0) << "closed where pressed";
    if (n % 16 == 0) {
      EXPECT_EQ(row[2], 0.0);
      EXPECT_EQ(row[3], 0.0) << "the surface starts on the symmetry line";
      continue;
    }
    const auto& before = one[n - 1];
    EXPECT_NEAR(row[2] - before[2], std::hypot(row[3] - before[3], row[4] - before[4]), 1e-12);
    // With int phi_j = int N_j, each facet carries half of its length at either pressure, along normals that lean by less than a/R.
    if (n > 16) end_force += 0.5 * (row[5] + before[5]) * (row[3] - before[3]);
  }
  const double force = nlohmann::json::parse(read_file(directory + "_1/summary.json")).at("quantities").at("contact_force").get<double>();
  EXPECT_NEAR(end_force, force, std::pow(2.33 / 50.0, 2) * force);

  const Table three = profile(directory + "_3", 3);
  ASSERT_EQ(three.size(), one.size());
  const double scales[] = {1.0, 1.0, 1.0, 1.0, 1.0, 1400.0, 1400.0, 1.0, 1.0};
  for (std::size_t n = 0; n < one.size(); ++n)
    for (std::size_t column = 0; column < 9; ++column) EXPECT_NEAR(three[n][column], one[n][column], 1e-9 * scales[column]) << n << " " << column;
}

}  // namespace
