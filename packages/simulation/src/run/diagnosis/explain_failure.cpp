#include "run/diagnosis/explain_failure.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <limits>
#include <vector>

#include "model/rigid_mode_names.hpp"
#include "mortise/core/symmetric_spectrum.hpp"
#include "mortise/solid/bodies.hpp"
#include "run/diagnosis/held_bodies.hpp"

namespace mortise {
namespace {

/// Forces over stiffness times motion below which nothing holds a motion, where all bodies are alike. Contact normals that turn with the loads give
/// values of the size of strains; what contact holds gives values of the size of one.
constexpr double hardly_resisted = 1e-4;

/// Of the softest body over that of the stiffest one: contact is as stiff as the softer side.
double ratio_of_moduli(const Bodies& bodies) {
  double least = std::numeric_limits<double>::max(), largest = 0.0;
  for (const auto& body : bodies.properties())
    if (!body.is_rigid()) {
      least = std::min(least, body.material->youngs_modulus);
      largest = std::max(largest, body.material->youngs_modulus);
    }
  return largest > 0.0 ? least / largest : 1.0;
}

/// A vector is kept for each of their motions: if more bodies lie loose, nothing is reported.
constexpr std::size_t most_loose_bodies = 10;

/// The rigid body modes, with what the rotations of reference points do.
RCP<MultiVector> modes_with_points(const Model& model, const Vector& displacement) {
  const Mesh& mesh = *model.mesh();
  const RCP<MultiVector> modes = rigid_body_modes(*model.bodies(), displacement);
  const auto values = modes->getLocalViewHost(Tpetra::Access::ReadWrite);
  const int dimension = mesh.dimension, rotations = dimension == 2 ? 1 : 3;
  for (const ReferencePoint& point : mesh.reference_points) {
    if (point.rotation_node < 0 || point.rotation_node >= mesh.owned_count()) continue;
    for (int i = 0; i < dimension; ++i)
      for (int mode = 0; mode < dimension + rotations; ++mode)
        values(model.space().row(point.rotation_node, i), mode) = i < rotations && mode == dimension + i ? point.arm : 0.0;
  }
  return modes;
}

std::vector<PairHold> pairs_now(const std::vector<int>& bodies, const Model& model, const SystemEvaluation& evaluation) {
  const NodePlaces at = places_at(model, evaluation.x());
  return contact_hold(model, modes_at(model, bodies, at), at, evaluation.contact_laws()).pairs;
}

std::string describe_free_motions(const std::vector<int>& bodies, const Model& model, const SemiSmoothSystem& system,
                                  const SystemEvaluation& evaluation, const ContactRecord& record) {
  const Mesh& mesh = *model.mesh();
  const RCP<MultiVector> modes = modes_with_points(model, *system.unknowns(evaluation.x()));
  const int per_body = static_cast<int>(modes->getNumVectors()), count = per_body * static_cast<int>(bodies.size());

  // Columns of A; rows of C as forces.
  MultiVector A(system.map(), count);
  const RCP<const Vector> weights = model.contact()->weights();
  const SystemLinearisation linearisation = system.linearise(evaluation);
  for (int column = 0; column < count; ++column) {
    Vector motion(system.map());
    {
      const auto from = modes->getVector(column % per_body)->getLocalViewHost(Tpetra::Access::ReadOnly);
      const auto to = motion.getLocalViewHost(Tpetra::Access::ReadWrite);
      for (std::size_t dof = 0; dof < from.extent(0); ++dof)
        if (mesh.body_of_node[model.space().place(static_cast<LocalOrdinal>(dof)).node] == bodies[column / per_body]) to(dof, 0) = from(dof, 0);
    }
    const RCP<Vector> force = A.getVectorNonConst(column);
    linearisation.apply(motion, *force);
    const RCP<Vector> conditions = system.multipliers(*force);
    conditions->elementWiseMultiply(1.0, *weights, *conditions, 0.0);
    force->scale(1.0 / (system.stiffness_scale() * motion.norm2()));
  }

  MultiVector gram(rcp(new Map(count, 0, mesh.comm, Tpetra::LocallyReplicated)), count);
  gram.multiply(Teuchos::TRANS, Teuchos::NO_TRANS, 1.0, A, A, 0.0);
  Eigen::MatrixXd products(count, count);
  const auto values = gram.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (int column = 0; column < count; ++column)
    for (int row = 0; row < count; ++row) products(row, column) = values(row, column);
  const SymmetricSpectrum spectrum = symmetric_spectrum(products);
  const double bound = hardly_resisted * ratio_of_moduli(*model.bodies());
  const auto found = (spectrum.values.array() < bound * bound).count();
  auto motions = distinct_modes(spectrum.vectors.leftCols(found), per_body);
  std::sort(motions.begin(), motions.end());
  if (motions.empty()) return {};
  const bool axisymmetric = model.bodies()->kinematics() == Kinematics::axisymmetric;
  std::vector<int> which;
  std::vector<std::vector<std::string>> names;
  for (const auto& [body, mode] : motions) {
    if (which.empty() || which.back() != bodies[body]) {
      which.push_back(bodies[body]);
      names.emplace_back();
    }
    names.back().emplace_back(rigid_mode_name(mesh.dimension, axisymmetric, mode));
  }
  std::vector<std::string> free;
  for (std::size_t b = 0; b < which.size(); ++b) free.push_back(fmt::format("body '{}' ({})", mesh.bodies[which[b]].name, fmt::join(names[b], ", ")));
  return fmt::format("free to move: {}; {}", fmt::join(free, ", "), record.describe(model, which, pairs_now(bodies, model, evaluation)));
}

}  // namespace

std::string describe_held_bodies(const FailedTry& failed, const Model& model, const SemiSmoothSystem& system, const ContactRecord& record) {
  const std::vector<int> bodies = bodies_held_by_contact_only(model);
  if (bodies.empty() || bodies.size() > most_loose_bodies || !failed.linearised) return {};
  const SystemEvaluation evaluation = system.evaluate(*failed.linearised->x, failed.linearised->context);
  return fmt::format("nothing but contact holds {}; in the last iterate {}", names_of_bodies(*model.mesh(), bodies),
                     record.describe(model, bodies, pairs_now(bodies, model, evaluation)));
}

std::string explain_failure(const FailedTry& failed, const Model& model, const SemiSmoothSystem& system, const ContactRecord& record) {
  const std::vector<int> bodies = bodies_held_by_contact_only(model);
  if (bodies.empty() || bodies.size() > most_loose_bodies || !failed.linearised) return {};
  return describe_free_motions(bodies, model, system, system.evaluate(*failed.linearised->x, failed.linearised->context), record);
}

}  // namespace mortise
