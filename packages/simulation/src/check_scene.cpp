#include <fmt/format.h>

#include <algorithm>

#include "mortise/simulation/model.hpp"
#include "names.hpp"
#include "precision.hpp"

namespace mortise {
namespace {

template <class T>
const Named<T>* find(const std::vector<Named<T>>& entries, const std::string& name) {
  const auto found = std::find_if(entries.begin(), entries.end(), [&](const auto& entry) { return entry.name == name; });
  return found == entries.end() ? nullptr : &*found;
}

}  // namespace

std::vector<Diagnostic> check_scene(const Scene& scene) {
  std::vector<Diagnostic> diagnostics;
  if (scene.bodies.empty()) diagnostics.push_back({{}, "the scene has no bodies; please add the list \"bodies\""});
  for (const auto& body : scene.bodies) {
    const auto& wanted = body.value.material;
    if (!wanted.value.empty() && find(scene.materials, wanted.value) == nullptr)
      diagnostics.push_back({wanted.place, unknown_name("material", wanted.value, names_of(scene.materials))});
  }
  const auto moduli = moduli_out_of_range(scene);
  diagnostics.insert(diagnostics.end(), moduli.begin(), moduli.end());
  for (const auto& pair : scene.contact)
    if (!pair.value.slave.value.empty() && pair.value.slave.value == pair.value.master.value)
      diagnostics.push_back({pair.value.master.place, fmt::format("slave and master are the same set \"{}\"", pair.value.slave.value)});
  for (const auto& check : scene.checks) {
    const auto& wanted = check.value.quantity;
    if (!wanted.value.empty() && find(scene.quantities, wanted.value) == nullptr)
      diagnostics.push_back({wanted.place, unknown_name("quantity", wanted.value, names_of(scene.quantities))});
  }
  return diagnostics;
}

}  // namespace mortise
