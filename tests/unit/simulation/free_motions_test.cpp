// Motions that a Gram matrix leaves free.

#include <gtest/gtest.h>

#include "mortise/simulation/run/diagnosis/contact_hold.hpp"

namespace mortise {
namespace {

Eigen::MatrixXd gram_of(const std::vector<Eigen::VectorXd>& rows, int size) {
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(size, size);
  for (const auto& row : rows) gram += row * row.transpose();
  return gram;
}

Eigen::VectorXd row(std::initializer_list<double> values) {
  Eigen::VectorXd result(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), result.begin());
  return result;
}

TEST(FreeMotions, NothingHeldIsAllFree) { EXPECT_EQ(free_motions(Eigen::MatrixXd::Zero(6, 6), 3).cols(), 6); }

TEST(FreeMotions, WhatRowsSpanIsHeld) {
  // Two normals in y, apart by 0.2 of the size: translation in y and rotation. Translation in x is left.
  const Eigen::MatrixXd free = free_motions(gram_of({row({0, 1, 0.1}), row({0, 1, -0.1})}, 3), 3);
  ASSERT_EQ(free.cols(), 1);
  EXPECT_NEAR(std::abs(free(0, 0)), 1.0, 1e-12);
}

TEST(FreeMotions, BodiesThatHoldOneAnotherMoveTogether) {
  // Body 1 sticks to body 0, which slides in x on what holds it in y and against rotation; body 2 is held.
  std::vector<Eigen::VectorXd> rows{row({0, 1, 0.5, 0, 0, 0, 0, 0, 0}), row({0, 1, -0.5, 0, 0, 0, 0, 0, 0})};
  for (int i = 0; i < 3; ++i) {
    Eigen::VectorXd between = Eigen::VectorXd::Zero(9), ground = between;
    between[i] = -1.0, between[3 + i] = 1.0;
    ground[6 + i] = 1000.0;
    rows.push_back(between);
    rows.push_back(ground);
  }
  const Eigen::MatrixXd free = free_motions(gram_of(rows, 9), 3);
  ASSERT_EQ(free.cols(), 1);
  EXPECT_NEAR(std::abs(free(0, 0)), std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(free(3, 0), free(0, 0), 1e-12);
}

TEST(FreeMotions, AGroupThatHoldsMuchHidesNoOtherOne) {
  // One group's rows are larger by 1e6: the other one's, of size one, still hold.
  std::vector<Eigen::VectorXd> rows;
  for (int i = 0; i < 6; ++i) rows.push_back((i < 3 ? 1e6 : 1.0) * Eigen::VectorXd::Unit(6, i));
  EXPECT_EQ(free_motions(gram_of(rows, 6), 3).cols(), 0);
}

// Normals that turn by 1e-5, as much as bodies are strained, hold nothing; a lever of 1e-2 does.
TEST(FreeMotions, NormalsThatTurnWithTheLoadsHoldNothing) {
  const double strain = 1e-5, lever = 1e-2;
  const Eigen::MatrixXd free = free_motions(gram_of({row({strain, 1, lever}), row({-strain, 1, -lever}), row({strain, 1, -lever})}, 3), 3);
  ASSERT_EQ(free.cols(), 1);
  EXPECT_NEAR(std::abs(free(0, 0)), 1.0, 2.0 * strain / lever);
}

}  // namespace
}  // namespace mortise
