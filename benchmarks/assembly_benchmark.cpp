// What the assembly of the stiffness of a square of n x n cells costs, against one product of the same matrix with a vector.
//
//     assembly_benchmark [n = 280]        280: 157 922 dofs
//
// Both are timed in turns, so that what else the machine does strikes both; medians of 11 repetitions.

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
#include <string>
#include <vector>

#include "mortise/mesh/build_mesh.hpp"
#include "mortise/mesh/generators.hpp"
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
  for (LocalOrdinal node = 0; node < bodies.mesh()->local_count(); ++node) {
    const auto& X = bodies.mesh()->coordinates[node];
    view(2 * node, 0) = 0.02 * std::sin(2.0 * X[0] + X[1]);
    view(2 * node + 1, 0) = 0.03 * X[1] * X[0];
  }
}

void measure(const RCP<const Communicator>& comm, int cells, ElementType element, const std::string& law,
             const std::shared_ptr<const MaterialOptions>& material) {
  auto block = std::make_shared<BlockMesh>();
  block->width = block->height = 1.0;
  block->cells_x = block->cells_y = cells;
  const auto mesh = build_mesh(comm, {{"square", {}, block, cell_shape(element)}}, {});
  const GlobalOrdinal elements = mesh_size(*mesh).elements;
  const Bodies bodies(mesh, Kinematics::plane_strain, 1.0, {{"square", {}, material, element}});
  Vector displacement(bodies.local_dofs()), x(bodies.dofs()), y(bodies.dofs());
  deform(bodies, displacement);
  x.randomize();
  Matrix matrix(bodies.graph());
  matrix.fillComplete();

  std::optional<StepFailure> failure;
  std::vector<double> assembly, product;
  for (int repetition = 0; repetition < 12; ++repetition) {
    const double assembling = seconds([&] { bodies.add_stiffness(displacement, matrix, failure); });
    const double multiplying = seconds([&] { matrix.apply(x, y); });
    if (failure) throw *failure;
    if (repetition == 0) continue;  // the first one touches the memory
    assembly.push_back(assembling);
    product.push_back(multiplying);
  }
  if (comm->getRank() == 0)
    fmt::print("| {} | {} | {} | {} | {:.2f} | {:.2f} | {:.2f} | {:.1f} |\n", to_string(element), law, elements,
               bodies.dofs()->getGlobalNumElements(), elements / median(assembly) / 1e6, 1e3 * median(assembly), 1e3 * median(product),
               median(assembly) / median(product));
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
        "| element | law | elements | dofs | 10⁶ elements/s | assembly, ms | product, ms | assembly / product |\n"
        "|---|---|---|---|---|---|---|---|\n");
  for (const auto element : {ElementType::q4, ElementType::q4_f_bar, ElementType::t3})
    for (const auto& law : material_registry().entries()) {
      const auto material = law.make();
      material->youngs_modulus = 210000.0;
      material->poissons_ratio = 0.3;
      if (check_combination({"square", {}, material, element}, Kinematics::plane_strain).empty()) measure(comm, cells, element, law.name, material);
    }
  return 0;
}
