// Cost of assembling the stiffness of a square of n x n cells, or of a cube of about as many, for linear elements and every law. It is given relative
// to Hencky's law on the same element and to one product of the same matrix with a vector. A third figure is the share of the law alone (stress and
// tangent at all points). Plastic laws flow everywhere.
//
//     assembly_benchmark [n = 280]        280: 157 922 dofs in 2D, 238 521 in 3D
//
// All are timed in turns, so that what else the machine does strikes all; medians of 11 repetitions.

#include <fmt/format.h>

#include <Tpetra_Core.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "mortise/material/materials.hpp"
#include "mortise/material/plane_stress.hpp"
#include "mortise/mesh/build_mesh.hpp"
#include "mortise/mesh/generators.hpp"
#include "mortise/mesh/volume_generators.hpp"
#include "mortise/solid/bodies.hpp"

namespace mortise {
namespace {

double seconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

/// A smooth displacement with strains of a few percent, so that no branch for the undeformed state is taken.
void deform(const Bodies& bodies, Vector& displacement) {
  auto view = displacement.getLocalViewHost(Tpetra::Access::OverwriteAll);
  const int dimension = bodies.dimension();
  for (LocalOrdinal node = 0; node < bodies.mesh()->local_count(); ++node) {
    const auto& X = bodies.mesh()->coordinates[node];
    view(dimension * node, 0) = 0.02 * std::sin(2.0 * X[0] + X[1]);
    view(dimension * node + 1, 0) = 0.03 * X[1] * X[0];
    if (dimension == 3) view(dimension * node + 2, 0) = 0.02 * X[2] * X[0];
  }
}

/// Yields at 0.4 % of strain, less than what deform() brings: every point flows.
struct Yielding : MaterialOptions {
  Hardening hardening;
  explicit Yielding(Hardening law) : hardening(std::move(law)) {}
  Law law() const override { return FiniteJ2(elastic_constants(), hardening); }
};

struct Material {
  std::string name;
  std::shared_ptr<MaterialOptions> options;
};

std::vector<Material> materials() {
  std::vector<Material> all;
  for (const auto& law : material_registry().entries())
    if (law.name != FiniteJ2::name) all.push_back({law.name, law.make()});
  all.push_back({"j2, linear", std::make_shared<Yielding>(LinearHardening{830.0, 300.0})});
  all.push_back({"j2, voce", std::make_shared<Yielding>(VoceHardening{830.0, 300.0, 10.0})});
  all.push_back({"j2, ludwik", std::make_shared<Yielding>(LudwikHardening{830.0, 600.0, 0.21})});
  for (const Material& material : all) {
    material.options->youngs_modulus = 210000.0;
    material.options->poissons_ratio = 0.3;
  }
  return all;
}

/// One body of one law, and what its parts took.
struct Case {
  std::string law;
  std::unique_ptr<Bodies> bodies;
  RCP<Matrix> matrix;
  std::vector<Matrix3> deformations;  ///< of its points
  Law at_points;
  std::vector<double> stiffness, force, law_alone, product;
};

/// The law's stress and tangent at all points, without elements around it.
template <class Components>
double evaluate_law(const Case& one) {
  return std::visit(
      [&](const auto& law) {
        const Unconstrained<std::decay_t<decltype(law)>> point{law};
        double sum = 0.0;  // keeps the work from being optimised away
        for (const Matrix3& F : one.deformations) sum += point.template stress_and_tangent<Components>(F, {}).tangent(0, 0);
        return sum;
      },
      one.at_points);
}

std::shared_ptr<const MeshOptions> square(int cells) {
  auto block = std::make_shared<BlockMesh>();
  block->width = block->height = 1.0;
  block->cells_x = block->cells_y = cells;
  return block;
}

/// Of about as many cells as the square.
std::shared_ptr<const MeshOptions> cube(int cells) {
  auto brick = std::make_shared<BrickMesh>();
  brick->cells_x = brick->cells_y = brick->cells_z = static_cast<int>(std::lround(std::pow(cells, 2.0 / 3.0)));
  return brick;
}

/// All laws on one kind of element, in turns.
void measure(const RCP<const Communicator>& comm, int cells, ElementType element) {
  const bool in_space = element == ElementType::h8 || element == ElementType::h8_f_bar;
  const Kinematics kinematics = in_space ? Kinematics::three_dimensional : Kinematics::plane_strain;
  BodyDescription body;
  body.name = "body";
  body.mesh = in_space ? cube(cells) : square(cells);
  body.shape = cell_shape(element);
  const auto mesh = build_mesh(comm, {body}, {});
  const double elements = static_cast<double>(mesh_size(*mesh).elements);
  std::vector<Case> cases;
  for (const Material& material : materials()) {
    if (!check_combination({"body", {}, material.options, element}, kinematics).empty()) continue;
    cases.push_back(
        {material.name,
         std::make_unique<Bodies>(displacement_space(mesh), kinematics, 1.0, std::vector<BodyProperties>{{"body", {}, material.options, element}}),
         {},
         {},
         material.options->law(),
         {},
         {},
         {},
         {}});
    cases.back().matrix = rcp(new Matrix(cases.back().bodies->space().graph()));
    cases.back().matrix->fillComplete();
  }
  const Bodies& any = *cases.front().bodies;
  Vector displacement(any.space().local_dofs()), x(any.space().dofs()), y(any.space().dofs());
  deform(any, displacement);
  x.randomize();
  for (Case& one : cases)
    one.bodies->visit_points(displacement, [&](const MaterialPoint& point) { one.deformations.push_back(point.deformation_gradient); });

  std::optional<StepFailure> failure;
  double sum = 0.0;
  for (int repetition = 0; repetition < 12; ++repetition)
    for (Case& one : cases) {
      const double stiffness = seconds([&] { one.bodies->add_stiffness(displacement, *one.matrix, failure); });
      const double force = seconds([&] { one.bodies->add_internal_force(displacement, y, failure); });
      const double law = seconds([&] { sum += in_space ? evaluate_law<SolidComponents>(one) : evaluate_law<PlaneComponents>(one); });
      const double product = seconds([&] { one.matrix->apply(x, y); });
      if (failure) throw *failure;
      if (repetition == 0) continue;  // the first one touches the memory
      one.stiffness.push_back(stiffness), one.force.push_back(force), one.law_alone.push_back(law), one.product.push_back(product);
    }
  if (!std::isfinite(sum)) throw std::runtime_error("a law has no stress");
  if (comm->getRank() != 0) return;
  double hencky = 0.0;
  for (const Case& one : cases)
    if (one.law == Hencky::name) hencky = median(one.stiffness);
  for (const Case& one : cases) {
    const double stiffness = median(one.stiffness), per_element = 1e6 / elements;
    fmt::print("| {} | {} | {:.0f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.1f} |\n", to_string(element), one.law, elements,
               elements / stiffness / 1e6, stiffness * per_element, median(one.law_alone) * per_element, median(one.force) * per_element,
               stiffness / hencky, stiffness / median(one.product));
  }
}

}  // namespace
}  // namespace mortise

int main(int argc, char** argv) {
  using namespace mortise;
  Tpetra::ScopeGuard scope(&argc, &argv);
  const int cells = argc > 1 ? std::atoi(argv[1]) : 280;
  if (cells < 1) return fmt::print(stderr, "usage: assembly_benchmark [cells along a side]\n"), 1;
  const auto comm = Tpetra::getDefaultComm();
  if (comm->getRank() == 0)
    fmt::print(
        "| element | law | elements | 10⁶ elements/s | stiffness, µs/element | law alone, µs/element | force, µs/element | stiffness / hencky | "
        "stiffness / product |\n"
        "|---|---|---|---|---|---|---|---|---|\n");
  for (const auto element : {ElementType::q4, ElementType::q4_f_bar, ElementType::t3, ElementType::h8, ElementType::h8_f_bar})
    measure(comm, cells, element);
  return 0;
}
