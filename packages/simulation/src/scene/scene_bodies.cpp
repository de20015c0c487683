#include "mortise/simulation/scene/scene_bodies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "mortise/core/names.hpp"
#include "mortise/material/materials.hpp"
#include "mortise/mesh/file_mesh.hpp"

namespace mortise {
namespace {

ElementType standard_element_of(CellShape shape) {
  for (const auto& [name, type] : element_names())
    if (cell_shape(type) == shape && formulation(type) == ElementFormulation::standard) return type;
  throw std::logic_error("a cell shape without an element");
}

std::shared_ptr<const MaterialOptions> find_material(const Scene& scene, const std::string& name) {
  const auto found = std::find_if(scene.materials.begin(), scene.materials.end(), [&](const auto& one) { return one.name == name; });
  return found == scene.materials.end() ? nullptr : found->value.law.options;
}

}  // namespace

std::string material_name(const BodyOptions& body, const std::string& part) {
  for (const Assignment& one : body.materials.all)
    if (one.path == part) return one.value;
  return body.material.value;
}

ElementType element_of(const BodyOptions& body, CellShape shape) {
  return body.element.value && cell_shape(*body.element.value) == shape ? *body.element.value : standard_element_of(shape);
}

ElementType element_of(const BodyOptions& body) {
  return body.element.value.value_or(body.mesh.options->dimension() == 2 ? ElementType::q4 : ElementType::h8);
}

std::vector<BodyDescription> body_descriptions(const Communicator& comm, const Scene& scene) {
  std::vector<FileBodyRequest> requests;
  for (const auto& body : scene.bodies)
    if (const auto* mesh = dynamic_cast<const FileMesh*>(body.value.mesh.options.get())) {
      requests.push_back(mesh->request(body.name, body.place, dimension(scene.kinematics), body.value.rigid.value));
      requests.back().shares_nodes = requests.back().shares_nodes || body.value.pattern.begin > 0;  // copies of one body
      for (const Assignment& part : body.value.materials.all) requests.back().parts.push_back({part.path, part.place});
    }
  std::vector<char> is_listed;
  for (const auto& body : scene.bodies) {
    is_listed.push_back(dynamic_cast<const FileMesh*>(body.value.mesh.options.get()) != nullptr ? 1 : 0);
    if (is_listed.back()) continue;
    // The choice of bodies that are lists does not depend on the rank; the lists themselves rank 0 needs alone.
    const MeshOptions& mesh = *body.value.mesh.options;
    const bool is_rigid = body.value.rigid.value;
    const CellShape cell = is_rigid ? rigid_shape(mesh.dimension()) : cell_shape(element_of(body.value));
    if (!is_rigid && topology(cell).dimension != mesh.dimension()) continue;  // refused where the mesh is built
    auto made = mesh.listed(cell, body.place);
    if (!made) continue;
    is_listed.back() = 1;
    FileBodyRequest request;
    request.name = body.name;
    request.place = body.place;
    request.is_surface = is_rigid;
    if (comm.getRank() == 0) request.made = std::make_shared<const MeshFile>(*std::move(made));
    requests.push_back(std::move(request));
  }
  const auto listed = make_file_bodies(comm, requests);
  std::vector<BodyDescription> descriptions;
  for (const auto& body : scene.bodies) {
    const MeshOptions& mesh = *body.value.mesh.options;
    const auto copy = placement(body.value.mirror, body.value.pattern);
    const auto found =
        std::find_if(requests.begin(), requests.end(), [&, &body = body](const FileBodyRequest& request) { return request.name == body.name; });
    if (is_listed[descriptions.size()])
      descriptions.push_back({body.name, body.place, body.value.mesh.options, {}, listed[static_cast<std::size_t>(found - requests.begin())], copy});
    else
      descriptions.push_back({body.name,
                              body.place,
                              body.value.mesh.options,
                              body.value.rigid.value ? rigid_shape(mesh.dimension()) : cell_shape(element_of(body.value)),
                              {},
                              copy});
  }
  return descriptions;
}

std::vector<BodyProperties> block_properties(const Scene& scene, const Mesh& mesh) {
  std::vector<Diagnostic> diagnostics;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const auto& [element, place] = scene.bodies[b].value.element;
    if (!element || mesh.bodies[b].is_surface) continue;
    const bool is_there = std::any_of(mesh.blocks.begin(), mesh.blocks.end(), [&, &element = element](const Block& block) {
      return block.body == static_cast<int>(b) && block.shape == cell_shape(*element);
    });
    if (!is_there)
      diagnostics.push_back({place, fmt::format("the mesh of body \"{}\" has no cells for elements \"{}\"; please leave out \"element\"",
                                                scene.bodies[b].name, to_string(*element))});
  }
  std::vector<BodyProperties> properties;
  for (const Block& block : mesh.blocks) {
    const auto& body = scene.bodies[static_cast<std::size_t>(block.body)];
    const bool is_rigid = mesh.bodies[block.body].is_surface;
    const auto material = is_rigid ? nullptr : find_material(scene, material_name(body.value, block.part));
    if (!is_rigid && material == nullptr)
      diagnostics.push_back(
          {body.place, fmt::format("body \"{}\" has elements that are in no block of \"materials\"; please add \"material\" for them", body.name)});
    properties.push_back({body.name, body.place, material, is_rigid ? ElementType{} : element_of(body.value, block.shape)});
  }
  if (!diagnostics.empty()) throw InputError(diagnostics);
  return properties;
}

double youngs_modulus(const Scene& scene, const Mesh& mesh, const Block& block) {
  if (mesh.body_of(block).is_surface) return std::numeric_limits<double>::infinity();
  return find_material(scene, material_name(scene.bodies[static_cast<std::size_t>(block.body)].value, block.part))->youngs_modulus;
}

bool has_temperature(const Scene& scene, const Mesh& mesh, const Block& block) {
  const BodyOptions& body = scene.bodies[static_cast<std::size_t>(block.body)].value;
  if (mesh.body_of(block).is_surface) return body.temperature.has_value();
  const std::string name = material_name(body, block.part);
  return std::any_of(scene.materials.begin(), scene.materials.end(),
                     [&](const auto& material) { return material.name == name && material.value.heat.conductivity.is_given(); });
}

std::vector<std::string> contact_sides(const Scene& scene) {
  std::vector<std::string> sides;
  for (const auto& pair : scene.contact)
    for (const auto* name : {&pair.value.slave.value, &pair.value.master.value}) sides.push_back(*name);
  for (const auto& tie : scene.ties)
    for (const auto* name : {&tie.value.slave.value, &tie.value.master.value}) sides.push_back(*name);
  // A set may be part of sets that stand before it.
  for (auto set = scene.sets.rbegin(); set != scene.sets.rend(); ++set)
    if (std::find(sides.begin(), sides.end(), set->name) != sides.end())
      sides.insert(sides.end(), set->value.of.value.begin(), set->value.of.value.end());
  return sides;
}

}  // namespace mortise
