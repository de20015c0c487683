#include "mortise/solid/bodies.hpp"

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Vector.hpp>
#include <limits>
#include <stdexcept>

#include "element_block.hpp"
#include "host_view.hpp"
#include "mortise/core/dof_map.hpp"

namespace mortise {
namespace {

/// A rigid body has no elements: nothing is computed, nothing remembered.
class RigidBlock final : public ElementBlock {
 public:
  void add_internal_force(const double*, double*, std::optional<StepFailure>&) const override {}
  void add_stiffness(const double*, const NodalSparsity::Values&, double, std::optional<StepFailure>&) const override {}
  void visit_points(const double*, LocalOrdinal, const std::function<void(const MaterialPoint&)>&) const override {}
  void commit(const double*) override {}
  void serialize(StateArchive&, const std::string&) override {}
  std::size_t history_bytes() const override { return 0; }
  long history_evaluations() const override { return 0; }
  void add_nodal_volumes(std::vector<double>&) const override {}
  std::pair<LocalOrdinal, double> smallest_reference_determinant() const override { return {-1, std::numeric_limits<double>::infinity()}; }
};

}  // namespace

Bodies::Bodies(RCP<const Mesh> mesh, Kinematics kinematics, double thickness, std::vector<BodyProperties> bodies)
    : mesh_(std::move(mesh)), kinematics_(kinematics), thickness_(thickness), properties_(std::move(bodies)) {
  if (properties_.size() != mesh_->blocks.size()) throw std::logic_error("bodies and blocks of the mesh do not match");
  std::vector<Diagnostic> diagnostics;
  for (std::size_t n = 0; n < properties_.size(); ++n) {
    for (Diagnostic& diagnostic : check_combination(properties_[n], kinematics_)) diagnostics.push_back(std::move(diagnostic));
    const CellShape shape = mesh_->blocks[n].shape;
    if (properties_[n].is_rigid() ? topology(shape).dimension != mesh_->dimension - 1 : cell_shape(properties_[n].element) != shape)
      throw std::logic_error("a block's cells are not those of its body's element");
  }
  throw_if_any(*mesh_->comm, diagnostics);
  if (mesh_->dimension != dimension()) throw std::logic_error("the mesh and the kinematics do not have the same dimension");

  dofs_ = make_dof_map(*mesh_->owned_nodes, dimension());
  local_dofs_ = make_dof_map(*mesh_->local_nodes, dimension());
  ghost_import_ = rcp(new Import(dofs_, local_dofs_));
  sparsity_ = std::make_unique<NodalSparsity>(*mesh_, dofs_, local_dofs_);
  for (std::size_t n = 0; n < properties_.size(); ++n) {
    const BlockContext context{*mesh_, mesh_->blocks[n], static_cast<LocalOrdinal>(n), *sparsity_};
    if (properties_[n].is_rigid()) {
      blocks_.push_back(std::make_unique<RigidBlock>());
      continue;
    }
    blocks_.push_back(make_element_block(context, properties_[n], kinematics_, thickness_));
    const auto [element, determinant] = blocks_.back()->smallest_reference_determinant();
    if (!(determinant > 0.0))
      diagnostics.push_back({properties_[n].place, fmt::format("body \"{}\": element {} {} is inverted, det J = {:.3g}", properties_[n].name,
                                                               context.block.element_ids[element], element_place(context, element), determinant)});
  }
  throw_if_any(*mesh_->comm, diagnostics);
}

Bodies::~Bodies() = default;

double Bodies::depth(double radius) const {
  if (kinematics_ == Kinematics::three_dimensional) return 1.0;
  return kinematics_ == Kinematics::axisymmetric ? 2.0 * EIGEN_PI * radius : thickness_;
}

void Bodies::add_internal_force(const Vector& local_displacement, Vector& residual, std::optional<StepFailure>& failure) const {
  const HostReadView displacement(local_displacement);
  const HostWriteView force(residual);
  for (const auto& block : blocks_) block->add_internal_force(displacement.data(), force.data(), failure);
}

void Bodies::add_stiffness(const Vector& local_displacement, Matrix& matrix, std::optional<StepFailure>& failure, double factor) const {
  const HostReadView displacement(local_displacement);
  const NodalSparsity::Values values = sparsity_->open(matrix);
  for (const auto& block : blocks_) block->add_stiffness(displacement.data(), values, factor, failure);
  values.close();
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

std::vector<double> Bodies::stored_energies(const Vector& local_displacement) const {
  std::vector<double> mine(blocks_.size(), 0.0), all(blocks_.size(), 0.0);
  visit_points(local_displacement, [&](const MaterialPoint& point) { mine[point.block] += point.weight * point.energy; });
  Teuchos::reduceAll(*mesh_->comm, Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), all.data());
  return all;
}

std::vector<double> Bodies::plastic_works(const Vector& local_displacement) const {
  std::vector<double> mine(blocks_.size(), 0.0), all(blocks_.size(), 0.0);
  const HostReadView displacement(local_displacement);
  for (std::size_t n = 0; n < blocks_.size(); ++n)
    if (blocks_[n]->history_bytes() > 0)
      blocks_[n]->visit_points(displacement.data(), mesh_->blocks[n].owned,
                               [&](const MaterialPoint& point) { mine[n] += point.weight * point.plastic_work; });
  Teuchos::reduceAll(*mesh_->comm, Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), all.data());
  return all;
}

namespace {

/// Adds the current volume and the stress times it.
void add_weighted_stress(const MaterialPoint& point, double& volume, StressComponents& stress) {
  const double weight = point.weight * point.volume_ratio;
  volume += weight;
  stress[0] += weight * point.cauchy_stress(0, 0);
  stress[1] += weight * point.cauchy_stress(1, 1);
  stress[2] += weight * point.cauchy_stress(2, 2);
  stress[3] += weight * point.cauchy_stress(0, 1);
  stress[4] += weight * point.cauchy_stress(1, 2);
  stress[5] += weight * point.cauchy_stress(0, 2);
}

}  // namespace

std::vector<StressComponents> Bodies::element_stresses(const Vector& local_displacement, LocalOrdinal block) const {
  const LocalOrdinal owned = mesh_->blocks.at(block).owned;
  std::vector<StressComponents> stresses(owned, StressComponents{});
  std::vector<double> volumes(owned, 0.0);
  const HostReadView displacement(local_displacement);
  blocks_.at(block)->visit_points(displacement.data(), owned,
                                  [&](const MaterialPoint& point) { add_weighted_stress(point, volumes[point.element], stresses[point.element]); });
  for (LocalOrdinal element = 0; element < owned; ++element)
    if (volumes[element] > 0.0)  // a rigid body has no stress
      for (double& component : stresses[element]) component /= volumes[element];
  return stresses;
}

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

RCP<MultiVector> Bodies::nodal_stresses(const Vector& local_displacement) const {
  const LocalOrdinal owned = mesh_->owned_count();
  std::vector<StressComponents> sums(owned, StressComponents{});
  std::vector<double> volumes(owned, 0.0);
  const HostReadView displacement(local_displacement);
  for (std::size_t n = 0; n < blocks_.size(); ++n) {
    const Block& block = mesh_->blocks[n];
    // Ghost elements too: every element around an owned node counts.
    blocks_[n]->visit_points(displacement.data(), block.size(), [&](const MaterialPoint& point) {
      const LocalOrdinal* nodes = block.nodes(point.element);
      for (int a = 0; a < block.nodes_per_element; ++a)
        if (nodes[a] < owned) add_weighted_stress(point, volumes[nodes[a]], sums[nodes[a]]);
    });
  }
  auto result = rcp(new MultiVector(mesh_->owned_nodes, stress_components()));
  auto view = result->getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (LocalOrdinal node = 0; node < owned; ++node)
    for (int c = 0; c < stress_components(); ++c) view(node, c) = volumes[node] > 0.0 ? sums[node][c] / volumes[node] : 0.0;
  return result;
}

}  // namespace mortise
