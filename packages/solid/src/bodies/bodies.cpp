#include "mortise/solid/bodies.hpp"

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <limits>
#include <stdexcept>

#include "bodies/host_view.hpp"
#include "elements/element_block.hpp"
#include "mortise/material/logarithmic.hpp"
#include "mortise/material/materials.hpp"
#include "mortise/solid/loaded_side.hpp"
#include "mortise/solid/nodal_means.hpp"

namespace mortise {
namespace {

/// A rigid body has no elements: nothing is computed, nothing remembered.
class RigidBlock final : public ElementBlock {
 public:
  void add(const double*, double, const AssemblyTarget&, std::optional<StepFailure>&) const override {}
  void visit_points(const double*, LocalOrdinal, const std::function<void(const MaterialPoint&)>&) const override {}
  void commit(const double*) override {}
  void serialize(StateArchive&, const std::string&) override {}
  std::size_t history_bytes() const override { return 0; }
  long history_evaluations() const override { return 0; }
  void add_mass(double, const NodalSparsity::Values&, double) const override {}
  void add_nodal_masses(double, std::vector<double>&) const override {}
  void add_nodal_volumes(std::vector<double>&) const override {}
  std::pair<LocalOrdinal, double> smallest_reference_determinant() const override { return {-1, std::numeric_limits<double>::infinity()}; }
};

/// The temperature that each body's law takes, if its material has properties that depend on it: a field "temperature" that lives on all its nodes,
/// on all ranks. Collective.
std::vector<std::optional<std::size_t>> temperatures_of(const FieldSpace& space, const std::vector<BodyProperties>& bodies) {
  std::vector<std::optional<std::size_t>> result(bodies.size());
  std::size_t field = 1;
  while (field < space.field_count() && space.field(field).name() != "temperature") ++field;
  if (field >= space.field_count()) return result;
  std::vector<int> mine(bodies.size(), 0), all(bodies.size(), 0);
  for (std::size_t n = 0; n < bodies.size(); ++n) {
    const Block& block = space.mesh()->blocks[n];
    const LocalOrdinal *first = block.nodes(0), *last = block.nodes(block.size());
    const bool lives = std::all_of(first, last, [&](LocalOrdinal node) { return space.rows(field).lives(node); });
    mine[n] = !bodies[n].is_rigid() && bodies[n].material->thermal.given() && lives ? 1 : 0;
  }
  Teuchos::reduceAll(*space.mesh()->comm, Teuchos::REDUCE_MIN, static_cast<int>(mine.size()), mine.data(), all.data());
  for (std::size_t n = 0; n < bodies.size(); ++n)
    if (all[n] != 0) result[n] = field;
  return result;
}

}  // namespace

std::shared_ptr<const FieldSpace> displacement_space(RCP<const Mesh> mesh) {
  const int dimension = mesh->dimension;
  return std::make_shared<FieldSpace>(std::move(mesh), std::vector<FieldDeclaration>{{"displacement", dimension}});
}

Bodies::Bodies(std::shared_ptr<const FieldSpace> space, Kinematics kinematics, double thickness, std::vector<BodyProperties> bodies,
               double heat_at_start)
    : space_(std::move(space)),
      mesh_(space_->mesh()),
      kinematics_(kinematics),
      thickness_(thickness),
      properties_(std::move(bodies)),
      heat_at_start_(heat_at_start) {
  if (properties_.size() != mesh_->blocks.size()) throw std::logic_error("properties and blocks of the mesh do not match");
  std::vector<Diagnostic> diagnostics;
  for (std::size_t n = 0; n < properties_.size(); ++n) {
    for (Diagnostic& diagnostic : check_combination(properties_[n], kinematics_)) diagnostics.push_back(std::move(diagnostic));
    const CellShape shape = mesh_->blocks[n].shape;
    if (properties_[n].is_rigid() ? topology(shape).dimension != mesh_->dimension - 1 : cell_shape(properties_[n].element) != shape)
      throw std::logic_error("a block's cells are not those of its body's element");
  }
  throw_if_any(*mesh_->comm, diagnostics);
  if (mesh_->dimension != dimension() || space_->rows(0).components != dimension())
    throw std::logic_error("the mesh, its first field and the kinematics do not have the same dimension");

  const std::vector<std::optional<std::size_t>> temperatures = temperatures_of(*space_, properties_);
  for (std::size_t n = 0; n < properties_.size(); ++n) {
    const BlockContext context{*space_, mesh_->blocks[n], static_cast<LocalOrdinal>(n)};
    if (properties_[n].is_rigid()) {
      blocks_.push_back(std::make_unique<RigidBlock>());
      continue;
    }
    blocks_.push_back(make_element_block(context, properties_[n], kinematics_, thickness_, temperatures[n], heat_at_start_));
    know_temperature_ = know_temperature_ || temperatures[n];
    const auto [element, determinant] = blocks_.back()->smallest_reference_determinant();
    if (!(determinant > 0.0))
      diagnostics.push_back({properties_[n].place, fmt::format("body \"{}\": element {} {} is inverted, det J = {:.3g}", properties_[n].name,
                                                               context.block.element_ids[element], element_place(context, element), determinant)});
  }
  throw_if_any(*mesh_->comm, diagnostics);
}

Bodies::~Bodies() = default;

double Bodies::depth(double radius) const { return mortise::depth(kinematics_, thickness_, radius); }

void Bodies::add_internal_force(const Vector& local_displacement, Vector& residual, std::optional<StepFailure>& failure, double time_step) const {
  const HostReadView displacement(local_displacement);
  const HostWriteView force(residual);
  for (const auto& block : blocks_) block->add(displacement.data(), time_step, {{force.data(), space_->rows(0)}}, failure);
}

void Bodies::add_stiffness(const Vector& local_displacement, Matrix& matrix, std::optional<StepFailure>& failure, double factor,
                           double time_step) const {
  const HostReadView displacement(local_displacement);
  const NodalSparsity::Values values = space_->sparsity().open(matrix);
  for (const auto& block : blocks_) block->add(displacement.data(), time_step, {{}, &values, factor}, failure);
  values.close();
}

void Bodies::add_internal_force_and_stiffness(const Vector& local_displacement, Vector& residual, Matrix& matrix, std::optional<StepFailure>& failure,
                                              double factor, double time_step) const {
  const HostReadView displacement(local_displacement);
  const HostWriteView force(residual);
  const NodalSparsity::Values values = space_->sparsity().open(matrix);
  for (const auto& block : blocks_) block->add(displacement.data(), time_step, {{force.data(), space_->rows(0)}, &values, factor}, failure);
  values.close();
}

void Bodies::add_mass(Matrix& matrix, double factor) const {
  const NodalSparsity::Values values = space_->sparsity().open(matrix);
  for (std::size_t n = 0; n < blocks_.size(); ++n)
    if (!properties_[n].is_rigid()) blocks_[n]->add_mass(properties_[n].material->density, values, factor);
  values.close();
}

std::vector<double> Bodies::nodal_masses() const {
  std::vector<double> masses(mesh_->owned_count(), 0.0);
  for (std::size_t n = 0; n < blocks_.size(); ++n)
    if (!properties_[n].is_rigid()) blocks_[n]->add_nodal_masses(properties_[n].material->density, masses);
  return masses;
}

std::vector<double> Bodies::masses() const {
  std::vector<double> mine(mesh_->bodies.size(), 0.0), all(mine.size(), 0.0);
  const std::vector<double> of_nodes = nodal_masses();
  for (std::size_t node = 0; node < of_nodes.size(); ++node) mine[mesh_->body_of_node[node]] += of_nodes[node];
  Teuchos::reduceAll(*mesh_->comm, Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), all.data());
  return all;
}

void Bodies::begin(const Vector& local_unknowns) {
  if (heat_at_start_ == 0.0) return;
  const HostReadView unknowns(local_unknowns);
  for (const auto& block : blocks_) block->begin(unknowns.data());
}

void Bodies::commit(const Vector& local_displacement) {
  const HostReadView displacement(local_displacement);
  for (const auto& block : blocks_) block->commit(displacement.data());
}

void Bodies::serialize(StateArchive& archive) {
  for (std::size_t n = 0; n < blocks_.size(); ++n) blocks_[n]->serialize(archive, fmt::format("body.{}", n));
}

std::size_t Bodies::history_bytes(LocalOrdinal block) const { return blocks_.at(block)->history_bytes(); }

long Bodies::history_evaluations(LocalOrdinal block) const { return blocks_.at(block)->history_evaluations(); }

void Bodies::visit_points(const Vector& local_displacement, const std::function<void(const MaterialPoint&)>& visit) const {
  const HostReadView displacement(local_displacement);
  for (std::size_t n = 0; n < blocks_.size(); ++n) blocks_[n]->visit_points(displacement.data(), mesh_->blocks[n].owned, visit);
}

std::vector<double> Bodies::nodal_volumes(LocalOrdinal block) const {
  std::vector<double> volumes(mesh_->owned_count(), 0.0);
  blocks_.at(block)->add_nodal_volumes(volumes);
  return volumes;
}

std::vector<double> Bodies::lumped_volumes(LocalOrdinal block) const {
  std::vector<double> volumes(mesh_->owned_count(), 0.0);
  blocks_.at(block)->add_nodal_masses(1.0, volumes);
  return volumes;
}

std::vector<double> Bodies::stored_energies(const Vector& local_displacement) const {
  std::vector<double> mine(mesh_->bodies.size(), 0.0), all(mine.size(), 0.0);
  visit_points(local_displacement, [&](const MaterialPoint& point) { mine[mesh_->blocks[point.block].body] += point.weight * point.energy; });
  Teuchos::reduceAll(*mesh_->comm, Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), all.data());
  return all;
}

bool Bodies::heat() const {
  return std::any_of(blocks_.begin(), blocks_.end(), [](const auto& block) { return block->heats(); });
}

std::vector<double> Bodies::heat_powers(const Vector& local_unknowns, double time_step) const {
  std::vector<double> mine(mesh_->bodies.size(), 0.0), all(mine.size(), 0.0);
  const HostReadView unknowns(local_unknowns);
  for (std::size_t n = 0; n < blocks_.size(); ++n)
    mine[mesh_->blocks[n].body] += blocks_[n]->heat(unknowns.data(), time_step, mesh_->blocks[n].owned);
  Teuchos::reduceAll(*mesh_->comm, Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), all.data());
  return all;
}

std::vector<double> Bodies::plastic_works(const Vector& local_displacement) const {
  std::vector<double> mine(mesh_->bodies.size(), 0.0), all(mine.size(), 0.0);
  const HostReadView displacement(local_displacement);
  for (std::size_t n = 0; n < blocks_.size(); ++n)
    if (blocks_[n]->history_bytes() > 0)
      blocks_[n]->visit_points(displacement.data(), mesh_->blocks[n].owned,
                               [&](const MaterialPoint& point) { mine[mesh_->blocks[n].body] += point.weight * point.plastic_work; });
  Teuchos::reduceAll(*mesh_->comm, Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), all.data());
  return all;
}

namespace {

StressComponents components_of(const Matrix3& tensor) { return {tensor(0, 0), tensor(1, 1), tensor(2, 2), tensor(0, 1), tensor(1, 2), tensor(0, 2)}; }

const Matrix3& stress_of(const MaterialPoint& point) { return point.cauchy_stress; }

}  // namespace

std::vector<StressComponents> Bodies::element_means(const Vector& local_displacement, LocalOrdinal block, const PointTensor& tensor) const {
  const LocalOrdinal owned = mesh_->blocks.at(block).owned;
  std::vector<StressComponents> means(owned, StressComponents{});
  std::vector<double> volumes(owned, 0.0);
  const HostReadView displacement(local_displacement);
  blocks_.at(block)->visit_points(displacement.data(), owned, [&](const MaterialPoint& point) {
    const double weight = point.weight * point.volume_ratio;
    const StressComponents components = components_of(tensor(point));
    volumes[point.element] += weight;
    for (std::size_t c = 0; c < components.size(); ++c) means[point.element][c] += weight * components[c];
  });
  for (LocalOrdinal element = 0; element < owned; ++element)
    if (volumes[element] > 0.0)  // a rigid body has no points
      for (double& component : means[element]) component /= volumes[element];
  return means;
}

RCP<MultiVector> Bodies::nodal_means(const Vector& local_displacement, const PointTensor& tensor) const {
  NodalMeans means(mesh_, stress_components());
  const HostReadView displacement(local_displacement);
  for (std::size_t n = 0; n < blocks_.size(); ++n) {
    if (properties_[n].is_rigid()) continue;
    const Block& block = mesh_->blocks[n];
    const Eigen::MatrixXd extrapolation = extrapolation_to_nodes(block.shape, kinematics_);
    // Ghost elements too: every element around an owned node counts.
    blocks_[n]->visit_points(displacement.data(), block.size(), [&](const MaterialPoint& point) {
      const StressComponents components = components_of(tensor(point));
      means.add(block, point.element, point.point, extrapolation, components.data());
    });
  }
  return means.result();
}

Bodies::PointTensor Bodies::strain_of_points() const {
  std::vector<char> is_small;
  for (const BodyProperties& body : properties_)
    is_small.push_back(!body.is_rigid() && std::visit([](const auto& law) { return law.small_strain; }, body.material->law()) ? 1 : 0);
  return [is_small](const MaterialPoint& point) -> Matrix3 {
    const Matrix3& F = point.deformation_gradient;
    if (is_small[point.block] != 0) return 0.5 * (F + F.transpose()) - Matrix3::Identity();
    const Spectrum b = spectral_decomposition(F * F.transpose());
    return in_axes_of(b, logarithmic_strain(b));
  };
}

std::vector<StressComponents> Bodies::element_stresses(const Vector& local_displacement, LocalOrdinal block) const {
  return element_means(local_displacement, block, stress_of);
}

std::vector<StressComponents> Bodies::element_strains(const Vector& local_displacement, LocalOrdinal block) const {
  return element_means(local_displacement, block, strain_of_points());
}

RCP<MultiVector> Bodies::nodal_stresses(const Vector& local_displacement) const { return nodal_means(local_displacement, stress_of); }

RCP<MultiVector> Bodies::nodal_strains(const Vector& local_displacement) const { return nodal_means(local_displacement, strain_of_points()); }

std::vector<double> Bodies::element_plastic_strains(const Vector& local_displacement, LocalOrdinal block) const {
  const LocalOrdinal owned = mesh_->blocks.at(block).owned;
  std::vector<double> strains(owned, 0.0), volumes(owned, 0.0);
  if (history_bytes(block) == 0) return strains;
  const HostReadView displacement(local_displacement);
  blocks_[block]->visit_points(displacement.data(), owned, [&](const MaterialPoint& point) {
    volumes[point.element] += point.weight;
    strains[point.element] += point.weight * point.equivalent_plastic_strain;
  });
  for (LocalOrdinal element = 0; element < owned; ++element) strains[element] /= volumes[element];
  return strains;
}

}  // namespace mortise
