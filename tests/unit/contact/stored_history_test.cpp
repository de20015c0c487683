// The history of contact in an archive: it comes back, and what cannot be one is refused.

#include <gmock/gmock.h>

#include <functional>
#include <limits>

#include "stored_numbers.hpp"
#include "two_surfaces.hpp"

namespace mortise {
namespace {

using test::Fixture;
using test::TwoSurfaces;
using ::testing::HasSubstr;
using Numbers = test::StoredNumbers::Numbers;

using Memory = test::StoredNumbers;

/// Pressed and sheared once.
struct Sheared {
  Sheared() : fixture(surfaces(), Tpetra::getDefaultComm()), d(fixture.dofs), z(fixture.contact->multiplier_map()) {
    const auto pressed = fixture.multipliers([](std::size_t) { return 5.0; });
    const ContactHistory history = fixture.first_step(d, z);
    fixture.contact->store(stored,
                           fixture.contact->start_step(fixture.contact->commit(fixture.contact->evaluate(d, history).laws(*pressed)), d, *pressed));
  }

  static TwoSurfaces surfaces() {
    TwoSurfaces surfaces = test::arch_on_ground();
    surfaces.has_conditions_on_rate = true;
    auto coulomb = std::make_shared<CoulombFriction>();
    coulomb->coefficient = ScalarFunction(0.3);
    surfaces.options.friction.options = coulomb;
    return surfaces;
  }

  /// Message about the history after `change`.
  std::string refusal(const std::function<void(Numbers&)>& change) const {
    Memory changed(stored.numbers);
    change(changed.numbers);
    try {
      fixture.contact->restore(changed, d, z);
    } catch (const FileError& error) {
      return error.what();
    }
    return "";
  }

  Fixture fixture;
  Vector d, z;
  Memory stored;
};

TEST(StoredHistory, ComesBack) {
  const Sheared sheared;
  Memory from(sheared.stored.numbers), again;
  sheared.fixture.contact->store(again, sheared.fixture.contact->restore(from, sheared.d, sheared.z));
  EXPECT_GT(again.numbers.at("contact.0.slip.nodes.longest").front(), 0.0);
  EXPECT_EQ(again.numbers, sheared.stored.numbers);
}

// Checks against data that no table of numbers has: which nodes there are, how long vectors are, which states a node may have.
TEST(StoredHistory, RefusesWhatCannotBeOne) {
  const Sheared sheared;
  EXPECT_EQ(sheared.refusal([](Numbers&) {}), "");
  for (const double node : {-1.0, 14.0, 0.5, 1e300, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THAT(sheared.refusal([&](Numbers& numbers) { numbers["contact.0.slip.nodes"][1] = node; }), HasSubstr("; nodes are from 0 to 13")) << node;
  EXPECT_THAT(sheared.refusal([](Numbers& numbers) { numbers["contact.0.slip.coefficients"][0] -= 1.0; }), HasSubstr("differ in their numbers"));
  EXPECT_THAT(sheared.refusal([](Numbers& numbers) {
    numbers["contact.0.slip.ties.longest"] = {2.0};
    numbers["contact.0.slip.ties"] = {2.0, 0.1, 0.1};
  }),
              HasSubstr("has 2 numbers; expected are 1"));
  EXPECT_THAT(sheared.refusal([](Numbers& numbers) { numbers["contact.0.states"][0] = 3.0; }), HasSubstr("holds 3, which is no state"));
}

}  // namespace
}  // namespace mortise
