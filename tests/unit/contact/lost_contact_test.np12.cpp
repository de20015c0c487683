// Nodes that find nothing within reach any more: lost ones, and those that have opened or run off.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>

#include "two_surfaces.hpp"

namespace mortise {
namespace {

using test::Fixture;
using ::testing::HasSubstr;

constexpr int slaves = 6, masters = 9;
constexpr double reach = 0.5;

/// A flat slave over [0, 5] that touches a flat master over [-1.5, 6.5]. The model starts with the slave moved by (x, y).
struct Flat {
  explicit Flat(double x = 0.0, double y = 0.0)
      : fixture(surfaces(), Tpetra::getDefaultComm()), contact(*fixture.contact), history(contact.initial_history(*moved(x, y))) {}

  static test::TwoSurfaces surfaces() {
    test::TwoSurfaces flat;
    for (int i = 0; i < slaves; ++i) flat.slave.push_back({1.0 * i, 0.0});
    for (int i = 0; i < masters; ++i) flat.master.push_back({6.5 - i, 0.0});
    flat.fixed.assign(flat.size(), {false, false});
    flat.options.mortar.search_reach = reach;
    return flat;
  }

  /// The slave moved by (x, y).
  RCP<Vector> moved(double x, double y) const {
    return Fixture::vector(fixture.dofs, [&](GlobalOrdinal id) { return id >= 2 * slaves ? 0.0 : id % 2 == 0 ? x : y; });
  }
  RCP<Vector> pressed(double pressure) const {
    return fixture.multipliers([&](std::size_t) { return pressure; });
  }

  /// Evaluates there; what was thrown on all ranks, empty if nothing was.
  std::string failure_at(double x, double y) {
    try {
      at.emplace(contact.differentiate(*moved(x, y), history, marked ? &*marked : nullptr));
    } catch (const StepFailure& lost) {
      EXPECT_EQ(lost.kind(), FailureKind::lost_contact);
      return lost.what();
    }
    return {};
  }
  /// Where the last evaluation was, an iterate ends with this pressure.
  void mark(double pressure) { marked = at->laws(*pressed(pressure)).states(); }
  /// Accepts a step with this pressure.
  void accept(double pressure) {
    history = contact.commit(at->laws(*pressed(pressure)));
    marked.reset();
  }
  /// A step from there, without pressure.
  void start(double x, double y) {
    const auto z = pressed(0.0);
    history = contact.start_step(history, *moved(x, y), *z);
    marked.reset();
  }

  Fixture fixture;
  const ContactSystem& contact;
  ContactHistory history;
  std::optional<ContactStates> marked;      // of the last iterate of the step
  std::optional<DifferentiatedContact> at;  // the last evaluation that did not fail
};

TEST(LostContact, AClosedNodeBehindTheMasterBeyondReachFails) {
  Flat flat;
  ASSERT_EQ(flat.failure_at(0.0, 0.0), "");
  flat.mark(1.0);
  EXPECT_EQ(flat.failure_at(0.0, -0.9 * reach), "") << "within reach contact pushes it back";
  for (const double depth : {0.75, 30.0}) {  // a facet's candidates lie nearer than its length plus the reach
    const std::string text = flat.failure_at(0.0, -depth);
    EXPECT_THAT(text, HasSubstr("contact \"pair\": node "));
    EXPECT_THAT(text, HasSubstr(depth == 30.0 ? "-30), 30 behind" : "-0.75), 0.75 behind"));
    EXPECT_THAT(text, HasSubstr("out of its reach 0.5"));
  }
}

TEST(LostContact, ANodeThatOpensIsNotLost) {
  Flat flat;
  ASSERT_EQ(flat.failure_at(0.0, 0.0), "");
  flat.mark(1.0);
  for (const double height : {0.4, 0.75, 30.0}) EXPECT_EQ(flat.failure_at(0.0, height), "") << height;
}

TEST(LostContact, ANodeThatRunsOffTheEdgeIsNotLost) {
  Flat flat;
  ASSERT_EQ(flat.failure_at(0.0, 0.0), "");
  flat.mark(1.0);
  for (const double height : {0.0, -0.75, -30.0}) EXPECT_EQ(flat.failure_at(6.6, height), "") << height;
  EXPECT_EQ(flat.failure_at(1.5, 0.0), "") << "the last node just at the edge";
  EXPECT_THAT(flat.failure_at(3.0, -0.75), HasSubstr("0.75 behind")) << "some have run off, the others have gone through";
}

// In front of the master in the accepted state, one step carries it through, farther than contact reaches. A node that was behind it already, or
// comes to lie there from beside the master, has not gone through.
TEST(LostContact, AnOpenNodeThatGoesThroughInOneStepIsLost) {
  for (const double height : {0.1, 2.0}) {
    Flat flat(0.0, height);
    ASSERT_EQ(flat.failure_at(0.0, height), "");
    flat.accept(0.0);
    EXPECT_EQ(flat.failure_at(0.0, 0.5 * height), "");
    EXPECT_EQ(flat.failure_at(0.0, -0.9 * reach), "") << "within reach contact pushes it back";
    EXPECT_THAT(flat.failure_at(0.0, -0.75), HasSubstr("in front of the master when the step began, is at"));
    EXPECT_THAT(flat.failure_at(0.5, -30.0), HasSubstr("30 behind"));
  }
  for (const auto& start : {std::pair{0.0, -0.75}, std::pair{9.0, 0.1}}) {
    Flat flat(start.first, start.second);
    ASSERT_EQ(flat.failure_at(start.first, start.second), "");
    flat.accept(0.0);
    EXPECT_EQ(flat.failure_at(0.0, -1.5), "");
  }
}

// Closed in the accepted state, open in an iterate, behind the master in the next. An undone step goes back to the accepted states.
TEST(LostContact, AcceptedStatesCountUntilTheNextOnes) {
  Flat flat;
  ASSERT_EQ(flat.failure_at(0.0, 0.0), "");
  flat.accept(1.0);
  ASSERT_EQ(flat.failure_at(0.0, 0.1), "");
  flat.mark(0.0);
  EXPECT_NE(flat.failure_at(0.0, -0.75), "");

  ASSERT_EQ(flat.failure_at(0.0, 0.1), "");
  flat.accept(0.0);
  EXPECT_THAT(flat.failure_at(0.0, -0.75), HasSubstr("in front of"));
  ASSERT_EQ(flat.failure_at(0.0, 0.0), "");
  flat.mark(1.0);
  EXPECT_THAT(flat.failure_at(0.0, -0.75), HasSubstr("which was closed"));
  flat.start(0.0, 0.1);
  EXPECT_THAT(flat.failure_at(0.0, -0.75), HasSubstr("in front of"));
}

}  // namespace
}  // namespace mortise
