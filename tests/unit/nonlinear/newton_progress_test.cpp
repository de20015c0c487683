// When a Newton solve with contact gets on, when it is done though states change, when a smaller step is of no use.

#include "newton/newton_progress.hpp"

#include <gtest/gtest.h>

#include "newton/newton_status_tests.hpp"
#include "stepping/repeated_course.hpp"

namespace mortise {
namespace {

using Iterates = std::vector<NewtonIteration>;

/// Iterates with these active sets and merits, 100 closed nodes each.
Iterates course(const std::vector<long long>& sets, const std::vector<double>& merits) {
  Iterates iterates;
  for (std::size_t k = 0; k < sets.size(); ++k) {
    NewtonIteration iterate;
    iterate.iteration = static_cast<int>(k);
    iterate.norms.active_set = {sets[k], -sets[k]};
    iterate.norms.merit = merits[k];
    iterate.norms.active = 100;
    iterates.push_back(iterate);
  }
  return iterates;
}

TEST(Progress, IsNewStatesAndASmallerMerit) {
  EXPECT_EQ(detail::iterations_without_progress(course({1, 2, 3, 4}, {9, 8, 7, 6})), 0);
  EXPECT_EQ(detail::iterations_without_progress(course({1, 2, 3, 2}, {9, 8, 7, 6})), 1);  // states that were there before
  EXPECT_EQ(detail::iterations_without_progress(course({1, 2, 3, 4}, {9, 8, 8, 7})), 1);  // a merit that rests
  EXPECT_EQ(detail::iterations_without_progress(course({0, 0, 0, 0}, {9, 8, 7, 6})), 3);  // no contact
}

TEST(Progress, EndsWhereEachClosedNodeMayHaveChanged) {
  Iterates iterates = course({1, 2, 3, 4}, {9, 8, 7, 6});
  for (NewtonIteration& iterate : iterates) iterate.norms.active = 2;
  EXPECT_EQ(detail::iterations_without_progress(iterates), 1);
}

TEST(Progress, IsNotToBeHopedForWhereTheResidualNeverFellAndStatesChangeOn) {
  const auto wanders = [](const std::function<double(int)>& merit, const std::function<int(int)>& changed, int iterations) {
    Iterates iterates = course(std::vector<long long>(iterations + 1, 1), std::vector<double>(iterations + 1, 1.0));
    for (int k = 0; k <= iterations; ++k) {
      iterates[k].norms.merit = merit(k);
      iterates[k].norms.changed = k == 0 ? 0 : changed(k);
    }
    return detail::wanders(iterates);
  };
  const auto grown = [](int k) { return k == 0 ? 1.0 : 5.0; };
  const auto at_random = [](int) { return 30; };
  EXPECT_TRUE(wanders(grown, at_random, 12));
  EXPECT_FALSE(wanders(grown, at_random, 11)) << "too early to tell";
  EXPECT_FALSE(wanders([](int k) { return k == 4 ? 0.9 : 1.0 + k; }, at_random, 20)) << "it fell once";
  EXPECT_FALSE(wanders(
      grown, [](int k) { return 100 / k; }, 12))
      << "states settle";
  EXPECT_FALSE(wanders(
      grown, [](int) { return 1; }, 12))
      << "a front passes one node after the other";
}

/// Iterates that meet all other criteria, the last one with other states than it was computed with and led to by `increment`.
bool is_done(double increment, double momentum_before, double complementarity = 0.0) {
  const NewtonOptions options;
  Iterates iterates = course({1, 2, 3}, {1, 1, 1});
  for (NewtonIteration& iterate : iterates) {
    iterate.norms.momentum = 1e-13;
    iterate.norms.momentum_absolute = 1.0;  // more than round-off
  }
  iterates[1].norms.momentum = momentum_before;
  iterates[2].increment = increment;
  iterates[2].norms.complementarity = complementarity;
  iterates[2].norms.changed = 7;
  for (const auto& criterion : detail::convergence_criteria(options, 1.0))
    if (!criterion.met(iterates)) return false;
  return true;
}

TEST(ChangesOfState, WithoutAnEffectAreNoReasonToGoOn) {
  EXPECT_TRUE(is_done(1e-14, 1e-13));
  EXPECT_FALSE(is_done(1e-9, 1e-13));         // displacements change
  EXPECT_FALSE(is_done(1e-14, 1e-6));         // the iterate before was no solution
  EXPECT_FALSE(is_done(1e-14, 1e-13, 1e-6));  // this one is none
}

TEST(Residual, IsMetWhereItJumpsAndCorrectionsDoNot) {
  const auto is_done = [](const std::vector<double>& momentum, double increment, double step_length = 1.0, int changed = 0) {
    std::vector<NewtonIteration> iterates;
    for (std::size_t i = 0; i < momentum.size(); ++i) {
      NewtonIteration at;
      at.iteration = static_cast<int>(i);
      at.norms.momentum = at.norms.momentum_absolute = at.norms.merit = momentum[i];
      at.norms.complementarity = momentum[i];
      at.norms.active = 7;
      at.norms.changed = changed;
      at.increment = increment;
      at.step_length = step_length;
      iterates.push_back(at);
    }
    for (const auto& criterion : detail::convergence_criteria(NewtonOptions(), 1.0))
      if (!criterion.met(iterates)) return false;
    return true;
  };
  const std::vector<double> jumping{1.0, 5e-9, 4.7e-9, 5.2e-9, 4.9e-9, 4.7e-9};
  EXPECT_TRUE(is_done(jumping, 5e-11));
  EXPECT_FALSE(is_done(jumping, 5e-11, 1.0 / 128.0));                       // the whole correction is not small
  EXPECT_FALSE(is_done(jumping, 5e-11, 1.0, 1));                            // states change
  EXPECT_FALSE(is_done(jumping, 5e-9));                                     // displacements do
  EXPECT_FALSE(is_done({1.0, 5e-9, 4.7e-9, 5.2e-9, 4.9e-9, 2e-9}, 5e-11));  // it still falls
  EXPECT_FALSE(is_done({1.0, 5e-7, 4.7e-7, 5.2e-7, 4.9e-7, 4.7e-7}, 5e-11));
  EXPECT_FALSE(is_done({1.0, 5e-9, 4.7e-9, 5.2e-9}, 5e-11));  // too early to say
}

NewtonReport report_of(const std::vector<long long>& sets) {
  NewtonReport report;
  report.iterations = course(sets, std::vector<double>(sets.size(), 1.0));
  return report;
}

TEST(RepeatedCourse, IsTheSameStatesAndReasonThreeTimes) {
  const StepFailure failure(FailureKind::too_many_iterations, "");
  detail::RepeatedCourse same, other, varied;
  EXPECT_FALSE(same.add(failure, report_of({1, 2, 3})));
  EXPECT_FALSE(same.add(failure, report_of({1, 2, 3})));
  EXPECT_TRUE(same.add(failure, report_of({1, 2, 3})));
  for (const long long last : {3, 4, 3, 4, 3}) EXPECT_FALSE(varied.add(failure, report_of({1, 2, last})));
  for (const FailureKind kind : {FailureKind::line_search, FailureKind::too_many_iterations, FailureKind::line_search})
    EXPECT_FALSE(other.add(StepFailure(kind, ""), report_of({1, 2, 3})));
}

TEST(RepeatedCourse, IsTheSameFiguresThreeTimes) {
  const auto tries = [](FailureKind kind, const std::vector<std::string>& words) {
    detail::RepeatedCourse course;
    std::vector<bool> in_vain;
    for (const std::string& text : words) in_vain.push_back(course.add(StepFailure(kind, text), report_of({0, 0})));
    return in_vain;
  };
  using Answers = std::vector<bool>;
  EXPECT_EQ(tries(FailureKind::linear_solver, {"by 1.3e-02", "by 1.3e-02", "by 1.3e-02"}), (Answers{false, false, true}));
  EXPECT_EQ(tries(FailureKind::linear_solver, {"by 1.3e-02", "by 1.2e-02", "by 1.3e-02"}), (Answers{false, false, false}));
  EXPECT_EQ(tries(FailureKind::linear_solver, {"pivot 3", "pivot 3", "pivot 3"}), (Answers{false, false, false})) << "no measured figure";
}

TEST(RepeatedCourse, DoesNotCountFailuresOfEvaluationsNorSolvesWithoutChangesOfState) {
  detail::RepeatedCourse evaluation, without_contact;
  for (int k = 0; k < 5; ++k) {
    EXPECT_FALSE(evaluation.add(StepFailure(FailureKind::inverted_element, ""), report_of({1, 2, 3})));
    EXPECT_FALSE(without_contact.add(StepFailure(FailureKind::line_search, ""), report_of({0, 0, 0})));
  }
}

}  // namespace
}  // namespace mortise
