// Moments on reference points in 3D and the moments that hold them, against statics, work and 2D results; at large rotations.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>

#include "mortise/mesh/reference_point.hpp"
#include "mortise/mesh/sets.hpp"
#include "mortise/simulation/model/model.hpp"
#include "mortise/simulation/quantities/quantity_kinds.hpp"
#include "mortise/solid/rotation_vector.hpp"
#include "quantity_text.hpp"

namespace mortise {
namespace {

using namespace test;
using Eigen::Vector3d;
using ::testing::HasSubstr;
using Values = std::vector<std::pair<std::string, std::string>>;

std::string with_set(const std::string& set, const Values& values) {
  std::string content = parameter("set", "string", set);
  for (const auto& [name, value] : values) content += parameter(name, "string", value);
  return content;
}

/// A soft bar 1 x 1 x 2, or a wider one of one layer or in 2D; "foot" holds its lower end, "grip" its upper one.
struct Bar {
  std::string kinematics = "three dimensional", element = "H8", material = "neo hooke";
  std::string mesh = parameter("type", "string", "brick") + parameter("height", "double", "2") + parameter("cells x", "int", "2") +
                     parameter("cells y", "int", "2") + parameter("cells z", "int", "4");
  std::string foot_set = "bar/bottom", grip_set = "bar/top", grip_at = "0.6, 0.3, 2.2", end = "1";
  Values foot{{"x", "0"}, {"y", "0"}, {"z", "0"}, {"rotation x", "0"}, {"rotation y", "0"}, {"rotation z", "0"}}, grip, moment;
  std::string sets, more_conditions;
  double step = 0.1;
};

/// The bar at the end of its run.
class Result {
 public:
  explicit Result(const Bar& bar)
      : scene_(read_text(text(bar))), model_(Tpetra::getDefaultComm(), scene_, timers_), system_(model_.parts(), timers_) {
    const auto energy_error = quantity("energy error", {{"against", "stored and plastic"}})->make_evaluator(QuantityContext{*model_.bodies()});
    StepperObserver observer;
    observer.accepted = [&](const StepReport&, const SystemEvaluation& at) {
      look_at(at);
      energy_error_ = energy_error->evaluate(context());
    };
    std::optional<StepFailure> failure;
    SteppingState state(system_.initial_state(Vector(system_.map())));
    const bool done = run_steps(system_, scene_.stepping, scene_.newton, state, {}, observer, failure);
    EXPECT_TRUE(done) << failure->what();
  }

  double energy_error() const { return energy_error_; }

  double value(const Quantity& quantity) const {
    const QuantityContext context = this->context();
    return quantity.make_evaluator(context)->evaluate(context);
  }

  double reaction(const std::string& set, Reaction::Of component) const {
    Reaction reaction;
    reaction.set.value = set;
    reaction.component = component;
    return value(reaction);
  }
  Vector3d force(const std::string& set) const {
    return {reaction(set, Reaction::Of::x), reaction(set, Reaction::Of::y), reaction(set, Reaction::Of::z)};
  }
  Vector3d moment(const std::string& set) const {
    return {reaction(set, Reaction::Of::rotation_x), reaction(set, Reaction::Of::rotation_y), reaction(set, Reaction::Of::rotation_z)};
  }

  /// [degrees]
  double rotation(const std::string& set, const std::string& component) const {
    return value(*quantity("rotation", {{"set", set}, {"component", component}}));
  }
  Vector3d rotation(const std::string& set) const { return {rotation(set, "x"), rotation(set, "y"), rotation(set, "z")}; }

  const ReferencePoint& point(const std::string& name) const { return require_rotating_point(*model_.mesh(), {name, {}}); }
  /// Three numbers of a node of a reference point, owned by any rank.
  Vector3d at(const Vector& vector, LocalOrdinal node) const {
    Vector local(model_.bodies()->space().local_dofs());
    local.doImport(vector, *model_.bodies()->space().ghost_import(), Tpetra::INSERT);
    const auto values = local.getLocalViewHost(Tpetra::Access::ReadOnly);
    return {values(3 * node, 0), values(3 * node + 1, 0), values(3 * node + 2, 0)};
  }
  Vector3d position(const std::string& name) const {
    const LocalOrdinal node = point(name).node;
    return Vector3d(model_.mesh()->coordinates[node].data()) + at(*displacement_, node);
  }
  /// T^T m of the moment that holds a point, as the equations have it.
  Vector3d generalised(const std::string& name) const { return at(*reaction_, point(name).rotation_node) * point(name).arm; }

 private:
  void look_at(const SystemEvaluation& at) {
    const double time = at.context().time;
    displacement_ = rcp(new Vector(*system_.unknowns(at.x()), Teuchos::Copy));
    local_ = rcp(new Vector(model_.bodies()->space().local_dofs()));
    local_->doImport(*displacement_, *model_.bodies()->space().ghost_import(), Tpetra::INSERT);
    reaction_ = at.forces();
    external_ = rcp(new Vector(model_.bodies()->space().dofs()));
    std::optional<StepFailure> none;
    for (const auto& contribution : model_.parts().contributions)
      if (contribution->kind() == Contribution::Kind::external) contribution->add_residual({time, *displacement_, *local_}, *external_, none);
    external_->scale(-1.0);
  }

  QuantityContext context() const {
    QuantityContext context{*model_.bodies()};
    context.displacement = displacement_.get();
    context.local_displacement = local_.get();
    context.reaction = reaction_.get();
    context.external_force = external_.get();
    context.prescribed = &model_.parts().constraints->prescribed();
    context.following = &model_.parts().rigid->dofs();
    return context;
  }

  static std::string text(const Bar& bar) {
    return list("bar",
                parameter("kinematics", "string", bar.kinematics) +
                    list("materials", list("rubber", parameter("type", "string", bar.material) + parameter("young's modulus", "double", "100") +
                                                         parameter("poisson's ratio", "double", "0.3"))) +
                    list("bodies", list("bar", parameter("material", "string", "rubber") + parameter("element", "string", bar.element) +
                                                   list("mesh", bar.mesh))) +
                    list("reference points", list("foot", with_set(bar.foot_set, {})) +
                                                 list("grip", with_set(bar.grip_set, {}) + parameter("position", "string", bar.grip_at))) +
                    (bar.sets.empty() ? "" : list("sets", bar.sets)) +
                    list("boundary conditions", list("base", with_set("foot", bar.foot)) +
                                                    (bar.grip.empty() ? "" : list("drive", with_set("grip", bar.grip))) + bar.more_conditions) +
                    (bar.moment.empty() ? "" : list("loads", list("twist", parameter("type", "string", "moment") + with_set("grip", bar.moment)))) +
                    list("newton", parameter("momentum tolerance", "double", "1e-12")) +
                    list("stepping", parameter("end time", "string", bar.end) + parameter("step", "double", fmt::format("{}", bar.step))));
  }

  Timers timers_;
  Scene scene_;
  Model model_;
  SemiSmoothSystem system_;
  RCP<const Vector> displacement_;
  RCP<Vector> local_, reaction_, external_;
  double energy_error_ = 0.0;
};

// Statics: forces balance to 1e-12 of all forces, which are some ten times moment over width; a hundred nodes make that less than 1e-9 of the moment.
constexpr double balance = 1e-9;

TEST(MomentOfSpace, IsHeldByTheOtherEndHoweverTheBarTurns) {
  Bar bar;
  bar.moment = {{"moment x", "3*t"}, {"moment y", "-4*t"}, {"moment z", "2.5*t"}};
  const Result result(bar);
  const Vector3d moment(3.0, -4.0, 2.5);
  EXPECT_GE(result.rotation("grip").norm(), 60.0) << "a large rotation is meant";
  EXPECT_LE((result.moment("foot") + moment).norm(), balance * moment.norm());
  EXPECT_LE(result.force("foot").norm(), balance * moment.norm());
  EXPECT_LE(result.moment("grip").norm(), balance * moment.norm()) << "nothing but the load acts on it";
}

TEST(MomentOfSpace, HoldsAPointAtAPrescribedRotation) {
  Bar bar;
  bar.grip = {{"x", "0.3*t"}, {"y", "-0.2*t"}, {"z", "0.1*t"}, {"rotation x", "40*t"}, {"rotation y", "-30*t"}, {"rotation z", "80*t"}};
  const Result result(bar);
  const Vector3d moment = result.moment("grip"), force = result.force("grip"), arm = result.position("grip") - result.position("foot");
  const double size = moment.norm() + arm.norm() * force.norm();
  EXPECT_LE((result.moment("foot") + moment + arm.cross(force)).norm(), balance * size);
  EXPECT_LE((result.force("foot") + force).norm(), balance * size);
  // The equations have T^T m: a product with three numbers, summed over nine nodes.
  const Vector3d theta = result.rotation("grip") * EIGEN_PI / 180.0;
  EXPECT_LE((generalised_moment(theta, moment).value - result.generalised("grip")).norm(), 1e-12 * size);
  EXPECT_GE((moment - result.generalised("grip")).norm(), 0.1 * size) << "T is far from 1";
}

// Elastic: what the moment does is stored. Works are summed by the trapezoidal rule, whose error falls by four when steps are halved.
TEST(MomentOfSpace, DoesTheWorkThatTheBarStores) {
  Bar bar;
  bar.moment = {{"moment x", "3*t"}, {"moment y", "-4*t^2"}, {"moment z", "2.5*t"}};
  const double error = std::abs(Result(bar).energy_error());
  bar.step *= 0.5;
  const double half = std::abs(Result(bar).energy_error());
  EXPECT_LE(error, 0.02);
  EXPECT_LE(half, error / 3.0);
}

// Bent until t = 0.25, then turned as a whole by 360 degrees about the origin in 15 steps, by two points that bear moments of opposite sign: together
// they do nothing.
TEST(MomentOfSpace, OfABarThatTurnsAsAWholeDoesNoWork) {
  const auto driven = [](const std::string& end) {
    Bar bar;
    bar.kinematics = "plane strain", bar.element = "Q4", bar.grip_at = "0.5, 2";
    bar.mesh = parameter("type", "string", "block") + parameter("height", "double", "2") + parameter("cells x", "int", "2") +
               parameter("cells y", "int", "4");
    const std::string turn = "2*pi*max(0, t - 0.25)/0.75", bend = "20*min(1, 4*t)";
    bar.foot = {
        {"x", fmt::format("0.5*(cos({0}) - 1)", turn)}, {"y", fmt::format("0.5*sin({0})", turn)}, {"rotation", fmt::format("180/pi*{0}", turn)}};
    bar.grip = {{"x", fmt::format("0.5*(cos({0}) - 1) - 2*sin({0})", turn)},
                {"y", fmt::format("0.5*sin({0}) + 2*(cos({0}) - 1)", turn)},
                {"rotation", fmt::format("180/pi*{0} + {1}", turn, bend)}};
    bar.step = 0.05, bar.end = end;
    return Result(bar);
  };
  const double bent = driven("0.25").energy_error();
  EXPECT_NEAR(driven("1").energy_error(), bent, 1e-9);
}

// A moment about a fixed axis leads to the rotation that asks for it, past a full turn as well: components across the axis are prescribed.
TEST(MomentOfSpace, TurnsPastAFullTurnAboutAFixedAxis) {
  Bar bar;
  bar.mesh = parameter("type", "string", "brick") + parameter("height", "double", "8") + parameter("cells x", "int", "1") +
             parameter("cells y", "int", "1") + parameter("cells z", "int", "12");
  bar.grip_at = "0.5, 0.5, 8";
  bar.step = 0.05;
  bar.grip = {{"x", "0"}, {"y", "0"}, {"z", "0"}, {"rotation x", "0"}, {"rotation y", "0"}, {"rotation z", "400*t"}};
  const Vector3d moment = Result(bar).moment("grip");
  bar.grip.back().second = "360*t";  // held at a full turn
  EXPECT_TRUE(Result(bar).moment("grip").allFinite());
  bar.grip.pop_back();
  bar.moment = {{"moment z", fmt::format("{:.17g}*t", moment.z())}};
  const Result loaded(bar);
  EXPECT_NEAR(loaded.rotation("grip", "z"), 400.0, 1e-6);
  EXPECT_LE((loaded.moment("foot") + moment).norm(), 1e-7 * moment.norm());
}

// One layer of hexahedra that is not let move in z is plane strain.
TEST(MomentOfSpace, IsThatOfThePlaneInOneLayer) {
  Bar plane;
  plane.kinematics = "plane strain";
  plane.element = "Q4";
  plane.mesh =
      parameter("type", "string", "block") + parameter("height", "double", "2") + parameter("cells x", "int", "2") + parameter("cells y", "int", "4");
  plane.grip_at = "0.6, 2.2";
  plane.foot = {{"x", "0"}, {"y", "0"}, {"rotation", "0"}};
  plane.moment = {{"moment", "5*t"}};
  Bar layer;
  layer.mesh = parameter("type", "string", "brick") + parameter("height", "double", "1") + parameter("depth", "double", "2") +
               parameter("cells x", "int", "2") + parameter("cells y", "int", "4") + parameter("cells z", "int", "1");
  layer.foot_set = "bar/front";
  layer.grip_set = "bar/back";
  layer.grip_at = "0.6, 2.2, 0.5";
  layer.grip = {{"z", "0"}, {"rotation x", "0"}, {"rotation y", "0"}};
  layer.moment = {{"moment z", "5*t"}};
  layer.sets = list("inner", parameter("of", "string", "bar") + parameter("where", "string", "y*(2 - y) - 1e-6"));
  layer.more_conditions = list("layer", with_set("inner", {{"z", "0"}}));
  const Result two(plane), three(layer);
  const double rotation = two.rotation("grip", "z");
  EXPECT_GE(std::abs(rotation), 30.0);
  EXPECT_NEAR(three.rotation("grip", "z"), rotation, 1e-8 * std::abs(rotation));
  EXPECT_NEAR(two.reaction("foot", Reaction::Of::rotation), -5.0, 5.0 * balance);
  EXPECT_NEAR(three.reaction("foot", Reaction::Of::rotation_z), -5.0, 5.0 * balance);
}

TEST(MomentOfSpace, IsAskedForByTheNamesOfSpace) {
  const auto complaint = [](const Result& result, Reaction::Of component) -> std::string {
    try {
      result.reaction("grip", component);
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  };
  Bar bar;
  bar.grip = {{"rotation z", "t"}};
  EXPECT_THAT(complaint(Result(bar), Reaction::Of::rotation), HasSubstr("in 3D please take \"rotation x\", \"rotation y\" or \"rotation z\""));
  Bar plane;
  plane.kinematics = "plane strain";
  plane.element = "Q4";
  plane.mesh = parameter("type", "string", "block") + parameter("cells x", "int", "1") + parameter("cells y", "int", "1");
  plane.grip_at = "0.5, 1";
  plane.foot = {{"x", "0"}, {"y", "0"}, {"rotation", "0"}};
  plane.grip = {{"rotation", "t"}};
  EXPECT_THAT(complaint(Result(plane), Reaction::Of::rotation_x), HasSubstr("in 2D please take \"rotation\""));
}

}  // namespace
}  // namespace mortise
