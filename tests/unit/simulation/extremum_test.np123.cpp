// Places of extrema where round-off alone tells one place from another.

#include <gtest/gtest.h>

#include "quantity_fixture.hpp"

namespace mortise {
namespace {

using namespace test;

// Two corners are moved alike but for round-off: the place is that of the smaller coordinates, whichever has more.
TEST(Quantity, PlaceOfAnExtremumDoesNotDependOnRoundOff) {
  for (const double more : {1e-12, -1e-12}) {
    TwoBlocks blocks;
    blocks.move([&](int body, const Point& X) {
      if (body == 0 || X[1] < 2.0) return Point{0.0, 0.0};
      return Point{0.0, X[0] == 0.0 ? 1.0 : X[0] == width ? 1.0 + more : 0.5};
    });
    Extremum extremum = field<Extremum>(PointField::displacement_y, "");
    EXPECT_NEAR(blocks.value(extremum), 1.0, 1e-11);
    extremum.gives = Extremum::Gives::x;
    EXPECT_EQ(blocks.value(extremum), 0.0);
    extremum.gives = Extremum::Gives::y;
    EXPECT_EQ(blocks.value(extremum), 2.0);
  }
}

}  // namespace
}  // namespace mortise
