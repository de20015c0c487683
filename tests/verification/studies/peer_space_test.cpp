// `mortise peer` in 3D: decks against what the manual of CalculiX says of elements and faces, and its results against ours.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "peer_support.hpp"

namespace {

namespace files = std::filesystem;
using namespace peer_support;

const std::string blocks = std::string(INPUTS) + "/scaling/pressed_blocks.xml", space = peers + "/space";
using Elements = std::vector<std::pair<std::string, std::string>>;  ///< of ours and of CalculiX
const Elements elements{{"H8", "C3D8"}, {"H20", "C3D20"}, {"Tet4", "C3D4"}, {"Tet10", "C3D10"}};
const Elements wedges{{"W6", "C3D6"}, {"W15", "C3D15"}};  ///< with fewer points than ours: 2 and 9

/// `mortise command scene` with settings.
Ending call(const std::string& command, const std::string& scene, const std::string& results, const std::vector<std::string>& settings,
            std::vector<std::string> words = {}) {
  files::remove_all(results);
  words.insert(words.end(), {MORTISE, command, scene, "-o", results});
  for (const std::string& setting : settings) words.insert(words.end(), {"--set", setting});
  return launch(words, 120);
}

struct Deck {
  std::map<long, std::array<double, 3>> nodes;
  std::map<long, std::pair<std::string, std::vector<long>>> elements;         ///< type and nodes
  std::map<std::string, std::vector<std::pair<long, std::size_t>>> surfaces;  ///< element and number of the face
  long supports = 0;                                                          ///< lines of *BOUNDARY
};

Deck read_deck(const std::string& path) {
  Deck deck;
  std::istringstream file(read_file(path));
  std::string card, name, line;
  while (std::getline(file, line)) {
    if (line.front() == '*') {
      card = line.substr(0, line.find(','));
      name = line.substr(std::min(line.find('=') + 1, line.size()));
      name = name.substr(0, name.find(','));
      continue;
    }
    for (std::string more; line.back() == ',' && std::getline(file, more); line += more)
      EXPECT_LE(std::max(std::count(line.begin(), line.end(), ','), std::count(more.begin(), more.end(), ',') + 1), 16) << line;
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    long id = 0, node = 0;
    char sign = 0;
    std::size_t face = 0;
    words >> id;
    if (card == "*NODE") words >> deck.nodes[id][0] >> deck.nodes[id][1] >> deck.nodes[id][2];
    if (card == "*ELEMENT") {
      deck.elements[id].first = name;
      while (words >> node) deck.elements[id].second.push_back(node);
    }
    if (card == "*SURFACE" && words >> sign >> face) deck.surfaces[name].emplace_back(id, face);
    deck.supports += card == "*BOUNDARY";
  }
  return deck;
}

/// Corners of the faces S1, S2, ... by the manual of CalculiX, counted from 1.
const std::vector<std::vector<int>>& faces_of(const std::string& type) {
  static const std::vector<std::vector<int>> hexahedron{{1, 2, 3, 4}, {5, 8, 7, 6}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 8, 4}, {4, 8, 5, 1}};
  static const std::vector<std::vector<int>> tetrahedron{{1, 2, 3}, {1, 4, 2}, {2, 4, 3}, {3, 4, 1}};
  static const std::vector<std::vector<int>> wedge{{1, 2, 3}, {4, 5, 6}, {1, 2, 5, 4}, {2, 3, 6, 5}, {3, 1, 4, 6}};
  if (type == "C3D6" || type == "C3D15") return wedge;
  return type == "C3D8" || type == "C3D20" ? hexahedron : tetrahedron;
}

TEST(PeerInSpace, TheDeckHasTheElementsAndTheFacesOfTheScene) {
  const std::string path = path_with("space_deck", "exit 201");
  struct Plane {
    const char* side;
    std::size_t direction;
    double position;
  };
  constexpr std::size_t n = 4;  // cells along an edge of the lower block, 3 of the upper one
  Elements all = elements;
  all.insert(all.end(), wedges.begin(), wedges.end());
  for (const auto& [element, theirs] : all) {
    const bool tetrahedra = element.front() == 'T', of_wedges = element.front() == 'W', quadratic = theirs.size() == 5;
    // A cell is cut into six tetrahedra, and has then diagonals on its sides and through its middle; or into two wedges, with diagonals below and
    // above.
    const auto nodes = [&](std::size_t cells) {
      const std::size_t corners = (cells + 1) * (cells + 1) * (cells + 1), whole = (2 * cells + 1) * (2 * cells + 1) * (2 * cells + 1);
      if (!quadratic || tetrahedra) return quadratic ? whole : corners;
      return corners + 3 * cells * (cells + 1) * (cells + 1) + (of_wedges ? cells * cells * (cells + 1) : 0);
    };
    for (const Plane& plane : {Plane{"top", 2, 1.0}, {"left", 0, 0.0}, {"right", 0, 1.0}, {"front", 1, 0.0}, {"back", 1, 1.0}}) {
      SCOPED_TRACE(element + " " + plane.side);
      const Ending ending = call("peer", blocks, space + "/deck",
                                 {"variables/n=4", "bodies/lower/element=" + element, "bodies/upper/element=" + element,
                                  std::string("contact/joint/master=lower/") + plane.side},
                                 {"env", path});
      ASSERT_EQ(ending.code, 3) << ending.output;
      const Deck deck = read_deck(space + "/deck/peer.inp");
      EXPECT_EQ(deck.nodes.size(), nodes(n) + nodes(n - 1));
      EXPECT_EQ(deck.elements.size(), (tetrahedra ? 6 : of_wedges ? 2 : 1) * (n * n * n + (n - 1) * (n - 1) * (n - 1)));
      for (const auto& [id, one] : deck.elements) {
        ASSERT_EQ(one.first, theirs) << id;
        ASSERT_EQ(one.second.size(), std::stoul(theirs.substr(3))) << id;
      }
      const auto expect_faces = [&](const std::string& surface, std::size_t cells, std::size_t direction, double position) {
        const auto& faces = deck.surfaces.at(surface);
        EXPECT_EQ(faces.size(), (tetrahedra || (of_wedges && direction == 2) ? 2 : 1) * cells * cells);
        for (const auto& [id, face] : faces)
          for (const int corner : faces_of(theirs).at(face - 1))
            EXPECT_NEAR(deck.nodes.at(deck.elements.at(id).second[static_cast<std::size_t>(corner - 1)])[direction], position, 1e-12)
                << surface << ", element " << id << ", face " << face;
      };
      expect_faces("SLAVE0", n - 1, 2, 1.0);
      expect_faces("MASTER0", n, plane.direction, plane.position);
      const auto at = [&](double z) {
        return std::count_if(deck.nodes.begin(), deck.nodes.end(), [&](const auto& node) { return std::abs(node.second[2] - z) < 1e-12; });
      };
      EXPECT_EQ(deck.supports, 3 * (at(0.0) + at(1.6)));  // below and above in all directions, and nothing else
    }
  }
}

/// A brick that is sheared, pressed and pulled at a side; of small strain, where both programs solve the same linear system.
std::string write_brick() {
  files::create_directories(space);
  const std::string path = space + "/brick.xml";
  std::ofstream(path) << R"(<ParameterList name="brick"><Parameter name="kinematics" type="string" value="three dimensional"/>
<ParameterList name="materials"><ParameterList name="steel"><Parameter name="type" type="string" value="small strain linear"/>
  <Parameter name="young's modulus" type="double" value="1000"/><Parameter name="poisson's ratio" type="double" value="0.3"/></ParameterList></ParameterList>
<ParameterList name="bodies"><ParameterList name="brick"><Parameter name="material" type="string" value="steel"/>
  <Parameter name="element" type="string" value="H8"/><ParameterList name="mesh"><Parameter name="type" type="string" value="brick"/>
  <Parameter name="width" type="double" value="1"/><Parameter name="depth" type="double" value="0.8"/><Parameter name="height" type="double" value="1.2"/>
  <Parameter name="cells x" type="int" value="2"/><Parameter name="cells y" type="int" value="3"/><Parameter name="cells z" type="int" value="2"/>
</ParameterList></ParameterList></ParameterList>
<ParameterList name="boundary conditions">
  <ParameterList name="floor"><Parameter name="set" type="string" value="brick/bottom"/><Parameter name="x" type="int" value="0"/>
    <Parameter name="y" type="int" value="0"/><Parameter name="z" type="int" value="0"/></ParameterList>
  <ParameterList name="press"><Parameter name="set" type="string" value="brick/top"/><Parameter name="x" type="string" value="0.05*t"/>
    <Parameter name="z" type="string" value="-0.02*t"/></ParameterList></ParameterList>
<ParameterList name="loads"><ParameterList name="pull"><Parameter name="type" type="string" value="dead traction"/>
  <Parameter name="set" type="string" value="brick/back"/><Parameter name="x" type="string" value="4*t"/><Parameter name="y" type="string" value="20*t"/>
  <Parameter name="z" type="string" value="-7*t"/></ParameterList></ParameterList>
<ParameterList name="stepping"><Parameter name="step" type="double" value="1"/></ParameterList>
<ParameterList name="quantities">
  <ParameterList name="floor_x"><Parameter name="type" type="string" value="reaction"/><Parameter name="set" type="string" value="brick/bottom"/>
    <Parameter name="component" type="string" value="x"/></ParameterList>
  <ParameterList name="floor_y"><Parameter name="type" type="string" value="reaction"/><Parameter name="set" type="string" value="brick/bottom"/>
    <Parameter name="component" type="string" value="y"/></ParameterList>
  <ParameterList name="floor_z"><Parameter name="type" type="string" value="reaction"/><Parameter name="set" type="string" value="brick/bottom"/>
    <Parameter name="component" type="string" value="z"/></ParameterList>
  <ParameterList name="bulge"><Parameter name="type" type="string" value="mean"/><Parameter name="field" type="string" value="displacement y"/>
    <Parameter name="on" type="string" value="brick/back"/></ParameterList>
  <ParameterList name="sink"><Parameter name="type" type="string" value="mean"/><Parameter name="field" type="string" value="displacement z"/>
    <Parameter name="on" type="string" value="brick/back"/></ParameterList></ParameterList>
</ParameterList>)";
  return path;
}

TEST(PeerInSpace, EachElementAgreesInASmallStrainProblem) {
  if (!installed()) GTEST_SKIP() << "ccx is not installed";
  const std::string scene = write_brick();
  for (const auto& [element, theirs] : elements) {
    SCOPED_TRACE(element);
    const std::vector<std::string> settings{"bodies/brick/element=" + element};
    ASSERT_EQ(call("run", scene, space + "/our_brick", settings).code, 0);
    const Ending ending = call("peer", scene, space + "/their_brick", settings);
    ASSERT_EQ(ending.code, 0) << ending.output;
    const auto ours = quantities(space + "/our_brick"), its = quantities(space + "/their_brick");
    // Its results have six digits: sums of forces at the nodes of the floor are off by 5e-6 of the largest of them at most for each node.
    double force = 0.0;
    for (const char* name : {"floor_x", "floor_y", "floor_z"}) force = std::max(force, std::abs(ours.at(name).get<double>()));
    for (const char* name : {"floor_x", "floor_y", "floor_z"}) EXPECT_NEAR(its.at(name), ours.at(name), 1e-5 * force) << name;
    for (const char* name : {"bulge", "sink"}) EXPECT_NEAR(its.at(name), ours.at(name), 1e-5 * std::abs(ours.at(name).get<double>())) << name;
  }
}

/// Reaction, contact force and largest pressure of the pressed blocks, pressed so little that what CalculiX linearises about the start of the
/// increment is exact to 1e-6.
std::vector<std::string> pressed_little(const std::string& element) {
  return {"variables/n=4",
          "bodies/lower/element=" + element,
          "bodies/upper/element=" + element,
          "boundary conditions/press/z=-2e-6*t",
          "quantities/force/type=contact force",
          "quantities/force/component=z",
          "quantities/peak/type=peak pressure"};
}

TEST(PeerInSpace, ItsMortarAgreesOnPressedBlocks) {
  if (!installed()) GTEST_SKIP() << "ccx is not installed";
  std::map<std::string, nlohmann::json> ours, its;
  for (const auto& one : elements) {
    const std::string& element = one.first;
    ASSERT_EQ(call("run", blocks, space + "/our_blocks", pressed_little(element)).code, 0) << element;
    const Ending ending = call("peer", blocks, space + "/their_blocks", pressed_little(element));
    ASSERT_EQ(ending.code, 0) << ending.output;
    ours[element] = quantities(space + "/our_blocks"), its[element] = quantities(space + "/their_blocks");
  }
  const auto value = [](const nlohmann::json& all, const char* name) { return all.at(name).get<double>(); };
  // The same method on linear elements; results have six digits.
  for (const char* element : {"H8", "Tet4"})
    for (const char* name : {"reaction_z", "force", "peak", "contact_area"})
      EXPECT_NEAR(value(its[element], name), value(ours[element], name), 1e-5 * value(ours[element], name)) << element << " " << name;
  // Other dual functions on quadratic ones: they matter less than the elements by a power of h.
  for (const auto& [quadratic, linear] : {std::make_pair("H20", "H8"), std::make_pair("Tet10", "Tet4")})
    for (const char* name : {"reaction_z", "force"})
      EXPECT_NEAR(value(its[quadratic], name), value(ours[quadratic], name), 0.1 * (value(ours[linear], name) - value(ours[quadratic], name)))
          << quadratic << " " << name;
}

// All are discretisations of one problem with the same elements: they differ by less than these are wrong.
TEST(PeerInSpace, StandsInAStudyBesideOurs) {
  if (!installed()) GTEST_SKIP() << "ccx is not installed";
  const std::string results = space + "/study";
  files::remove_all(results);
  for (const char* friction : {"0", "0.2"}) {
    const Ending ending = call("study", std::string(INPUTS) + "/studies/pressed_blocks.xml", results,
                               {"axes/n/values=4", "finest/variables/n=8", std::string("settings/variables/mu=") + friction});
    ASSERT_EQ(ending.code, 0) << ending.output;
    const auto study = nlohmann::json::parse(read_file(results + "/study.json"));
    const auto& reaction = study.at("errors").at(0);
    ASSERT_EQ(study.at("points").size(), 3u);
    const double ours = reaction.at("value").at(0), finest = reaction.at("reference").at(0);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& point = study.at("points").at(i);
      EXPECT_EQ(point.at("status"), "done") << point.at("said");
      EXPECT_EQ(point.at("element"), i == 0 ? "H8" : "H8 (CalculiX C3D8)");
      EXPECT_NEAR(reaction.at("value").at(i), ours, std::abs(ours - finest)) << point.at("formulation") << ", friction " << friction;
      for (const char* name : {"newton_iterations", "cpu_s", "memory_mib"}) EXPECT_GT(point.at(name), 0.0) << name;
    }
    EXPECT_NE(read_file(results + "/study.csv").find("memory_mib,value_reaction_z,error_reaction_z,status"), std::string::npos);
  }
}

/// The line of a deck that follows a card; empty: there is no such card.
std::string after_card(const std::string& deck, const std::string& card) {
  const auto found = deck.find(card + "\n");
  if (found == std::string::npos) return "";
  const auto begin = found + card.size() + 1;
  return deck.substr(begin, deck.find('\n', begin) - begin);
}
const std::string pressing_card = "*SURFACE BEHAVIOR,PRESSURE-OVERCLOSURE=LINEAR";

// E = 1000, and the edge of a slave facet is h = 0.6 / (3 n / 4): E/h = 1250 n. Sticking is ten times softer.
TEST(PeerInSpace, ThePenaltyIsTheMultipleThatIsSaid) {
  const std::string path = path_with("space_penalty", "exit 201");
  files::remove_all(space + "/penalty");
  struct Case {
    std::string by, penalty;
    const char *n, *pressing, *friction;
  };
  for (const Case& one : {Case{"calculix surface to surface", "", "4", "250000", "0.2,25000"},
                          {"calculix surface to surface", "3", "4", "15000", "0.2,1500"},
                          {"calculix surface to surface", "800/n", "4", "1000000", "0.2,100000"},
                          {"calculix node to surface", "800/n", "8", "1000000", "0.2,100000"},
                          {"calculix mortar", "", "4", "", "0.2,50000"}}) {
    SCOPED_TRACE(one.by + " " + one.penalty);
    std::vector<std::string> words{"env",  path, MORTISE, "peer", blocks, "--by", one.by, "-o", space + "/penalty", "--set", "variables/mu=0.2",
                                   "--set"};
    words.push_back(std::string("variables/n=") + one.n);
    if (!one.penalty.empty()) words.insert(words.end(), {"--penalty", one.penalty});
    const Ending ending = launch(words);
    ASSERT_EQ(ending.code, 3) << ending.output;
    const std::string deck = read_file(space + "/penalty/peer.inp");
    EXPECT_EQ(after_card(deck, pressing_card), one.pressing);
    EXPECT_EQ(after_card(deck, "*FRICTION"), one.friction);
  }
  for (const auto& [by, penalty, said] : {std::array<const char*, 3>{"calculix surface to surface", "-3", "above 0"},
                                          {"calculix surface to surface", "800/cells", "cells"},
                                          {"calculix mortar", "3", "without a penalty"}}) {
    const Ending ending = launch({"env", path, MORTISE, "peer", blocks, "--by", by, "--penalty", penalty, "-o", space + "/penalty"});
    EXPECT_EQ(ending.code, 2) << ending.output;
    EXPECT_NE(ending.output.find("--penalty"), std::string::npos) << ending.output;
    EXPECT_NE(ending.output.find(said), std::string::npos) << ending.output;
  }
}

// All points of a study are given it, and those take it that press by one.
TEST(PeerInSpace, AStudyHandsThePenaltyToThePeersThatHaveOne) {
  const std::string path = path_with("space_study_penalty", "exit 201"), study = std::string(INPUTS) + "/studies/pressed_blocks.xml",
                    results = space + "/study_penalty";
  files::remove_all(results);
  const std::vector<std::string> small{"axes/n/values=4", "finest/variables/n=8"};
  for (const auto& [penalty, pressing] : {std::pair{"50", "250000"}, {"800/n", "1000000"}}) {
    std::vector<std::string> settings = small;
    settings.push_back(std::string("settings/peer penalty=") + penalty);
    const Ending ending = call("study", study, results, settings, {"env", path});
    ASSERT_EQ(ending.code, 3) << ending.output;  // the script does not solve anything
    const auto deck = [&](const std::string& peer) { return read_file(results + "/points/formulation=CalculiX_" + peer + ",n=4/peer.inp"); };
    EXPECT_EQ(after_card(deck("surface_to_surface"), pressing_card), pressing);
    EXPECT_NE(deck("mortar").find("TYPE=MORTAR"), std::string::npos);
    EXPECT_EQ(nlohmann::json::parse(read_file(results + "/study.json")).at("points").at(0).at("status"), "done");
  }
  const Ending wrong = call("study", study, results, {"settings/peer penalty=0"}, {"env", path});
  EXPECT_EQ(wrong.code, 2) << wrong.output;
  EXPECT_NE(wrong.output.find("above 0"), std::string::npos) << wrong.output;
}

TEST(PeerInSpace, SaysWhatADeckCannotHold) {
  const std::string path = path_with("space_obstacles", "exit 1");
  const auto refusal = [&](const std::string& scene, const std::vector<std::string>& settings) {
    const Ending ending = call("peer", std::string(INPUTS) + scene, space + "/refused", settings, {"env", path});
    EXPECT_EQ(ending.code, 2) << ending.output;
    return ending.output;
  };
  const auto contains = [](const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; };
  const std::string rigid = refusal("/verification/3d/square_billet.xml", {});
  EXPECT_TRUE(contains(rigid, "the deck of CalculiX cannot hold it: \"plate\" is rigid")) << rigid;
  const std::string bounded = refusal("/scaling/pressed_blocks.xml", {"variables/mu=0.2", "contact/joint/friction/largest traction=1"});
  EXPECT_TRUE(contains(bounded, "friction of \"joint\" other than Coulomb's")) << bounded;
  const std::string quadratic = refusal("/verification/patch_quadratic.xml", {});
  EXPECT_TRUE(contains(quadratic, "the elements Q8 of")) << quadratic;
}

}  // namespace
