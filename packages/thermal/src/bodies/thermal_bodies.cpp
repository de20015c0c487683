#include "mortise/thermal/thermal_bodies.hpp"

#include <fmt/format.h>

#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <stdexcept>

#include "elements/thermal_block.hpp"
#include "mortise/solid/nodal_means.hpp"

namespace mortise {
namespace {

std::optional<std::size_t> field_named(const FieldSpace& space, const std::string& name) {
  for (std::size_t n = 0; n < space.field_count(); ++n)
    if (space.field(n).name() == name) return n;
  return std::nullopt;
}

}  // namespace

ThermalBodies::ThermalBodies(std::shared_ptr<const FieldSpace> space, Kinematics kinematics, double thickness, std::vector<ThermalBody> bodies)
    : space_(std::move(space)),
      kinematics_(kinematics),
      thickness_(thickness),
      bodies_(std::move(bodies)),
      displacement_(field_named(*space_, "displacement")) {
  const Mesh& mesh = *space_->mesh();
  const auto temperature = field_named(*space_, "temperature");
  if (!temperature || space_->rows(*temperature).components != 1) throw std::logic_error("heat needs a field \"temperature\" of one component");
  temperature_ = *temperature;
  if (mesh.dimension != dimension(kinematics_)) throw std::logic_error("the mesh and the kinematics do not have the same dimension");
  if (bodies_.size() != mesh.blocks.size()) throw std::logic_error("thermal bodies and blocks of the mesh do not match");
  if (displacement_ && space_->rows(*displacement_).components != mesh.dimension)
    throw std::logic_error("displacements do not have as many components as the mesh has dimensions");

  std::vector<Diagnostic> diagnostics;
  for (std::size_t n = 0; n < bodies_.size(); ++n) {
    if (!bodies_[n].properties) continue;
    const ThermalProperties& properties = *bodies_[n].properties;
    const Block& block = mesh.blocks[n];
    const CellTopology& cell = topology(block.shape);
    const auto refuse = [&](const std::string& what) {
      diagnostics.push_back({bodies_[n].place, fmt::format("body \"{}\": {}", mesh.body_of(block).name, what)});
    };
    if (cell.dimension != mesh.dimension) throw std::logic_error("a body of surfaces has no temperature");
    for (const LocalOrdinal node : block.connectivity)
      if (!space_->rows(temperature_).lives(node))
        throw std::logic_error("the field \"temperature\" does not live on a body with thermal properties");
    if (const auto fault = properties.fault()) refuse(*fault);
    if (properties.lumped_capacity && cell.nodes != cell.corners)
      refuse("a lumped capacity is for linear cells, and its cells are quadratic; leave it out, or take linear elements");
    if (properties.specific_heat.is_given() && !(bodies_[n].density > 0.0))
      refuse(fmt::format("it has a specific heat, and its density is {:g}; give a density above 0", bodies_[n].density));
  }
  throw_if_any(*mesh.comm, diagnostics);
  for (std::size_t n = 0; n < bodies_.size(); ++n)
    blocks_.push_back(!bodies_[n].properties ? nullptr
                                             : make_thermal_block({*space_, mesh.blocks[n], temperature_, displacement_, kinematics_, thickness_,
                                                                   bodies_[n].properties, bodies_[n].density}));
}

ThermalBodies::~ThermalBodies() = default;

bool ThermalBodies::conducts_by_displacement() const {
  return displacement_ && std::any_of(bodies_.begin(), bodies_.end(), [](const ThermalBody& body) {
           return body.properties && body.properties->acts_in != ConductivityActsIn::reference;
         });
}

bool ThermalBodies::has_capacity() const {
  return std::any_of(bodies_.begin(), bodies_.end(),
                     [](const ThermalBody& body) { return body.properties && body.properties->specific_heat.is_given(); });
}

bool ThermalBodies::has_source() const {
  return std::any_of(bodies_.begin(), bodies_.end(), [](const ThermalBody& body) { return body.properties && body.properties->source; });
}

std::vector<std::array<double, 3>> ThermalBodies::element_heat_fluxes(const Vector& local_unknowns, LocalOrdinal block) const {
  const LocalOrdinal owned = mesh()->blocks.at(block).owned;
  std::vector<std::array<double, 3>> fluxes(owned, std::array<double, 3>{});
  if (!blocks_[block]) return fluxes;
  std::vector<double> volumes(owned, 0.0);
  const auto unknowns = local_unknowns.getLocalViewHost(Tpetra::Access::ReadOnly);
  blocks_[block]->visit_fluxes({0.0, unknowns.data()}, owned, [&](const HeatFluxPoint& point) {
    volumes[point.element] += point.weight;
    for (int i = 0; i < 3; ++i) fluxes[point.element][i] += point.weight * point.flux[i];
  });
  for (LocalOrdinal element = 0; element < owned; ++element)
    for (double& component : fluxes[element]) component /= volumes[element];
  return fluxes;
}

RCP<MultiVector> ThermalBodies::nodal_heat_fluxes(const Vector& local_unknowns) const {
  NodalMeans means(mesh(), mesh()->dimension);
  const auto unknowns = local_unknowns.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t n = 0; n < blocks_.size(); ++n) {
    if (!blocks_[n]) continue;
    const Block& block = mesh()->blocks[n];
    const Eigen::MatrixXd extrapolation = extrapolation_to_nodes(block.shape, kinematics_);
    blocks_[n]->visit_fluxes({0.0, unknowns.data()}, block.size(),
                             [&](const HeatFluxPoint& point) { means.add(block, point.element, point.point, extrapolation, point.flux.data()); });
  }
  return means.result();
}

}  // namespace mortise
