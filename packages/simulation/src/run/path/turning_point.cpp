#include "run/path/turning_point.hpp"

#include <fmt/format.h>

#include <Tpetra_Vector.hpp>
#include <optional>

#include "mortise/core/error.hpp"
#include "run/path/limit_load.hpp"

namespace mortise {
namespace {

/// Momentum over forces, and gaps over facets, at which a state counts as one of the path.
constexpr double on_path = 1e-6;

constexpr int most_iterations = 10, most_points = 8;

/// The step's way from one pseudo-time to the other, mu = 0 to 1, and Newton's directions there.
struct Way {
  const SemiSmoothSystem& system;
  double from, to;
  StepContext context;  ///< of the step

  RCP<Vector> direction(const Vector& x, double mu, ResidualNorms& norms) const {
    const auto result = rcp(new Vector(system.map()));
    StepContext between = context;
    between.time = from + mu * (to - from);
    const SystemEvaluation at = system.evaluate(x, between);
    norms = at.norms();
    system.linearise(at).newton_direction(at.residual(), *result);
    return result;
  }

  /// dx/dmu along the path, as J dx/dmu = -dF/dmu: loads and prescribed motions are taken for linear within the step.
  RCP<Vector> tangent(const Vector& x) const {
    ResidualNorms norms;
    const RCP<Vector> u = direction(x, 1.0, norms);
    u->update(-1.0, *direction(x, 0.0, norms), 1.0);
    return u;
  }
};

/// A state of the path.
struct PathPoint {
  RCP<Vector> x;
  double mu;
  RCP<Vector> tangent;
};

double product(const SemiSmoothSystem& system, const Vector& a, const Vector& b) { return system.unknowns(a)->dot(*system.unknowns(b)); }

/// The state of the path on the plane t . (x - x_p - s t) = 0 across its tangent t at p. Newton's method with mu as one more unknown; none if it
/// fails.
std::optional<PathPoint> state_on_plane(const Way& way, const PathPoint& p, double s) try {
  PathPoint next{rcp(new Vector(*p.x, Teuchos::Copy)), p.mu + s, {}};
  next.x->update(s, *p.tangent, 1.0);
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    ResidualNorms norms;
    const RCP<Vector> correction = way.direction(*next.x, next.mu, norms);
    next.tangent = way.tangent(*next.x);
    if (norms.momentum <= on_path && norms.gap <= on_path && norms.prescribed <= on_path) return next;
    const double change = -product(way.system, *p.tangent, *correction) / product(way.system, *p.tangent, *next.tangent);
    next.x->update(1.0, *correction, change, *next.tangent, 1.0);
    next.mu += change;
  }
  return std::nullopt;
} catch (const StepFailure&) {  // on every rank
  return std::nullopt;
}

/// Near a maximum the path is mu - mu_p = s - s^2/(2 m): at most m/2. That is less than the 1 - mu_p that the step still asks for, if the state on
/// the plane s = 2 (1 - mu_p) has mu < 1. Behind the maximum dx/dmu points back. Close to it dx/dmu is long, so nearer planes are tried too. In front
/// of it, as where points begin to flow and dx/dmu grows, the path is followed on.
bool path_turns_back(const Way& way, const Vector& converged) {
  PathPoint p{rcp(new Vector(converged, Teuchos::Copy)), 0.0, way.tangent(converged)};
  for (int point = 0; point < most_points; ++point) {
    std::optional<PathPoint> next;
    for (const double s : {2.0, 0.5, 0.125, 0.03125})
      if (!next) next = state_on_plane(way, p, s * (1.0 - p.mu));
    if (!next || !(next->mu < 1.0)) return false;
    if (product(way.system, *p.tangent, *next->tangent) < 0.0) return true;
    p = *next;
  }
  return false;
}

}  // namespace

std::string explain_turning_point(const FailedTry& failed, const Model& model, const SemiSmoothSystem& system) {
  if (!failed.linearised || system.parts().fields.size() > 1) return {};  // with heat a path has rates, and no way back
  const Vector& converged = *failed.from.x;
  bool turns = false, loads = false;
  try {
    loads = system.evaluate(converged, failed.context).norms().momentum >= least_load;
    turns = path_turns_back({system, failed.from.context.time, failed.time, failed.context}, converged);
  } catch (const StepFailure&) {  // on every rank: no state to judge by
  }
  if (!turns) return {};
  return fmt::format("no equilibrium beyond this {0}: the {0} has a maximum here, and equilibrium goes on with less of it; {1}",
                     loads ? "load" : "motion", describe_flow(model, *system.unknowns(*failed.linearised->x), *system.unknowns(converged)));
}

}  // namespace mortise
