// `mortise peer` and points of studies that CalculiX runs. Tests that need the program ccx are skipped where it is not installed; the others take a
// script in its place, or nothing.

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "peer_support.hpp"
#include "study_support.hpp"

namespace {

namespace files = std::filesystem;
using namespace peer_support;
using namespace study_support;
using Json = nlohmann::json;

/// The patch test with seven slave facets to a master facet, of linear elasticity, held sideways at two nodes that touch nothing.
std::vector<std::string> patch(const std::string& command, const std::string& results) {
  files::remove_all(results);
  std::vector<std::string> words{MORTISE, command, std::string(INPUTS) + "/verification/patch_ratio_1_7.xml", "-o", results};
  for (const char* setting :
       {"materials/steel/type=small strain linear", "bodies/upper/element=Q4", "bodies/lower/element=Q4", "sets/low/of=lower/left",
        "sets/low/where=1-y", "sets/high/of=upper/left", "sets/high/where=y-39", "boundary conditions/lower symmetry/set=low",
        "boundary conditions/upper symmetry/set=high", "quantities/floor/type=reaction", "quantities/floor/set=lower/bottom",
        "quantities/push/type=contact force", "quantities/peak/type=peak pressure", "quantities/least/type=extremum",
        "quantities/least/field=contact pressure", "quantities/least/which=minimum", "quantities/down/type=mean",
        "quantities/down/field=displacement y", "quantities/down/on=upper/top"})
    words.insert(words.end(), {"--set", setting});
  return words;
}

/// A study of the patch test by one peer.
std::string study_by(const std::string& name, const std::string& peer, const std::string& scene) {
  files::remove_all(peers + "/" + name);  // results of an earlier call
  files::create_directories(peers);
  const std::string path = peers + "/" + name + ".xml";
  std::ofstream(path) << R"(<ParameterList name="peers"><Parameter name="scene" type="string" value=")" << INPUTS << "/verification/" << scene
                      << R"("/><ParameterList name="axes"><ParameterList name="peer"><Parameter name="setting" type="string" value="peer"/>
<Parameter name="values" type="string" value=")"
                      << peer << R"("/></ParameterList></ParameterList><ParameterList name="quantities"><ParameterList name="stress_spread">
<Parameter name="measure" type="string" value="itself"/></ParameterList></ParameterList></ParameterList>)";
  return path;
}

Json first_point(const std::string& results) { return Json::parse(read_file(results + "/study.json")).at("points").at(0); }

TEST(Peer, TheDeckHasTheMeshAndTheLoadsOfTheScene) {
  const std::string results = peers + "/deck", path = path_with("failing", "echo; echo ' *ERROR: as it was told'; exit 201");
  std::vector<std::string> command = patch("peer", results);
  command.insert(command.begin(), {"env", path});
  const Ending ending = launch(command);
  EXPECT_EQ(ending.code, 3) << ending.output;
  EXPECT_TRUE(contains(ending.output, "CalculiX mortar stopped at time 0 of 1, exit code 201: *ERROR: as it was told")) << ending.output;
  std::istringstream deck(read_file(results + "/peer.inp"));
  long nodes = 0, elements = 0, facets = 0;
  double load = 0.0;
  std::string card;
  for (std::string line; std::getline(deck, line);) {
    if (line.front() == '*') card = line;
    if (line.front() == '*') continue;
    nodes += card == "*NODE,NSET=ALL";
    elements += card.rfind("*ELEMENT,TYPE=C3D8", 0) == 0;
    facets += card == "*SURFACE,NAME=SLAVE0,TYPE=ELEMENT";
    if (card.rfind("*CLOAD", 0) == 0) load += std::stod(line.substr(line.rfind(',') + 1));
  }
  EXPECT_EQ(nodes, 2 * (4 * 3 + 22 * 5));  // two layers
  EXPECT_EQ(elements, 3 * 2 + 21 * 4);
  EXPECT_EQ(facets, 21);
  EXPECT_NEAR(load, -36000.0, 36000.0 * 1e-11);  // written with 12 digits
}

TEST(Peer, AgreesInAPatchTest) {
  if (!installed()) GTEST_SKIP() << "ccx is not installed";
  const std::string ours = peers + "/ours", theirs = peers + "/theirs";
  ASSERT_EQ(launch(patch("run", ours)).code, 0);
  const Ending ending = launch(patch("peer", theirs));
  ASSERT_EQ(ending.code, 0) << ending.output;
  const Json a = quantities(ours), b = quantities(theirs);
  const auto relative = [&](const char* name) { return std::abs(b.at(name).get<double>() / a.at(name).get<double>() - 1.0); };
  // Their results have six digits: 5e-6 at most. Pressures are per current width here, per undeformed width there: they differ by the strain in x.
  const double strain = 450.0 / 210000.0 * 0.33 * 1.33;
  for (const char* name : {"floor", "push", "down"}) EXPECT_LT(relative(name), 5e-6) << name;
  for (const char* name : {"peak", "least"}) EXPECT_LT(relative(name), strain + 1e-5) << name;
  EXPECT_TRUE(b.at("stress_spread").is_null());  // cannot be had
}

/// Laws of plasticity may be of Kirchhoff or of Cauchy stress: their forces differ by the change of volume, p/K, and elastic parts by as much again.
/// Homogeneous compression in plane strain: p is half the largest stress, which is 2/sqrt(3) times the yield stress. Without the free sides, which
/// touch nothing: CalculiX' mortar does not bear their corners.
TEST(Peer, YieldsAlikeUnderAPrescribedMotion) {
  if (!installed()) GTEST_SKIP() << "ccx is not installed";
  const std::string ours = peers + "/our_yield", theirs = peers + "/their_yield", scene = std::string(INPUTS) + "/verification/upsetting_plane.xml";
  const auto command = [&](const char* name, const std::string& results) {
    files::remove_all(results);
    return std::vector<std::string>{
        MORTISE, name, scene, "-o", results, "--set", "variables/mu=0", "--set", "variables/nx=10", "--set", "contact/interface/slave=billet/top"};
  };
  ASSERT_EQ(launch(command("run", ours)).code, 0);
  const Ending ending = launch(command("peer", theirs));
  ASSERT_EQ(ending.code, 0) << ending.output;
  const double force = quantities(ours).at("force"), yield_stress = 370.0 + 550.0 * std::pow(2.0 / std::sqrt(3.0) * -std::log(0.7), 0.223);
  const double volume_change = yield_stress / std::sqrt(3.0) / (210000.0 / (3.0 * (1.0 - 2.0 * 0.3)));
  EXPECT_NEAR(quantities(theirs).at("force"), force, 2.0 * volume_change * force);
  EXPECT_NEAR(quantities(theirs).at("contact_force"), quantities(ours).at("contact_force"), 2.0 * volume_change * force);
}

TEST(Peer, StandsInAStudyBesideOurs) {
  if (!installed()) GTEST_SKIP() << "ccx is not installed";
  const std::string results = peers + "/beside";
  const Ending ending = study(study_by("beside", "calculix node to surface, none", "patch_ratio_1_7.xml"), results);
  EXPECT_EQ(ending.code, 0) << ending.output;
  const Json point = first_point(results);
  EXPECT_EQ(point.at("status"), "done") << point.at("said");
  EXPECT_EQ(point.at("formulation"), "CalculiX node to surface");
  EXPECT_EQ(point.at("element"), "Q4 F-bar (CalculiX C3D8)");
  EXPECT_EQ(point.at("steps"), 2);
  EXPECT_GE(point.at("newton_iterations"), 2);
  for (const char* name : {"wall_s", "cpu_s", "memory_mib"}) EXPECT_GT(point.at(name), 0.0) << name;
  EXPECT_TRUE(contains(read_file(results + "/study.csv"), "dual mortar,Q4 F-bar,"));
}

TEST(Peer, ThatStopsIsRecordedWithItsReason) {
  const std::string results = peers + "/stops", path = path_with("stopping", "echo ' *ERROR: as it was told'; exit 201");
  const Ending ending = study(study_by("stops", "calculix surface to surface, none", "patch_ratio_1_7.xml"), results, {"env", path});
  EXPECT_EQ(ending.code, 3) << ending.output;
  const Json point = first_point(results);
  EXPECT_EQ(point.at("status"), "not converged");
  EXPECT_TRUE(contains(point.at("said"), "CalculiX surface to surface stopped at time 0 of 1, exit code 201: *ERROR: as it was told")) << point;
  EXPECT_EQ(Json::parse(read_file(results + "/study.json")).at("points").at(1).at("status"), "done");
}

TEST(Peer, ThatIsNotInstalledIsSaidAndDoesNotFailAStudy) {
  const std::string results = peers + "/absent", path = path_with("nothing", "");
  files::remove_all(results);
  const Ending ending = study(study_by("absent", "calculix mortar, none", "patch_ratio_1_7.xml"), results, {"env", path});
  EXPECT_EQ(ending.code, 0) << ending.output;
  EXPECT_EQ(first_point(results).at("status"), "not installed: ccx (Debian: calculix-ccx)");
  EXPECT_FALSE(first_point(results).at("finished"));
  EXPECT_TRUE(contains(read_file(results + "/study.csv"), "not installed: ccx (Debian: calculix-ccx)"));
  std::vector<std::string> command = patch("peer", peers + "/absent_run");
  command.insert(command.begin(), {"env", path});
  EXPECT_EQ(launch(command).code, 5);
}

TEST(Peer, SaysWhatADeckCannotHold) {
  const std::string results = peers + "/obstacles", path = path_with("unused", "exit 1");
  const Ending ending = study(study_by("obstacles", "calculix mortar", "patch_axisymmetric.xml"), results, {"env", path});
  EXPECT_EQ(ending.code, 3) << ending.output;
  EXPECT_EQ(first_point(results).at("status"), "not possible by the peer");
  EXPECT_TRUE(contains(first_point(results).at("said"), "kinematics \"axisymmetric\"")) << first_point(results);
  const Ending rigid = launch({"env", path, MORTISE, "peer", std::string(INPUTS) + "/verification/rolling_disk.xml", "-o", peers + "/rigid"});
  EXPECT_EQ(rigid.code, 2);
  for (const char* expected : {"is rigid", "the deck of CalculiX cannot hold it"}) EXPECT_TRUE(contains(rigid.output, expected)) << rigid.output;
}

TEST(Peer, ThatThereIsNotIsSaidWithWhatThereIs) {
  const Ending ending = study(study_by("unknown", "calculix mortr", "patch_ratio_1_7.xml"), peers + "/unknown");
  EXPECT_EQ(ending.code, 2);
  EXPECT_TRUE(contains(ending.output, "there is no peer \"calculix mortr\"; did you mean \"calculix mortar\"?")) << ending.output;
}

}  // namespace
