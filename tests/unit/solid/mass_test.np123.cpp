// Masses of every element in the registry: exact totals and kinetic energies, lumped masses, several ranks.

#include <gtest/gtest.h>

#include "mortise/mesh/volume_generators.hpp"
#include "solid_test_support.hpp"

namespace mortise {
namespace {

constexpr double density = 2.0, thickness = 0.7;  // density: of make_material

struct Case {
  ElementType element;
  Kinematics kinematics;
};

std::vector<Case> every_case() {
  std::vector<Case> cases;
  for (const auto& [element_name, element] : element_names())
    for (const auto& [kinematics_name, kinematics] : kinematics_names())
      if (check_combination({"body", {}, make_material("hencky"), element}, kinematics).empty()) cases.push_back({element, kinematics});
  return cases;
}

std::string case_name(const testing::TestParamInfo<Case>& info) {
  std::string name = to_string(info.param.element) + "_" + to_string(info.param.kinematics);
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
}

std::shared_ptr<Bodies> make_bodies(const RCP<const Mesh>& mesh, const Case& at) {
  return std::make_shared<Bodies>(displacement_space(mesh), at.kinematics, thickness,
                                  std::vector<BodyProperties>{{"body", {}, make_material("hencky"), at.element}});
}

/// X = X0 + A s for s in the unit square or cube.
struct Parallelepiped {
  Eigen::Vector3d X0{2.0, 0.3, -0.4};
  Matrix3 A = (Matrix3() << 1.0, 0.3, -0.2, 0.4, 1.3, 0.1, 0.0, -0.3, 0.8).finished();

  explicit Parallelepiped(int dimension) {
    if (dimension == 3) return;
    X0(2) = 0.0;
    A.col(2) = Eigen::Vector3d::UnitZ();
    A.row(2) = Eigen::RowVector3d::UnitZ();
  }
  Eigen::Vector3d position(const Eigen::Vector3d& s) const { return X0 + A * s; }
  Eigen::Vector3d middle(int dimension) const { return position(dimension == 3 ? Eigen::Vector3d(0.5, 0.5, 0.5) : Eigen::Vector3d(0.5, 0.5, 0.0)); }

  /// Area or volume.
  double measure() const { return A.determinant(); }
  double volume(Kinematics kinematics) const {
    if (kinematics == Kinematics::three_dimensional) return measure();
    return measure() * (kinematics == Kinematics::axisymmetric ? 2.0 * EIGEN_PI * middle(2)(0) : thickness);
  }

  /// The integral of |v|^2 dV for v = c + G X. With s = 1/2 + t it is v = v_m + B t, and the integrals of t_j t_k over the unit cube are 1/12 for j =
  /// k, else 0, as those of products of three. A radius is linear in t too.
  double squares(const Eigen::Vector3d& c, const Matrix3& G, Kinematics kinematics) const {
    const int dimension = mortise::dimension(kinematics);
    const Eigen::Vector3d X_m = middle(dimension), v_m = c + G * X_m;
    const Eigen::MatrixXd B = (G * A).leftCols(dimension);
    const double mean = v_m.squaredNorm() + B.squaredNorm() / 12.0;
    if (kinematics != Kinematics::axisymmetric) return volume(kinematics) * mean;
    const Eigen::VectorXd slope = A.row(0).head(dimension);
    return measure() * 2.0 * EIGEN_PI * (X_m(0) * mean + 2.0 * v_m.dot(B * slope) / 12.0);
  }

  /// Inner nodes are moved by `distortion`; cells stay straight.
  RCP<Mesh> mesh(const RCP<const Communicator>& comm, CellShape shape, int cells, double distortion) const {
    const int dimension = topology(shape).dimension;
    return make_lattice_mesh(
        comm, shape, {cells, cells, cells},
        [&](const Point3& at) -> Point3 {
          Eigen::Vector3d s(at[0], at[1], at[2]);
          double bubble = distortion;
          for (int i = 0; i < dimension; ++i) bubble *= 4.0 * at[i] * (1.0 - at[i]);
          s(0) += bubble * std::cos(3.0 * at[1] + at[2]);
          s(1) += bubble * std::sin(2.0 * at[0] - at[2] + 1.0);
          if (dimension == 3) s(2) += bubble * std::cos(at[0] + 2.0 * at[1]);
          const Eigen::Vector3d X = position(s);
          return {X(0), X(1), X(2)};
        },
        false);
  }
};

Matrix mass_matrix(const Bodies& bodies, double factor = 1.0) {
  Matrix matrix(bodies.space().graph());
  bodies.add_mass(matrix, factor);
  matrix.fillComplete(bodies.space().dofs(), bodies.space().dofs());
  return matrix;
}

/// v(X) on the owned dofs.
Vector velocity(const Bodies& bodies, const Eigen::Vector3d& c, const Matrix3& G) {
  Vector v(bodies.space().dofs());
  const auto view = v.getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (LocalOrdinal node = 0; node < bodies.mesh()->owned_count(); ++node) {
    const Eigen::Vector3d value = c + G * Eigen::Map<const Eigen::Vector3d>(bodies.mesh()->coordinates[node].data());
    for (int i = 0; i < bodies.dimension(); ++i) view(bodies.dimension() * node + i, 0) = value(i);
  }
  return v;
}

double kinetic_energy(const Matrix& mass, const Vector& v) {
  Vector momentum(v.getMap());
  mass.apply(v, momentum);
  return 0.5 * v.dot(momentum);
}

/// Components that the kinematics has.
Eigen::Vector3d translation(int dimension) { return dimension == 3 ? Eigen::Vector3d(0.7, -1.1, 0.4) : Eigen::Vector3d(0.7, -1.1, 0.0); }
Matrix3 rates(int dimension) {
  Matrix3 G = (Matrix3() << 0.3, -0.8, 0.5, 0.9, 0.2, -0.4, 0.1, 0.6, -0.7).finished();
  if (dimension == 2) G.row(2).setZero(), G.col(2).setZero();
  return G;
}

class Mass : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(OfElements, Mass, testing::ValuesIn(every_case()), case_name);

TEST_P(Mass, IsDensityTimesVolumeOfStraightCells) {
  const int dimension = mortise::dimension(GetParam().kinematics);
  const Parallelepiped block(dimension);
  for (const double distortion : {0.0, 0.1}) {
    const auto bodies = make_bodies(block.mesh(self(), cell_shape(GetParam().element), 2, distortion), GetParam());
    const double mass = density * block.volume(GetParam().kinematics);
    EXPECT_NEAR(bodies->masses()[0], mass, 1e-13 * mass);
    const Eigen::Vector3d v = translation(dimension);
    EXPECT_NEAR(kinetic_energy(mass_matrix(*bodies), velocity(*bodies, v, Matrix3::Zero())), 0.5 * mass * v.squaredNorm(), 1e-13 * mass);
    EXPECT_NEAR(kinetic_energy(mass_matrix(*bodies, 0.25), velocity(*bodies, v, Matrix3::Zero())), 0.125 * mass * v.squaredNorm(), 1e-13 * mass);
  }
}

TEST_P(Mass, IsSymmetricAndEqualForEachComponent) {
  const Parallelepiped block(mortise::dimension(GetParam().kinematics));
  const auto bodies = make_bodies(block.mesh(self(), cell_shape(GetParam().element), 2, 0.1), GetParam());
  const Eigen::MatrixXd M = to_dense(mass_matrix(*bodies));
  const int dimension = bodies->dimension();
  EXPECT_EQ((M - M.transpose()).cwiseAbs().maxCoeff(), 0.0);
  for (Eigen::Index row = 0; row < M.rows(); ++row)
    for (Eigen::Index column = 0; column < M.cols(); ++column)
      EXPECT_EQ(M(row, column), row % dimension == column % dimension ? M(row - row % dimension, column - column % dimension) : 0.0);
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(M).eigenvalues().minCoeff(), 0.0);
}

TEST_P(Mass, HasTheKineticEnergyOfALinearVelocity) {
  const int dimension = mortise::dimension(GetParam().kinematics);
  const Parallelepiped block(dimension);
  const auto bodies = make_bodies(block.mesh(self(), cell_shape(GetParam().element), 2, 0.0), GetParam());
  const double energy = 0.5 * density * block.squares(translation(dimension), rates(dimension), GetParam().kinematics);
  EXPECT_NEAR(kinetic_energy(mass_matrix(*bodies), velocity(*bodies, translation(dimension), rates(dimension))), energy, 1e-13 * energy);
}

TEST_P(Mass, LumpedIsPositiveAndOfOneTotal) {
  const Parallelepiped block(mortise::dimension(GetParam().kinematics));
  const auto bodies = make_bodies(block.mesh(self(), cell_shape(GetParam().element), 2, 0.1), GetParam());
  const std::vector<double> masses = bodies->nodal_masses();
  const Eigen::MatrixXd M = to_dense(mass_matrix(*bodies));
  const CellTopology& cell = topology(cell_shape(GetParam().element));
  double sum = 0.0;
  for (std::size_t node = 0; node < masses.size(); ++node) {
    EXPECT_GT(masses[node], 0.0);
    sum += masses[node];
    if (cell.mid_side_nodes() == 0) EXPECT_NEAR(masses[node], M.row(bodies->dimension() * static_cast<int>(node)).sum(), 1e-14);
  }
  const double mass = density * block.volume(GetParam().kinematics);
  EXPECT_NEAR(sum, mass, 1e-13 * mass);
}

// One cell: the diagonal, in one proportion.
TEST(LumpedMass, OfQuadraticCellsIsInTheProportionsOfTheDiagonal) {
  for (const auto& [element, cells] : {std::pair(ElementType::q8, 1), std::pair(ElementType::h20, 1)}) {
    const Case at{element, element == ElementType::q8 ? Kinematics::plane_strain : Kinematics::three_dimensional};
    const Parallelepiped block(mortise::dimension(at.kinematics));
    const auto bodies = make_bodies(block.mesh(self(), cell_shape(element), cells, 0.0), at);
    const std::vector<double> masses = bodies->nodal_masses();
    const Eigen::MatrixXd M = to_dense(mass_matrix(*bodies));
    const double factor = masses[0] / M(0, 0);
    for (std::size_t node = 0; node < masses.size(); ++node) {
      const Eigen::Index row = bodies->dimension() * static_cast<Eigen::Index>(node);
      EXPECT_NEAR(masses[node], factor * M(row, row), 1e-14);
    }
  }
}

TEST(MassOnRanks, IsThatOfOneRank) {
  for (const Case& at : {Case{ElementType::h8, Kinematics::three_dimensional}, Case{ElementType::w6, Kinematics::three_dimensional},
                         Case{ElementType::q4, Kinematics::axisymmetric}, Case{ElementType::t3, Kinematics::plane_strain}}) {
    const auto make = [&](const RCP<const Communicator>& comm) {
      std::shared_ptr<MeshOptions> body;
      if (at.kinematics == Kinematics::three_dimensional) {
        auto brick = std::make_shared<BrickMesh>();
        brick->cells_x = 4;
        brick->cells_y = 3;
        brick->cells_z = 2;
        body = brick;
      } else {
        auto block = std::make_shared<BlockMesh>();
        block->width = block->height = 1.0;
        block->cells_x = 5;
        block->cells_y = 4;
        block->translation = {2.0, 0.0};
        body = block;
      }
      const auto mesh = build_mesh(comm, {{"body", {}, body, cell_shape(at.element)}}, {});
      for (auto& X : mesh->coordinates) X[0] += 0.03 * std::sin(3.0 * X[1] + X[2]);
      return make_bodies(mesh, at);
    };
    const auto one = make(self()), shared = make(world());
    EXPECT_NEAR(shared->masses()[0], one->masses()[0], 1e-13 * one->masses()[0]);
    const auto momentum = [&](const Bodies& bodies) {
      Vector result(bodies.space().dofs());
      mass_matrix(bodies).apply(velocity(bodies, translation(bodies.dimension()), rates(bodies.dimension())), result);
      return to_eigen(result);
    };
    const Eigen::VectorXd mine = momentum(*shared), all = momentum(*one);
    const std::vector<double> my_masses = shared->nodal_masses(), masses = one->nodal_masses();
    const int dimension = shared->dimension();
    for (LocalOrdinal node = 0; node < shared->mesh()->owned_count(); ++node) {
      const LocalOrdinal there = one->mesh()->owned_nodes->getLocalElement(shared->mesh()->owned_nodes->getGlobalElement(node));
      EXPECT_NEAR(my_masses[node], masses[there], 1e-14);
      for (int i = 0; i < dimension; ++i) EXPECT_NEAR(mine(dimension * node + i), all(dimension * there + i), 1e-14);
    }
  }
}

}  // namespace
}  // namespace mortise
