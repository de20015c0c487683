// Surfaces that are glued together: what slave nodes follow, the derivative, the Newton direction, forces, bad input.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "mortise/core/trilinos_versions.hpp"
#include "mortise/simulation/model/model.hpp"
#include "scene_text.hpp"

namespace mortise {
namespace {

using namespace test;
using ::testing::HasSubstr;

/// A block on a block.
struct Case {
  std::string name;
  std::string lower = "Q4", upper = "Q4";  ///< elements; "rigid"
  std::string more = "";                   ///< lists of the scene
  std::string tie = "";                    ///< more parameters of the tie
  double rise = 0.0;                       ///< of the interface in 2D
  std::string slave = "upper/bottom", master = "lower/top";
};

void PrintTo(const Case& one, std::ostream* stream) { *stream << one.name; }

bool in_space(const Case& one) { return one.upper[0] == 'H' || one.upper[0] == 'W' || one.upper.substr(0, 3) == "Tet"; }

std::string body_text(const std::string& name, const std::string& element, const std::string& mesh) {
  const std::string made_of = element == "rigid" ? parameter("rigid", "bool", "true") + parameter("reference point", "string", "0.9, 0.2")
                                                 : parameter("material", "string", "rubber") + parameter("element", "string", element);
  return list(name, made_of + list("mesh", mesh));
}

std::string plane_mesh(const std::string& corners, int cells) {
  return parameter("type", "string", "block") + parameter("corners", "string", corners) + parameter("cells x", "int", std::to_string(cells)) +
         parameter("cells y", "int", "2");
}

std::string space_mesh(double height, int cells, double z) {
  return parameter("type", "string", "brick") + parameter("height", "string", fmt::format("{}", height)) +
         parameter("cells x", "int", std::to_string(cells)) + parameter("cells y", "int", std::to_string(cells + 1)) +
         parameter("cells z", "int", "2") + parameter("translation", "string", fmt::format("0, 0, {}", z));
}

const std::string rubber = list("rubber", parameter("type", "string", "neo hooke") + parameter("young's modulus", "double", "100") +
                                              parameter("poisson's ratio", "double", "0.3"));

std::string condition(const std::string& name, const std::string& set, const std::vector<std::pair<std::string, std::string>>& values) {
  std::string content = parameter("set", "string", set);
  for (const auto& [component, value] : values) content += parameter(component, "string", value);
  return list(name, content);
}

std::string text_of(const Case& one) {
  std::string bodies, conditions = one.lower == "rigid" ? condition("drive", "lower/reference", {{"x", "0.1*t"}, {"y", "0"}, {"rotation", "30*t"}})
                                                        : condition("floor", "lower/bottom", {{in_space(one) ? "z" : "y", "0"}});
  if (in_space(one)) {
    bodies = body_text("lower", one.lower, space_mesh(0.5, 3, 0.0)) + body_text("upper", one.upper, space_mesh(0.5, 2, 0.5));
    for (const std::string body : {"lower", "upper"})
      conditions += condition(body + " left", body + "/left", {{"x", "0"}}) + condition(body + " front", body + "/front", {{"y", "0"}});
    conditions += condition("pull", "upper/top", {{"z", "0.2*t"}});
  } else {
    bodies = body_text("lower", one.lower, plane_mesh(fmt::format("0, 0, 2, 0, 2, {}, 0, {}", 1.0 + one.rise, 1.0 - one.rise), 5)) +
             body_text("upper", one.upper, plane_mesh(fmt::format("0, {}, 2, {}, 2, 2, 0, 2", 1.0 - one.rise, 1.0 + one.rise), 4));
    if (one.lower != "rigid") conditions += condition("left", "lower/left", {{"x", "0"}}) + condition("pull", "upper/top", {{"y", "0.2*t"}});
  }
  const std::string tie = parameter("slave", "string", one.slave) + parameter("master", "string", one.master) + one.tie;
  return list("tied", parameter("kinematics", "string", in_space(one) ? "three dimensional" : "plane strain") + list("materials", rubber) +
                          list("bodies", bodies) + list("boundary conditions", conditions) + list("ties", list("joint", tie)) + one.more +
                          list("stepping", parameter("end time", "double", "1") + parameter("step", "double", "0.25")));
}

std::string sets(const std::string& content) { return list("sets", content); }
std::string half(const std::string& name, const std::string& of, const std::string& where) {
  return list(name, parameter("of", "string", of) + parameter("kind", "string", "sides") + parameter("where", "string", where));
}
std::string pair(const std::string& slave, const std::string& master) {
  return list("contact", list("beside", parameter("slave", "string", slave) + parameter("master", "string", master)));
}

const std::string halves =
    sets(half("glued", "upper/bottom", "1 - x") + half("loose", "upper/bottom", "x - 1") + half("base", "lower/top", "x - 1.01"));

const std::vector<Case> cases{{"lines"},
                              {"inclined lines", "Q4", "Q4", "", "", 0.3},
                              {"quadratic lines", "Q8", "Q8", "", "", 0.3},
                              {"quadratic lines on linear ones", "Q4", "Q8"},
                              {"linear lines on quadratic ones", "T6", "T3"},
                              {"beside contact", "Q4", "Q4", halves + pair("loose", "base"), "", 0.0, "glued"},
                              {"beside contact of masters", "Q4", "Q4", halves + pair("base", "loose"), "", 0.0, "glued"},
                              {"beside contact, other way round", "Q4", "Q4", halves + pair("loose", "base"), "", 0.0, "lower/top", "glued"},
                              {"rigid master that turns", "rigid", "Q4"},
                              {"quadrilaterals", "H8", "H8"},
                              {"triangles on quadrilaterals", "H8", "Tet4"},
                              {"wedges on wedges", "W6", "W6"},
                              {"quadratic quadrilaterals", "H20", "H20"},
                              {"quadratic triangles", "Tet10", "Tet10"},
                              {"quadratic wedges on linear hexahedra", "H8", "W15"}};

class SurfaceTies : public testing::TestWithParam<Case> {};

TEST_P(SurfaceTies, SlavesFollowLinearFieldsAndNoTiedNode) {
  const Scene scene = read_text(text_of(GetParam()));
  const Model model(Tpetra::getDefaultComm(), scene, Timers());
  const Mesh& mesh = *model.mesh();
  const AffineConstraints& tied = *model.parts().constraints;
  EXPECT_GT(model.ties_at_start()[0].tied, 0);
  Vector field(model.parts().dofs), followed(model.parts().dofs), marks(model.parts().dofs), seen(model.parts().dofs);
  {
    const auto values = field.getLocalViewHost(Tpetra::Access::OverwriteAll), mark = marks.getLocalViewHost(Tpetra::Access::ReadWrite);
    for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node)
      for (int i = 0; i < mesh.dimension; ++i) {
        const auto& x = mesh.coordinates[static_cast<std::size_t>(node)];
        values(mesh.dimension * node + i, 0) = 3.0 + i + 2.0 * x[0] - (1.0 + i) * x[1] + 0.7 * x[2];
      }
    for (const LocalOrdinal dof : tied.dependent()) mark(dof, 0) = 1.0 + dof % 7;
  }
  tied.T()->apply(field, followed);
  followed.update(-1.0, field, 1.0);
  EXPECT_LE(followed.normInf(), 1e-12 * field.normInf());
  tied.T()->apply(marks, seen);
  EXPECT_EQ(seen.normInf(), 0.0) << "a tied dof follows a tied one";
}

struct Reached {
  Vector x;
  StepContext context;
};

Reached run_to(const Scene& scene, const SemiSmoothSystem& system, double time) {
  SteppingState state(system.initial_state(Vector(system.map())));
  std::optional<StepFailure> failure;
  const auto start = [&](const AcceptedState& from, double to, const Vector& d, Vector& z) { return system.start_step(from, to, d, z); };
  SteppingOptions stepping = scene.stepping;
  stepping.end_time = time;
  EXPECT_TRUE(run_steps(system, stepping, scene.newton, state, start, {}, failure)) << failure->what();
  Vector x(*state.accepted.x, Teuchos::Copy);
  const StepContext context = start(state.accepted, time + 0.25, *system.unknowns(std::as_const(x)), *system.multipliers(x));
  return {x, context};
}

TEST_P(SurfaceTies, JacobianAgreesWithCentralDifferences) {
  const Scene scene = read_text(text_of(GetParam()));
  const Timers timers;
  const Model model(Tpetra::getDefaultComm(), scene, timers);
  SemiSmoothSystem system(model.parts(), timers);
  auto [x, context] = run_to(scene, system, 0.5);
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
  linearisation.apply(v, J_v);
  const double size = J_v.norm2();
  difference.update(-1.0, J_v, 1.0);
  EXPECT_LE(difference.norm2(), 1e-6 * size);
  const Vector& F = linearisation.evaluation().residual();
  linearisation.newton_direction(F, direction);
  linearisation.apply(direction, J_dx);
  J_dx.update(1.0, F, 1.0);
  EXPECT_LE(J_dx.norm2(), 1e-10 * F.norm2());
}

/// Without rigid bodies: rotations of reference points are no forces.
class DeformableTies : public SurfaceTies {};

std::vector<Case> deformable_cases() {
  std::vector<Case> kept;
  std::copy_if(cases.begin(), cases.end(), std::back_inserter(kept), [](const Case& one) { return one.lower != "rigid"; });
  return kept;
}

// Forces of ties do no work on motions that the ties allow, and have no resultant, nor a moment where slaves lie on their masters.
TEST_P(DeformableTies, GatheredForcesKeepTheirResultants) {
  const Scene scene = read_text(text_of(GetParam()));
  const Timers timers;
  const Model model(Tpetra::getDefaultComm(), scene, timers);
  SemiSmoothSystem system(model.parts(), timers);
  const auto [x, context] = run_to(scene, system, 0.5);
  const SystemEvaluation at = system.evaluate(x, context);
  const RCP<const Vector> gathered = at.forces();
  Vector internal(model.parts().dofs), on_tied(model.parts().dofs);
  Vector local(model.parts().local_dofs);
  local.doImport(*system.unknowns(x), Import(model.parts().dofs, model.parts().local_dofs), Tpetra::INSERT);
  std::optional<StepFailure> failure;
  for (const auto& one : model.parts().contributions) one->add_residual({context.time, *system.unknowns(x), local}, internal, failure);
  if (model.contact()) at.contact_laws().add_force(internal);
  const Mesh& mesh = *model.mesh();
  std::vector<double> mine(4, 0.0), all(4, 0.0);  // three components and the moment about z, in the reference configuration
  {
    const auto before = internal.getLocalViewHost(Tpetra::Access::ReadOnly), after = gathered->getLocalViewHost(Tpetra::Access::ReadOnly);
    for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node)
      for (int i = 0; i < mesh.dimension; ++i) {
        const double change = after(mesh.dimension * node + i, 0) - before(mesh.dimension * node + i, 0);
        const auto& X = mesh.coordinates[static_cast<std::size_t>(node)];
        mine[static_cast<std::size_t>(i)] += change;
        mine[3] += i == 0 ? -X[1] * change : i == 1 ? X[0] * change : 0.0;
      }
    for (const LocalOrdinal dof : model.parts().constraints->dependent()) EXPECT_EQ(after(dof, 0), 0.0);
  }
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_SUM, 4, mine.data(), all.data());
  const double size = internal.norm1();
  EXPECT_GT(size, 1.0);
  for (const double sum : all) EXPECT_LE(std::abs(sum), 1e-12 * size);
}

INSTANTIATE_TEST_SUITE_P(All, SurfaceTies, testing::ValuesIn(cases));
INSTANTIATE_TEST_SUITE_P(All, DeformableTies, testing::ValuesIn(deformable_cases()));

/// Two blocks side by side, tied, on a base that is held or not, with friction.
std::string blocks_on_base(bool base_is_held) {
  const auto block = [](double x, double y, double width, int cells) {
    return plane_mesh(fmt::format("{0}, {2}, {1}, {2}, {1}, {3}, {0}, {3}", x, x + width, y, y + 1.0), cells);
  };
  const auto on_base = [](const std::string& name) {
    return list(name, parameter("slave", "string", name + "/bottom") + parameter("master", "string", "base/top") +
                          list("friction", parameter("type", "string", "coulomb") + parameter("coefficient", "double", "0.3")));
  };
  const std::string held =
      base_is_held ? condition("floor", "base/bottom", {{"x", "0"}, {"y", "0"}}) : condition("floor", "base/bottom", {{"y", "0"}});
  const std::string load =
      list("press", parameter("type", "string", "dead traction") + parameter("set", "string", "left/top") + parameter("y", "string", "-2*t"));
  return list("loose", parameter("kinematics", "string", "plane strain") + list("materials", rubber) +
                           list("bodies", body_text("base", "Q4", block(-1.0, 0.0, 4.0, 7)) + body_text("left", "Q4", block(0.0, 1.0, 1.0, 3)) +
                                              body_text("right", "Q4", block(1.0, 1.0, 1.0, 4))) +
                           list("boundary conditions", held) + list("loads", load) +
                           list("ties", list("joint", parameter("slave", "string", "right/left") + parameter("master", "string", "left/right"))) +
                           list("contact", on_base("left") + on_base("right")) +
                           list("stepping", parameter("end time", "double", "1") + parameter("step", "double", "0.25")));
}

TEST(TiesHold, BodiesThatAreTiedToOnesThatAreHeld) {
  const Scene scene = read_text(text_of(cases[0]));
  const Model model(Tpetra::getDefaultComm(), scene, Timers());
  for (const char loose : model.held_by_contact_only()) EXPECT_FALSE(loose);
}

TEST(TiesHold, BodiesTogetherWhereContactAloneHoldsThem) {
  const Scene scene = read_text(blocks_on_base(true));
  const Timers timers;
  const Model model(Tpetra::getDefaultComm(), scene, timers);
  const Mesh& mesh = *model.mesh();
  for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node)
    EXPECT_EQ(model.held_by_contact_only()[static_cast<std::size_t>(node)] != 0, mesh.body_of_node[static_cast<std::size_t>(node)] > 0);
  const SemiSmoothSystem system(model.parts(), timers);
  run_to(scene, system, 0.75);
}

TEST(TiesHold, NoMotionOfAllBodiesTogether) {
  std::string message;
  try {
    const Scene scene = read_text(blocks_on_base(false));
    const Model model(Tpetra::getDefaultComm(), scene, Timers());
  } catch (const InputError& error) {
    message = error.what();
  }
  EXPECT_THAT(message, HasSubstr("can move: translation in x"));
  EXPECT_EQ(message.find("can move"), message.rfind("can move"));
}

std::string complaints(const Case& one) {
  try {
    const Scene scene = read_text(text_of(one));
    const Model model(Tpetra::getDefaultComm(), scene, Timers());
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(SurfaceTieErrors, NameTheNodeAndThePlace) {
  Case one;
  one.slave = "upper/top";
  EXPECT_THAT(complaints(one), HasSubstr("ties/joint: tie \"joint\" holds nothing: no master facet covers 20 % of a slave node within the tolerance "
                                         "0.05"));
  one = {};
  one.slave = "lower/top";
  EXPECT_THAT(complaints(one), HasSubstr("slave and master are the same set \"lower/top\""));
  one = {};
  one.slave = "upper/botom";
  EXPECT_THAT(complaints(one), HasSubstr("upper/botom"));
  one = {};
  one.tie = parameter("tolerance", "double", "0");
  EXPECT_THAT(complaints(one), HasSubstr("tolerance"));
}

TEST(SurfaceTieErrors, RigidSlave) {
  Case one;
  one.lower = "rigid";
  std::swap(one.slave, one.master);
  EXPECT_THAT(complaints(one), HasSubstr("holds nothing: all slave nodes that a master covers are prescribed, follow a rigid body or a reference "
                                         "point, or belong to other ties; please exchange slave and master"));
}

TEST(SurfaceTieErrors, FacetsOfTwoTies) {
  std::string text = text_of(Case{});
  const std::string again = list("again", parameter("slave", "string", "upper/bottom") + parameter("master", "string", "lower/top"));
  const std::string ties = "<ParameterList name=\"ties\">\n";
  text.insert(text.find(ties) + ties.size(), again);
  std::string message;
  try {
    const Scene scene = read_text(text);
    const Model model(Tpetra::getDefaultComm(), scene, Timers());
  } catch (const InputError& error) {
    message = error.what();
  }
  EXPECT_THAT(message, HasSubstr("tie \"again\": all nodes of a slave facet"));
  EXPECT_THAT(message, HasSubstr("belong to other ties too, as node"));
  EXPECT_THAT(message, HasSubstr("to \"joint\"; a node follows one surface"));
}

}  // namespace
}  // namespace mortise
