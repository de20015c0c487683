#include "model/precision.hpp"

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <algorithm>
#include <cmath>
#include <limits>

#include "mortise/mesh/sets.hpp"
#include "mortise/solid/bodies.hpp"

namespace mortise {
namespace {

/// Distance of the model from the origin over its size from which on contact measures from its middle.
constexpr double far_away = 1e3;

/// Uncertainty of tractions over the master's modulus from which on the log mentions it.
constexpr double uncertain = 1e-6;

/// Least and largest coordinate of the reference positions in a direction, over all ranks.
std::array<double, 2> range(const Mesh& mesh, int direction) {
  double mine[2] = {std::numeric_limits<double>::max(), std::numeric_limits<double>::max()}, all[2];  // least, minus the largest
  for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node) {
    mine[0] = std::min(mine[0], mesh.coordinates[node][direction]);
    mine[1] = std::min(mine[1], -mesh.coordinates[node][direction]);
  }
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MIN, 2, mine, all);
  return {all[0], -all[1]};
}

/// Young's modulus of the stiffest body of a side set, over all ranks; 0 if all are rigid.
double stiffest(const Model& model, const Located<std::string>& set) {
  double mine = 0.0, largest = 0.0;
  for (const Side& side : require_side_set(*model.mesh(), set).sides) {
    const BodyProperties& body = model.bodies()->properties()[side.block];
    if (!body.is_rigid()) mine = std::max(mine, body.material->youngs_modulus);
  }
  Teuchos::reduceAll(*model.mesh()->comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(largest));
  return largest;
}

}  // namespace

std::array<double, 3> contact_origin(const Mesh& mesh, double length, bool axisymmetric) {
  std::array<double, 3> origin{};
  for (int i = axisymmetric ? 1 : 0; i < mesh.dimension; ++i) {
    const auto [least, largest] = range(mesh, i);
    const double middle = 0.5 * (least + largest);
    if (std::abs(middle) > far_away * length) origin[i] = middle;
  }
  return origin;
}

void report_precision(const Model& model, const Scene& scene, RunLog& log) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  const MeshSize& size = model.size();
  const auto origin = contact_origin(*model.mesh(), size.length, scene.kinematics == Kinematics::axisymmetric);
  const double away = std::hypot(origin[0], origin[1], origin[2]);
  if (away > 0.0)
    log.warning(
        fmt::format("the model is {:.3g} away from the origin, {:.3g} times its size: its meshes are known to {:.1e} of their shortest side only. "
                    "Contact measures positions from ({:.9g}, {:.9g}, {:.9g}), and so do its messages",
                    away, away / size.length, epsilon * away / size.shortest_side, origin[0], origin[1], origin[2]));
  for (const auto& pair : scene.contact) {
    const double slave = stiffest(model, pair.value.slave), master = stiffest(model, pair.value.master);
    if (master == 0.0) continue;
    // Displacements are known to eps times the length, strains of the slave to that over the side of an element.
    const double error = epsilon * slave / master * size.length / size.shortest_side;
    if (error > uncertain)
      log.warning(fmt::format(
          "{}:{}: {}: the slave \"{}\" is {:.1e} times as stiff as the master \"{}\": round-off of its displacements leaves its tractions "
          "uncertain by {:.1e} of the master's Young's modulus; please exchange slave and master",
          pair.place.file, pair.place.line, pair.place.path, pair.value.slave.value, slave / master, pair.value.master.value, error));
  }
}

}  // namespace mortise
