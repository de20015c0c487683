#include "run/path/limit_load.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Tpetra_Import.hpp>
#include <Tpetra_Vector.hpp>
#include <optional>
#include <vector>

#include "mortise/core/over_ranks.hpp"
#include "mortise/solid/bodies.hpp"

namespace mortise {
namespace {

/// Momentum over forces up to which an iterate is close to equilibrium: statements on its stiffness hold within that share of the load.
constexpr double near_equilibrium = 1e-2;

/// Stiffness over elastic stiffness up to which nothing resists: strain hardening leaves H / (E + H), in metals 1e-3 and more.
constexpr double hardly_stiff = 1e-4;

bool newton_came_to_no_end(FailureKind kind) {
  return kind == FailureKind::line_search || kind == FailureKind::too_many_iterations || kind == FailureKind::diverged ||
         kind == FailureKind::cycling_active_set;
}

/// u: K u = the load that the step adds, at an evaluation; `load` holds its negative, 0 on prescribed rows. Each solve has the rows of a contact's
/// conditions, so there u is the difference of two.
RCP<Vector> answer_to_load(const SemiSmoothSystem& system, const SystemEvaluation& at, const Vector& load) {
  const SystemLinearisation linearisation = system.linearise(at);
  const auto direction = [&](const Vector& F) {
    const auto u = rcp(new Vector(system.map()));
    linearisation.newton_direction(F, *u);
    return u;
  };
  if (!system.parts().contact) return direction(load);
  Vector F(at.residual(), Teuchos::Copy);
  const RCP<Vector> without = direction(F);
  F.update(1.0, load, 1.0);
  const RCP<Vector> u = direction(F);
  u->update(-1.0, *without, 1.0);
  return u;
}

/// u^T K u over u^T K_e u; none where the step adds no load or the failed try is far from equilibrium.
std::optional<double> remaining_stiffness(const SemiSmoothSystem& system, const FailedTry& tried) {
  const SystemEvaluation failed = system.evaluate(*tried.linearised->x, tried.linearised->context);
  if (!(failed.norms().momentum <= near_equilibrium)) return std::nullopt;
  // The last state is in equilibrium with the last load: what it lacks now is what the step adds.
  const SystemEvaluation converged = system.evaluate(*tried.from.x, tried.context);
  if (!(converged.norms().momentum >= least_load)) return std::nullopt;
  Vector load(converged.residual(), Teuchos::Copy);
  if (const auto& constraints = system.parts().constraints) {  // supports that move are no loads
    const auto rows = load.getLocalViewHost(Tpetra::Access::ReadWrite);
    for (const auto* dofs : {&constraints->prescribed(), &constraints->dependent()})
      for (const LocalOrdinal dof : *dofs) rows(dof, 0) = 0.0;
  }
  system.multipliers(load)->putScalar(0.0);
  const RCP<Vector> u = answer_to_load(system, failed, load);
  system.multipliers(*u)->putScalar(0.0);
  const double work = -u->dot(load);
  Vector force(system.map());
  system.linearise(converged).apply(*u, force);
  const double elastic = system.unknowns(*u)->dot(*system.unknowns(force));
  if (!(elastic > 0.0)) return std::nullopt;
  return work / elastic;
}

/// Plastic strain at each quadrature point of this rank, and its block and volume.
struct PlasticPoint {
  LocalOrdinal block;
  double volume, strain;
};

std::vector<PlasticPoint> plastic_points(const Bodies& bodies, const Vector& displacement) {
  Vector local(bodies.space().local_dofs());
  local.doImport(displacement, *bodies.space().ghost_import(), Tpetra::INSERT);
  std::vector<PlasticPoint> points;
  bodies.visit_points(local, [&](const MaterialPoint& point) {
    points.push_back({bodies.mesh()->blocks[point.block].body, point.weight, point.equivalent_plastic_strain});
  });
  return points;
}

}  // namespace

std::string describe_flow(const Model& model, const Vector& failed, const Vector& converged) {
  const Mesh& mesh = *model.mesh();
  const auto before = plastic_points(*model.bodies(), converged), after = plastic_points(*model.bodies(), failed);
  std::vector<double> mine(2 * mesh.bodies.size(), 0.0);
  for (std::size_t point = 0; point < after.size(); ++point) {
    mine[2 * after[point].block] += after[point].volume;
    if (after[point].strain > before[point].strain) mine[2 * after[point].block + 1] += after[point].volume;
  }
  const std::vector<double> all = sum_over_ranks(*mesh.comm, mine);
  std::vector<std::string> shares;
  for (std::size_t block = 0; block < mesh.bodies.size(); ++block)
    if (all[2 * block + 1] > 0.0)
      shares.push_back(fmt::format("{:.3g} % of body '{}'", 100.0 * all[2 * block + 1] / all[2 * block], mesh.bodies[block].name));
  return shares.empty() ? "no point flows, so the structure buckles or snaps through" : fmt::format("plastic flow in {}", fmt::join(shares, ", "));
}

std::string explain_limit_load(const FailedTry& failed, const Model& model, const SemiSmoothSystem& system) {
  if (!newton_came_to_no_end(failed.failure.kind()) || !failed.linearised) return {};
  if (system.parts().fields.size() > 1) return {};  // of other units
  std::optional<double> stiffness;
  try {
    stiffness = remaining_stiffness(system, failed);
  } catch (const StepFailure&) {  // on every rank: no state to judge by
    return {};
  }
  if (!stiffness || !(*stiffness < hardly_stiff)) return {};
  return fmt::format("no equilibrium beyond this load: against more of it the stiffness is {:.1e} of the elastic one; {}", *stiffness,
                     describe_flow(model, *system.unknowns(*failed.linearised->x), *system.unknowns(*failed.from.x)));
}

}  // namespace mortise
