// Properties of every shape in the registry. A new shape is tested by its line there.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "mortise/shape/cell.hpp"

namespace mortise {
namespace {

template <class List>
struct TestsOf;
template <class... Entries>
struct TestsOf<CellList<Entries...>> {
  using Types = ::testing::Types<typename Entries::Cell...>;
};

/// Exponents of all monomials up to a degree.
std::vector<std::array<int, 3>> powers(int dimension, int most_degree) {
  std::vector<std::array<int, 3>> all;
  for (int p = 0; p <= most_degree; ++p)
    for (int q = 0; q <= (dimension > 1 ? most_degree - p : 0); ++q)
      for (int r = 0; r <= (dimension > 2 ? most_degree - p - q : 0); ++r) all.push_back({p, q, r});
  return all;
}

template <class Cell>
class RegisteredCell : public ::testing::Test {
 protected:
  static constexpr int dimension = Cell::dimension;
  using Position = std::array<double, dimension>;
  using Vector = Eigen::Matrix<double, dimension, 1>;

  /// Points inside all reference cells of the dimension.
  std::vector<Position> points() const {
    std::vector<Position> result;
    for (const auto& point : std::vector<std::array<double, 3>>{
             {0.1, 0.2, 0.3}, {0.6, 0.15, 0.2}, {0.0, 0.0, 0.0}, {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}, {0.25, 0.7, 0.04}}) {
      result.emplace_back();
      std::copy_n(point.begin(), dimension, result.back().begin());
    }
    return result;
  }

  static Vector node(int a) { return Eigen::Map<const Vector>(Cell::node_positions[a].data()); }
  static Vector centroid() { return Eigen::Map<const Vector>(Cell::centroid.data()); }
  static Position position(const Vector& x) {
    Position result;
    std::copy_n(x.data(), dimension, result.begin());
    return result;
  }

  /// The integral without the cell's own rules: over the simplices between the last corner and the sides' corners, by Gauss rules collapsed there,
  /// that are exact to degree 10. Last corners of pyramids are apexes: functions of the rays and polynomials in the distance from it are exact too.
  template <class Function>
  static auto integral(const Function& function) {
    auto sum = function(Cell::centroid);
    sum *= 0.0;
    const auto line = gauss_legendre(7);
    const Vector tip = node(Cell::corners - 1);
    const auto over = [&](const Eigen::Matrix<double, dimension, dimension>& legs) {  // the simplex of the tip and what they lead to
      std::array<std::size_t, dimension> at{};
      for (std::size_t flat = 0; flat < std::pow(line.size(), dimension); ++flat) {
        std::size_t rest = flat;
        for (auto& k : at) k = rest % line.size(), rest /= line.size();
        // s_1 is the share of the way from the tip: xi_i = s_1 ... s_i (1 - s_{i+1}), and s_{n+1} = 0.
        Vector xi = Vector::Zero();
        double product = 1.0, weight = std::abs(legs.determinant());
        for (int i = 0; i < dimension; ++i) {
          const double s = 0.5 * (1.0 + line[at[i]].xi);
          weight *= 0.5 * line[at[i]].weight * std::pow(s, dimension - 1 - i);
          if (i > 0) xi(i - 1) = product * (1.0 - s);
          product *= s;
        }
        xi(dimension - 1) = product;
        sum += weight * function(position(tip + legs * xi));
      }
    };
    Eigen::Matrix<double, dimension, dimension> legs;
    if constexpr (dimension == 1) {
      over(legs = node(0) - tip);
    } else {
      for (const CellSide& side : topology(shape_of<Cell>).sides)
        for (int first = 1; first + dimension - 2 < side.corners; ++first) {  // a fan of simplices about the side's first corner
          for (int i = 0; i < dimension; ++i) legs.col(i) = node(side.nodes[i == 0 ? 0 : first + i - 1]) - tip;
          over(legs);
        }
    }
    return sum;
  }

  /// The same by a rule of the cell.
  template <class Function>
  static auto integral_by_rule(int points, const Function& function) {
    auto sum = function(Cell::centroid);
    sum *= 0.0;
    for (const CellPoint& point : Cell::rule(points)) sum += point.weight * function(point.position<dimension>());
    return sum;
  }

  /// [nodes, dimension]
  static Eigen::MatrixXd gradients(const Position& xi) {
    const auto dN = Cell::gradients(xi);
    Eigen::MatrixXd result(Cell::nodes, dimension);
    for (int a = 0; a < Cell::nodes; ++a)
      for (int i = 0; i < dimension; ++i) result(a, i) = dN[a][i];
    return result;
  }
  static Eigen::VectorXd values(const Position& xi) {
    const auto N = Cell::values(xi);
    return Eigen::Map<const Eigen::VectorXd>(N.data(), Cell::nodes);
  }
  /// All products of two derivatives of shape functions.
  static Eigen::MatrixXd gradient_products(const Position& xi) {
    const Eigen::MatrixXd dN = gradients(xi);
    const Eigen::VectorXd all = Eigen::Map<const Eigen::VectorXd>(dN.data(), dN.size());
    return all * all.transpose();
  }
};
TYPED_TEST_SUITE(RegisteredCell, TestsOf<Cells>::Types);

TYPED_TEST(RegisteredCell, IsAPartitionOfUnityThatReproducesPosition) {
  constexpr int dimension = TypeParam::dimension;
  for (const auto& xi : this->points()) {
    const auto N = TypeParam::values(xi);
    const auto dN = TypeParam::gradients(xi);
    double sum = 0.0;
    typename TestFixture::Position position{}, gradient{};
    std::array<std::array<double, dimension>, dimension> jacobian{};
    for (int a = 0; a < TypeParam::nodes; ++a) {
      sum += N[a];
      for (int i = 0; i < dimension; ++i) {
        position[i] += N[a] * TypeParam::node_positions[a][i];
        gradient[i] += dN[a][i];
        for (int j = 0; j < dimension; ++j) jacobian[i][j] += TypeParam::node_positions[a][i] * dN[a][j];
      }
    }
    const double round_off = 1e-16 * std::max(TypeParam::nodes, 3);
    EXPECT_NEAR(sum, 1.0, round_off);
    for (int i = 0; i < dimension; ++i) {
      EXPECT_NEAR(position[i], xi[i], round_off);
      EXPECT_NEAR(gradient[i], 0.0, 4.0 * round_off);
      for (int j = 0; j < dimension; ++j) EXPECT_NEAR(jacobian[i][j], i == j ? 1.0 : 0.0, 4.0 * round_off);
    }
  }
}

TYPED_TEST(RegisteredCell, InterpolatesAtItsNodes) {
  for (int b = 0; b < TypeParam::nodes; ++b) {
    const auto N = TypeParam::values(TypeParam::node_positions[b]);
    for (int a = 0; a < TypeParam::nodes; ++a) EXPECT_EQ(N[a], a == b ? 1.0 : 0.0);
  }
}

TYPED_TEST(RegisteredCell, GradientsAreTheCentralDifferencesOfTheValues) {
  const double h = 1e-5;
  for (const auto& xi : this->points()) {
    const auto dN = TypeParam::gradients(xi);
    for (int i = 0; i < TypeParam::dimension; ++i) {
      auto ahead = xi, behind = xi;
      ahead[i] += h;
      behind[i] -= h;
      const auto forward = TypeParam::values(ahead), backward = TypeParam::values(behind);
      // Polynomials are at most quadratic in each direction: only round-off remains. Of pyramids d^3 N / dzeta^3 = 1.5 u v / (1 - zeta)^2 < 0.9 here,
      // which leaves h^2 / 6 of it.
      for (int a = 0; a < TypeParam::nodes; ++a) EXPECT_NEAR(dN[a][i], (forward[a] - backward[a]) / (2.0 * h), 1e-10);
    }
  }
}

TYPED_TEST(RegisteredCell, IsFoundByItsName) {
  const CellShape shape = shape_of<TypeParam>;
  EXPECT_TRUE(visit_cell(shape, [](auto cell) { return std::is_same_v<decltype(cell), TypeParam>; }));
  const CellTopology& cell = topology(shape);
  EXPECT_EQ(cell.dimension, TypeParam::dimension);
  EXPECT_EQ(cell.nodes, TypeParam::nodes);
  EXPECT_EQ(cell.corners, TypeParam::corners);
  EXPECT_LE(cell.nodes, most_cell_nodes);
}

TYPED_TEST(RegisteredCell, CornersOfSidesRunWithTheNormalOutward) {
  if constexpr (TypeParam::dimension > 1) {
    using Vector = typename TestFixture::Vector;
    Vector closed = Vector::Zero();  // of a closed surface the area vectors sum to zero
    for (const CellSide& side : topology(shape_of<TypeParam>).sides) {
      ASSERT_EQ(static_cast<int>(side.nodes.size()), topology(side.shape).nodes);
      ASSERT_EQ(topology(side.shape).dimension, TypeParam::dimension - 1);
      EXPECT_LE(topology(side.shape).nodes, most_side_nodes);
      Vector middle = Vector::Zero(), normal = Vector::Zero();
      for (int c = 0; c < side.corners; ++c) {
        const Vector a = this->node(side.nodes[c]), b = this->node(side.nodes[(c + 1) % side.corners]);
        middle += a / side.corners;
        if constexpr (TypeParam::dimension == 2)
          normal = c == 0 ? Vector(b(1) - a(1), a(0) - b(0)) : normal;
        else
          normal += 0.5 * a.cross(b);
      }
      EXPECT_GT(normal.dot(middle - this->centroid()), 0.0);
      closed += normal;
    }
    EXPECT_LE(closed.norm(), 1e-15);
  }
}

TYPED_TEST(RegisteredCell, EachEdgeIsMetByItsSidesInOppositeDirections) {
  const CellTopology& cell = topology(shape_of<TypeParam>);
  std::map<std::pair<int, int>, int> uses;
  for (const CellSide& side : cell.sides)
    for (const auto& [a, b] : topology(side.shape).edges) ++uses[{side.nodes[a], side.nodes[b]}];
  for (const auto& [a, b] : cell.edges) {
    EXPECT_LT(a, cell.corners);
    EXPECT_LT(b, cell.corners);
    const int along = uses[{a, b}], against = uses[{b, a}];
    EXPECT_EQ(along, cell.dimension > 1 ? 1 : 0);
    EXPECT_EQ(against, cell.dimension > 2 ? 1 : 0);
    uses.erase({a, b});
    uses.erase({b, a});
  }
  EXPECT_TRUE(uses.empty());
}

TYPED_TEST(RegisteredCell, MidSideNodesStandInTheMiddleOfTheEdges) {
  const CellTopology& cell = topology(shape_of<TypeParam>);
  ASSERT_LE(cell.mid_side_nodes(), static_cast<int>(cell.edges.size()));
  for (int k = 0; k < cell.mid_side_nodes(); ++k)
    EXPECT_LE((this->node(cell.corners + k) - 0.5 * (this->node(cell.edges[k][0]) + this->node(cell.edges[k][1]))).norm(), 1e-16);
}

TYPED_TEST(RegisteredCell, HasTheShapeFunctionsOfItsSidesOnThem) {
  for (const CellSide& side : topology(shape_of<TypeParam>).sides)
    visit_cell(side.shape, [&](auto of_side) {
      using Side = decltype(of_side);
      if constexpr (Side::dimension == TypeParam::dimension - 1)
        for (const CellPoint& point : Side::rule(Side::side_points)) {
          const auto expected = Side::values(point.template position<Side::dimension>());
          typename TestFixture::Vector x = TestFixture::Vector::Zero();
          for (int a = 0; a < Side::nodes; ++a) x += expected[a] * this->node(side.nodes[a]);
          Eigen::VectorXd N = this->values(this->position(x));
          for (int a = 0; a < Side::nodes; ++a) N(side.nodes[a]) -= expected[a];
          EXPECT_LE(N.cwiseAbs().maxCoeff(), 1e-15);
        }
    });
}

TYPED_TEST(RegisteredCell, ContainsItsNodesAndWhatLiesBetweenThem) {
  EXPECT_TRUE(TypeParam::contains(TypeParam::centroid, 0.0));
  for (int a = 0; a < TypeParam::nodes; ++a) {
    const auto x = this->node(a);
    EXPECT_TRUE(TypeParam::contains(this->position(x), 1e-15));
    EXPECT_TRUE(TypeParam::contains(this->position(x - 0.01 * (x - this->centroid())), 0.0));
    if (a < TypeParam::corners) EXPECT_FALSE(TypeParam::contains(this->position(x + 0.01 * (x - this->centroid())), 1e-4));
  }
}

TYPED_TEST(RegisteredCell, HasTheMeasureOfItsSimplices) {
  EXPECT_NEAR(this->integral([](const auto&) { return 1.0; }), TypeParam::measure, 1e-14 * TypeParam::measure);
}

TYPED_TEST(RegisteredCell, RulesHavePositiveWeightsAndPointsInside) {
  std::set<int> sizes;
  if constexpr (TypeParam::dimension > 1) sizes.insert(TypeParam::stiffness_points);
  if constexpr (TypeParam::dimension > 1) sizes.insert(TypeParam::mass_points);
  if constexpr (TypeParam::dimension == 2) sizes.insert({TypeParam::axisymmetric_stiffness_points, TypeParam::axisymmetric_mass_points});
  if constexpr (TypeParam::dimension < 3) sizes.insert(TypeParam::side_points);
  if constexpr (TypeParam::nodes > TypeParam::dimension + 1) sizes.insert(TypeParam::jacobian_points);
  sizes.erase(0);
  for (const int points : sizes) {
    const auto rule = TypeParam::rule(points);
    EXPECT_EQ(static_cast<int>(rule.size()), points);
    double sum = 0.0;
    for (const CellPoint& point : rule) {
      EXPECT_GT(point.weight, 0.0);
      EXPECT_TRUE(TypeParam::contains(point.template position<TypeParam::dimension>(), 0.0));
      sum += point.weight;
    }
    EXPECT_NEAR(sum, TypeParam::measure, 1e-14 * TypeParam::measure);
  }
}

TYPED_TEST(RegisteredCell, RuleForTheStiffnessIsExact) {
  if constexpr (TypeParam::dimension > 1) {
    const auto products = [&](const auto& xi) { return this->gradient_products(xi); };
    const Eigen::MatrixXd exact = this->integral(products), found = this->integral_by_rule(TypeParam::stiffness_points, products);
    EXPECT_LE((found - exact).cwiseAbs().maxCoeff(), 1e-13);
  }
}

TYPED_TEST(RegisteredCell, RuleForTheAxisymmetricStiffnessIsExactForRadiiAndHoopStrains) {
  if constexpr (TypeParam::dimension == 2) {
    // grad N_a x grad N_b r, and N_a / r x grad N_b r. N_a N_b / r is no polynomial.
    const auto with_radius = [&](const auto& xi) -> Eigen::MatrixXd { return this->gradient_products(xi) * (3.0 + xi[0] + 0.5 * xi[1]); };
    const auto with_hoop = [&](const auto& xi) -> Eigen::MatrixXd {
      const Eigen::MatrixXd dN = this->gradients(xi);
      return this->values(xi) * Eigen::Map<const Eigen::VectorXd>(dN.data(), dN.size()).transpose();
    };
    constexpr int points = TypeParam::axisymmetric_stiffness_points;
    const Eigen::MatrixXd radius = this->integral(with_radius), radius_by_rule = this->integral_by_rule(points, with_radius);
    const Eigen::MatrixXd hoop = this->integral(with_hoop), hoop_by_rule = this->integral_by_rule(points, with_hoop);
    EXPECT_LE((radius_by_rule - radius).cwiseAbs().maxCoeff(), 1e-13);
    EXPECT_LE((hoop_by_rule - hoop).cwiseAbs().maxCoeff(), 1e-13);
  }
}

TYPED_TEST(RegisteredCell, RulesForTheMassAreExact) {
  if constexpr (TypeParam::dimension > 1) {
    const auto products = [&](const auto& xi) -> Eigen::MatrixXd { return this->values(xi) * this->values(xi).transpose(); };
    EXPECT_LE((this->integral_by_rule(TypeParam::mass_points, products) - this->integral(products)).cwiseAbs().maxCoeff(), 1e-14);
    if constexpr (TypeParam::dimension == 2) {
      const auto with_radius = [&](const auto& xi) -> Eigen::MatrixXd { return products(xi) * (3.0 + xi[0] + 0.5 * xi[1]); };
      EXPECT_LE((this->integral_by_rule(TypeParam::axisymmetric_mass_points, with_radius) - this->integral(with_radius)).cwiseAbs().maxCoeff(),
                1e-14);
    }
  }
}

TYPED_TEST(RegisteredCell, RuleForLoadsOnASideIsExactToDegreeFive) {
  if constexpr (TypeParam::dimension < 3)
    for (const auto& power : powers(TypeParam::dimension, 5)) {
      const auto monomial = [&](const auto& xi) {
        double product = 1.0;
        for (int i = 0; i < TypeParam::dimension; ++i) product *= std::pow(xi[i], power[i]);
        return product;
      };
      EXPECT_NEAR(this->integral_by_rule(TypeParam::side_points, monomial), this->integral(monomial), 1e-14);
    }
}

TYPED_TEST(RegisteredCell, IsMadeBySweepsOfPlaneCells) {
  if constexpr (TypeParam::dimension == 3) {
    using Profile = typename TypeParam::Profile;
    // Profiles lie below cells that end in two of them, and below tetrahedra; a pyramid ends in an apex.
    EXPECT_EQ(std::is_void_v<Profile>, TypeParam::corners == 5);
    if constexpr (!std::is_void_v<Profile>) EXPECT_EQ(topology(shape_of<Profile>).dimension, 2);
    EXPECT_EQ(std::is_void_v<typename TypeParam::MiddleProfile>, TypeParam::nodes == TypeParam::corners);
  }
}

TYPED_TEST(RegisteredCell, HasNodesBetweenThePointsOfALatticeIfItIsQuadratic) {
  EXPECT_EQ(TypeParam::midpoint_directions > 0, TypeParam::nodes > TypeParam::corners);
}

TEST(Registry, NamesAndNumbersAreDifferent) {
  std::set<CellShape> names;
  std::set<int> numbers;
  visit_each_cell([&](auto cell) {
    EXPECT_TRUE(names.insert(shape_of<decltype(cell)>).second);
    EXPECT_TRUE(numbers.insert(decltype(cell)::xdmf_number).second);
  });
  EXPECT_THROW(visit_cell(static_cast<CellShape>(-1), [](auto) {}), std::logic_error);
}

TEST(Lines, TakeACoordinateThatIsNoArray) {
  for (const double xi : {-1.0, -0.3, 0.0, 0.8, 1.0}) {
    const std::array<double, 1> array{xi};
    EXPECT_EQ(Line2::values(xi), Line2::values(array));
    EXPECT_EQ(Line3::values(xi), Line3::values(array));
    for (int a = 0; a < 2; ++a) EXPECT_EQ(Line2::gradients(xi)[a], Line2::gradients(array)[a][0]);
    for (int a = 0; a < 3; ++a) EXPECT_EQ(Line3::gradients(xi)[a], Line3::gradients(array)[a][0]);
  }
}

TEST(Wedge15, ReproducesWhatItsFunctionsSpan) {
  // Quadratic in the triangle times linear upright, linear in the triangle times quadratic upright.
  for (const auto& power : powers(3, 3)) {
    const auto [p, q, r] = power;
    if (!((p + q <= 2 && r <= 1) || (p + q <= 1 && r <= 2))) continue;
    const auto monomial = [&, p = p, q = q, r = r](const std::array<double, 3>& x) {
      return std::pow(x[0], p) * std::pow(x[1], q) * std::pow(x[2], r);
    };
    for (const std::array<double, 3>& xi : {std::array<double, 3>{0.1, 0.2, 0.3}, {0.6, 0.15, -0.7}, {1.0 / 3.0, 1.0 / 3.0, 0.9}}) {
      const auto N = Wedge15::values(xi);
      double sum = 0.0;
      for (int a = 0; a < 15; ++a) sum += N[a] * monomial(Wedge15::node_positions[a]);
      EXPECT_NEAR(sum, monomial(xi), 1e-15) << p << q << r;
    }
  }
}

TEST(Pyramid5, HasTheMeanOfTheLimitsAlongTheEdgesAtItsApex) {
  const std::array<double, 3> apex{0.0, 0.0, 1.0};
  std::array<std::array<double, 3>, 5> mean{};
  for (int edge = 0; edge < 4; ++edge) {
    const auto& p = Pyramid5::node_positions[edge];
    const double left = 1e-6;  // of the way from the corner to the apex
    const auto near = Pyramid5::gradients(std::array<double, 3>{left * p[0], left * p[1], 1.0 - left});
    const auto at_corner = Pyramid5::gradients(p);
    for (int a = 0; a < 5; ++a)
      for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(near[a][i], at_corner[a][i], 1e-9) << "derivatives are constant along a ray";
        mean[a][i] += 0.25 * at_corner[a][i];
      }
  }
  const auto gradients = Pyramid5::gradients(apex);
  for (int a = 0; a < 5; ++a)
    for (int i = 0; i < 3; ++i) EXPECT_EQ(gradients[a][i], mean[a][i]);
  // Where round-off puts points at the apex, everything is bounded.
  for (const double xi : {0.0, 1e-16, -3e-16})
    for (const double zeta : {1.0 - 2e-16, 1.0, 1.0 + 2e-16}) {
      const auto N = Pyramid5::values(std::array<double, 3>{xi, -xi, zeta});
      for (int a = 0; a < 5; ++a) EXPECT_NEAR(N[a], a == 4 ? 1.0 : 0.0, 1e-15);
    }
}

TEST(Pyramid5, IsInvertedByNewtonsMethodUpToTheApex) {
  const Eigen::Matrix<double, 3, 5> X =
      (Eigen::Matrix<double, 3, 5>() << -1.1, 0.9, 1.3, -0.7, 0.2, -0.8, -1.2, 1.1, 0.9, 0.4, 0.1, -0.2, 0.3, 0.0, 1.2).finished();
  for (const std::array<double, 3>& wanted : {std::array<double, 3>{0.0, 0.0, 1.0}, {1e-9, -1e-9, 1.0 - 1e-9}, {0.3, -0.3, 0.7}, {-1.0, 1.0, 0.0}}) {
    const auto N = Pyramid5::values(wanted);
    const Eigen::Vector3d point = X * Eigen::Map<const Eigen::Matrix<double, 5, 1>>(N.data());
    auto xi = Pyramid5::centroid;
    for (int iteration = 0; iteration < 10; ++iteration) {
      const auto values = Pyramid5::values(xi);
      const auto gradients = Pyramid5::gradients(xi);
      const Eigen::Vector3d residual = X * Eigen::Map<const Eigen::Matrix<double, 5, 1>>(values.data()) - point;
      Eigen::Matrix3d J = Eigen::Matrix3d::Zero();
      for (int a = 0; a < 5; ++a)
        for (int i = 0; i < 3; ++i) J.col(i) += gradients[a][i] * X.col(a);
      const Eigen::Vector3d step = J.inverse() * residual;
      for (int i = 0; i < 3; ++i) xi[i] -= step(i);
    }
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(xi[i], wanted[i], 1e-14);
    EXPECT_TRUE(Pyramid5::contains(xi, 1e-8));
  }
}

TEST(Pyramid5, HasADeterminantThatIsLeastAtACornerOfTheBase) {
  const Eigen::Matrix<double, 3, 5> X =
      (Eigen::Matrix<double, 3, 5>() << -1.1, 0.9, 1.3, -0.7, 0.2, -0.8, -1.2, 1.1, 0.9, 0.4, 0.1, -0.2, 0.3, 0.0, 1.2).finished();
  const auto determinant = [&](const std::array<double, 3>& xi) {
    const auto dN = Pyramid5::gradients(xi);
    Eigen::Matrix3d J = Eigen::Matrix3d::Zero();
    for (int a = 0; a < 5; ++a)
      for (int i = 0; i < 3; ++i) J.col(i) += dN[a][i] * X.col(a);
    return J.determinant();
  };
  std::array<double, 4> corners{};
  for (int a = 0; a < 4; ++a) corners[a] = determinant(Pyramid5::node_positions[a]);
  for (const double u : {-1.0, -0.4, 0.3, 1.0})
    for (const double v : {-1.0, -0.2, 0.7, 1.0})
      for (const double zeta : {0.0, 0.5, 0.99}) {
        const auto N = Quadrilateral4::values(std::array<double, 2>{u, v});
        const double bilinear = N[0] * corners[0] + N[1] * corners[1] + N[2] * corners[2] + N[3] * corners[3];
        EXPECT_NEAR(determinant({u * (1.0 - zeta), v * (1.0 - zeta), zeta}), bilinear, 1e-13);
      }
  EXPECT_NEAR(determinant(Pyramid5::node_positions[4]), 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]), 1e-15);
}

}  // namespace
}  // namespace mortise
