#pragma once
// Small bodies with distorted meshes, displacement fields and dense views for the tests of `solid`.

#include <Eigen/Dense>
#include <Teuchos_DefaultMpiComm.hpp>
#include <Tpetra_Core.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Vector.hpp>
#include <cmath>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "lattice_mesh.hpp"
#include "mortise/material/materials.hpp"
#include "mortise/mesh/build_mesh.hpp"
#include "mortise/mesh/generators.hpp"
#include "mortise/solid/bodies.hpp"

namespace mortise {

/// J2 plasticity that yields at 2 % of Young's modulus 1000 and hardens with a curve.
struct YieldingMaterial : MaterialOptions {
  Law law() const override { return FiniteJ2(elastic_constants(), SwiftHardening{20.0, 0.02, 0.3}); }
};

inline std::shared_ptr<const MaterialOptions> make_material(const std::string& law, double youngs_modulus = 1000.0, double poissons_ratio = 0.3) {
  for (const auto& entry : material_registry().entries())
    if (entry.name == law) {
      std::shared_ptr<MaterialOptions> material = law == FiniteJ2::name ? std::make_shared<YieldingMaterial>() : entry.make();
      material->youngs_modulus = youngs_modulus;
      material->poissons_ratio = poissons_ratio;
      material->density = 2.0;
      return material;
    }
  throw std::logic_error("no law " + law);
}

struct BodySetup {
  ElementType element = ElementType::q4;
  std::string law = "hencky";
  Kinematics kinematics = Kinematics::plane_strain;
  int cells_x = 2, cells_y = 2;
  double width = 1.0, height = 1.0, left = 2.0;  ///< left > 0 keeps an axisymmetric body off the axis
  double poissons_ratio = 0.3, thickness = 0.7, distortion = 0.15;
};

/// All elements in the registry of 2D or 3D.
inline std::vector<ElementType> elements_of(int dimension) {
  std::vector<ElementType> found;
  visit_each_element([&](const auto& entry) {
    if (std::decay_t<decltype(entry)>::Cell::dimension == dimension) found.push_back(entry.type);
  });
  return found;
}

inline RCP<const Communicator> world() { return Tpetra::getDefaultComm(); }
inline RCP<const Communicator> self() { return rcp(new Teuchos::MpiComm<int>(MPI_COMM_SELF)); }

/// A rectangle [left, left + width] x [0, height] whose inner nodes are displaced by a smooth function, which curves quadratic cells.
inline RCP<Mesh> make_test_mesh(const RCP<const Communicator>& comm, const BodySetup& setup) {
  const CellShape shape = cell_shape(setup.element);
  RCP<Mesh> mesh;
  if (shape == CellShape::quadrilateral4 || shape == CellShape::triangle3) {
    auto block = std::make_shared<BlockMesh>();
    block->width = setup.width;
    block->height = setup.height;
    block->cells_x = setup.cells_x;
    block->cells_y = setup.cells_y;
    block->translation = {setup.left, 0.0};
    mesh = build_mesh(comm, {{"body", {}, block, shape}}, {});
  } else {
    mesh = make_lattice_mesh(
        comm, shape, {setup.cells_x, setup.cells_y, 1},
        [&](const std::array<double, 3>& s) -> std::array<double, 3> {
          return {setup.left + setup.width * s[0], setup.height * s[1], 0.0};
        },
        true);
  }
  for (auto& X : mesh->coordinates) {
    const double s = (X[0] - setup.left) / setup.width, t = X[1] / setup.height, bubble = 16.0 * s * (1.0 - s) * t * (1.0 - t);
    X[0] += setup.distortion * bubble * setup.width / setup.cells_x * std::cos(3.0 * s + 5.0 * t);
    X[1] += setup.distortion * bubble * setup.height / setup.cells_y * std::sin(4.0 * s - 2.0 * t + 1.0);
  }
  return mesh;
}

inline std::shared_ptr<Bodies> make_test_bodies(const RCP<const Communicator>& comm, const BodySetup& setup) {
  return std::make_shared<Bodies>(displacement_space(make_test_mesh(comm, setup)), setup.kinematics, setup.thickness,
                                  std::vector<BodyProperties>{{"body", {}, make_material(setup.law, 1000.0, setup.poissons_ratio), setup.element}});
}

using Field = std::function<std::array<double, 2>(double, double)>;

/// u(X) on the local dofs.
inline Vector local_field(const Bodies& bodies, const Field& field) {
  Vector u(bodies.space().local_dofs());
  auto view = u.getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (LocalOrdinal node = 0; node < bodies.mesh()->local_count(); ++node) {
    const auto value = field(bodies.mesh()->coordinates[node][0], bodies.mesh()->coordinates[node][1]);
    view(2 * node, 0) = value[0];
    view(2 * node + 1, 0) = value[1];
  }
  return u;
}

/// A point in 3D or a displacement there.
using Point3 = std::array<double, 3>;
using SpaceField = std::function<Point3(const Point3&)>;

/// The brick [2, 3] x [0, 1] x [0, 1]; its nodes, those of the surface too, are displaced by a smooth function.
struct BrickSetup {
  ElementType element = ElementType::h8;
  std::string law = "hencky";
  std::array<int, 3> cells{2, 1, 1};
  double poissons_ratio = 0.3, distortion = 0.1;
  bool curved = false;  ///< mid-side nodes move too
};

inline RCP<Mesh> make_brick_mesh(const BrickSetup& setup) {
  return make_lattice_mesh(
      self(), cell_shape(setup.element), setup.cells,
      [&](const Point3& s) -> Point3 {
        const double d = setup.distortion;
        return {2.0 + s[0] + d / setup.cells[0] * std::cos(1.0 + 2.0 * s[1] - 3.0 * s[2]),
                s[1] + d / setup.cells[1] * std::sin(2.0 * s[0] + 4.0 * s[2]), s[2] + d / setup.cells[2] * std::sin(1.0 + 3.0 * s[0] - 2.0 * s[1])};
      },
      setup.curved);
}

inline std::shared_ptr<Bodies> make_brick(const BrickSetup& setup) {
  return std::make_shared<Bodies>(displacement_space(make_brick_mesh(setup)), Kinematics::three_dimensional, 1.0,
                                  std::vector<BodyProperties>{{"body", {}, make_material(setup.law, 1000.0, setup.poissons_ratio), setup.element}});
}

/// u(X) on the local dofs in 3D.
inline Eigen::VectorXd space_field(const Bodies& bodies, const SpaceField& field) {
  Eigen::VectorXd u(3 * bodies.mesh()->local_count());
  for (LocalOrdinal node = 0; node < bodies.mesh()->local_count(); ++node)
    u.segment<3>(3 * node) = Eigen::Map<const Eigen::Vector3d>(field(bodies.mesh()->coordinates[node]).data());
  return u;
}

/// 1/2 ln(F F^T) from Eigen's decomposition, or the symmetric part of F - 1.
inline Matrix3 expected_strain(const Matrix3& F, bool small_strain) {
  if (small_strain) return 0.5 * (F + F.transpose()) - Matrix3::Identity();
  const Eigen::SelfAdjointEigenSolver<Matrix3> b(F * F.transpose());
  return b.eigenvectors() * (0.5 * b.eigenvalues().array().log()).matrix().asDiagonal() * b.eigenvectors().transpose();
}

inline Eigen::VectorXd to_eigen(const Vector& vector) {
  const auto view = vector.getLocalViewHost(Tpetra::Access::ReadOnly);
  return Eigen::Map<const Eigen::VectorXd>(view.data(), view.extent(0));
}

inline Vector to_local(const Bodies& bodies, const Eigen::VectorXd& values) {
  Vector vector(bodies.space().local_dofs());
  auto view = vector.getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (Eigen::Index n = 0; n < values.size(); ++n) view(n, 0) = values(n);
  return vector;
}

/// One rank: the whole matrix.
inline Eigen::MatrixXd to_dense(const Matrix& matrix) {
  const auto local = const_cast<Matrix&>(matrix).getLocalMatrixHost();
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(local.numRows(), local.numCols());
  for (LocalOrdinal row = 0; row < local.numRows(); ++row)
    for (auto n = local.graph.row_map(row); n < local.graph.row_map(row + 1); ++n) dense(row, local.graph.entries(n)) += local.values(n);
  return dense;
}

/// Central differences of f at u, column by column. Step: cube root of the round-off times a length of 1.
inline Eigen::MatrixXd central_differences(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& f, const Eigen::VectorXd& u,
                                           double step = 1e-6) {
  Eigen::MatrixXd J(f(u).size(), u.size());
  for (Eigen::Index n = 0; n < u.size(); ++n) {
    Eigen::VectorXd plus = u, minus = u;
    plus(n) += step;
    minus(n) -= step;
    J.col(n) = (f(plus) - f(minus)) / (plus(n) - minus(n));
  }
  return J;
}

inline Eigen::VectorXd internal_force(const Bodies& bodies, const Eigen::VectorXd& u) {
  Vector residual(bodies.space().dofs());
  std::optional<StepFailure> failure;
  bodies.add_internal_force(to_local(bodies, u), residual, failure);
  if (failure) throw *failure;
  return to_eigen(residual);
}

inline Eigen::MatrixXd stiffness(const Bodies& bodies, const Eigen::VectorXd& u) {
  Matrix matrix(bodies.space().graph());
  std::optional<StepFailure> failure;
  bodies.add_stiffness(to_local(bodies, u), matrix, failure);
  if (failure) throw *failure;
  return to_dense(matrix);
}

}  // namespace mortise
