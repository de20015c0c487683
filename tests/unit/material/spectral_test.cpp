#include "mortise/material/spectral.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <random>

namespace mortise {
namespace {

void expect_spectrum(const Matrix3& b, Eigen::Vector3d expected) {
  const Spectrum found = spectral_decomposition(b);
  const double scale = b.norm();
  EXPECT_LE((found.vectors.transpose() * found.vectors - Matrix3::Identity()).norm(), 1e-14);
  EXPECT_LE((found.vectors * found.values.asDiagonal() * found.vectors.transpose() - b).norm(), 1e-14 * scale);
  Eigen::Vector3d values = found.values;
  std::sort(values.data(), values.data() + 3);
  std::sort(expected.data(), expected.data() + 3);
  EXPECT_LE((values - expected).norm(), 1e-14 * scale);
}

TEST(SpectralDecomposition, IsOrthonormalAndGivesTheTensorBack) {
  std::mt19937 generator(7);
  std::normal_distribution<double> normal;
  for (const Eigen::Vector3d& values : std::vector<Eigen::Vector3d>{
           {1.0, 2.0, 3.0}, {1.0, 1.0, 1.0}, {1.0, 1.0, 4.0}, {1.0, 1.0 + 1e-9, 1.0 - 1e-12}, {1e-6, 1.0, 1e6}, {2.0, 2.0 + 1e-15, 0.1}})
    for (int sample = 0; sample < 50; ++sample) {
      const Matrix3 Q =
          Eigen::Quaterniond(normal(generator), normal(generator), normal(generator), normal(generator)).normalized().toRotationMatrix();
      const Matrix3 b = Q * values.asDiagonal() * Q.transpose();
      expect_spectrum(0.5 * (b + b.transpose()), values);
    }
}

TEST(SpectralDecomposition, TakesDiagonalPlaneAndOneOffDiagonalComponent) {
  expect_spectrum(Eigen::Vector3d(3.0, 1.0, 2.0).asDiagonal(), {1.0, 2.0, 3.0});
  for (int p = 0; p < 3; ++p)
    for (int q = 0; q < p; ++q) {
      Matrix3 b = 5.0 * Matrix3::Identity();
      b(p, q) = b(q, p) = 2.0;
      expect_spectrum(b, {3.0, 5.0, 7.0});
      b(p, q) = b(q, p) = 1e-200;  // its square is zero
      expect_spectrum(b, {5.0, 5.0, 5.0});
    }
}

TEST(SpectralDecomposition, EndsForWhatIsNotANumber) {
  const Spectrum found = spectral_decomposition(Matrix3::Constant(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_TRUE(std::isnan(found.values.sum()));
}

}  // namespace
}  // namespace mortise
