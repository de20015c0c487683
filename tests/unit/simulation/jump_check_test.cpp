// Steps that jump to another branch of equilibria, told from those along a path by their rates.

#include "mortise/simulation/run/path/jump_check.hpp"

#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <functional>

#include "mortise/core/error.hpp"

namespace mortise {
namespace {

/// Goes along u(t), one displacement, from 0 to `end` in steps of `step`, halved down to step/1024 where they are refused. Returns where it ends.
double end_of(const std::function<double(double)>& u, double end, double step, bool is_far = false) {
  const RCP<const Map> map = rcp(new Map(1, 0, Tpetra::getDefaultComm()));
  JumpCheck check(1.0);
  Vector from(map), to(map);
  double time = 0.0, dt = step;
  while (time < end - 1e-12) {
    from.putScalar(u(time));
    to.putScalar(u(time + dt));
    try {
      check.verify(from, to, dt, is_far);
      check.accept();
      time += dt;
      dt = std::min(step, end - time);
    } catch (const StepFailure&) {
      dt *= 0.5;
      if (dt < step / 1024.0) return time;
    }
  }
  return time;
}

TEST(JumpCheck, PathsArePassed) {
  EXPECT_NEAR(end_of([](double t) { return t; }, 1.0, 0.1), 1.0, 1e-9);
  EXPECT_NEAR(end_of([](double t) { return t < 0.5 ? 0.01 * t : 0.005 + 5.0 * (t - 0.5); }, 1.0, 0.1), 1.0, 1e-9) << "a faster motion begins";
  EXPECT_NEAR(end_of([](double t) { return t < 0.35 ? 0.0 : 2.0 * (t - 0.35); }, 1.0, 0.1), 1.0, 1e-9) << "a motion begins within a step";
  EXPECT_NEAR(end_of([](double t) { return -0.5 * std::sqrt(1.0 - t); }, 1.0, 0.1), 1.0, 1e-9) << "up to a maximum of the load";
  EXPECT_NEAR(end_of([](double t) { return t < 0.45 ? 0.0 : 0.03; }, 1.0, 0.1), 1.0, 1e-9) << "small changes are not asked";
}

TEST(JumpCheck, WhatABodyIsNotCarriedToIsAskedHoweverSmallItIs) {
  const double end = end_of([](double t) { return t < 0.43 ? 0.01 * t : 0.03 + 0.01 * t; }, 1.0, 0.1, true);
  EXPECT_LE(end, 0.43);
  EXPECT_GE(end, 0.43 - 2.0 * 0.1 / 1024.0);
  EXPECT_NEAR(end_of([](double t) { return t < 0.5 ? 0.01 * t : 0.005 + 0.1 * (t - 0.5); }, 1.0, 0.1, true), 1.0, 1e-9) << "a faster motion begins";
}

TEST(JumpCheck, JumpsEndAtTheirPlace) {
  const double smallest = 0.1 / 1024.0;
  for (const double place : {0.43, 0.5073, 0.77})
    for (const double far : {0.06, 0.3, 5.0}) {
      const double end = end_of([&](double t) { return t < place ? 0.1 * t : far + 0.1 * t; }, 1.0, 0.1);
      EXPECT_LE(end, place);
      EXPECT_GE(end, place - 2.0 * smallest) << far;
    }
}

}  // namespace
}  // namespace mortise
