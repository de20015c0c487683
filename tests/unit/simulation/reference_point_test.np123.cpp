// Rigid bodies and tied sets in the nonlinear system: derivative, Newton direction, forces.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>

#include "mortise/core/trilinos_versions.hpp"
#include "mortise/simulation/model/model.hpp"
#include "scene_text.hpp"

namespace mortise {
namespace {

using namespace test;
using ::testing::HasSubstr;

/// A base with a body on it; the slave is the base's top.
struct Case {
  std::string name, kinematics, body, points, conditions, loads;
  double friction = 0.0;
  std::string formulation = "dual mortar";
};

void PrintTo(const Case& one, std::ostream* stream) { *stream << one.name; }

std::string condition(const std::string& name, const std::string& set, const std::string& x, const std::string& y, const std::string& rotation = "") {
  std::string content = parameter("set", "string", set);
  if (!x.empty()) content += parameter("x", "string", x);
  if (!y.empty()) content += parameter("y", "string", y);
  if (!rotation.empty()) content += parameter("rotation", "string", rotation);
  return list(name, content);
}

std::string load(const std::string& name, const std::string& type, const std::string& set, const std::string& component, const std::string& value) {
  return list(name, parameter("type", "string", type) + parameter("set", "string", set) + parameter(component, "string", value));
}

std::string scene_text(const Case& one) {
  const std::string body = one.body.empty() ? parameter("material", "string", "rubber") + parameter("element", "string", "Q4") : one.body;
  const auto block = [](const std::string& width, const std::string& cells, const std::string& translation) {
    return list("mesh", parameter("type", "string", "block") + parameter("width", "string", width) + parameter("height", "string", "1") +
                            parameter("cells x", "string", cells) + parameter("cells y", "string", "2") +
                            parameter("translation", "string", translation));
  };
  const std::string material = list("rubber", parameter("type", "string", one.kinematics == "plane stress" ? "st venant kirchhoff" : "neo hooke") +
                                                  parameter("young's modulus", "double", "100") + parameter("poisson's ratio", "double", "0.3"));
  const std::string pair = list(
      "pair", parameter("slave", "string", "base/top") + parameter("master", "string", "upper/bottom") +
                  list("formulation", parameter("type", "string", one.formulation)) +
                  list("friction", one.friction > 0.0
                                       ? parameter("type", "string", "coulomb") + parameter("coefficient", "string", fmt::format("{}", one.friction))
                                       : parameter("type", "string", "none")));
  return list("tied", parameter("kinematics", "string", one.kinematics) + list("materials", material) +
                          list("bodies", list("base", parameter("material", "string", "rubber") + parameter("element", "string", "Q4") +
                                                          block("4", "7", "0, 0")) +
                                             list("upper", body + block("2.2", "3", "0.9, 1"))) +
                          list("sets", list("flank nodes", parameter("of", "string", "base/left") + parameter("where", "string", "y - 0.1"))) +
                          (one.points.empty() ? "" : list("reference points", one.points)) +
                          list("boundary conditions", condition("floor", "base/bottom", "0", "0") + one.conditions) +
                          (one.loads.empty() ? "" : list("loads", one.loads)) + list("contact", pair) +
                          list("stepping", parameter("end time", "double", "1") + parameter("step", "double", "0.25")));
}

/// The same in 3D: a wider brick on a brick.
std::string space_text(const Case& one) {
  const auto brick = [](const std::string& width, const std::string& depth, const std::string& cells, const std::string& translation) {
    return list("mesh", parameter("type", "string", "brick") + parameter("width", "string", width) + parameter("depth", "string", depth) +
                            parameter("cells x", "string", cells) + parameter("cells y", "string", cells) + parameter("cells z", "string", "2") +
                            parameter("translation", "string", translation));
  };
  const std::string elastic = parameter("material", "string", "rubber") + parameter("element", "string", "H8");
  const std::string material = list("rubber", parameter("type", "string", "neo hooke") + parameter("young's modulus", "double", "100") +
                                                  parameter("poisson's ratio", "double", "0.3"));
  const std::string held = parameter("x", "string", "0") + parameter("y", "string", "0") + parameter("z", "string", "0");
  const std::string pair = list(
      "pair", parameter("slave", "string", "base/top") + parameter("master", "string", "upper/bottom") +
                  list("friction", parameter("type", "string", "coulomb") + parameter("coefficient", "string", fmt::format("{}", one.friction))));
  return list("tied", parameter("kinematics", "string", one.kinematics) + list("materials", material) +
                          list("bodies", list("base", elastic + brick("1.2", "1.1", "3", "0.45, 0.4, 0")) +
                                             list("upper", (one.body.empty() ? elastic : one.body) + brick("2.2", "2.3", "4", "0, -0.1, 1"))) +
                          (one.points.empty() ? "" : list("reference points", one.points)) +
                          list("boundary conditions", list("floor", parameter("set", "string", "base/bottom") + held) + one.conditions) +
                          (one.loads.empty() ? "" : list("loads", one.loads)) + list("contact", pair) +
                          list("stepping", parameter("end time", "double", "1") + parameter("step", "double", "0.25")));
}

Scene read(const Case& one) { return read_text(one.kinematics == "three dimensional" ? space_text(one) : scene_text(one)); }

const std::string rigid = parameter("rigid", "bool", "true") + parameter("reference point", "string", "2.3, 2.5");

std::string tied(const std::string& more) { return list("grip", parameter("set", "string", "upper/top") + more); }

const std::vector<Case> cases{
    {"free rigid body", "plane strain", rigid, "", condition("guide", "upper/reference", "0.1*t", ""),
     load("push", "nodal force", "upper/reference", "y", "-20*t") + load("twist", "moment", "upper/reference", "moment", "3*t"), 0.2},
    {"turning rigid body", "plane strain", rigid, "", condition("drive", "upper/reference", "0.05*t", "-0.1*t", "20*t"), "", 0.3},
    {"rigid body, axisymmetric", "axisymmetric", parameter("rigid", "bool", "true"), "", "",
     load("push", "nodal force", "upper/reference", "y", "-200*t"), 0.2},
    {"tied set that turns", "plane strain", "", tied(parameter("position", "string", "2.2, 3")), condition("guide", "grip", "0.1*t", ""),
     load("push", "nodal force", "grip", "y", "-20*t") + load("twist", "moment", "grip", "moment", "3*t"), 0.2},
    {"tied set that does not turn", "plane strain", "", tied(parameter("rotation", "bool", "false")), condition("guide", "grip", "0.1*t", ""),
     load("push", "nodal force", "grip", "y", "-20*t"), 0.2},
    {"set tied in one component", "plane stress", "", tied(parameter("rotation", "bool", "false") + parameter("follows", "string", "y")),
     condition("middle", "upper/left", "0", ""), load("push", "nodal force", "grip", "y", "-20*t"), 0.2},
    {"tied slave side", "plane strain", rigid, list("flank", parameter("set", "string", "flank nodes") + parameter("rotation", "bool", "false")),
     condition("drive", "upper/reference", "0", "-0.1*t", "5*t"), load("pull", "nodal force", "flank", "x", "-3*t"), 0.2}};

const std::string rigid_in_space = parameter("rigid", "bool", "true") + parameter("reference point", "string", "1.1, 1, 2.5");

std::string in_space(const std::string& set, const std::vector<std::pair<std::string, std::string>>& values) {
  std::string content = parameter("set", "string", set);
  for (const auto& [name, value] : values) content += parameter(name, "string", value);
  return list("drive", content);
}

const std::vector<Case> space_cases{
    {"free rigid body of space", "three dimensional", rigid_in_space, "",
     in_space("upper/reference", {{"x", "0.1*t"}, {"y", "-0.05*t"}, {"rotation z", "10*t"}}),
     load("push", "nodal force", "upper/reference", "z", "-20*t"), 0.2},
    {"turning rigid body of space", "three dimensional", rigid_in_space, "",
     in_space("upper/reference",
              {{"x", "0.05*t"}, {"y", "0"}, {"z", "-0.2*t"}, {"rotation x", "4*t"}, {"rotation y", "-6*t"}, {"rotation z", "30*t"}}),
     "", 0.3},
    {"tied set of space that turns", "three dimensional", "",
     list("grip", parameter("set", "string", "upper/top") + parameter("position", "string", "1, 1, 2.1")),
     in_space("grip", {{"x", "0.05*t"}, {"y", "0"}, {"rotation z", "5*t"}}), load("push", "nodal force", "grip", "z", "-20*t"), 0.2},
    {"tied set of space that a moment turns", "three dimensional", "",
     list("grip", parameter("set", "string", "upper/top") + parameter("position", "string", "1, 1, 2.1")),
     in_space("grip", {{"x", "0.05*t"}, {"y", "0"}, {"rotation z", "5*t"}}),
     load("push", "nodal force", "grip", "z", "-20*t") +
         list("twist", parameter("type", "string", "moment") + parameter("set", "string", "grip") + parameter("moment x", "string", "3*t") +
                           parameter("moment y", "string", "-2*t") + parameter("moment z", "string", "5*t")),
     0.2},
    {"set of space tied in one component", "three dimensional", "",
     list("grip", parameter("set", "string", "upper/top") + parameter("rotation", "bool", "false") + parameter("follows", "string", "z")),
     in_space("upper/left", {{"x", "0"}, {"y", "0"}}), load("push", "nodal force", "grip", "z", "-20*t"), 0.2}};

class ReferencePoints : public testing::TestWithParam<Case> {};

/// F, J and the direction at a state that a run has reached, moved a little so that nothing is settled.
TEST_P(ReferencePoints, JacobianAgreesWithCentralDifferences) {
  const auto comm = Tpetra::getDefaultComm();
  const Scene scene = read(GetParam());
  const Timers timers;
  const Model model(comm, scene, timers);
  SemiSmoothSystem system(model.parts(), timers);
  SteppingState state(system.initial_state(Vector(system.map())));
  std::optional<StepFailure> failure;
  const auto start = [&](const AcceptedState& from, double time, const Vector& d, Vector& z) { return system.start_step(from, time, d, z); };
  SteppingOptions stepping = scene.stepping;
  stepping.end_time = 0.5;
  ASSERT_TRUE(run_steps(system, stepping, scene.newton, state, start, {}, failure)) << failure->what();
  Vector x(*state.accepted.x, Teuchos::Copy);
  const StepContext context = start(state.accepted, 0.75, *system.unknowns(std::as_const(x)), *system.multipliers(x));
  Vector v(system.map()), J_v(system.map()), difference(system.map()), direction(system.map()), J_dx(system.map());
  for (const GlobalOrdinal id : local_ids(*x.getMap())) {
    x.sumIntoGlobalValue(id, 2e-3 * std::sin(0.37 * id + 0.4));
    v.replaceGlobalValue(id, std::sin(0.91 * id + 0.4));
  }
  const double h = 1e-6;
  for (const double sign : {1.0, -1.0}) {
    Vector at(x, Teuchos::Copy);
    at.update(sign * h, v, 1.0);
    difference.update(sign / (2.0 * h), system.evaluate(at, context).residual(), 1.0);
  }
  const SystemLinearisation linearisation = system.linearise(system.evaluate(x, context));
  const Vector& F = linearisation.evaluation().residual();
  EXPECT_GT(linearisation.evaluation().norms().active, 0);
  linearisation.apply(v, J_v);
  const double size = J_v.norm2();
  difference.update(-1.0, J_v, 1.0);
  EXPECT_LE(difference.norm2(), 1e-6 * size);

  linearisation.newton_direction(F, direction);
  linearisation.apply(direction, J_dx);
  J_dx.update(1.0, F, 1.0);
  EXPECT_LE(J_dx.norm2(), 1e-11 * F.norm2());
}

INSTANTIATE_TEST_SUITE_P(All, ReferencePoints, testing::ValuesIn(cases));
INSTANTIATE_TEST_SUITE_P(InSpace, ReferencePoints, testing::ValuesIn(space_cases));

/// The cases with multipliers that stay unknowns, and with conditions that give them.
std::vector<Case> other_formulations() {
  std::vector<Case> all;
  for (const std::string formulation : {"standard mortar", "variational mortar", "node to segment", "penalty"})
    for (const std::size_t i : {std::size_t{0}, std::size_t{2}, cases.size() - 1}) {
      Case one = cases[i];
      one.name += ", " + formulation;
      one.formulation = formulation;
      all.push_back(one);
    }
  return all;
}

INSTANTIATE_TEST_SUITE_P(OtherFormulations, ReferencePoints, testing::ValuesIn(other_formulations()));

std::string complaints(const Case& one) {
  try {
    const Scene scene = read(one);
    const Timers timers;
    const Model model(Tpetra::getDefaultComm(), scene, timers);
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(ReferencePointErrors, NameWhatIsWrong) {
  Case one = cases[0];
  one.conditions += condition("wrong", "upper/top", "0", "");
  EXPECT_THAT(complaints(one), HasSubstr("nodes that follow \"upper/reference\"; please prescribe \"upper/reference\""));
  one = cases[0];
  one.points = list("again", parameter("set", "string", "upper/left"));
  EXPECT_THAT(complaints(one), HasSubstr("follows \"upper/reference\" already"));
  one = cases[0];
  one.loads = load("twist", "moment", "upper", "moment", "1");
  EXPECT_THAT(complaints(one), HasSubstr("no reference point that rotates"));
  one = cases[0];
  one.conditions = "";
  one.friction = 0.0;
  EXPECT_THAT(complaints(one), HasSubstr("body 'upper' can move: translation in x"));
  one = cases[4];
  one.conditions = "";
  one.friction = 0.0;
  EXPECT_THAT(complaints(one), HasSubstr("body 'upper' can move: translation in x"));
  one = cases[2];
  one.conditions = condition("radial", "upper/reference", "0.1*t", "");
  EXPECT_THAT(complaints(one), HasSubstr("in which nothing follows it"));
  one = cases[0];
  one.body += parameter("material", "string", "rubber");
  EXPECT_THAT(complaints(one), HasSubstr("a rigid body has no material"));
  one = space_cases[0];
  one.body = rigid;
  EXPECT_THAT(complaints(one), HasSubstr("the position of its reference point has 2 numbers; a scene with kinematics \"three dimensional\" needs 3"));
  one = space_cases[0];
  one.conditions = in_space("upper/reference", {{"x", "0"}, {"y", "0"}, {"rotation", "10*t"}});
  EXPECT_THAT(complaints(one), HasSubstr("prescribes a rotation for 2D in a 3D model"));
  one = space_cases[0];
  one.loads = load("twist", "moment", "upper/reference", "moment", "1");
  EXPECT_THAT(complaints(one), HasSubstr("\"moment\" is for 2D, the model is in 3D; please give \"moment x\", \"moment y\", \"moment z\""));
  one = cases[0];
  one.loads = load("twist", "moment", "upper/reference", "moment x", "1");
  EXPECT_THAT(complaints(one), HasSubstr("\"moment x\" is for 3D, the model is in 2D; please give \"moment\""));
  one = space_cases[0];
  one.loads = load("twist", "moment", "uper/reference", "moment x", "1");
  EXPECT_THAT(complaints(one), HasSubstr("no reference point that rotates; did you mean \"upper/reference\"?"));
  one = space_cases.back();
  one.loads = load("twist", "moment", "grip", "moment x", "1");
  EXPECT_THAT(complaints(one), HasSubstr("\"grip\" cannot rotate: there is no reference point that rotates"));
}

}  // namespace
}  // namespace mortise
