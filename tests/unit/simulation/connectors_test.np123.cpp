// Springs, dashpots, point masses and stabilisation in scenes: derivatives, forces, what they hold, what is refused.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <cmath>

#include "mortise/core/trilinos_versions.hpp"
#include "mortise/simulation/model/model.hpp"
#include "scene_text.hpp"

namespace mortise {
namespace {

using namespace test;
using ::testing::HasSubstr;

/// Lists of a scene beside its bodies: a block and a rigid one apart from it, in the plane or in space.
struct Case {
  std::string name;
  bool in_space = false;
  std::string kinematics = "plane strain";
  std::string lists;
};

void PrintTo(const Case& one, std::ostream* stream) { *stream << one.name; }

std::string entry(const std::string& name, const std::vector<std::pair<std::string, std::string>>& values) {
  std::string content;
  for (const auto& [key, value] : values) content += parameter(key, "string", value);
  return list(name, content);
}

std::string scene_text(const Case& one) {
  const auto mesh = [&](const std::string& translation) {
    return list("mesh", parameter("type", "string", one.in_space ? "brick" : "block") + parameter("cells x", "string", "2") +
                            parameter("cells y", "string", "2") + (one.in_space ? parameter("cells z", "string", "2") : "") +
                            parameter("translation", "string", translation));
  };
  const std::string material = list("rubber", parameter("type", "string", "neo hooke") + parameter("young's modulus", "double", "100") +
                                                  parameter("poisson's ratio", "double", "0.3") + parameter("density", "double", "2"));
  const std::string bodies = list("block", parameter("material", "string", "rubber") + mesh(one.in_space ? "0, 0, 0" : "0, 0")) +
                             list("tool", parameter("rigid", "bool", "true") + mesh(one.in_space ? "2.5, 0.4, 0.3" : "2.5, 0.4"));
  return list("springs", parameter("kinematics", "string", one.in_space ? "three dimensional" : one.kinematics) + list("materials", material) +
                             list("bodies", bodies) + list("stepping", parameter("end time", "double", "1") + parameter("step", "double", "0.25")) +
                             one.lists);
}

const std::string inertia = list("inertia", parameter("scheme", "string", "generalised alpha") + parameter("balance", "string", "at the end"));
const std::string push = list("loads", entry("push", {{"type", "nodal force"}, {"set", "tool/reference"}, {"x", "2*t"}, {"y", "-t"}}) +
                                           entry("weight", {{"type", "gravity"}, {"y", "-0.5*t"}}));
const std::string held = entry("wall", {{"set", "block/left"}, {"stiffness x", "40"}, {"stiffness y", "30"}});
const std::string tool = entry("tool", {{"set", "tool/reference"}, {"stiffness x", "5"}, {"stiffness y", "6"}, {"rotational stiffness", "7"}});
const std::string rope = entry("rope", {{"set", "block/right"}, {"to", "tool/reference"}, {"stiffness", "9"}, {"rest length", "1.2"}});
const std::string anchored = entry("anchored", {{"set", "tool/reference"}, {"anchor", "3, 3"}, {"stiffness", "4"}});
const std::string between = entry("between", {{"set", "block/top"}, {"to", "tool/left"}, {"stiffness x", "3"}, {"stiffness y", "2"}});
const std::string at_nodes = entry("at nodes", {{"set", "block/bottom"}, {"per", "node"}, {"stiffness y", "1.5"}});
const std::string dashpots = list("dashpots", entry("rope", {{"set", "block/right"}, {"to", "tool/reference"}, {"coefficient", "0.8"}}) +
                                                  entry("floor", {{"set", "block/bottom"}, {"coefficient x", "0.3"}, {"coefficient y", "0.6"}}) +
                                                  entry("turning", {{"set", "tool/reference"}, {"rotational coefficient", "0.5"}}));
const std::string mass =
    list("point masses", entry("tool", {{"set", "tool/reference"}, {"mass", "3"}, {"moments of inertia", "0.7"}}) +
                             entry("lid", {{"set", "block/top"}, {"mass", "1.5"}}) + entry("nodes", {{"set", "block"}, {"mass", "0.4"}}));

const std::string plane_springs = list("springs", held + tool + rope + anchored + between + at_nodes);
const std::string space_springs = list(
    "springs",
    entry("wall", {{"set", "block/left"}, {"stiffness x", "40"}, {"stiffness y", "30"}, {"stiffness z", "20"}}) +
        entry("tool", {{"set", "tool/reference"}, {"stiffness x", "5"}, {"stiffness y", "6"}, {"stiffness z", "7"}, {"rotational stiffness", "7"}}) +
        rope + between);
const std::string space_dashpots = list("dashpots", entry("rope", {{"set", "block/right"}, {"to", "tool/reference"}, {"coefficient", "0.8"}}) +
                                                        entry("floor", {{"set", "block/bottom"}, {"coefficient z", "0.3"}}));
const std::string space_mass =
    list("point masses", entry("tool", {{"set", "tool/reference"}, {"mass", "3"}, {"moments of inertia", "0.7, 0.8, 0.9"}}));
const std::string ring_springs = list("springs", entry("wall", {{"set", "block/bottom"}, {"stiffness x", "4"}, {"stiffness y", "30"}}) +
                                                     entry("between", {{"set", "block/top"}, {"to", "tool/reference"}, {"stiffness y", "3"}}) +
                                                     entry("line", {{"set", "block/right"}, {"to", "tool/reference"}, {"stiffness", "3"}}));

const std::vector<Case> cases{{"statics", false, "plane strain", plane_springs + dashpots + push},
                              {"motion", false, "plane strain", plane_springs + dashpots + mass + push + inertia},
                              {"rings", false, "axisymmetric", ring_springs + push},
                              {"statics of space", true, "", space_springs + space_dashpots + push},
                              {"motion of space", true, "", space_springs + space_dashpots + space_mass + push + inertia}};

const RCP<const Communicator>& comm() {
  static const RCP<const Communicator> all = Tpetra::getDefaultComm();
  return all;
}

class ConnectorScenes : public testing::TestWithParam<Case> {};

/// At a state that steps have reached, moved so far that lines have turned.
TEST_P(ConnectorScenes, JacobianAgreesWithCentralDifferences) {
  const Scene scene = read_text(scene_text(GetParam()));
  const Timers timers;
  const Model model(comm(), scene, timers);
  SemiSmoothSystem system(model.parts(), timers);
  const Vector rest(system.map());
  SteppingState state(scene.inertia.acts() ? system.initial_state(rest, Vector(model.parts().dofs), false) : system.initial_state(rest));
  std::optional<StepFailure> failure;
  const auto start = [&](const AcceptedState& from, double time, const Vector& d, Vector& z) { return system.start_step(from, time, d, z); };
  SteppingOptions stepping = scene.stepping;
  stepping.end_time = 0.5;
  ASSERT_TRUE(run_steps(system, stepping, scene.newton, state, start, {}, failure)) << (failure ? failure->what() : "");
  const StepContext context = system.step_from(state.accepted, 0.75);
  Vector x(*state.accepted.x, Teuchos::Copy), v(system.map()), J_v(system.map()), difference(system.map());
  for (const GlobalOrdinal id : local_ids(*x.getMap())) {
    x.sumIntoGlobalValue(id, 2e-2 * std::sin(0.37 * id + 0.4));
    v.replaceGlobalValue(id, std::sin(0.91 * id + 0.4));
  }
  const double h = 1e-6;
  for (const double sign : {1.0, -1.0}) {
    Vector at(x, Teuchos::Copy);
    at.update(sign * h, v, 1.0);
    difference.update(sign / (2.0 * h), system.evaluate(at, context).residual(), 1.0);
  }
  system.linearise(system.evaluate(x, context)).apply(v, J_v);
  const double size = J_v.norm2();
  difference.update(-1.0, J_v, 1.0);
  EXPECT_LE(difference.norm2(), 1e-6 * size);
}

INSTANTIATE_TEST_SUITE_P(All, ConnectorScenes, testing::ValuesIn(cases));

/// Message of the error of a scene or of its model; "" without.
std::string refusal(const std::string& lists, bool in_space = false) {
  try {
    const Model model(comm(), read_text(scene_text({"", in_space, "plane strain", lists})), Timers());
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string springs(const std::vector<std::pair<std::string, std::string>>& values) { return list("springs", entry("one", values)); }

TEST(Springs, HoldBodiesInStatics) {
  EXPECT_EQ(refusal(list("springs", held + tool)), "");
  EXPECT_THAT(refusal(list("springs", held + entry("tool", {{"set", "tool/reference"}, {"stiffness x", "5"}, {"stiffness y", "6"}}))),
              HasSubstr("body 'tool' can move: rotation"));
  EXPECT_THAT(refusal(list("springs", entry("wall", {{"set", "block/left"}, {"stiffness x", "40"}}) + tool)),
              HasSubstr("body 'block' can move: translation in y"));
  // On each other alone they move together, and a line holds along itself alone.
  EXPECT_THAT(refusal(list("springs", tool + rope)), HasSubstr("can move"));
  EXPECT_EQ(
      refusal(list("springs", held + entry("tool", {{"set", "tool/reference"}, {"rotational stiffness", "5"}}) +
                                  entry("joint", {{"set", "block/right"}, {"to", "tool/reference"}, {"stiffness x", "1"}, {"stiffness y", "1"}}))),
      "");
}

TEST(Dashpots, HoldBodiesInStatics) {
  EXPECT_EQ(
      refusal(list("dashpots",
                   entry("tool", {{"set", "tool/reference"}, {"coefficient x", "1"}, {"coefficient y", "1"}, {"rotational coefficient", "1"}})) +
              list("springs", held)),
      "");
}

TEST(Springs, WhatMakesNoSenseIsRefused) {
  EXPECT_THAT(refusal(springs({{"set", "block/lef"}, {"stiffness x", "1"}})), HasSubstr("block/left"));
  EXPECT_THAT(refusal(springs({{"set", "block/left"}})), HasSubstr("nothing that acts on it"));
  EXPECT_THAT(refusal(springs({{"set", "block/left"}, {"stiffness", "1"}})), HasSubstr("\"to\" or to \"anchor\""));
  EXPECT_THAT(refusal(springs({{"set", "block/left"}, {"to", "block/right"}, {"stiffness", "1"}, {"stiffness x", "1"}})), HasSubstr("two lists"));
  EXPECT_THAT(refusal(springs({{"set", "block/left"}, {"stiffness z", "1"}})), HasSubstr("3D"));
  EXPECT_THAT(refusal(springs({{"set", "block/left"}, {"stiffness x", "-1"}})), HasSubstr("stiffness x"));
  EXPECT_THAT(refusal(springs({{"set", "block/left"}, {"anchor", "0, 0.5"}, {"stiffness", "1"}})), HasSubstr("one place"));
  EXPECT_THAT(refusal(springs({{"set", "block/left"}, {"anchor", "0, 0.5, 1"}, {"stiffness", "1"}})), HasSubstr("2 are needed"));
  EXPECT_THAT(refusal(springs({{"set", "block/left"}, {"rotational stiffness", "1"}})), HasSubstr("block/left"));
  EXPECT_THAT(refusal(springs({{"set", "block/left"}, {"to", "block/right"}, {"per", "node"}, {"stiffness x", "1"}})), HasSubstr("ground alone"));
  EXPECT_THAT(refusal(springs({{"set", "tool/reference"}, {"to", "tool/reference"}, {"stiffness x", "1"}})), HasSubstr("at both ends"));
  EXPECT_THAT(refusal(list("point masses", entry("one", {{"set", "block/left"}, {"mass", "0"}}))), HasSubstr("is 0"));
  EXPECT_THAT(refusal(list("point masses", entry("one", {{"set", "tool/reference"}, {"mass", "1"}, {"moments of inertia", "1, 1, 1"}}))),
              HasSubstr("1 are needed"));
  EXPECT_THAT(refusal(list("stabilisation", parameter("type", "string", "viscous") + parameter("until", "double", "2"))), HasSubstr("end time"));
  EXPECT_THAT(refusal(list("stabilisation", parameter("type", "string", "viscous") + parameter("until", "double", "0.25"))), HasSubstr("shorter"));
  EXPECT_THAT(refusal(list("stabilisation", parameter("type", "string", "viscous")) + inertia), HasSubstr("needs no stabilisation"));
}

TEST(Springs, WithoutThemNothingOfThemExists) {
  const std::string conditions =
      list("boundary conditions", entry("block", {{"set", "block/left"}, {"x", "0"}, {"y", "0"}}) +
                                      entry("tool", {{"set", "tool/reference"}, {"x", "0"}, {"y", "0"}, {"rotation", "0"}}));
  const Model model(comm(), read_text(scene_text({"", false, "plane strain", conditions})), Timers());
  EXPECT_EQ(model.parts().contributions.size(), 1U);
  EXPECT_FALSE(model.connectors().springs || model.connectors().dashpots || model.connectors().stabilisation);
  EXPECT_TRUE(model.bodies()->point_masses().empty());
  EXPECT_TRUE(model.supports().connectors.empty());
}

TEST(Springs, ForcesOfASetAreThoseOfItsWholeStiffness) {
  const Scene scene = read_text(scene_text({"", false, "plane strain", list("springs", held + tool + rope + at_nodes)}));
  const Model model(comm(), scene, Timers());
  const Connectors& all = *model.connectors().springs;
  Vector local(model.bodies()->space().local_dofs());
  const Mesh& mesh = *model.mesh();
  for (LocalOrdinal node = 0; node < mesh.local_count(); ++node)
    if (mesh.bodies[mesh.body_of_node[node]].name == "block") {
      local.replaceLocalValue(2 * node, 0.1);
      local.replaceLocalValue(2 * node + 1, -0.2 * mesh.coordinates[node][1]);
    }
  const ConnectorState wall = all.state(0, local, nullptr), line = all.state(2, local, nullptr), nodes = all.state(3, local, nullptr);
  EXPECT_NEAR(wall.force[0], -40.0 * 0.1, 1e-13);
  EXPECT_NEAR(wall.force[1], 30.0 * 0.1, 1e-13);
  EXPECT_NEAR(wall.elongation[1], -0.1, 1e-14);
  EXPECT_NEAR(wall.energy, 0.5 * 40.0 * 0.01 + 0.5 * 30.0 * 0.04 / 3.0, 1e-13);  // the integral of (0.2 y)^2
  const double length = std::hypot(3.0 - 1.1, 0.9 - 0.4);
  EXPECT_NEAR(line.elongation_along, length - 1.2, 1e-13);
  EXPECT_NEAR(line.along, 9.0 * (length - 1.2), 1e-12);
  EXPECT_NEAR(nodes.force[1], 0.0, 1e-14);
  Vector forces(model.parts().dofs);
  std::optional<StepFailure> failure;
  all.add_forces(local, nullptr, forces, failure);
  EXPECT_FALSE(failure);
  Vector ones(model.parts().dofs);
  ones.putScalar(1.0);
  EXPECT_NEAR(forces.dot(ones), 40.0 * 0.1 - 30.0 * 0.1, 1e-12) << "forces between the bodies have the sum 0";
}

TEST(PointMasses, HaveTheirMassAndWeight) {
  const Scene scene = read_text(scene_text({"", false, "plane strain", mass + push + list("springs", held + tool) + inertia}));
  const Model model(comm(), scene, Timers());
  Vector ones(model.parts().dofs);
  ones.putScalar(1.0);
  // Of the block 2, of points 3 + 1.5 + 0.4; the moment of inertia over the square of the arm, twice for the idle dof.
  double arm = model.mesh()->reference_points.front().arm;
  EXPECT_NEAR(model.inertia().mass->times(ones)->dot(ones), 2.0 * (2.0 + 4.9 + 0.7 / (arm * arm)), 1e-12);
  Vector residual(model.parts().dofs), local(model.parts().local_dofs);
  std::optional<StepFailure> failure;
  for (const auto& contribution : model.parts().contributions)
    if (contribution->name() == "weight") contribution->add_residual({1.0, residual, local}, residual, failure);
  EXPECT_NEAR(residual.dot(ones), 0.5 * (2.0 + 4.9), 1e-12);
}

}  // namespace
}  // namespace mortise
