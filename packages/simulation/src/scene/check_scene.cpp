#include "mortise/simulation/scene/check_scene.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "mortise/core/names.hpp"

namespace mortise {
namespace {

/// Newton's tolerances ask for 1e-12 of forces, which are strains of 1e-8 and more times E; with their squares above 1e-308 E has to be above 1e-134.
constexpr double least_modulus = 1e-120, largest_modulus = 1e120;

template <class T>
const Named<T>* find(const std::vector<Named<T>>& entries, const std::string& name) {
  const auto found = std::find_if(entries.begin(), entries.end(), [&](const auto& entry) { return entry.name == name; });
  return found == entries.end() ? nullptr : &*found;
}

/// Materials whose Young's modulus is so small or large that squares of forces leave the range of numbers.
std::vector<Diagnostic> moduli_out_of_range(const Scene& scene) {
  std::vector<Diagnostic> diagnostics;
  for (const auto& material : scene.materials) {
    if (material.value.law.options == nullptr) continue;
    const double modulus = material.value.law.options->youngs_modulus;
    if (modulus >= least_modulus && modulus <= largest_modulus) continue;
    diagnostics.push_back(
        {material.place, fmt::format("\"young's modulus\" is {}; allowed: {:g} to {:g}, as squares of forces would leave the range of "
                                     "numbers; please take other units",
                                     modulus, least_modulus, largest_modulus)});
  }
  return diagnostics;
}

}  // namespace

std::vector<Diagnostic> check_scene(const Scene& scene) {
  std::vector<Diagnostic> diagnostics;
  if (scene.bodies.empty()) diagnostics.push_back({{}, "the scene has no bodies; please add the list \"bodies\""});
  for (const auto& body : scene.bodies) {
    const auto& wanted = body.value.material;
    if (!wanted.value.empty() && find(scene.materials, wanted.value) == nullptr)
      diagnostics.push_back({wanted.place, unknown_name("material", wanted.value, names_of(scene.materials))});
    for (const Assignment& part : body.value.materials.all)
      if (find(scene.materials, part.value) == nullptr)
        diagnostics.push_back({part.place, unknown_name("material", part.value, names_of(scene.materials))});
  }
  const auto moduli = moduli_out_of_range(scene);
  diagnostics.insert(diagnostics.end(), moduli.begin(), moduli.end());
  for (const auto& pair : scene.contact)
    if (!pair.value.slave.value.empty() && pair.value.slave.value == pair.value.master.value)
      diagnostics.push_back({pair.value.master.place, fmt::format("slave and master are the same set \"{}\"", pair.value.slave.value)});
  for (const auto& tie : scene.ties)
    if (!tie.value.slave.value.empty() && tie.value.slave.value == tie.value.master.value)
      diagnostics.push_back({tie.value.master.place, fmt::format("slave and master are the same set \"{}\"", tie.value.slave.value)});
  for (const auto& check : scene.checks) {
    const auto& wanted = check.value.quantity;
    if (!wanted.value.empty() && find(scene.quantities, wanted.value) == nullptr)
      diagnostics.push_back({wanted.place, unknown_name("quantity", wanted.value, names_of(scene.quantities))});
  }
  return diagnostics;
}

}  // namespace mortise
