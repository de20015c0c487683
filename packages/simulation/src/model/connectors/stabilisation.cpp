#include "model/connectors/stabilisation.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <cmath>
#include <limits>

#include "mortise/material/materials.hpp"
#include "surfaces/body_surfaces.hpp"

namespace mortise {
namespace {

/// [owned nodes] integral of N_a E dV, see Stabilisation. Collective.
std::vector<double> moduli_of_nodes(const Bodies& bodies, const std::vector<char>& stabilised) {
  const Mesh& mesh = *bodies.mesh();
  std::vector<double> result(static_cast<std::size_t>(mesh.owned_count()), 0.0);
  double softest = std::numeric_limits<double>::max();
  for (std::size_t block = 0; block < mesh.blocks.size(); ++block) {
    const BodyProperties& body = bodies.properties()[block];
    if (body.is_rigid()) continue;
    softest = std::min(softest, body.material->youngs_modulus);
    if (!stabilised[static_cast<std::size_t>(mesh.blocks[block].body)]) continue;
    const std::vector<double> volumes = bodies.lumped_volumes(static_cast<LocalOrdinal>(block));
    for (std::size_t node = 0; node < volumes.size(); ++node) result[node] += body.material->youngs_modulus * volumes[node];
  }
  const std::vector<Box3> boxes = body_boxes(mesh, reference_places(mesh));
  std::vector<double> mine(mesh.bodies.size(), 0.0), counts(mine.size());
  for (LocalOrdinal node = 0; node < mesh.owned_body_count(); ++node) mine[static_cast<std::size_t>(mesh.body_of_node[node])] += 1.0;
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), counts.data());
  for (LocalOrdinal node = 0; node < mesh.owned_body_count(); ++node) {
    const auto body = static_cast<std::size_t>(mesh.body_of_node[node]);
    if (!mesh.bodies[body].is_surface || !stabilised[body] || softest == std::numeric_limits<double>::max()) continue;
    const double side = (boxes[body].high - boxes[body].low).norm() / std::sqrt(mesh.dimension);
    const double depth = bodies.depth(0.5 * (boxes[body].low[0] + boxes[body].high[0]));
    result[static_cast<std::size_t>(node)] = softest * std::pow(side, mesh.dimension) * depth / counts[body];
  }
  return result;
}

}  // namespace

Stabilisation::Stabilisation(std::shared_ptr<const Bodies> bodies, const std::vector<char>& stabilised, const StabilisationOptions& options,
                             double end_time, double length, const Timers& timers)
    : CountedContribution("stabilisation", timers),
      bodies_(std::move(bodies)),
      viscosities_(moduli_of_nodes(*bodies_, stabilised)),
      until_(options.until.value_or(end_time)),
      memory_(bodies_),
      force_(rcp(new Vector(bodies_->space().dofs()))) {
  for (double& one : viscosities_) one *= options.factor * until_ / (length * length);
}

RCP<Vector> Stabilisation::force_at(const Configuration& at) const {
  const auto result = rcp(new Vector(bodies_->space().dofs()));
  const double share = this->share(at.time);
  if (share == 0.0) return result;
  const RCP<const Vector> velocity = memory_.at(at);
  const auto v = velocity->getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto f = result->getLocalViewHost(Tpetra::Access::ReadWrite);
  for (LocalOrdinal node = 0; node < static_cast<LocalOrdinal>(viscosities_.size()); ++node)
    for (int i = 0; i < bodies_->dimension(); ++i) {
      const LocalOrdinal row = bodies_->space().row(node, i);
      f(row, 0) = share * viscosities_[static_cast<std::size_t>(node)] * v(row, 0);
    }
  return result;
}

void Stabilisation::add_residual(const Configuration& at, Vector& residual, std::optional<StepFailure>&) {
  const auto timer = count("stabilisation");
  residual.update(1.0, *force_at(at), 1.0);
}

void Stabilisation::add_jacobian(const Configuration& at, const JacobianWeights& weights, Matrix& jacobian, std::optional<StepFailure>&) {
  const auto timer = count("stabilisation");
  const double factor = weights.unknowns * share(at.time) * memory_.per_time(at);
  if (factor == 0.0) return;
  for (LocalOrdinal node = 0; node < static_cast<LocalOrdinal>(viscosities_.size()); ++node) {
    const double value = factor * viscosities_[static_cast<std::size_t>(node)];
    for (int i = 0; i < bodies_->dimension() && value != 0.0; ++i) {
      const LocalOrdinal row = bodies_->space().row(node, i);
      jacobian.sumIntoLocalValues(row, 1, &value, &row);
    }
  }
}

void Stabilisation::commit(const Configuration& at) {
  force_ = force_at(at);
  const RCP<const Vector> change = memory_.change(at)->offsetView(bodies_->space().dofs(), 0);
  work_ += force_->dot(*change);
  largest_force_ = std::max(largest_force_, force_->norm2());
  memory_.accept(at, *memory_.at(at));
}

void Stabilisation::serialize(StateArchive& archive) {
  memory_.serialize(archive, "stabilisation");
  mortise::serialize(archive, "stabilisation.force", "dofs", *force_);
  mortise::serialize(archive, "stabilisation.work", work_);
  mortise::serialize(archive, "stabilisation.largest_force", largest_force_);
}

}  // namespace mortise
