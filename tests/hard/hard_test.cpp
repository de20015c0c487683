// `mortise hard`: what a ledger calls right, stopped and wrong, what it refuses, and that it goes on where it was.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "launch.hpp"
#include "scene_text.hpp"

namespace {

namespace files = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using namespace scene_text;

const std::string directory = SCRATCH;

/// A case of layers between walls, whose stress is the variable s, or of another scene.
std::string a_case(const std::string& name, const std::string& rest, const std::string& scene = "layers.xml") {
  return list(name, parameter("scene", std::string(INPUTS) + "/hard/" + scene) + parameter("hard", "nothing") + parameter("expectation", "a stress") +
                        parameter("source", "closed form") + rest);
}

std::string expect_stress(const std::string& value) {
  return list("expected", list("stress", parameter("value", value) + parameter("bound", "1e-6*s")));
}

std::string write_ledger(const std::string& name, const std::string& cases) {
  files::create_directories(directory);
  files::remove_all(directory + "/" + name);
  const std::string path = directory + "/" + name + ".xml";
  std::ofstream(path) << list("ledger", list("cases", cases));
  return path;
}

Ending hard(const std::string& name, std::vector<std::string> options = {}) {
  options.insert(options.begin(), {MORTISE, "hard", directory + "/" + name + ".xml", "-o", directory + "/" + name});
  return launch(options, 240);
}

const std::string no_answer = "<Parameter name=\"required\" type=\"bool\" value=\"true\"/>\n";

TEST(Hard, TellsRightFromStoppedAndWrong) {
  const std::string profile = "limit_bar.xml", late = list("expected", list("time", parameter("figure", "t") + parameter("low", "0.76")));
  const std::string early = list("expected", list("time", parameter("figure", "t") + parameter("high", "0.1")));
  const std::string stops = parameter("reason", "residual|equilibrium");
  write_ledger("verdicts", a_case("good", expect_stress("s")) + a_case("bad", expect_stress("1.01*s")) +
                               a_case("must_stop", list("stop", stops + no_answer) + late, profile) +
                               a_case("stops_too_late", list("stop", stops + no_answer) + early, profile) +
                               a_case("may_stop", list("stop", stops) + late, profile) +
                               a_case("other_reason", list("stop", parameter("reason", "eclipse")) + late, profile) +
                               a_case("ends_without_answer", list("stop", stops + no_answer)) +
                               a_case("broken_on_the_way", parameter("always", "t &lt; 0.6") + expect_stress("s")));
  const Ending ending = hard("verdicts");
  EXPECT_EQ(ending.code, 4) << ending.output;
  EXPECT_THAT(ending.output,
              AllOf(HasSubstr("good: right"), HasSubstr("bad: wrong"), HasSubstr("must_stop: right"), HasSubstr("stops_too_late: wrong"),
                    HasSubstr("may_stop: stopped with a true reason"), HasSubstr("other_reason: wrong"), HasSubstr("ends_without_answer: wrong"),
                    HasSubstr("broken_on_the_way: wrong"), HasSubstr("2 right, 1 stopped with a true reason, 5 wrong")));
  EXPECT_THAT(read_file(directory + "/verdicts/hard-cases.md"), HasSubstr("after the step to t = 1, accepted, this does not hold"));
  EXPECT_THAT(read_file(directory + "/verdicts/ledger.csv"), HasSubstr("bad,,1,wrong,stress,"));
}

TEST(Hard, ComparesWithCompanionsAndRanksAndGoesOnWhereItWas) {
  const std::string stiffer = list(
      "companions",
      list("stiff", list("settings", parameter("variables/E1", "2000") + parameter("variables/E2", "2000") + parameter("variables/E3", "2000"))));
  const std::string sweep = list("axes", list("u", parameter("setting", "variables/u") + parameter("values", "0.01, 0.02")));
  const std::string everywhere = "<Parameter name=\"every ranks\" type=\"bool\" value=\"true\"/>\n";
  write_ledger("companions",
               a_case("twice_as_stiff", everywhere + sweep + stiffer + expect_stress("stiff_stress/2")) + a_case("alone", expect_stress("s")));
  Ending ending = hard("companions", {"--only", "twice", "--ranks", "1,3"});
  EXPECT_EQ(ending.code, 0) << ending.output;
  EXPECT_THAT(ending.output, AllOf(HasSubstr("4/4 twice_as_stiff, u = 0.02, 3 rank(s): right"), Not(HasSubstr("alone"))));
  ending = hard("companions", {"--sweeps"});
  EXPECT_EQ(ending.code, 0) << ending.output;
  EXPECT_THAT(ending.output, AllOf(HasSubstr("u = 0.01: right, run of an earlier call"), HasSubstr("3/3 alone: right, "), HasSubstr("3 right")));
  ending = hard("companions", {"--list"});
  EXPECT_THAT(ending.output, AllOf(HasSubstr("alone"), Not(HasSubstr("twice"))));
}

TEST(Hard, SaysAllThatIsWrongWithALedger) {
  write_ledger("invalid", a_case("unknown", expect_stress("strain")) + a_case("nothing_expected", "") +
                              a_case("no_quantity", list("expected", list("warmth", parameter("low", "0")))));
  Ending ending = hard("invalid");
  EXPECT_EQ(ending.code, 2);
  EXPECT_THAT(ending.output, HasSubstr("nothing is expected"));
  write_ledger("unknown",
               a_case("unknown", expect_stress("strain")) + a_case("no_quantity", list("expected", list("warmth", parameter("low", "0")))));
  ending = hard("unknown");
  EXPECT_EQ(ending.code, 2);
  EXPECT_THAT(ending.output, AllOf(HasSubstr("strain"), HasSubstr("there is no quantity \"warmth\"")));
}

}  // namespace
