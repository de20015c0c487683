// The displacement of a point in 3D, in every element, of fields that the element holds exactly; the same on any number of ranks.

#include <gmock/gmock.h>

#include <Tpetra_Core.hpp>
#include <Tpetra_Vector.hpp>

#include "mortise/material/materials.hpp"
#include "mortise/mesh/build_mesh.hpp"
#include "mortise/mesh/volume_generators.hpp"
#include "mortise/simulation/quantities/quantity_kinds.hpp"

namespace mortise {
namespace {

using ::testing::HasSubstr;
using Position = std::array<double, 3>;

struct Case {
  ElementType element;
  CellShape shape;
  bool quadratic;
};

/// A brick [0, 2] x [0, 1] x [0, 1.5], displaced by a polynomial that its elements hold.
class Brick {
 public:
  explicit Brick(const Case& one) : quadratic_(one.quadratic) {
    const auto options = std::make_shared<BrickMesh>();
    options->width = 2.0, options->depth = 1.0, options->height = 1.5;
    options->cells_x = 3, options->cells_y = 2, options->cells_z = 2;
    mesh_ = build_mesh(Tpetra::getDefaultComm(), {{"brick", {}, options, one.shape}}, {});
    const std::shared_ptr<MaterialOptions> material = std::make_shared<ElasticMaterialOptions<SmallStrainLinear>>();
    material->youngs_modulus = 100.0, material->poissons_ratio = 0.3;
    bodies_ = std::make_unique<Bodies>(displacement_space(mesh_), Kinematics::three_dimensional, 1.0,
                                       std::vector<BodyProperties>{{"brick", {}, material, one.element}});
    displacement_ = rcp(new Vector(bodies_->space().local_dofs()));
    for (LocalOrdinal node = 0; node < mesh_->local_count(); ++node)
      for (int i = 0; i < 3; ++i) displacement_->replaceLocalValue(3 * node + i, expected(mesh_->coordinates[node], i));
  }

  double expected(const Position& X, int i) const {
    const double affine = 0.1 * (i + 1) + 0.2 * X[0] - 0.3 * X[1] + 0.4 * (2 - i) * X[2];
    return quadratic_ ? affine + 0.05 * X[0] * X[1] - 0.07 * X[2] * X[2] : affine;
  }

  double at(const Position& X, int component, bool with_z = true) const {
    PointDisplacement point;
    point.point.x.value = X[0], point.point.y.value = X[1];
    if (with_z) point.point.z = X[2];
    point.component = static_cast<Component>(component);
    QuantityContext context{*bodies_};
    const auto evaluator = point.make_evaluator(context);
    context.local_displacement = displacement_.get();
    return evaluator->evaluate(context);
  }

 private:
  bool quadratic_;
  RCP<Mesh> mesh_;
  std::unique_ptr<Bodies> bodies_;
  RCP<Vector> displacement_;
};

TEST(SpacePoint, IsDisplacedAsTheElementThatHoldsIt) {
  const std::vector<Case> cases{{ElementType::h8, CellShape::hexahedron8, false},  {ElementType::tet4, CellShape::tetrahedron4, false},
                                {ElementType::h20, CellShape::hexahedron20, true}, {ElementType::tet10, CellShape::tetrahedron10, true},
                                {ElementType::w6, CellShape::wedge6, false},       {ElementType::w15, CellShape::wedge15, true}};
  // Inside, on a side, on an edge, at a corner.
  const std::vector<Position> points{{0.7, 0.3, 1.1}, {2.0, 0.61, 0.2}, {0.0, 1.0, 0.9}, {2.0, 1.0, 1.5}};
  for (const Case& one : cases) {
    const Brick brick(one);
    for (const Position& X : points)
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(brick.at(X, i), brick.expected(X, i), 1e-13) << static_cast<int>(one.shape);
  }
}

TEST(SpacePoint, OutsideOrWithoutZIsRefused) {
  const Brick brick({ElementType::h8, CellShape::hexahedron8, false});
  const auto error = [&](const Position& X, bool with_z) {
    try {
      brick.at(X, 2, with_z);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(error({1.0, 0.5, 1.6}, true), HasSubstr("the point (1, 0.5, 1.6) lies in no body"));
  EXPECT_THAT(error({1.0, 0.5, 0.0}, false), HasSubstr("a point in 3D needs \"z\""));
}

}  // namespace
}  // namespace mortise
