// Steps that work, steps that are undone, and the end.

#include "mortise/nonlinear/load_stepper.hpp"

#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>
#include <cmath>

#include "spring_grid.hpp"

namespace mortise {
namespace {

using test::Problem;

Problem::Choices moved(double reach) {
  Problem::Choices choices;
  choices.motion = {1.0, 0.5};
  choices.reach = reach;
  return choices;
}

struct Walk {
  bool finished = false;
  std::vector<StepReport> accepted;
  std::vector<std::string> undone;
  int begun = 0;
  std::optional<StepFailure> last_failure;
};

/// The start of a try that looks at its displacement.
StepStart start_with(const Problem& problem, const std::function<void(const Vector& d)>& look) {
  return [&problem, look](const AcceptedState& state, double time, const Vector& d, Vector&) {
    look(d);
    return problem.system->step_from(state, time);
  };
}

/// run_steps() from rest; leaves the last state in problem.x.
bool run(Problem& problem, const SteppingOptions& stepping, const StepStart& start, const StepperObserver& observer,
         std::optional<StepFailure>& last_failure) {
  SteppingState state(problem.system->initial_state(*problem.x));
  const bool finished = run_steps(*problem.system, stepping, {}, state, start, observer, last_failure);
  Tpetra::deep_copy(*problem.x, *state.accepted.x);
  return finished;
}

Walk walk(Problem& problem, const SteppingOptions& stepping, const StepStart& start = {}) {
  Walk result;
  StepperObserver observer;
  observer.begin = [&](int, double, double) { ++result.begun; };
  observer.accepted = [&](const StepReport& report, const SystemEvaluation&) { result.accepted.push_back(report); };
  observer.undone = [&](const StepReport&, const StepFailure& failure) { result.undone.push_back(failure.what()); };
  result.finished = run(problem, stepping, start, observer, result.last_failure);
  return result;
}

TEST(Stepper, WalksToTheEndThroughOutputTimes) {
  Problem problem(Tpetra::getDefaultComm(), moved(1e30));
  SteppingOptions stepping;
  stepping.step = 0.4;
  stepping.output_times = {0.5};
  const Walk result = walk(problem, stepping);
  EXPECT_TRUE(result.finished);
  EXPECT_EQ(problem.brittle->times, (std::vector<double>{0.4, 0.5, 0.9, 1.0}));
  ASSERT_EQ(result.accepted.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(result.accepted[k].step, static_cast<int>(k) + 1);
    EXPECT_EQ(result.accepted[k].time, problem.brittle->times[k]);
    EXPECT_EQ(result.accepted[k].cutbacks, 0);
    EXPECT_GT(result.accepted[k].newton.newton_steps(), 0);
  }
  EXPECT_FALSE(result.last_failure);
  EXPECT_DOUBLE_EQ(problem.x->normInf(), 1.0);
}

// The upper edge may move by 0.3 in a step: a whole step of 1 fails, and 0.5; 0.25 works; the next of 0.5 fails again, ...
TEST(Stepper, UndoesAndHalvesAndTheResultIsThatOfSmallSteps) {
  Problem problem(Tpetra::getDefaultComm(), moved(0.3));
  const Walk result = walk(problem, {});
  EXPECT_TRUE(result.finished);
  ASSERT_FALSE(result.accepted.empty());
  EXPECT_EQ(result.accepted[0].cutbacks, 2);
  EXPECT_EQ(result.accepted[0].undone.size(), 2u);
  EXPECT_NE(result.accepted[0].undone[0].find("too far at once"), std::string::npos);
  EXPECT_EQ(result.accepted[0].time, 0.25);
  EXPECT_EQ(problem.brittle->times.back(), 1.0);
  EXPECT_EQ(result.begun, static_cast<int>(result.accepted.size() + result.undone.size()));

  // The springs are elastic, so the way does not matter.
  Problem direct(Tpetra::getDefaultComm(), moved(1e30));
  SteppingOptions small;
  small.step = 0.25;
  walk(direct, small);
  direct.x->update(-1.0, *problem.x, 1.0);
  EXPECT_LE(direct.x->normInf(), 1e-7);  // increments are converged to 1e-8 of the model's size of 5
  Vector committed(problem.brittle->committed, Teuchos::Copy);
  committed.update(-1.0, *problem.x, 1.0);
  EXPECT_EQ(committed.normInf(), 0.0);
}

TEST(Stepper, StopsAtTheSmallestStepWithTheLastGoodState) {
  Problem::Choices choices = moved(1e30);
  choices.limit = 0.6;  // reached at t = 0.6 by the upper edge
  Problem problem(Tpetra::getDefaultComm(), choices);
  SteppingOptions stepping;
  stepping.step = 0.25;
  stepping.minimum_step = 0.01;
  const Walk result = walk(problem, stepping);
  EXPECT_FALSE(result.finished);
  ASSERT_TRUE(result.last_failure);
  EXPECT_EQ(result.last_failure->what(), result.undone.back());
  // Steps are halved until half of one would be less than 0.01: the last state is nearer to the limit than 0.02.
  ASSERT_FALSE(problem.brittle->times.empty());
  EXPECT_GT(problem.brittle->times.back(), 0.58);
  EXPECT_LE(problem.brittle->times.back(), 0.6);
  EXPECT_DOUBLE_EQ(problem.x->normInf(), problem.brittle->times.back());
  Vector committed(problem.brittle->committed, Teuchos::Copy);
  committed.update(-1.0, *problem.x, 1.0);
  EXPECT_EQ(committed.normInf(), 0.0);
}

TEST(Stepper, EachTryStartsFromTheLastGoodState) {
  Problem problem(Tpetra::getDefaultComm(), moved(0.3));
  int calls = 0;
  SteppingOptions stepping;
  stepping.predictor = Predictor::none;
  const Walk result = walk(problem, stepping, start_with(problem, [&](const Vector& d) {
                             ++calls;
                             Vector difference(d, Teuchos::Copy);
                             difference.update(-1.0, problem.brittle->committed, 1.0);
                             EXPECT_EQ(difference.normInf(), 0.0);
                           }));
  EXPECT_EQ(calls, result.begun);
}

// The line through the last two states, also where the next step is of another length.
TEST(Stepper, ALinearPredictorContinuesTheLastStep) {
  Problem plain(Tpetra::getDefaultComm(), moved(1e30)), predicted(Tpetra::getDefaultComm(), moved(1e30));
  SteppingOptions stepping;
  stepping.step = 0.2;
  stepping.output_times = {0.5};
  stepping.predictor = Predictor::none;
  const Walk without = walk(plain, stepping);
  stepping.predictor = Predictor::linear;
  // The states of the last two commits, seen when the step after them starts.
  std::vector<Vector> states{Vector(predicted.x->getMap())};
  const std::vector<double> times{0.0, 0.2, 0.4, 0.5, 0.7, 0.9, 1.0};
  const auto look = [&](const Vector& d) {
    const std::size_t done = predicted.brittle->times.size();
    if (done == 0) return;
    states.emplace_back(predicted.brittle->committed, Teuchos::Copy);
    const double ratio = (times.at(done + 1) - times[done]) / (times[done] - times[done - 1]);
    Vector expected(states[done], Teuchos::Copy);
    expected.update(-ratio, states[done - 1], 1.0 + ratio);
    expected.update(-1.0, d, 1.0);
    EXPECT_LE(expected.normInf(), 1e-14);
  };
  const Walk with = walk(predicted, stepping, start_with(predicted, look));
  int steps_without = 0, steps_with = 0;
  for (const auto& report : without.accepted) steps_without += report.newton.newton_steps();
  for (const auto& report : with.accepted) steps_with += report.newton.newton_steps();
  EXPECT_LT(steps_with, steps_without);
  plain.x->update(-1.0, *predicted.x, 1.0);
  EXPECT_LE(plain.x->normInf(), 1e-7);
}

// Loads and motions that slow down, or return, are followed by as much less.
TEST(Stepper, APredictionGoesAsFarAsWhatDrivesTheStepGoesOn) {
  for (const bool by_motion : {true, false}) {
    Problem::Choices choices;
    if (by_motion)
      choices.motion = {1.0, 0.5};
    else
      choices.force = {0.02, 0.01};
    const std::vector<double> levels{0.0, 0.25, 0.5, 0.525, 0.425};  // at t = 0, 0.25, ...
    choices.course = [&](double time) { return levels.at(static_cast<std::size_t>(std::lround(4.0 * time))); };
    Problem problem(Tpetra::getDefaultComm(), choices);
    SteppingOptions stepping;
    stepping.step = 0.25;
    std::vector<Vector> states{Vector(problem.x->getMap())};
    const std::vector<double> shares{0.0, 1.0, 0.1, 0.0};
    std::size_t starts = 0;
    walk(problem, stepping, start_with(problem, [&](const Vector& d) {
           if (starts > 0) states.emplace_back(problem.brittle->committed, Teuchos::Copy);
           Vector expected(states.back(), Teuchos::Copy);
           if (starts > 0) expected.update(-shares[starts], states[starts - 1], 1.0 + shares[starts]);
           expected.update(-1.0, d, 1.0);
           EXPECT_LE(expected.normInf(), 1e-12) << "step " << starts + 1;
           ++starts;
         }));
    EXPECT_EQ(starts, 4u);
  }
}

// A state that is refused after a prediction is sought from the last state, and only then with half the step.
TEST(Stepper, APredictionThatLedAstrayIsLeftOutBeforeTheStepIsCut) {
  for (const int refusals : {1, 2}) {
    Problem problem(Tpetra::getDefaultComm(), moved(1e30));
    SteppingOptions stepping;
    stepping.step = 0.25;
    StepperObserver observer;
    int refused = 0;
    observer.verify = [&](const AcceptedState& from, const SystemEvaluation&, int) -> RCP<Vector> {
      if (from.context.time == 0.25 && refused < refusals) {
        ++refused;
        throw StepFailure(FailureKind::unstable, "another branch");
      }
      return Teuchos::null;
    };
    std::vector<bool> predicted;
    const auto look = [&](const Vector& d) {
      Vector difference(d, Teuchos::Copy);
      difference.update(-1.0, problem.brittle->committed, 1.0);
      predicted.push_back(difference.normInf() > 0.01);
    };
    std::optional<StepFailure> failure;
    EXPECT_TRUE(run(problem, stepping, start_with(problem, look), observer, failure));
    const std::vector<double> whole{0.25, 0.5, 0.75, 1.0};
    if (refusals == 1)
      EXPECT_EQ(problem.brittle->times, whole);
    else
      EXPECT_EQ(problem.brittle->times.at(1), 0.375);
    ASSERT_GE(predicted.size(), 3u);
    EXPECT_EQ(std::vector<bool>(predicted.begin(), predicted.begin() + 3), (std::vector<bool>{false, true, false}));
  }
}

TEST(Stepper, IsInterruptedWithinAStepAndKeepsTheLastState) {
  Problem problem(Tpetra::getDefaultComm(), moved(1e30));
  SteppingOptions stepping;
  stepping.step = 0.25;
  StepperObserver observer;
  observer.interrupted = [&] { return problem.brittle->times.size() == 2; };
  std::optional<StepFailure> failure;
  EXPECT_FALSE(run(problem, stepping, {}, observer, failure));
  EXPECT_FALSE(failure);
  EXPECT_EQ(problem.brittle->times, (std::vector<double>{0.25, 0.5}));
  EXPECT_DOUBLE_EQ(problem.x->normInf(), 0.5);
}

// A start that throws is a failed try like any other.
TEST(Stepper, AFailingStartIsAFailedTry) {
  Problem problem(Tpetra::getDefaultComm(), moved(1e30));
  int calls = 0;
  const Walk result = walk(problem, {}, start_with(problem, [&](const Vector&) {
                             if (++calls == 1) throw StepFailure(FailureKind::projection, "no start");
                           }));
  EXPECT_TRUE(result.finished);
  EXPECT_EQ(result.undone, std::vector<std::string>{"no start"});
  EXPECT_EQ(result.accepted[0].time, 0.5);
}

// A solution that verify() refuses leaves no trace and is not explained: its failure speaks for itself.
TEST(Stepper, ASolutionThatIsRefusedIsAFailedTry) {
  Problem problem(Tpetra::getDefaultComm(), moved(1e30));
  StepperObserver observer;
  std::vector<double> verified;
  int explained = 0;
  observer.verify = [&](const AcceptedState& from, const SystemEvaluation& found, int round) -> RCP<Vector> {
    EXPECT_EQ(round, 1);
    EXPECT_EQ(from.x->normInf(), verified.size() < 2 ? 0.0 : problem.brittle->committed.normInf());
    verified.push_back(found.x().normInf());
    if (found.x().normInf() > 0.7 && verified.size() == 1) throw StepFailure(FailureKind::lost_contact, "went too far");
    return Teuchos::null;
  };
  observer.explain = [&](const FailedTry&) {
    ++explained;
    return FailureExplanation{"never", true};
  };
  std::vector<StepReport> accepted;
  observer.accepted = [&](const StepReport& report, const SystemEvaluation&) { accepted.push_back(report); };
  std::optional<StepFailure> failure;
  EXPECT_TRUE(run(problem, {}, {}, observer, failure));
  ASSERT_EQ(accepted.size(), 2u);
  EXPECT_EQ(accepted[0].undone, std::vector<std::string>{"lost contact: went too far"});
  EXPECT_EQ(problem.brittle->times, (std::vector<double>{0.5, 1.0}));
  ASSERT_EQ(verified.size(), 3u);
  EXPECT_DOUBLE_EQ(verified[0], 1.0);
  EXPECT_DOUBLE_EQ(verified[1], 0.5);
  EXPECT_EQ(explained, 0);
}

// Newton's iterations from another start belong to the same try.
TEST(Stepper, ASolutionMayBeSentBackToAnotherStart) {
  Problem problem(Tpetra::getDefaultComm(), moved(1e30)), plain(Tpetra::getDefaultComm(), moved(1e30));
  const Walk without = walk(plain, {});
  StepperObserver observer;
  std::vector<int> rounds;
  observer.verify = [&](const AcceptedState& from, const SystemEvaluation&, int round) -> RCP<Vector> {
    rounds.push_back(round);
    return round == 1 ? rcp(new Vector(*from.x, Teuchos::Copy)) : Teuchos::null;
  };
  std::vector<StepReport> accepted;
  observer.accepted = [&](const StepReport& report, const SystemEvaluation&) { accepted.push_back(report); };
  std::optional<StepFailure> failure;
  EXPECT_TRUE(run(problem, {}, {}, observer, failure));
  EXPECT_EQ(rounds, (std::vector<int>{1, 2}));
  ASSERT_EQ(accepted.size(), 1u);
  EXPECT_EQ(accepted[0].cutbacks, 0);
  EXPECT_EQ(accepted[0].newton.solves, 2);
  EXPECT_EQ(accepted[0].newton.newton_steps(), 2 * without.accepted.at(0).newton.newton_steps());
  plain.x->update(-1.0, *problem.x, 1.0);
  EXPECT_LE(plain.x->normInf(), 1e-7);
}

// The rate that a hook leaves is what the next step starts with.
TEST(Stepper, TheLineOfThePredictorMayBeChanged) {
  Problem problem(Tpetra::getDefaultComm(), moved(1e30));
  SteppingOptions stepping;
  stepping.step = 0.25;
  StepperObserver observer;
  observer.predict = [&](const Vector& x, double dt, Vector& rate) {
    EXPECT_EQ(dt, 0.25);
    EXPECT_DOUBLE_EQ(rate.normInf(), 1.0);  // the edge moves by t
    EXPECT_DOUBLE_EQ(x.normInf(), problem.brittle->times.back());
    rate.putScalar(0.0);
  };
  std::optional<StepFailure> failure;
  int starts = 0;
  const auto look = [&](const Vector& d) {
    Vector difference(d, Teuchos::Copy);
    difference.update(-1.0, problem.brittle->committed, 1.0);
    EXPECT_EQ(difference.normInf(), 0.0);
    ++starts;
  };
  EXPECT_TRUE(run(problem, stepping, start_with(problem, look), observer, failure));
  EXPECT_EQ(starts, 4);
}

TEST(Stepper, AgreesWithOneRank) {
  Problem problem(Tpetra::getDefaultComm(), moved(0.3)), alone(test::this_rank_only(), moved(0.3));
  const Walk result = walk(problem, {}), alone_result = walk(alone, {});
  ASSERT_EQ(result.accepted.size(), alone_result.accepted.size());
  for (std::size_t k = 0; k < result.accepted.size(); ++k) {
    EXPECT_EQ(result.accepted[k].time, alone_result.accepted[k].time);
    EXPECT_EQ(result.accepted[k].cutbacks, alone_result.accepted[k].cutbacks);
    EXPECT_EQ(result.accepted[k].newton.newton_steps(), alone_result.accepted[k].newton.newton_steps());
  }
  const auto mine = problem.x->getData(), whole = alone.x->getData();
  for (std::size_t i = 0; i < problem.x->getLocalLength(); ++i) {
    const GlobalOrdinal id = problem.grid->dofs->getGlobalElement(static_cast<LocalOrdinal>(i));
    EXPECT_NEAR(mine[i], whole[alone.grid->dofs->getLocalElement(id)], 1e-10);
  }
}

}  // namespace
}  // namespace mortise
