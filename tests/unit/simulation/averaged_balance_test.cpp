// Balance at the end of a step is that of Chung and Hulbert with averaged internal, external and contact forces, row by row, in an impact too.

#include <gtest/gtest.h>
#include <unistd.h>

#include <Tpetra_Core.hpp>
#include <Tpetra_Vector.hpp>
#include <filesystem>
#include <fstream>

#include "mortise/nonlinear/load_stepper.hpp"
#include "mortise/simulation/model/model.hpp"
#include "mortise/simulation/scene/read_scene.hpp"

namespace mortise {
namespace {

const char* const text = R"xml(<ParameterList name="impact">
  <Parameter name="kinematics" type="string" value="plane strain"/>
  <ParameterList name="materials"><ParameterList name="soft">
    <Parameter name="type" type="string" value="neo hooke"/>
    <Parameter name="young's modulus" type="double" value="4"/>
    <Parameter name="poisson's ratio" type="double" value="0.3"/>
    <Parameter name="density" type="double" value="1"/>
  </ParameterList></ParameterList>
  <ParameterList name="bodies">
    <ParameterList name="striker"><Parameter name="material" type="string" value="soft"/>
      <ParameterList name="mesh"><Parameter name="type" type="string" value="block"/>
        <Parameter name="cells x" type="int" value="6"/><Parameter name="cells y" type="int" value="2"/></ParameterList></ParameterList>
    <ParameterList name="target"><Parameter name="material" type="string" value="soft"/>
      <ParameterList name="mesh"><Parameter name="type" type="string" value="block"/><Parameter name="translation" type="string" value="1.01, 0.1"/>
        <Parameter name="cells x" type="int" value="6"/><Parameter name="cells y" type="int" value="3"/></ParameterList></ParameterList>
  </ParameterList>
  <ParameterList name="inertia">
    <Parameter name="scheme" type="string" value="generalised alpha"/>
    <Parameter name="spectral radius" type="double" value="0.6"/>
    <Parameter name="balance" type="string" value="at the end"/>
    <Parameter name="contact mass" type="string" value="kept"/>
  </ParameterList>
  <ParameterList name="contact"><ParameterList name="pair">
    <Parameter name="slave" type="string" value="striker/right"/><Parameter name="master" type="string" value="target/left"/>
  </ParameterList></ParameterList>
</ParameterList>
)xml";

RCP<Vector> sum(double a, const Vector& u, double b, const Vector& v) {
  const auto result = rcp(new Vector(u.getMap()));
  result->update(a, u, b, v, 0.0);
  return result;
}

TEST(AveragedBalance, IsThatAtTheEndOfSteps) {
  const auto file = std::filesystem::temp_directory_path() / ("mortise_balance_" + std::to_string(getpid()) + ".xml");
  std::ofstream(file) << text;
  const RCP<const Communicator> comm = Tpetra::getDefaultComm();
  const Scene scene = read_scene(*comm, file, {});
  std::filesystem::remove(file);
  const Model model(comm, scene, Timers());
  const SemiSmoothSystem system(model.parts(), Timers());
  const Mesh& mesh = *model.mesh();
  const Vector x(system.map());
  Vector velocity(model.parts().dofs);
  for (LocalOrdinal node = 0; node < mesh.owned_body_count(); ++node)
    if (mesh.coordinates[node][0] < 1.005) velocity.replaceLocalValue(2 * node, 0.2);
  SteppingState at(system.initial_state(x, velocity, false));

  const double rho = 0.6, alpha_m = (2.0 * rho - 1.0) / (rho + 1.0), alpha_f = rho / (rho + 1.0);
  Vector acceleration(*at.accepted.rates->acceleration, Teuchos::Copy), forces(model.parts().dofs);  // no forces act at the start
  SteppingOptions stepping;
  stepping.end_time = 1.0;
  stepping.step = 0.025;
  const double size = model.inertia().mass->times(velocity)->normInf() / stepping.step;  // a force that stops a node within a step
  int touching = 0, steps = 0;
  StepperObserver observer;
  observer.accepted = [&](const StepReport&, const SystemEvaluation& found) {
    // f_int - f_ext + f_c of both ends, and the accelerations of Newmark's formulas
    const RCP<Vector> now = sum(1.0, found.nodal_forces(), -1.0, found.rate_forces());
    const Vector& a = *at.accepted.rates->acceleration;
    const RCP<Vector> residual = model.inertia().mass->times(*sum(1.0 - alpha_m, a, alpha_m, acceleration));
    residual->update(1.0 - alpha_f, *now, alpha_f, forces, 1.0);
    EXPECT_LE(residual->normInf(), 1e-12 * size) << steps;
    acceleration.assign(a);
    forces.assign(*now);
    touching += found.norms().active > 0;
    ++steps;
  };
  NewtonOptions newton;
  newton.momentum_tolerance = 1e-14;
  newton.increment_tolerance = 1e-13;
  std::optional<StepFailure> failure;
  EXPECT_TRUE(run_steps(system, stepping, newton, at, {}, observer, failure)) << (failure ? failure->what() : "");
  EXPECT_GT(touching, 10);
  EXPECT_LT(touching, steps);
}

}  // namespace
}  // namespace mortise
