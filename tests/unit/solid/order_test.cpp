// Orders of convergence of wedges and pyramids, and what their nodal stresses are exact for.

#include <gtest/gtest.h>

#include <Eigen/Sparse>

#include "solid_test_support.hpp"

namespace mortise {
namespace {

/// u = 0.01 grad(cos(a x) cos(b y) cosh(c z)) with c^2 = a^2 + b^2: div u = 0 and Laplace u = 0, so that Navier's equations hold without a load.
struct Solution {
  double a = 2.0, b = 1.5, c = 2.5, scale = 0.01;

  Point3 displacement(const Point3& X) const {
    const double x = a * X[0], y = b * X[1], z = c * X[2];
    return {-scale * a * std::sin(x) * std::cos(y) * std::cosh(z), -scale * b * std::cos(x) * std::sin(y) * std::cosh(z),
            scale * c * std::cos(x) * std::cos(y) * std::sinh(z)};
  }

  Matrix3 gradient(const Point3& X) const {
    const double sx = std::sin(a * X[0]), cx = std::cos(a * X[0]), sy = std::sin(b * X[1]), cy = std::cos(b * X[1]), sz = std::sinh(c * X[2]),
                 cz = std::cosh(c * X[2]);
    Matrix3 H;
    H << -a * a * cx * cy * cz, a * b * sx * sy * cz, -a * c * sx * cy * sz,  //
        a * b * sx * sy * cz, -b * b * cx * cy * cz, -b * c * cx * sy * sz,   //
        -a * c * sx * cy * sz, -b * c * cx * sy * sz, c * c * cx * cy * cz;
    return scale * H;
  }
};

/// The displacement that holds where it is prescribed on the surface.
Eigen::VectorXd solved(const Bodies& bodies, const SpaceField& on_surface) {
  const auto& surface = bodies.mesh()->node_sets.at("body/surface");
  Eigen::VectorXd u = space_field(bodies, [](const Point3&) -> Point3 { return {}; });
  std::vector<char> is_free(u.size(), 1);
  for (const LocalOrdinal node : surface) {
    u.segment<3>(3 * node) = Eigen::Map<const Eigen::Vector3d>(on_surface(bodies.mesh()->coordinates[node]).data());
    std::fill_n(is_free.begin() + 3 * node, 3, char{0});
  }
  Matrix matrix(bodies.space().graph());
  std::optional<StepFailure> failure;
  bodies.add_stiffness(to_local(bodies, u), matrix, failure);
  EXPECT_FALSE(failure);
  Eigen::VectorXd force = internal_force(bodies, u);
  std::vector<Eigen::Triplet<double>> entries;
  const auto local = matrix.getLocalMatrixHost();
  for (LocalOrdinal row = 0; row < local.numRows(); ++row) {
    if (is_free[row] == 0) force(row) = 0.0;
    if (is_free[row] == 0) entries.emplace_back(row, row, 1.0);
    for (auto n = local.graph.row_map(row); n < local.graph.row_map(row + 1); ++n)
      if (is_free[row] != 0 && is_free[local.graph.entries(n)] != 0) entries.emplace_back(row, local.graph.entries(n), local.values(n));
  }
  Eigen::SparseMatrix<double> K(u.size(), u.size());
  K.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(K);
  u -= solver.solve(force);
  return u;
}

struct Errors {
  double displacement = 0.0, gradient = 0.0;  ///< L2 norms
};

Errors errors(ElementType element, int cells) {
  const Solution exact;
  BrickSetup setup;
  setup.element = element;
  setup.law = "small strain linear";
  setup.cells = {cells, cells, cells};
  const auto mesh = make_lattice_mesh(
      self(), cell_shape(element), setup.cells,
      [](const Point3& s) -> Point3 {
        return {s[0] + 0.05 * std::sin(3.0 * s[1]), s[1] + 0.05 * std::sin(3.0 * s[2]), s[2] + 0.05 * std::sin(3.0 * s[0])};
      },
      true);
  const Bodies bodies(displacement_space(mesh), Kinematics::three_dimensional, 1.0, {{"body", {}, make_material(setup.law), element}});
  const Eigen::VectorXd u = solved(bodies, [&](const Point3& X) { return exact.displacement(X); });
  Errors found;
  bodies.visit_points(to_local(bodies, u), [&](const MaterialPoint& point) {
    const Point3 expected = exact.displacement(point.reference_position);
    for (int i = 0; i < 3; ++i) found.displacement += point.weight * std::pow(point.position[i] - point.reference_position[i] - expected[i], 2);
    found.gradient += point.weight * (point.deformation_gradient - Matrix3::Identity() - exact.gradient(point.reference_position)).squaredNorm();
  });
  return {std::sqrt(found.displacement), std::sqrt(found.gradient)};
}

/// Slope of the line that fits log(error) over log(1 / cells) best.
double fitted_order(const std::vector<int>& cells, const std::vector<double>& error) {
  Eigen::MatrixXd A(cells.size(), 2);
  Eigen::VectorXd b(cells.size());
  for (std::size_t n = 0; n < cells.size(); ++n) {
    A.row(n) << 1.0, -std::log(cells[n]);
    b(n) = std::log(error[n]);
  }
  return A.colPivHouseholderQr().solve(b)(1);
}

TEST(Order, OfWedgesAndPyramidsIsThatOfTheirPolynomials) {
  struct Case {
    ElementType element;
    std::vector<int> cells;
    double order;  ///< of the displacement's gradient; the displacement has one more
  };
  for (const auto& [element, cells, order] :
       {Case{ElementType::w6, {4, 6, 8, 12}, 1.0}, {ElementType::w15, {3, 4, 6}, 2.0}, {ElementType::p5, {4, 6, 8}, 1.0}}) {
    std::vector<double> displacement, gradient;
    for (const int n : cells) {
      const Errors found = errors(element, n);
      displacement.push_back(found.displacement);
      gradient.push_back(found.gradient);
    }
    const double of_gradient = fitted_order(cells, gradient), of_displacement = fitted_order(cells, displacement);
    RecordProperty(to_string(element) + "_gradient", std::to_string(of_gradient));
    RecordProperty(to_string(element) + "_displacement", std::to_string(of_displacement));
    // Meshes this coarse differ from the limit by some tenths; a lost degree would be a whole order.
    EXPECT_NEAR(of_gradient, order, 0.2) << to_string(element);
    EXPECT_NEAR(of_displacement, order + 1.0, 0.3) << to_string(element);
  }
}

/// Nodal stresses of a quadratic displacement, whose strain is linear, on cells that are not distorted.
double stress_error_of_a_linear_field(ElementType element) {
  BrickSetup setup;
  setup.element = element;
  setup.law = "small strain linear";
  setup.distortion = 0.0;
  setup.cells = {2, 2, 2};
  const auto bodies = make_brick(setup);
  const Eigen::VectorXd u = space_field(*bodies, [](const Point3& X) -> Point3 {
    return {0.01 * (X[0] * X[0] - X[1] * X[2]), 0.01 * (X[1] * X[1] + X[0] * X[2]), 0.01 * (X[2] * X[0] - 2.0 * X[2] * X[2])};
  });
  const auto strains = bodies->nodal_strains(to_local(*bodies, u));
  const auto view = strains->getLocalViewHost(Tpetra::Access::ReadOnly);
  double error = 0.0;
  for (LocalOrdinal node = 0; node < bodies->mesh()->owned_count(); ++node) {
    const auto& X = bodies->mesh()->coordinates[node];
    const std::array<double, 6> expected{0.02 * X[0], 0.02 * X[1], 0.01 * (X[0] - 4.0 * X[2]), 0.0, 0.005 * X[0], 0.005 * (X[2] - X[1])};
    for (int c = 0; c < 6; ++c) error = std::max(error, std::abs(view(node, c) - expected[c]));
  }
  return error;
}

TEST(NodalStrains, OfQuadraticCellsAreExactIfTheyAreLinear) {
  for (const ElementType element : {ElementType::h20, ElementType::tet10, ElementType::w15})
    EXPECT_LE(stress_error_of_a_linear_field(element), 1e-13) << to_string(element);
}

}  // namespace
}  // namespace mortise
